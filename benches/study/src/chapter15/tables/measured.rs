//! The tables that the chapter could not have.

use holonom::dynamics::Iterations;

use super::by_method;
use crate::chapter15::Settings;
use crate::chapter15::outcome::Outcome;
use crate::document::Table;
use crate::format::{fixed, scientific};
use crate::statistics::Quartiles;

/// What an evaluation costs, against the run-time assembler.
#[must_use]
pub fn prices(outcomes: &[Outcome]) -> Table {
    by_method(
        "Time per evaluation, the integrator included.",
        &[
            "generated (ns)",
            "quartiles (ns)",
            "assembler (ns)",
            "quartiles (ns)",
            "assembler / generated",
        ],
        outcomes,
        |outcome| {
            let ours = &outcome.prices.generated.time;
            let assembler = outcome.prices.cheapest_assembler();
            vec![
                fixed(ours.median, 1),
                quartiles(ours, 1),
                assembler.map_or("–".into(), |price| fixed(price.time.median, 0)),
                assembler.map_or("–".into(), |price| quartiles(&price.time, 0)),
                assembler.map_or("–".into(), |price| {
                    fixed(price.time.median / ours.median, 1)
                }),
            ]
        },
        "Whole runs over 10 s divided by their evaluations; the median of many runs, all candidates taking turns in one \
         process. The assembler builds the same equations at run time from a list of bodies and joints with dense \
         matrices; it runs through the same integrator, in the fastest form that it has for the formulation.",
    )
}

/// The forms of one formulation against each other; `None` where there is only one.
#[must_use]
pub fn baselines(outcome: &Outcome) -> Option<Table> {
    let ours = &outcome.prices.generated.time;
    let rows: Vec<_> = outcome
        .prices
        .all()
        .map(|price| {
            vec![
                price.name.clone(),
                fixed(price.time.median, 1),
                quartiles(&price.time, 1),
                fixed(price.time.median / ours.median, 1),
                price.evaluations.to_string(),
            ]
        })
        .collect();
    (rows.len() > 1).then(|| Table {
        caption: format!(
            "The {} formulation in all its forms.",
            outcome.method.name()
        ),
        columns: [
            "form",
            "per evaluation (ns)",
            "quartiles (ns)",
            "to generated",
            "evaluations",
        ]
        .map(Into::into)
        .into(),
        rows,
        note: String::new(),
    })
}

/// A ratio: without a power of ten where it is easier to read so.
fn factor(ratio: f64) -> String {
    if (0.1..1e4).contains(&ratio) {
        fixed(ratio, 1)
    } else {
        scientific(ratio, 1)
    }
}

fn quartiles(time: &Quartiles, digits: usize) -> String {
    format!(
        "{} … {}",
        fixed(time.lower, digits),
        fixed(time.upper, digits)
    )
}

/// Steps and iterations.
#[must_use]
pub fn steps(outcomes: &[Outcome]) -> Table {
    by_method(
        "Steps and iterations.",
        &[
            "accepted",
            "rejected",
            "iterations per evaluation",
            "most iterations",
        ],
        outcomes,
        |outcome| {
            let Iterations { total, largest, .. } = outcome.iterations;
            let or_dash = |text: String| if total == 0 { "–".into() } else { text };
            vec![
                outcome.accepted.to_string(),
                outcome.rejected.to_string(),
                or_dash(fixed(total as f64 / outcome.evaluations as f64, 2)),
                or_dash(largest.to_string()),
            ]
        },
        "Every evaluation of the augmented Lagrangian starts its iteration afresh, so that the accelerations depend on time \
         and state alone.",
    )
}

/// Errors against the closed form.
#[must_use]
pub fn accuracy(outcomes: &[Outcome]) -> Table {
    by_method(
        "Errors at the reporting times.",
        &[
            "angle at the end (rad)",
            "energy, largest (J)",
            "radial reaction, largest (N)",
            "transverse reaction, largest (N)",
        ],
        outcomes,
        |outcome| {
            let (radial, transverse) = outcome.largest_reaction_errors();
            vec![
                scientific(outcome.final_angle_error(), 1),
                scientific(outcome.energy_drift(), 1),
                scientific(radial, 1),
                scientific(transverse, 1),
            ]
        },
        "The angle from the Euler parameters as integrated. The penalty formulation has a bias of its own: a finite penalty \
         gives way a little to the reaction, however small the steps.",
    )
}

/// The violation of the constraints.
#[must_use]
pub fn violation(outcomes: &[Outcome], settings: &Settings) -> Table {
    by_method(
        "Violation of the constraints, ΦᵀΦ (m² and 1), largest at the reporting times.",
        &[
            "first second",
            "last second",
            "last / first",
            "whole run",
            "at the end",
        ],
        outcomes,
        |outcome| {
            let first = outcome.largest_violation(0.0..1.0);
            let last = outcome.largest_violation(settings.end - 1.0..f64::INFINITY);
            let whole = outcome.largest_violation(0.0..f64::INFINITY);
            vec![
                scientific(first, 1),
                scientific(last, 1),
                factor(last / first),
                scientific(whole, 1),
                scientific(outcome.final_violation(), 1),
            ]
        },
        "ΦᵀΦ adds three squared distances (m²) and two squared scalar products of unit vectors (1).",
    )
}
