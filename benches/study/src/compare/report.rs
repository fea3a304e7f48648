//! The comparison as a document and as files.

use std::path::{Path, PathBuf};

use super::measure::Refused;
use super::record::{Compiled, Row, from_json, json};
use super::{charts, tables};
use crate::chapter15::Method;
use crate::document::{Block, Document, Section};
use crate::error::StudyError;
use crate::files::write_atomically;
use crate::page::write_page;
use crate::statistics::Quartiles;
use crate::target::Target;
use crate::timing::busy_sentence;

/// The command that the numbers are made with.
pub const COMMAND: &str = "RUSTFLAGS=\"-C target-cpu=native\" cargo run --release --target-dir target/native --bin study -- compare --large";
/// The command for a plain build.
pub const PLAIN_COMMAND: &str = "cargo run --release --bin study -- compare --large --plain";

/// The file of the numbers of a plain build.
const PLAIN: &str = "plain.json";
/// The file of what builds take.
const COMPILED: &str = "compile.json";
/// The file of the numbers.
const NUMBERS: &str = "compare.json";

/// The comparison as a document.
#[must_use]
pub fn document(rows: &[Row], refused: &[Refused], beside: &Beside, target: &Target) -> Document {
    let text = |text: &str| Block::Text(text.into());
    let section = |heading: &str, blocks| Section {
        heading: heading.into(),
        blocks,
    };
    let mut standard = vec![Block::Table(tables::cost(rows, Method::Standard))];
    standard.push(Block::Figure(charts::price(rows)));
    let growth = charts::operations(rows)
        .into_iter()
        .chain(charts::growth(rows));
    let growth: Vec<_> = growth.map(Block::Figure).collect();
    let others = [
        Method::Baumgarte,
        Method::Penalty,
        Method::AugmentedLagrangian,
    ];
    let mut others: Vec<_> = others
        .map(|method| Block::Table(tables::cost(rows, method)))
        .into();
    others.extend(left_out(refused).map(Block::Text));

    let mut sections = vec![section("Standard multipliers", standard)];
    if !growth.is_empty() {
        sections.push(section("Growth", growth));
    }
    sections.extend([
        section("The other formulations", others),
        section(
            "Two number types",
            vec![Block::Table(tables::precisions(rows))],
        ),
        section(
            "What stands before a kernel",
            vec![Block::Table(tables::interface(rows))],
        ),
    ]);
    sections.push(match &beside.plain {
        Some(plain) => section("A plain build", vec![Block::Table(tables::builds(rows, plain))]),
        None => section(
            "A plain build",
            vec![text(&format!("There are no numbers of a plain build beside these. Make them with: {PLAIN_COMMAND}"))],
        ),
    });
    sections.push(match &beside.compiled {
        Some(compiled) => section(
            "Expansion and compile time",
            vec![Block::Table(tables::builds_of(compiled))],
        ),
        None => section(
            "Expansion and compile time",
            vec![text("Not measured: --compile does.")],
        ),
    });
    let mut document = Document {
        title: "What an evaluation costs".into(),
        lead: vec![
            "Mechanisms by their bodies and by their joints, in four formulations and two number types. Everything is timed in one race: in every round each \
             right-hand side has a turn, and a time is the least of its turns, by the clock of the thread's processor. Evaluations go over up to 64 states of a motion, and do not depend on each other; those that wait \
             have the rates of the last evaluation in their state. Steps of Runge-Kutta start from states that do not depend on each other."
                .into(),
            "The reference kernel is the pendulum of chapter 15 of Flores (2015) by its bodies, written by hand: masses eliminated first, five equations solved by L D Lᵀ, \
             nothing known of the mechanism beyond zeros and constants. Its time, T, is a unit that depends little on the processor."
                .into(),
        ],
        sections,
        colophon: vec![
            format!("Compiled for {target}."),
            format!(
                "holonom {}. Repeat with: {COMMAND}. A plain build: {PLAIN_COMMAND}. The numbers are in {NUMBERS}, beside this page.",
                env!("CARGO_PKG_VERSION")
            ),
        ],
    };
    // The first that is read, on a terminal too.
    if let Some(section) = document.sections.first_mut() {
        section.blocks.splice(0..0, busy(rows).map(Block::Text));
    }
    document
}

/// A sentence where the machine was not quiet.
fn busy(rows: &[Row]) -> Option<String> {
    let share = rows
        .iter()
        .map(|row| row.processor_share)
        .fold(1.0, f64::min);
    let spreads: Vec<f64> = rows.iter().map(|row| row.spread).collect();
    let spread = Quartiles::of(&spreads).map_or(1.0, |spread| spread.median);
    busy_sentence(share, spread)
}

/// What was refused, one sentence for each reason.
fn left_out(refused: &[Refused]) -> Option<String> {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for case in refused {
        let reason = case.fault.to_string();
        let which = format!(
            "{} {} in {}, {} by {}",
            case.scene,
            case.n,
            case.precision.key(),
            case.method.name(),
            case.coordinates.key()
        );
        let place = reasons.iter().position(|(known, _)| *known == reason);
        let place = place.unwrap_or_else(|| {
            reasons.push((reason, Vec::new()));
            reasons.len() - 1
        });
        if !reasons[place].1.contains(&which) {
            reasons[place].1.push(which);
        }
    }
    let sentences: Vec<_> = reasons
        .iter()
        .map(|(reason, which)| format!("Not here: {} ({reason}).", which.join("; ")))
        .collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

/// What other runs have left in a directory, to stand on the page as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beside {
    /// The rows of a plain build.
    pub plain: Option<Vec<Row>>,
    /// What builds of small crates take.
    pub compiled: Option<Vec<Compiled>>,
}

impl Beside {
    /// Reads what is there.
    ///
    /// # Errors
    /// [`StudyError::Json`] where a file is none of ours.
    pub fn of(directory: &Path) -> Result<Self, StudyError> {
        let text = |name: &str| std::fs::read_to_string(directory.join(name)).ok();
        Ok(Self {
            plain: text(PLAIN).map(|text| from_json(&text)).transpose()?,
            compiled: text(COMPILED)
                .map(|text| serde_json::from_str(&text))
                .transpose()?,
        })
    }
}

/// Writes what builds take into a directory.
///
/// # Errors
/// [`StudyError`] where the file cannot be written.
pub fn write_compiled(compiled: &[Compiled], directory: &Path) -> Result<(), StudyError> {
    let text = serde_json::to_string_pretty(compiled)?;
    write_atomically(&directory.join(COMPILED), text.as_bytes())
}

/// Writes the rows of a plain build into a directory; the path of the file.
///
/// # Errors
/// [`StudyError`] where a number is not finite or the file cannot be written.
pub fn write_plain(rows: &[Row], directory: &Path) -> Result<PathBuf, StudyError> {
    let path = directory.join(PLAIN);
    write_atomically(&path, json(rows)?.as_bytes())?;
    Ok(path)
}

/// Writes `index.html`, the pictures and `compare.json` into a directory; the paths of what was
/// written.
///
/// # Errors
/// [`StudyError`] where a number is not finite, a picture has nothing to show or a file cannot be
/// written.
pub fn write(
    document: &Document,
    rows: &[Row],
    directory: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let numbers = directory.join(NUMBERS);
    write_atomically(&numbers, json(rows)?.as_bytes())?;
    let mut written = write_page(document, directory)?;
    written.push(numbers);
    Ok(written)
}
