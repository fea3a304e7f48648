//! The map as a document and as files.

use std::path::{Path, PathBuf};

use super::outcome::Outcome;
use super::run::{Axis, Row};
use super::thresholds::{HOLDS, WRONG};
use crate::document::{Block, Document, Section, Table};
use crate::error::StudyError;
use crate::files::write_atomically;
use crate::page::write_page;
use crate::target::Target;
use crate::trade::json;

/// The command that the map is made with.
pub const COMMAND: &str = "cargo run --release --bin study -- extremes --large";

/// The map as a document.
#[must_use]
pub fn document(axes: &[Axis], rows: &[Row]) -> Document {
    let mut sections = vec![Section {
        heading: "All axes".into(),
        blocks: vec![Block::Table(counts(axes, rows))],
    }];
    for axis in axes {
        let rows: Vec<_> = rows.iter().filter(|row| row.axis == axis.name).collect();
        if rows.is_empty() {
            continue;
        }
        let mut blocks = vec![
            Block::Text(format!("{}.", axis.title)),
            Block::Table(map(axis, &rows)),
        ];
        blocks.extend(reasons(&rows).map(Block::Text));
        sections.push(Section {
            heading: axis.name.into(),
            blocks,
        });
    }
    Document {
        title: "Where the numerics stop to hold".into(),
        lead: vec![
            format!(
                "Motions with closed forms, swept along one axis at a time. ● holds: the error is within {HOLDS} times of what step, tolerance, formulation and number type promise. ◐ drifts: it is larger, and the \
                 run's monitor says so, or it is below {WRONG} of the motion. × fails: the run ends with an error that says why. WRONG: the error is above {WRONG} of the motion and nothing tells."
            ),
            "What is promised stands in benches/study/src/extremes/thresholds.rs, with the reason for every number.".into(),
        ],
        sections,
        colophon: vec![
            format!("Compiled for {}.", Target::CURRENT),
            format!(
                "holonom {}. Repeat with: {COMMAND}. The numbers are in extremes.json, beside this page.",
                env!("CARGO_PKG_VERSION")
            ),
        ],
    }
}

fn counts(axes: &[Axis], rows: &[Row]) -> Table {
    let line = |name: &str, scalar: &str| {
        let same =
            |row: &&Row| (name.is_empty() || row.axis == name) && row.setting.scalar == scalar;
        let count = |outcome: Outcome| {
            rows.iter()
                .filter(same)
                .filter(|row| row.outcome == outcome)
                .count()
        };
        let mut line = vec![format!(
            "{}{scalar}",
            if name.is_empty() {
                "all, ".into()
            } else {
                format!("{name}, ")
            }
        )];
        line.extend(Outcome::ALL.map(|outcome| count(outcome).to_string()));
        line
    };
    let names = axes.iter().map(|axis| axis.name).chain([""]);
    let lines = names.flat_map(|name| ["f64", "f32"].map(|scalar| line(name, scalar)));
    let mut columns = vec![String::new()];
    columns.extend(Outcome::ALL.map(|outcome| outcome.key().to_owned()));
    Table {
        caption: format!("{} runs", rows.len()),
        columns,
        rows: lines
            .filter(|line| line[1..].iter().any(|count| count != "0"))
            .collect(),
        note: String::new(),
    }
}

/// One line for each setting, one column for each value.
fn map(axis: &Axis, rows: &[&Row]) -> Table {
    let mut values: Vec<&str> = Vec::new();
    let mut lines: Vec<(String, Vec<String>)> = Vec::new();
    for row in rows {
        if !values.contains(&row.value_text.as_str()) {
            values.push(&row.value_text);
        }
    }
    for row in rows {
        let setting = &row.setting;
        let stabilisation = match setting.stabilisation.as_str() {
            "none" => String::new(),
            other => format!(", {other}"),
        };
        let name = format!(
            "{}, {}{stabilisation}, {}, {}",
            setting.coordinates, setting.formulation, setting.integrator, setting.scalar
        );
        let place = lines
            .iter()
            .position(|(known, _)| *known == name)
            .unwrap_or_else(|| {
                lines.push((name, vec![String::new(); values.len()]));
                lines.len() - 1
            });
        if let Some(column) = values.iter().position(|value| *value == row.value_text) {
            lines[place].1[column] = row.outcome.sign().into();
        }
    }
    let mut columns = vec![axis.unit.to_owned()];
    columns.extend(values.iter().map(|&value| value.to_owned()));
    Table {
        caption: axis.title.clone(),
        columns,
        rows: lines
            .into_iter()
            .map(|(name, signs)| std::iter::once(name).chain(signs).collect())
            .collect(),
        note: String::new(),
    }
}

/// Why runs failed or drifted: every reason once, with the first value at which it was given.
fn reasons(rows: &[&Row]) -> Option<String> {
    let mut seen: Vec<(String, usize, String)> = Vec::new();
    for row in rows.iter().filter(|row| row.outcome != Outcome::Holds) {
        // Numbers differ from run to run: what is the same without them is the same reason.
        let words = |reason: &str| {
            reason
                .chars()
                .filter(|c| !c.is_ascii_digit())
                .collect::<String>()
        };
        let kind = format!("{} {}", row.outcome.key(), words(&row.reason));
        match seen.iter_mut().find(|(known, ..)| *known == kind) {
            Some((_, count, _)) => *count += 1,
            None => {
                let setting = &row.setting;
                let first = format!(
                    "{} at {} ({}, {}, {}): {}",
                    row.outcome.key(),
                    row.value_text,
                    setting.coordinates,
                    setting.formulation,
                    setting.scalar,
                    row.reason
                );
                seen.push((kind, 1, first));
            }
        }
    }
    let sentences: Vec<_> = seen
        .iter()
        .map(|(_, count, first)| match count {
            1 => format!("{first}."),
            _ => format!("{first} (and {} more of the kind).", count - 1),
        })
        .collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

/// Writes `extremes.json` and the page into a directory; the paths of what was written.
///
/// # Errors
/// [`StudyError`] where a file cannot be written.
pub fn write(
    document: &Document,
    rows: &[Row],
    directory: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let numbers = directory.join("extremes.json");
    write_atomically(&numbers, json(rows)?.as_bytes())?;
    let mut written = write_page(document, directory)?;
    written.push(numbers);
    Ok(written)
}
