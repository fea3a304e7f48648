//! The whole study as a document and as files.

use std::path::{Path, PathBuf};

use super::outcome::Outcome;
use super::record::json;
use super::{Settings, charts, tables};
use crate::document::{Block, Document, Section};
use crate::error::StudyError;
use crate::files::write_atomically;
use crate::page::write_page;
use crate::target::Target;

/// The study as a document.
#[must_use]
pub fn document(outcomes: &[Outcome], settings: &Settings, target: &Target) -> Document {
    let text = |text: &str| Block::Text(text.into());
    let section = |heading: &str, blocks| Section {
        heading: heading.into(),
        blocks,
    };
    let mut price = vec![Block::Table(tables::prices(outcomes))];
    price.extend(
        outcomes
            .first()
            .and_then(tables::baselines)
            .map(Block::Table),
    );
    price.push(Block::Table(tables::steps(outcomes)));
    let mut reactions: Vec<_> = outcomes
        .first()
        .map(|outcome| Block::Figure(charts::reaction(outcome)))
        .into_iter()
        .collect();
    reactions.extend([
        Block::Figure(charts::radial(outcomes)),
        Block::Figure(charts::transverse(outcomes)),
    ]);
    Document {
        title: "Chapter 15: one pendulum, four formulations".into(),
        lead: vec![
            "Flores closes his Concepts and Formulations for Spatial Multibody Dynamics (2015) with a rod on a hinge, \
             integrated with four formulations of its equations of motion. This page repeats his comparison with \
             kernels that were generated at compile time from an annotated struct, and adds what the chapter could not \
             show: the errors against the closed form of the pendulum, and the price of an evaluation."
                .into(),
        ],
        sections: vec![
            section(
                "The problem",
                vec![Block::Table(tables::data()), Block::Table(tables::parameters(settings))],
            ),
            section(
                "What the chapter shows",
                vec![
                    Block::Table(tables::evaluations(outcomes)),
                    Block::Figure(charts::violation(outcomes)),
                    Block::Table(tables::violation(outcomes, settings)),
                ],
            ),
            section("What an evaluation costs", price),
            section(
                "How right it is",
                vec![
                    text(
                        "The pendulum has a closed form, sin(φ/2) = k cd(ω₀t, k) with k = sin 45° and Jacobi’s elliptic \
                         function cd. Everything below is measured against it.",
                    ),
                    Block::Table(tables::accuracy(outcomes)),
                    Block::Figure(charts::angle(outcomes)),
                    Block::Figure(charts::energy(outcomes)),
                ],
            ),
            section("The reaction of the pivot", reactions),
        ],
        colophon: vec![
            format!("Compiled for {target}."),
            format!(
                "holonom {}. Repeat with: cargo run --release --bin study. The numbers are in chapter15.json, beside \
                 this page.",
                env!("CARGO_PKG_VERSION")
            ),
        ],
    }
}

/// Writes `index.html`, the pictures and `chapter15.json` into a directory; the paths of what was
/// written.
///
/// # Errors
/// [`StudyError`] where a number is not finite, a picture has nothing to show or a file cannot be
/// written.
pub fn write(
    document: &Document,
    outcomes: &[Outcome],
    directory: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let numbers = directory.join("chapter15.json");
    write_atomically(&numbers, json(outcomes)?.as_bytes())?;
    let mut written = write_page(document, directory)?;
    written.push(numbers);
    Ok(written)
}

#[cfg(test)]
mod tests {
    use super::{document, write};
    use crate::chapter15::outcome::tests::made_up;
    use crate::chapter15::{Method, Settings};
    use crate::document::Block;
    use crate::page::html_page;
    use crate::target::Target;

    #[test]
    fn the_page_has_all_tables_figures_and_formulations() {
        let outcomes = Method::ALL.map(made_up);
        let document = document(&outcomes, &Settings::TABLE_15_2, &Target::CURRENT);
        let page = html_page(&document).unwrap();
        for part in [
            "Table 15.1",
            "Table 15.2",
            "Table 15.3",
            "Figure 15.2",
            "Compiled for",
        ] {
            assert!(page.contains(part), "{part} is missing");
        }
        let figures: Vec<_> = document
            .figures()
            .map(|figure| figure.name.as_str())
            .collect();
        assert_eq!(
            figures,
            [
                "violation",
                "angle",
                "energy",
                "reaction",
                "radial",
                "transverse"
            ]
        );
        for figure in document
            .figures()
            .filter(|figure| figure.name != "reaction")
        {
            let names: Vec<_> = figure
                .chart
                .series
                .iter()
                .map(|series| &series.name)
                .collect();
            assert_eq!(
                names,
                ["standard", "Baumgarte", "penalty", "augmented Lagrangian"]
            );
            let svg = figure.chart.draw().unwrap().svg;
            assert!(names.iter().all(|name| svg.contains(name.as_str())));
        }
        assert_eq!(page.matches("<svg").count(), 6);
    }

    #[test]
    fn headings_are_followed_by_something() {
        let document = document(
            &Method::ALL.map(made_up),
            &Settings::TABLE_15_2,
            &Target::CURRENT,
        );
        assert!(
            document
                .sections
                .iter()
                .all(|section| !section.blocks.is_empty())
        );
        let tables = document.sections.iter().flat_map(|s| &s.blocks);
        assert_eq!(tables.filter(|b| matches!(b, Block::Table(_))).count(), 8);
    }

    #[test]
    fn all_files_are_written() {
        let outcomes = Method::ALL.map(made_up);
        let document = document(&outcomes, &Settings::TABLE_15_2, &Target::CURRENT);
        let directory = std::env::temp_dir().join(format!("holonom-15-{}", std::process::id()));
        let written = write(&document, &outcomes, &directory).unwrap();
        assert_eq!(written.len(), 8);
        assert!(written.iter().all(|path| path.is_file()));
        assert_eq!(std::fs::read_dir(&directory).unwrap().count(), 8);
    }
}
