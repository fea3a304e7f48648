//! The tables of a trade.

use super::front::front;
use super::measure::Trade;
use super::record::{Key, Row};
use crate::compare::{Coordinates, Precision};
use crate::document::Table;
use crate::format::{fixed, scientific};

/// A setting in a few words.
pub(super) fn name(setting: &Key) -> String {
    let stabilisation = match setting.stabilisation.as_str() {
        "none" => String::new(),
        other => format!(", {other}"),
    };
    format!(
        "{}, {}{stabilisation}, {} {}, {}",
        setting.coordinates,
        setting.formulation,
        setting.integrator,
        scientific(setting.step_or_tolerance, 1),
        setting.scalar
    )
}

fn columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

fn line(first: String, row: &Row) -> Vec<String> {
    vec![
        first,
        scientific(row.error, 1),
        scientific(row.seconds, 2),
        row.reference_kernels
            .map_or_else(|| "\u{2013}".into(), |x| fixed(x, 0)),
        row.evaluations.to_string(),
        row.steps[0].to_string(),
        scientific(row.max_violation, 1),
        scientific(row.energy_drift_joule, 1),
        if row.is_trusted() { "" } else { "warned" }.into(),
    ]
}

fn heads(trade: &Trade) -> Vec<String> {
    let mut heads = columns(&[
        "",
        "",
        "time (s)",
        "in T",
        "evaluations",
        "steps",
        "violation",
        "energy (J)",
        "",
    ]);
    let quantity = trade.facts.quantity;
    heads[1] = format!("error of {} ({})", quantity.name, quantity.unit);
    heads
}

/// The Pareto front of all settings.
#[must_use]
pub fn best(trade: &Trade) -> Table {
    let rows = front(&trade.rows);
    Table {
        caption: "Nothing is both faster and more exact".into(),
        columns: heads(trade),
        rows: rows.iter().map(|row| line(name(&row.setting), row)).collect(),
        note: "Time: of the whole run, without monitor and readings, the median of several; T is an evaluation of the reference kernel, timed in turn with the run. Violation: the largest |Φ| at the reporting times. Energy: the \
               largest change that no force accounts for."
            .into(),
    }
}

/// What is cheapest for an error, by description and number type.
#[must_use]
pub fn cheapest(trade: &Trade) -> Table {
    let mut rows = Vec::new();
    for exponent in 1..=12 {
        let asked = 10.0_f64.powi(-exponent);
        for by in [Coordinates::Joints, Coordinates::Bodies] {
            for scalar in [Precision::Double, Precision::Single] {
                let enough = trade
                    .rows
                    .iter()
                    .filter(|row| row.is(by, scalar) && row.error <= asked);
                if let Some(row) = enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds)) {
                    let first = format!("{}: {}", scientific(asked, 0), name(&row.setting));
                    rows.push(line(first, row));
                }
            }
        }
    }
    Table {
        caption: "The cheapest setting for an error".into(),
        columns: heads(trade),
        rows,
        note: "Found among the settings of the grid: an error between two of them would take a step between theirs.".into(),
    }
}

/// What each number type can do: the least error that was reached, by description and formulation.
#[must_use]
pub fn limits(trade: &Trade) -> Table {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut seen: Vec<(&str, &str, &str)> = Vec::new();
    for row in &trade.rows {
        let setting = &row.setting;
        let kind = (
            setting.coordinates.as_str(),
            setting.formulation.as_str(),
            setting.stabilisation.as_str(),
        );
        if !seen.contains(&kind) {
            seen.push(kind);
        }
    }
    for kind in seen {
        let least = |scalar: &str| {
            let same = trade.rows.iter().filter(|row| {
                let setting = &row.setting;
                (
                    setting.coordinates.as_str(),
                    setting.formulation.as_str(),
                    setting.stabilisation.as_str(),
                ) == kind
                    && setting.scalar == scalar
            });
            same.min_by(|a, b| a.error.total_cmp(&b.error))
        };
        let cells = |row: Option<&Row>| match row {
            Some(row) => [scientific(row.error, 1), scientific(row.seconds, 2)],
            None => ["\u{2013}".into(), "\u{2013}".into()],
        };
        let [double, single] = ["f64", "f32"].map(|scalar| cells(least(scalar)));
        let (coordinates, formulation, stabilisation) = kind;
        let stabilisation = if stabilisation == "none" {
            String::new()
        } else {
            format!(", {stabilisation}")
        };
        let mut line = vec![format!("{coordinates}, {formulation}{stabilisation}")];
        line.extend(double);
        line.extend(single);
        rows.push(line);
    }
    Table {
        caption: "The least error that was reached".into(),
        columns: columns(&["", "f64", "time (s)", "f32", "time (s)"]),
        rows,
        note: "Of all integrators and steps of the grid. Below it, smaller steps give more round-off, or the formulation has an error of its own.".into(),
    }
}

/// Of each problem the setting with the least error.
#[must_use]
pub fn most_exact(trades: &[Trade]) -> Table {
    let lines = trades.iter().filter_map(|trade| {
        let row = trade
            .rows
            .iter()
            .min_by(|a, b| a.error.total_cmp(&b.error))?;
        Some(of_problem(trade, "", row))
    });
    Table {
        caption: "The least error of any setting".into(),
        columns: of_problems(),
        rows: lines.collect(),
        note: "Errors against closed forms, and against published or integrated values that are themselves known to 1e-11 or better. Where a motion passes a singular configuration every run has a warning, also if it is right."
            .into(),
    }
}

/// Of each problem the cheapest settings for three errors, of runs without warnings where there
/// are any.
#[must_use]
pub fn cheapest_of(trades: &[Trade]) -> Table {
    let mut rows = Vec::new();
    for trade in trades {
        for (asked, text) in [(1e-3, ", 1e-3"), (1e-6, ", 1e-6"), (1e-9, ", 1e-9")] {
            let enough = || trade.rows.iter().filter(|row| row.error <= asked);
            let cheapest = |a: &&Row, b: &&Row| a.seconds.total_cmp(&b.seconds);
            let trusted = enough().filter(|row| row.is_trusted()).min_by(cheapest);
            if let Some(row) = trusted.or_else(|| enough().min_by(cheapest)) {
                rows.push(of_problem(trade, text, row));
            }
        }
    }
    Table {
        caption: "The cheapest setting for an error".into(),
        columns: of_problems(),
        rows,
        note: String::new(),
    }
}

fn of_problems() -> Vec<String> {
    columns(&[
        "",
        "error",
        "steps",
        "evaluations",
        "time (s)",
        "in T",
        "energy (J)",
        "violation",
        "",
    ])
}

fn of_problem(trade: &Trade, asked: &str, row: &Row) -> Vec<String> {
    let facts = &trade.facts;
    vec![
        format!("{}{asked}: {}", facts.name, name(&row.setting)),
        format!("{} {}", scientific(row.error, 1), facts.quantity.unit),
        row.steps[0].to_string(),
        row.evaluations.to_string(),
        scientific(row.seconds, 2),
        row.reference_kernels
            .map_or_else(|| "\u{2013}".into(), |x| fixed(x, 0)),
        scientific(row.energy_drift_joule, 1),
        scientific(row.max_violation, 1),
        if row.is_trusted() { "" } else { "warned" }.into(),
    ]
}
