//! The cells of a map, and their runs.

use std::hash::{DefaultHasher, Hasher as _};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use super::outcome::{Outcome, judge};
use super::thresholds::{HOLDS, Motion, WRONG, promised};
use crate::error::StudyError;
use crate::target::Target;
use crate::trade::{Journal, Key, Setting, Subject};

/// What is swept.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// A short name without spaces.
    pub name: &'static str,
    /// What is varied, and of what, in a sentence.
    pub title: String,
    /// The unit of its values; `1` for a pure number.
    pub unit: &'static str,
}

/// One run of a map.
pub struct Cell {
    /// The place of its axis among those of the map.
    pub axis: usize,
    /// The mechanism.
    pub model: &'static str,
    /// The place on the axis.
    pub value: f64,
    /// With what it is run.
    pub setting: Setting,
    /// What is known of the motion beforehand.
    pub motion: Motion,
    /// The scale of the motion, in the unit of the problem.
    pub scale: f64,
    /// Makes the problem, where it is run.
    pub subject: Box<dyn Fn() -> Box<dyn Subject> + Send + Sync>,
}

/// A cell in `extremes.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What is swept.
    pub axis: String,
    /// The mechanism.
    pub model: String,
    /// With what it was run.
    #[serde(flatten)]
    pub setting: Key,
    /// The place on the axis, `null` where it is not a finite number.
    pub value: Option<f64>,
    /// The same as text.
    pub value_text: String,
    /// What became of it.
    pub outcome: Outcome,
    /// Why, where it does not hold.
    pub reason: String,
    /// The error over the motion's scale; `null` where the run failed.
    pub error: Option<f64>,
    /// What was promised; `null` where that is no number, as for an input that is none.
    pub promised: Option<f64>,
}

/// Runs all cells, on as many processors as there are; in their order. Every one is written down in
/// `journal` at once, so that an interrupted map goes on where it was.
///
/// `progress` is called with the cells done.
///
/// # Errors
/// [`StudyError`] where the journal cannot be written. A run that stops is an outcome.
pub fn run(
    axes: &[Axis],
    cells: &[Cell],
    journal: &Path,
    progress: impl Fn(usize) + Sync,
) -> Result<Vec<Row>, StudyError> {
    let conditions = conditions(axes, cells)?;
    let journal = Mutex::new(Journal::<Row>::open(journal, &conditions)?);
    let next = AtomicUsize::new(0);
    let done = AtomicUsize::new(0);
    let rows: Mutex<Vec<Option<Row>>> = Mutex::new(vec![None; cells.len()]);
    let failed: Mutex<Option<StudyError>> = Mutex::new(None);
    let work = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let is_over = lock(&failed).is_some();
            let Some(cell) = cells.get(place).filter(|_| !is_over) else {
                return;
            };
            match row(&axes[cell.axis], cell, &journal) {
                Ok(row) => lock(&rows)[place] = Some(row),
                Err(error) => *lock(&failed) = Some(error),
            }
            progress(done.fetch_add(1, Ordering::Relaxed) + 1);
        }
    };
    std::thread::scope(|scope| {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        for _ in 0..processors {
            scope.spawn(work);
        }
    });
    if let Some(error) = lock(&failed).take() {
        return Err(error);
    }
    let rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(rows.into_iter().flatten().collect())
}

/// Under which conditions entries of a journal are those of this map, in one line: program, target,
/// and what every cell promises.
fn conditions(axes: &[Axis], cells: &[Cell]) -> Result<String, StudyError> {
    let mut hasher = DefaultHasher::new();
    for number in [HOLDS, WRONG] {
        hasher.write_u64(number.to_bits());
    }
    for cell in cells {
        hasher.write(axes[cell.axis].name.as_bytes());
        for number in [
            cell.value,
            cell.scale,
            promised(&cell.setting, &cell.motion),
        ] {
            hasher.write_u64(number.to_bits());
        }
    }
    Ok(serde_json::to_string(&(
        env!("CARGO_PKG_VERSION"),
        Target::CURRENT.to_string(),
        hasher.finish(),
    ))?)
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn row(axis: &Axis, cell: &Cell, journal: &Mutex<Journal<Row>>) -> Result<Row, StudyError> {
    let key = Key::from(&cell.setting);
    let text = format!("{:e}", cell.value);
    let known = lock(journal)
        .entries()
        .iter()
        .find(|row| {
            row.axis == axis.name
                && row.model == cell.model
                && row.value_text == text
                && row.setting == key
        })
        .cloned();
    if let Some(row) = known {
        return Ok(row);
    }
    let subject = (cell.subject)();
    let verdict = judge(&*subject, &cell.setting, &cell.motion, cell.scale)?;
    let row = Row {
        axis: axis.name.into(),
        model: cell.model.into(),
        setting: key,
        value: cell.value.is_finite().then_some(cell.value),
        value_text: text,
        outcome: verdict.outcome,
        reason: verdict.reason,
        error: verdict.error,
        promised: verdict.promised.is_finite().then_some(verdict.promised),
    };
    lock(journal).add(row.clone())?;
    Ok(row)
}
