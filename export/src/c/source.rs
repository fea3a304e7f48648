//! The functions of a program.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use holonom::Mechanism;
use holonom::mechanism::TracedCoordinates;

use super::Text;
use super::body::{body, number};
use super::header::{comment, signature};
use crate::export::{CONSTANTS, Export, INPUTS, PARAMETERS, SLOPE, STATE};
use crate::number::Precision;
use crate::program::Struct;
use crate::values::Value;

pub(super) fn source<M: Mechanism, P: Precision, C: TracedCoordinates<M>>(
    text: &Text,
    export: &Export<M, P, C>,
) -> String {
    let (mut functions, mut support) = (String::new(), BTreeSet::new());
    let program = &export.program;
    let has_constants = !program.structs[CONSTANTS].members.is_empty();
    for function in &program.functions {
        let takes = ["prepare", "set_inputs"].contains(&function.name.as_str());
        if takes && !has_constants {
            continue;
        }
        let written = body(text, program, function, &mut support);
        let kept = if function.is_public { "" } else { "static " };
        let about = if function.is_public {
            String::new()
        } else {
            format!("/* {} */\n", comment(&function.about))
        };
        let signature = signature(text, program, function);
        let unused = unused(text, program, function, &written);
        let _ = writeln!(
            functions,
            "{about}{kept}{signature}\n{{\n{unused}{written}}}\n"
        );
    }
    wrappers(text, export, &mut functions);
    let mut all = support.clone();
    for support in &support {
        all.extend(support.calls());
    }
    let helpers: Vec<String> = all.iter().map(|support| support.written(text)).collect();
    format!(
        "\
/* The mechanism {mechanism}, written by holonom-export {version}: see {n}.h. */
#include \"{n}.h\"

#if !defined(__CUDACC_RTC__) && !defined(__HIPCC_RTC__)
#include <math.h>
#elif !defined(HUGE_VAL)
#define HUGE_VAL __int_as_float(0x7f800000)
#endif

{alone}/* No product and sum is rounded at once unless it is said. */
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#define REAL(x) (({n}_real)(x))

{helpers}
{functions}{no_more}#undef REAL
",
        mechanism = text.mechanism,
        version = env!("CARGO_PKG_VERSION"),
        n = text.name,
        helpers = helpers.join("\n"),
        no_more = if export.has_few_turns() { NO_MORE } else { "" },
        alone = if export.has_few_turns() { ALONE } else { "" },
    )
}

/// What keeps gcc from putting few numbers side by side. By `benches/c/run`, with these lines and
/// without: a step of a four-bar takes 106 and 152 ns, of a UR5, which has six turns, 400 and 357.
const ALONE: &str = "\
/* Numbers that gcc puts side by side in one register pass through memory to be taken apart. */
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#pragma GCC push_options
#pragma GCC optimize (\"no-tree-slp-vectorize\")
#endif

";

/// The end of [`ALONE`].
const NO_MORE: &str = "\
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#pragma GCC pop_options
#endif
";

/// Statements that say of arguments that they are not used.
fn unused(
    text: &Text,
    program: &crate::program::Program,
    function: &crate::program::Function,
    written: &str,
) -> String {
    let declared = text.declared(program, &function.arguments);
    let names = function.arguments.iter().map(|argument| argument.name);
    let is_declared = |name: &&str| {
        declared.split(", ").any(|declared| {
            declared.trim_end().ends_with(&format!("*{name}"))
                || declared.ends_with(&format!(" {name}"))
        })
    };
    // A member of that name is no use.
    let is_used = |name: &str| {
        written.match_indices(name).any(|(at, _)| {
            let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let (before, after) = (&written[..at], &written[at + name.len()..]);
            !before.ends_with(is_word)
                && !before.ends_with("->")
                && !before.ends_with('.')
                && !after.starts_with(is_word)
        })
    };
    let mut unused: Vec<&str> = names
        .filter(is_declared)
        .filter(|name| !is_used(name))
        .collect();
    unused.dedup();
    unused
        .iter()
        .map(|name| format!("    (void){name};\n"))
        .collect()
}

/// What is no straight line.
fn wrappers<M: Mechanism, P: Precision, C: TracedCoordinates<M>>(
    text: &Text,
    export: &Export<M, P, C>,
    functions: &mut String,
) {
    let (n, u, real) = (&text.name, &text.upper, text.real());
    let structs = &export.program.structs;
    for (place, values) in [PARAMETERS, INPUTS].into_iter().zip(&export.values) {
        if !structs[place].members.is_empty() {
            defaults(text, &structs[place], values, &export.defaults, functions);
        }
    }
    let numbers = [0.0, 0.0].into_iter().chain(export.start.iter().copied());
    let mut lines = String::new();
    for (path, value) in structs[STATE].paths().iter().zip(numbers) {
        let _ = writeln!(lines, "    state->{path} = {};", number(value));
    }
    let _ = writeln!(
        functions,
        "{u}_FUNCTION void {n}_init({n}_state *state)\n{{\n{lines}}}\n"
    );

    let (declared, handed) = if structs[CONSTANTS].members.is_empty() {
        (String::new(), "")
    } else {
        (
            format!("const {n}_constants *{u}_RESTRICT constants, "),
            "constants, ",
        )
    };
    let evaluate = if text.has_pivot {
        format!("const {real} pivot = {n}_evaluate({handed}state, &rates);")
    } else {
        format!("{n}_evaluate({handed}state, &rates);")
    };
    let least = number(export.least_pivot);
    let singular = if text.has_pivot {
        format!("    if (pivot < {least}) {{\n        return {u}_SINGULAR;\n    }}\n")
    } else {
        String::new()
    };
    finite(text, &structs[SLOPE], functions);
    let _ = writeln!(
        functions,
        "\
{u}_FUNCTION {n}_status {n}_rates({declared}const {n}_state *{u}_RESTRICT state, {n}_slope *{u}_RESTRICT slope)
{{
    {n}_slope rates;
    {evaluate}
{singular}    if (!{n}_slope_is_finite(&rates)) {{
        return {u}_NOT_FINITE;
    }}
    *slope = rates;
    return {u}_OK;
}}
"
    );
}

/// A sum of terms by halves: none waits for all that stand before it.
pub(super) fn balanced(terms: &[String]) -> String {
    match terms {
        [] => String::new(),
        [only] => only.clone(),
        _ => {
            let (first, last) = terms.split_at(terms.len() / 2);
            format!("({}\n        + {})", balanced(first), balanced(last))
        }
    }
}

/// Whether all numbers of a struct are finite: the difference of one that is not is no number.
fn finite(text: &Text, of: &Struct, functions: &mut String) {
    let (n, u) = (&text.name, &text.upper);
    let differences = of
        .paths()
        .into_iter()
        .map(|path| format!("(x->{path} - x->{path})"));
    let sum = balanced(&differences.collect::<Vec<_>>());
    let (kind, zero) = (of.name, number(0.0));
    let _ = writeln!(
        functions,
        "\
static {u}_FUNCTION int {n}_{kind}_is_finite(const {n}_{kind} *x)
{{
    const {real} zero = {sum};
    return zero <= {zero};
}}
",
        real = text.real(),
    );
}

fn defaults(text: &Text, of: &Struct, values: &[Value], numbers: &[f64], functions: &mut String) {
    let (n, u, name) = (&text.name, &text.upper, of.name);
    let places = values.iter().flat_map(|value| &value.places);
    let mut lines = String::new();
    for (path, &place) in of.paths().iter().zip(places) {
        let value = numbers.get(place).copied().unwrap_or(0.0);
        let _ = writeln!(lines, "    {name}->{path} = {};", number(value));
    }
    let _ = writeln!(
        functions,
        "{u}_FUNCTION void {n}_default_{name}({n}_{name} *{name})\n{{\n{lines}}}\n"
    );
}
