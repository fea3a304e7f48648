//! A trade as a document and as files.

use std::path::{Path, PathBuf};

use super::charts::{self, History, Steps};
use super::integration::{Family, IntegratorSetting};
use super::measure::Trade;
use super::recommend::{Processor, Recommendation, STARTS, Wish};
use super::record::{csv, json};
use super::reference::Source;
use super::setting::{Choice, PostStabilisation, Setting};
use super::subject::Subject;
use super::tables;
use crate::chapter15::Method;
use crate::compare::{Coordinates, Precision};
use crate::document::{Block, Document, Section};
use crate::error::StudyError;
use crate::files::write_atomically;
use crate::format::scientific;
use crate::page::write_page;
use crate::target::Target;

/// Runs that are shown over time: Runge-Kutta with the step of which the time scale has 64, by the
/// bodies, in every formulation, and with a correction.
///
/// A run that stops is left out.
///
/// # Errors
/// Why the mechanism does not stand.
pub fn histories(subject: &dyn Subject) -> Result<Vec<History>, StudyError> {
    let facts = subject.facts();
    let start = subject.start()?;
    let kinds = Method::ALL
        .map(|method| (method, PostStabilisation::None))
        .into_iter();
    let kinds = kinds.chain([(Method::Standard, PostStabilisation::Projection)]);
    let history = |(method, stabilisation): (Method, PostStabilisation)| {
        let integration = IntegratorSetting {
            family: Family::Rk4,
            step_or_tolerance: facts.time_scale / 64.0,
        };
        let scalar = Precision::Double;
        let (formulation, is_derived, _) =
            Choice::Derived(method).made(subject, scalar, integration);
        let setting = Setting {
            coordinates: Coordinates::Bodies,
            formulation,
            is_derived,
            stabilisation,
            integration,
            scalar,
        };
        let name = match stabilisation {
            PostStabilisation::None => method.name().to_owned(),
            _ => format!("{}, {}", method.name(), stabilisation.key()),
        };
        let run = subject.observe(&setting, &start).ok()?;
        Some(History { name, run })
    };
    Ok(kinds.filter_map(history).collect())
}

/// A trade as a document; `command` is what it was made with.
#[must_use]
pub fn document(trade: &Trade, shown: &[History], command: &str) -> Document {
    let section = |heading: &str, blocks: Vec<Block>| Section {
        heading: heading.into(),
        blocks,
    };
    let figures = |figures: Vec<Option<crate::document::Figure>>| -> Vec<Block> {
        figures.into_iter().flatten().map(Block::Figure).collect()
    };
    let both = [Coordinates::Joints, Coordinates::Bodies];
    let kinds = both
        .into_iter()
        .flat_map(|by| Steps::BOTH.map(|steps| (by, steps)));
    let integrators = kinds.flat_map(|(by, steps)| {
        [
            charts::integrators(trade, by, steps),
            charts::evaluations(trade, by, steps),
        ]
    });
    let integrators: Vec<_> = integrators.collect();
    let mut best = figures(vec![charts::fronts(trade)]);
    best.push(Block::Table(tables::best(trade)));
    let mut sections = vec![
        section("The best of all", best),
        section(
            "The cheapest for an error",
            vec![Block::Table(tables::cheapest(trade))],
        ),
        section("Integrators", figures(integrators)),
        section(
            "Formulations",
            figures(
                both.iter()
                    .map(|&by| charts::formulations(trade, by))
                    .collect(),
            ),
        ),
        section(
            "Single precision",
            vec![Block::Table(tables::limits(trade))],
        ),
    ];
    let over_time: Vec<_> = charts::histories(shown)
        .into_iter()
        .map(Block::Figure)
        .collect();
    if !over_time.is_empty() {
        let mut blocks = vec![Block::Text(format!(
            "Runge-Kutta of order 4 with steps of {} s, by the bodies, in f64.",
            scientific(trade.facts.time_scale / 64.0, 2)
        ))];
        blocks.extend(over_time);
        sections.push(section("Over time", blocks));
    }
    if !trade.stopped.is_empty() {
        sections.push(section(
            "What did not come to its end",
            vec![Block::Text(stopped(trade))],
        ));
    }
    sections.retain(|section| !section.blocks.is_empty());
    let facts = &trade.facts;
    Document {
        title: format!("What accuracy costs: {}", facts.name),
        lead: vec![
            format!("{}.", facts.title),
            format!(
                "{} runs: descriptions, formulations, stabilisations after steps, integrators, steps and tolerances, number types. The error is the largest of {} ({}) at the reporting times. {}",
                trade.rows.len() + trade.stopped.len(),
                facts.quantity.name,
                facts.quantity.unit,
                match trade.reference.source {
                    Source::Problem => "The reference is a closed form or published.".into(),
                    Source::IntegratorSetting => format!(
                        "The reference is an integration with tight tolerances, which another one, by other means, differs from by {}: errors below that say nothing.",
                        scientific(trade.reference.error, 1)
                    ),
                }
            ),
        ],
        sections,
        colophon: vec![
            format!("Compiled for {}.", Target::CURRENT),
            match trade.reference_kernel {
                Some(reference_kernel) => format!(
                    "T, an evaluation of the pendulum of chapter 15 written by hand, took {} s here.",
                    scientific(reference_kernel, 2)
                ),
                None => "There was no reference kernel.".into(),
            },
            format!(
                "holonom {}. Repeat with: {command}. The numbers are in {}.json and {}.csv, beside this page.",
                env!("CARGO_PKG_VERSION"),
                facts.name,
                facts.name
            ),
        ],
    }
}

/// Several trades in two tables: of each problem the most exact setting, and the cheapest for an
/// error of a millionth.
#[must_use]
pub fn summary(trades: &[Trade], command: &str) -> Document {
    Document {
        title: "What accuracy costs".into(),
        lead: vec![
            "Problems with known answers, each run with every description, formulation, stabilisation after steps, integrator, step or tolerance and number type. Settings whose runs have warnings are left out.".into(),
        ],
        sections: vec![
            Section {
                heading: "The most exact settings".into(),
                blocks: vec![Block::Table(tables::most_exact(trades))],
            },
            Section {
                heading: "The cheapest settings for an error".into(),
                blocks: vec![Block::Table(tables::cheapest_of(trades))],
            },
        ],
        colophon: vec![
            format!("Compiled for {}.", Target::CURRENT),
            format!("holonom {}. Repeat with: {command}. Each problem has a page of its own beside this one.", env!("CARGO_PKG_VERSION")),
        ],
    }
}

/// What did not come to its end, one sentence for each reason and kind.
fn stopped(trade: &Trade) -> String {
    let mut kinds: Vec<(String, usize, &str)> = Vec::new();
    for entry in &trade.stopped {
        let setting = &entry.setting;
        let kind = format!(
            "{} by {}, {}, {}",
            setting.formulation, setting.coordinates, setting.integrator, setting.scalar
        );
        match kinds.iter_mut().find(|(known, ..)| *known == kind) {
            Some((_, count, _)) => *count += 1,
            None => kinds.push((kind, 1, &entry.reason)),
        }
    }
    let sentences: Vec<_> = kinds
        .iter()
        .map(|(kind, count, reason)| format!("{kind} ({count}): {reason}."))
        .collect();
    sentences.join(" ")
}

/// A recommendation in words, with the lines of Rust that run it.
#[must_use]
pub fn recommendation(
    trade: &Trade,
    wish: Wish,
    processor: Processor,
    found: Option<&Recommendation>,
) -> String {
    let facts = &trade.facts;
    let (name, unit) = (facts.quantity.name, facts.quantity.unit);
    let asked = match wish {
        Wish::Error(error) => format!("an error of {name} of at most {error:e} {unit}"),
        Wish::Budget(seconds) => format!("at most {seconds:.3e} s for the whole run"),
    };
    let on = match processor {
        Processor::Here => format!("compiled for {}", Target::CURRENT),
        Processor::CortexM7 => {
            "a Cortex-M7 at 480 MHz, estimated from counts of operations: 0.7 to 1.5 times what is counted there".into()
        }
    };
    let mut text = format!("{}\n\nAsked for: {asked} ({on}).\n", facts.title);
    let Some(found) = found else {
        let trusted = || trade.rows.iter().filter(|row| row.is_trusted());
        let least = trusted().map(|row| row.error).fold(f64::INFINITY, f64::min);
        let shortest = trusted()
            .map(|row| row.seconds)
            .fold(f64::INFINITY, f64::min);
        text.push_str(&if trusted().count() == 0 {
            format!(
                "No setting of the grid does that: of {} runs none came to its end without a warning.\n",
                trade.rows.len() + trade.stopped.len()
            )
        } else {
            format!(
                "No setting of the grid does that from all {STARTS} starts nearby. Of runs without warnings, the least error is {least:.1e} {unit}, the shortest time {shortest:.1e} s.\n"
            )
        });
        return text;
    };
    let row = &found.row;
    text.push_str(&format!(
        "Recommended: {}\n\n  error               {:.1e} {unit}, from {STARTS} starts nearby at most {:.1e}",
        found.setting.name(),
        row.error,
        found.worst()
    ));
    if let Wish::Error(error) = wish {
        text.push_str(&format!(
            ": {:.1} times less than asked for",
            error / found.worst()
        ));
    }
    text.push_str(&format!(
        "\n  time                {:.2e} s for {} s of motion, {} evaluations\n  violation, energy   {:.1e}, {:.1e} J\n\n{}",
        found.seconds,
        facts.span.end - facts.span.start,
        row.evaluations,
        row.max_violation,
        row.energy_drift_joule,
        found.setting.code("mechanism")
    ));
    if !found.passed_over.is_empty() {
        text.push_str("\nPassed over:\n");
        for (setting, reason) in &found.passed_over {
            text.push_str(&format!("  {}: {reason}\n", setting.name()));
        }
    }
    text
}

/// Writes `<problem>.json`, `<problem>-stopped.json`, `<problem>.csv`, the page and its pictures
/// into a directory; the paths of what was written.
///
/// # Errors
/// [`StudyError`] where a picture has nothing to show or a file cannot be written.
pub fn write(
    trade: &Trade,
    document: &Document,
    directory: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let name = &trade.facts.name;
    let pages = directory.join(name);
    let mut written = write_page(document, &pages)?;
    let files = [
        (format!("{name}.json"), json(&trade.rows)?.into_bytes()),
        (
            format!("{name}-stopped.json"),
            json(&trade.stopped)?.into_bytes(),
        ),
        (format!("{name}.csv"), csv(&trade.rows)?),
    ];
    for (name, contents) in files {
        let path = directory.join(name);
        write_atomically(&path, &contents)?;
        written.push(path);
    }
    Ok(written)
}
