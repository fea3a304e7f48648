//! `fmi3_model.h`: what a mechanism has, for the files in C that are always the same.

use std::fmt::Write as _;

use holonom_export::{Coordinate, Interface, Quantity};

use crate::variables::{Variable, indicators};

/// How many numbers a state has before those that are moved: the time in two parts.
const TIMES: usize = 2;

fn count(quantities: &[Quantity]) -> usize {
    quantities.iter().map(|of| of.start.len()).sum()
}

/// The places of the states, each behind that which it is against.
fn order(states: &[Coordinate]) -> Vec<usize> {
    let depth = |place: usize| {
        let against = |&place: &usize| states.get(place)?.against;
        std::iter::successors(Some(place), against)
            .take(states.len())
            .count()
    };
    let mut order: Vec<usize> = (0..states.len()).collect();
    order.sort_by_key(|&place| depth(place));
    order
}

fn coordinate(of: &Coordinate) -> String {
    let sign = if of.is_reversed { -1.0 } else { 1.0 };
    let against = of
        .against
        .map_or_else(|| "-1".to_owned(), |place| place.to_string());
    format!("{{{sign:?}, {:?}, {against}}}", of.offset)
}

fn variable(of: &Variable) -> String {
    format!("{{{}, {}, {}}}", of.kind.in_c(), of.first, of.count)
}

/// A list as what a macro stands for, a line for each.
fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(", \\\n    ")
}

/// The names of distances to limits as texts in C, and an empty one.
fn gaps(of: &Interface) -> impl Iterator<Item = String> {
    let gaps = indicators(of).into_iter().take(of.gaps.len() / 3 * 2);
    let names = gaps.map(|gap| format!("\"{}\"", gap.name));
    names.chain(["\"\"".to_owned()])
}

/// What may be open: joint, unit, and what a start may have; and an end.
fn openings(of: &Interface) -> impl Iterator<Item = String> {
    let openings = of.openings.iter();
    let openings =
        openings.map(|of| format!("{{{:?}, {:?}, {:?}}}", of.joint, of.unit, of.accepted));
    openings.chain(["{\"\", \"\", 1.0}".to_owned()])
}

/// What counts turns, a line for each part of a joint; and an end.
fn turned(of: &Interface) -> Vec<String> {
    let lines = of.turned.iter().flat_map(|of| {
        let parts = of.parts.iter();
        parts
            .map(|(joint, part)| format!("{{{}, {:?}, {joint}, {part:?}}}", of.state, of.described))
    });
    lines.chain(["{0, 0.0, 0, 0.0}".to_owned()]).collect()
}

/// The text of the header.
pub(crate) fn header(
    of: &Interface,
    variables: &[Variable],
    token: &str,
    internal_step: f64,
) -> String {
    let states = &of.states;
    let angles = states.iter().filter(|state| state.is_angle).count();
    let (parameters, inputs) = (count(&of.parameters), count(&of.inputs));
    let turned = turned(of);
    let mut text = format!(
        "\
/* What the mechanism has: see fmi3_mechanism.h. Written by holonom-fmu {version}. */
#ifndef FMI3_MODEL_H
#define FMI3_MODEL_H

#include \"{n}.h\"

#include <stddef.h>

#define FMU_TOKEN \"{token}\"
#define FMU_INTERNAL_STEP {internal_step:?}
#define FMU_STATES {all}
#define FMU_ANGLES {angles}
#define FMU_PARAMETERS {parameters}
#define FMU_INPUTS {inputs}
#define FMU_READINGS {readings}
#define FMU_LIMITED {limited}
#define FMU_SWITCHES {switches}
#define FMU_OPENINGS {opening}
#define FMU_PARTS {parts}

/* Kind, first number, count of numbers. */
#define FMU_VARIABLES \\
    {variables}

/* Sign, offset, what it is against. */
#define FMU_COORDINATES \\
    {coordinates}

#define FMU_ORDER \\
    {order}

#define FMU_START \\
    {start}

/* What two numbers of each joint with limits say, and the end. */
#define FMU_GAPS \\
    {gaps}

/* Joint, unit, and by how much it may be open at a start. */
#define FMU_OPENS \\
    {opens}

/* What counts turns, its described angle, a coordinate of a joint, how much of it is added. */
#define FMU_TURNED \\
    {turned}

",
        version = env!("CARGO_PKG_VERSION"),
        n = of.name,
        all = states.len(),
        readings = of.readings.len(),
        limited = of.gaps.len() / 3,
        switches = of.switches.len(),
        opening = of.openings.len(),
        parts = turned.len() - 1,
        turned = list(turned.into_iter()),
        gaps = list(gaps(of)),
        opens = list(openings(of)),
        variables = list(variables.iter().map(variable)),
        coordinates = list(states.iter().map(coordinate)),
        order = list(order(states).iter().map(usize::to_string)),
        start = list(
            states
                .iter()
                .map(|of| format!("{:?}", of.quantity.start[0]))
        ),
    );
    let columns = states.len() + parameters + inputs;
    let readings = of.readings.len();
    for (name, of_program, numbers) in [
        ("state", "state", TIMES + states.len() + angles),
        ("slope", "slope", states.len()),
        ("parameters", "parameters", parameters),
        ("inputs", "inputs", inputs),
        ("jacobian", "jacobian", states.len() * columns),
        ("sensitivities", "sensitivities", readings * columns),
        ("gaps", "gaps", of.gaps.len()),
        ("switches", "switches", of.switches.len()),
        ("openings", "openings", 2 * of.openings.len()),
    ] {
        union(&of.name, name, of_program, numbers, columns, &mut text);
    }
    functions(of, &mut text);
    text.push_str("#endif\n");
    text
}

/// A struct of the program as its numbers. Where there is none, as many as are ever read.
fn union(n: &str, name: &str, of: &str, numbers: usize, columns: usize, text: &mut String) {
    let member = if numbers > 0 {
        format!("    {n}_{of} of;\n")
    } else {
        String::new()
    };
    let numbers = if numbers > 0 { numbers } else { columns };
    let _ = writeln!(
        text,
        "typedef union {{\n{member}    double number[{numbers}];\n}} fmu_{name};\n"
    );
}

/// A function that calls one of the program.
struct Wrapper {
    result: &'static str,
    name: &'static str,
    arguments: String,
    body: String,
}

impl Wrapper {
    fn new(result: &'static str, name: &'static str, arguments: String, body: String) -> Self {
        Self {
            result,
            name,
            arguments,
            body,
        }
    }

    fn write(&self, text: &mut String) {
        let (arguments, body) = (&self.arguments, &self.body);
        let _ = writeln!(
            text,
            "static {} fmu_{}({arguments})\n{{",
            self.result, self.name
        );
        for argument in arguments.split(", ") {
            let name = argument.rsplit([' ', '*']).next().unwrap_or_default();
            if !body.contains(name) {
                let _ = writeln!(text, "    (void){name};");
            }
        }
        if !body.is_empty() {
            let _ = writeln!(text, "    {body}");
        }
        text.push_str("}\n\n");
    }
}

/// The functions of the program, with the same arguments whatever it has.
fn functions(of: &Interface, text: &mut String) {
    let kind = if of.has_constants {
        format!("{}_constants", of.name)
    } else {
        "char".to_owned()
    };
    let _ = writeln!(text, "typedef {kind} fmu_constants;\n");
    for wrapper in of_parameters(of).iter().chain(&of_states(of)) {
        wrapper.write(text);
    }
}

/// Those that are given parameters and inputs.
fn of_parameters(of: &Interface) -> [Wrapper; 5] {
    let n = &of.name;
    let lists = [("parameters", &of.parameters), ("inputs", &of.inputs)];
    let present = lists.into_iter().filter(|(_, list)| !list.is_empty());
    let names: Vec<&str> = present.map(|(name, _)| name).collect();
    let given: String = names.iter().map(|name| format!("&{name}->of, ")).collect();
    let defaults = names.iter();
    let defaults: String = defaults
        .map(|name| format!("\n    {n}_default_{name}(&{name}->of);"))
        .collect();
    let call = |name: &str, last: &str, is_there: bool| {
        if is_there {
            format!("{n}_{name}({given}{last});")
        } else {
            String::new()
        }
    };
    let both = "const fmu_parameters *parameters, const fmu_inputs *inputs, ";
    let (constants, has_inputs) = (of.has_constants, names.contains(&"inputs"));
    [
        Wrapper::new(
            "void",
            "start",
            "fmu_state *state, fmu_parameters *parameters, fmu_inputs *inputs".to_owned(),
            format!("{n}_init(&state->of);{defaults}"),
        ),
        Wrapper::new(
            "void",
            "prepare",
            format!("{both}fmu_constants *constants"),
            call("prepare", "constants", constants),
        ),
        Wrapper::new(
            "void",
            "set_inputs",
            format!("{both}fmu_constants *constants"),
            call("set_inputs", "constants", constants && has_inputs),
        ),
        Wrapper::new(
            "void",
            "derivatives",
            format!("{both}const fmu_state *state, fmu_jacobian *jacobian"),
            call("derivatives", "&state->of, &jacobian->of", true),
        ),
        Wrapper::new(
            "void",
            "reading_derivatives",
            format!("{both}const fmu_state *state, fmu_sensitivities *all"),
            call(
                "reading_derivatives",
                "&state->of, &all->of",
                !of.readings.is_empty(),
            ),
        ),
    ]
}

/// Those that are given constants and a state.
fn of_states(of: &Interface) -> [Wrapper; 8] {
    let n = &of.name;
    let constants = "const fmu_constants *constants, ";
    let handed = if of.has_constants { "constants, " } else { "" };
    let reading = |name: &str, is_there: bool| {
        if is_there {
            format!("{n}_get_{name}({handed}&state->of, &{name}->of);")
        } else {
            String::new()
        }
    };
    let check = if of.openings.is_empty() {
        "return 0;".to_owned()
    } else {
        format!("return (int){n}_check_joints({handed}&state->of);")
    };
    let impact = if of.gaps.is_empty() {
        "return 0;".to_owned()
    } else {
        format!("return (int){n}_impact({handed}&state->of, within, rest);")
    };
    [
        Wrapper::new(
            "void",
            "get_gaps",
            format!("{constants}const fmu_state *state, fmu_gaps *gaps"),
            reading("gaps", !of.gaps.is_empty()),
        ),
        Wrapper::new(
            "void",
            "get_switches",
            format!("{constants}const fmu_state *state, fmu_switches *switches"),
            reading("switches", !of.switches.is_empty()),
        ),
        Wrapper::new(
            "void",
            "get_openings",
            format!("{constants}const fmu_state *state, fmu_openings *openings"),
            reading("openings", !of.openings.is_empty()),
        ),
        Wrapper::new(
            "int",
            "check_joints",
            format!("{constants}const fmu_state *state"),
            check,
        ),
        Wrapper::new(
            "int",
            "impact",
            format!("{constants}fmu_state *state, double within, double rest"),
            impact,
        ),
        Wrapper::new(
            "int",
            "rates",
            format!("{constants}const fmu_state *state, fmu_slope *slope"),
            format!("return (int){n}_rates({handed}&state->of, &slope->of);"),
        ),
        Wrapper::new(
            "int",
            "step",
            format!("{constants}fmu_state *state, double dt"),
            format!("return (int){n}_step({handed}&state->of, dt);"),
        ),
        Wrapper::new(
            "double",
            "reading",
            format!("{constants}const fmu_state *state, size_t place"),
            readings(of, handed),
        ),
    ]
}

fn readings(of: &Interface, handed: &str) -> String {
    let mut body = "switch (place) {\n".to_owned();
    for (place, reading) in of.readings.iter().enumerate() {
        let _ = writeln!(
            body,
            "    case {place}:\n        return {}_{}({handed}&state->of);",
            of.name, reading.name
        );
    }
    body.push_str("    default:\n        return 0.0;\n    }");
    body
}
