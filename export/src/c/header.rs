//! The header of a program.

use std::fmt::Write as _;

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;

use super::Text;
use crate::export::{CONSTANTS, Export, INPUTS, PARAMETERS};
use crate::number::Precision;
use crate::program::{Function, Program, Struct};

pub(super) fn header<M: Mechanism, P: Precision, C: TracedCoordinates<M>>(
    text: &Text,
    export: &Export<M, P, C>,
) -> String {
    let (n, u, program) = (&text.name, &text.upper, &export.program);
    let mut header = format!(
        "\
/*
 * The mechanism {mechanism}, written by holonom-export {version}.
 *
 * Functions allocate nothing, keep nothing and call math.h alone; a function may be called from
 * several threads at once. Compile without -ffast-math. The numbers are those of Rust to the last
 * bit with -ffp-contract=off, where both round a b + c the same number of times.
 */
#ifndef {u}_H
#define {u}_H

/* In CUDA and HIP all functions are there for the device as well. */
#if defined(__CUDACC__) || defined(__HIPCC__)
#define {u}_FUNCTION __host__ __device__
#else
#define {u}_FUNCTION
#endif

/* Structs of one call do not overlap. One that is read and written, such as the state of a step, is
 * handed over once. */
#if defined(__cplusplus) || defined(_MSC_VER)
#define {u}_RESTRICT __restrict
#else
#define {u}_RESTRICT restrict
#endif

#ifdef __cplusplus
extern \"C\" {{
#endif

/* The type of all numbers. The program was written for {precision}. */
typedef {precision} {n}_real;

/* What became of a call. States that it was to write are as before unless it is {u}_OK. */
typedef enum {n}_status {{
    {u}_OK = 0,
    /* A step that is not positive, or below the resolution of the time where laws depend on it. */
    {u}_BAD_STEP = 1,
    /* Equations depend on each other here: their solution has no digit left. */
    {u}_SINGULAR = 2,
    /* A number that is not finite. */
    {u}_NOT_FINITE = 3,
    /* A step would pass a limit of a joint: take a shorter one up to it. */
    {u}_LIMIT = 4,
    /* A projection that has not converged. */
    {u}_NOT_CONVERGED = 5,
    /* A joint is open, or its bodies move against it. */
    {u}_OPEN = 6
}} {n}_status;

",
        mechanism = text.mechanism,
        version = env!("CARGO_PKG_VERSION"),
        precision = if P::IS_SINGLE { "float" } else { "double" },
    );
    for of in &program.structs {
        declare(text, of, &mut header);
    }
    functions(text, program, &mut header);
    header.push_str("#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
    header
}

fn declare(text: &Text, of: &Struct, header: &mut String) {
    if of.members.is_empty() {
        return;
    }
    let name = text.named(of.name);
    let about = comment(&of.about);
    let _ = writeln!(header, "/* {about} */\ntypedef struct {name} {{");
    for member in &of.members {
        let length = member
            .length
            .map_or_else(String::new, |length| format!("[{length}]"));
        let about = if member.about.is_empty() {
            String::new()
        } else {
            format!(" /* {} */", comment(&member.about))
        };
        let _ = writeln!(
            header,
            "    {} {}{length};{about}",
            text.real(),
            member.name
        );
    }
    let _ = writeln!(header, "}} {name};\n");
}

/// A text within a comment: it neither ends there nor begins another one.
pub(super) fn comment(text: &str) -> String {
    let line = text.replace(['\n', '\r', '\\'], " ");
    line.replace("*/", "* /").replace("/*", "/ *")
}

/// What a function of the program that users call begins with.
pub(super) fn signature(text: &Text, program: &Program, function: &Function) -> String {
    let result = if function.is_checked {
        text.named("status")
    } else if function.returned.is_some() {
        text.real()
    } else {
        "void".to_owned()
    };
    let name = text.named(&function.name);
    let declared = text.declared(program, &function.arguments);
    format!("{}_FUNCTION {result} {name}({declared})", text.upper)
}

fn functions(text: &Text, program: &Program, header: &mut String) {
    let (n, u) = (&text.name, &text.upper);
    let has = |place: usize| !program.structs[place].members.is_empty();
    for (place, name) in [(PARAMETERS, "parameters"), (INPUTS, "inputs")] {
        if has(place) {
            let _ = writeln!(
                header,
                "/* The {name} of the mechanism that was exported. */\n{u}_FUNCTION void {n}_default_{name}({n}_{name} *{name});\n"
            );
        }
    }
    let constants = if has(CONSTANTS) {
        format!("const {n}_constants *{u}_RESTRICT constants, ")
    } else {
        String::new()
    };
    let _ = writeln!(
        header,
        "/* The state in which the mechanism begins, at the time 0. */\n{u}_FUNCTION void {n}_init({n}_state *state);\n"
    );
    for function in program
        .functions
        .iter()
        .filter(|function| function.is_public)
    {
        if function.name == "prepare" && !has(CONSTANTS) {
            continue;
        }
        if function.name == "set_inputs" && !has(CONSTANTS) {
            continue;
        }
        let _ = writeln!(
            header,
            "/* {} */\n{};\n",
            comment(&function.about),
            signature(text, program, function)
        );
    }
    let _ = writeln!(
        header,
        "/* The rates of a state at its time. */\n{u}_FUNCTION {n}_status {n}_rates({constants}const {n}_state *{u}_RESTRICT state, {n}_slope *{u}_RESTRICT slope);\n"
    );
}
