//! The tables of the comparison.

use super::record::{Compiled, Row};
use super::{Coordinates, Precision};
use crate::chapter15::Method;
use crate::document::Table;
use crate::format::fixed;

/// Both descriptions in their order.
const BOTH: [Coordinates; 2] = [Coordinates::Bodies, Coordinates::Joints];

/// The rows of a formulation and a number type.
fn chosen(rows: &[Row], method: Method, precision: Precision) -> impl Iterator<Item = &Row> {
    rows.iter().filter(move |row| {
        BOTH.iter()
            .any(|&coordinates| row.is(coordinates, method, precision))
    })
}

/// The row of the same right-hand side among others.
fn same<'a>(row: &Row, among: &'a [Row], scalar: &str) -> Option<&'a Row> {
    among.iter().find(|other| {
        (
            &other.scene,
            other.n,
            &other.coordinates,
            &other.formulation,
        ) == (&row.scene, row.n, &row.coordinates, &row.formulation)
            && other.scalar == scalar
    })
}

/// The name of a row: the mechanism and its description.
fn name(row: &Row) -> String {
    if row.is_reference() {
        "reference kernel (T)".into()
    } else {
        format!("{}, {}", row.name(), row.coordinates)
    }
}

/// A time (ns) with three digits or more.
fn time(nanoseconds: f64) -> String {
    fixed(nanoseconds, significant(nanoseconds))
}

/// The digits behind the point that leave three significant ones.
fn significant(value: f64) -> usize {
    match value.abs() {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        _ => 2,
    }
}

fn optional(value: Option<f64>, write: fn(f64) -> String) -> String {
    value.map_or_else(|| "\u{2013}".into(), write)
}

fn ratio(value: f64) -> String {
    fixed(value, significant(value))
}

fn columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

/// What an evaluation costs in a formulation, in `f64`.
#[must_use]
pub fn cost(rows: &[Row], method: Method) -> Table {
    let line = |row: &Row| {
        vec![
            name(row),
            row.operations.to_string(),
            row.stage_operations.to_string(),
            row.path.to_string(),
            time(row.nanoseconds_throughput),
            time(row.upper_quartile_nanoseconds),
            ratio(row.reference_kernels),
            time(row.nanoseconds_dependent),
            time(row.rk4_step_nanoseconds),
            optional(row.assembler_nanoseconds, time),
        ]
    };
    let lines = chosen(rows, method, Precision::Double).map(line);
    let note = match method {
        Method::Standard => {
            "Time: of evaluations that do not depend on each other, the least of all turns; quartile: three quarters of the turns took at most this; waiting: of evaluations that do; step: of Runge-Kutta, four evaluations. Operations of the whole right-hand side, multipliers of the remaining equations included; a stage of a step does without these in joint coordinates. A fused multiply-add is two. The path is the longest chain \
             of dependent operations. The assembler is that of the mechanism by its bodies, in its cheapest form; it computes in f64 alone."
        }
        Method::AugmentedLagrangian => {
            "It solves its system as often as the state asks for: operations are those at one state of the motion."
        }
        Method::Baumgarte | Method::Penalty => "",
    };
    Table {
        caption: format!("{}, f64", capital(method.name())),
        columns: columns(&[
            "",
            "operations",
            "in a stage",
            "path",
            "time (ns)",
            "quartile (ns)",
            "in T",
            "waiting (ns)",
            "step (ns)",
            "assembler (ns)",
        ]),
        rows: lines.collect(),
        note: note.into(),
    }
}

/// `f64` beside `f32`, standard multipliers.
#[must_use]
pub fn precisions(rows: &[Row]) -> Table {
    let lines = chosen(rows, Method::Standard, Precision::Double).filter_map(|row| {
        let single = same(row, rows, Precision::Single.key())?;
        Some(vec![
            name(row),
            time(row.nanoseconds_throughput),
            time(single.nanoseconds_throughput),
            time(row.nanoseconds_dependent),
            time(single.nanoseconds_dependent),
            time(row.rk4_step_nanoseconds),
            time(single.rk4_step_nanoseconds),
        ])
    });
    Table {
        caption: "f64 and f32, standard".into(),
        columns: columns(&[
            "",
            "time, f64 (ns)",
            "f32",
            "waiting, f64 (ns)",
            "f32",
            "step, f64 (ns)",
            "f32",
        ]),
        rows: lines.collect(),
        note: String::new(),
    }
}

/// What the public interface adds to the kernel, standard multipliers in `f64`.
#[must_use]
pub fn interface(rows: &[Row]) -> Table {
    let lines = chosen(rows, Method::Standard, Precision::Double).filter_map(|row| {
        let kernel = row.kernel_nanoseconds.filter(|_| !row.is_reference())?;
        Some(vec![
            name(row),
            time(kernel),
            time(row.nanoseconds_throughput),
            ratio(row.nanoseconds_throughput / kernel),
            time(0.25 * row.rk4_step_nanoseconds),
            ratio(0.25 * row.rk4_step_nanoseconds / kernel),
        ])
    });
    Table {
        caption: "The kernel and what calls it, standard, f64".into(),
        columns: columns(&[
            "",
            "kernel (ns)",
            "evaluation (ns)",
            "in kernels",
            "step / 4 (ns)",
            "in kernels",
        ]),
        rows: lines.collect(),
        note: "An evaluation hands on rates and multipliers, and refuses what is not finite or singular. A step of Runge-Kutta evaluates four times, each time at \
               a state that waits for the slope before."
            .into(),
    }
}

/// Two builds beside each other, standard multipliers in `f64`.
#[must_use]
pub fn builds(rows: &[Row], plain: &[Row]) -> Table {
    let lines = chosen(rows, Method::Standard, Precision::Double).filter_map(|row| {
        let other = same(row, plain, &row.scalar)?;
        Some(vec![
            name(row),
            time(other.nanoseconds_throughput),
            time(row.nanoseconds_throughput),
            ratio(other.nanoseconds_throughput / row.nanoseconds_throughput),
            time(other.nanoseconds_dependent),
            time(row.nanoseconds_dependent),
            time(other.rk4_step_nanoseconds),
            time(row.rk4_step_nanoseconds),
        ])
    });
    let build = |rows: &[Row]| rows.first().map_or("", |row| &row.build).to_owned();
    Table {
        caption: "A plain build beside this one, standard, f64".into(),
        columns: columns(&[
            "",
            "time, plain (ns)",
            "here",
            "plain / here",
            "waiting, plain (ns)",
            "here",
            "step, plain (ns)",
            "here",
        ]),
        rows: lines.collect(),
        note: format!("Plain: {}. Here: {}.", build(plain), build(rows)),
    }
}

/// What a derive costs a build.
#[must_use]
pub fn builds_of(compiled: &[Compiled]) -> Table {
    let line = |build: &Compiled| {
        vec![
            format!("{}, {}", build.name, build.profile),
            fixed(build.seconds, 1),
            optional(build.processor_seconds, |seconds| fixed(seconds, 1)),
        ]
    };
    Table {
        caption: "The build of a small crate".into(),
        columns: columns(&["", "time (s)", "of all processors together (s)"]),
        rows: compiled.iter().map(line).collect(),
        note: "Rods on parallel hinges one behind the other, or four-bar windows side by side: a derive and a loop of steps with standard multipliers; cargo's default profiles; dependencies are there already. \
               Those that end in joints have both descriptions, and move by joints."
            .into(),
    }
}

/// A name at the beginning of a sentence.
pub(super) fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
