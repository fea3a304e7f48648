//! The runs of a trade.

use std::hash::{DefaultHasher, Hasher as _};
use std::path::Path;
use std::time::Duration;

use super::grid::{Grid, Planned};
use super::observation::{Observation, Start};
use super::record::{Entry, Key, Row, Stopped, Time};
use super::reference::{Reference, observed};
use super::setting::{PostStabilisation, Setting};
use super::subject::{Facts, Subject};
use crate::compare::Coordinates;
use crate::error::StudyError;
use crate::journal::Journal;
use crate::target::Target;
use crate::timing::{Candidate, Schedule, race};

/// What was measured of a problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// The problem.
    pub facts: Facts,
    /// What errors are against.
    pub reference: Reference,
    /// The runs that came to their end, in the order of the grid.
    pub rows: Vec<Row>,
    /// Their settings, one for each row.
    pub settings: Vec<Setting>,
    /// The others.
    pub stopped: Vec<Stopped>,
    /// The time of an evaluation of the reference kernel (s), the median of all that were measured
    /// beside the runs; `None` without a reference kernel.
    pub reference_kernel: Option<f64>,
}

/// How runs are timed.
#[derive(Clone, Copy)]
pub struct Timing<'a> {
    /// How often, and for how long.
    pub schedule: Schedule,
    /// What is timed in turn with every run, so that a machine whose speed changes is no part of
    /// the ratio.
    pub reference_kernel: Option<&'a dyn Fn() -> Candidate<'static>>,
}

/// Five rounds of 2 ms, without a reference kernel.
impl Default for Timing<'_> {
    fn default() -> Self {
        Self {
            schedule: Schedule {
                rounds: 5,
                turn: Duration::from_millis(2),
            },
            reference_kernel: None,
        }
    }
}

/// Runs a problem with all settings of a grid. Every run is written down in `journal` at once, so
/// that an interrupted study goes on where it was; the file stays, and another study takes from it
/// what is there, if program, processor, problem and motion are the same.
///
/// `progress` is called with the runs done and their number.
///
/// # Errors
/// [`StudyError`] where the reference cannot be computed or the journal cannot be written. A run
/// that stops is no error, see [`Trade::stopped`].
pub fn measure(
    subject: &dyn Subject,
    grid: &Grid,
    timing: Timing<'_>,
    journal: &Path,
    mut progress: impl FnMut(usize, usize),
) -> Result<Trade, StudyError> {
    let facts = subject.facts();
    facts.check()?;
    grid.check()?;
    let start = subject.start()?;
    let reference = Reference::of(subject, None)?;
    // What is read of the mechanism, and how it moves.
    let probe = observed(
        subject,
        &start,
        Coordinates::Bodies,
        PostStabilisation::None,
        1e-6,
    )?;
    reference.check(&facts, &probe)?;
    let conditions = conditions(&facts, &start, &reference, &probe)?;
    let mut journal = Journal::<Entry>::open(journal, &conditions)?;
    let all = grid.settings(subject);
    let (mut rows, mut settings, mut stopped) = (Vec::new(), Vec::new(), Vec::new());
    for (done, Planned { setting, refused }) in all.iter().enumerate() {
        progress(done, all.len());
        if let Some(reason) = refused {
            stopped.push(Stopped::new(setting, reason.clone()));
            continue;
        }
        let key = Key::from(setting);
        let known = journal
            .entries()
            .iter()
            .find(|entry| *entry.setting() == key);
        let entry = match known {
            Some(entry) => entry.clone(),
            None => {
                let entry = measured(subject, setting, &start, &reference, timing)?;
                journal.add(entry.clone())?;
                entry
            }
        };
        match entry {
            Entry::Row(row) => {
                rows.push(row);
                settings.push(*setting);
            }
            Entry::Stopped(entry) => stopped.push(entry),
        }
    }
    progress(all.len(), all.len());
    let mut reference_kernels: Vec<_> = rows
        .iter()
        .filter_map(|row| Some(row.seconds / row.reference_kernels?))
        .collect();
    reference_kernels.sort_by(f64::total_cmp);
    Ok(Trade {
        facts,
        reference,
        rows,
        settings,
        stopped,
        reference_kernel: reference_kernels.get(reference_kernels.len() / 2).copied(),
    })
}

/// Under which conditions entries of a journal are those of this study, in one line: program,
/// target, problem, what is read of it, what that should be, and how it moves.
fn conditions(
    facts: &Facts,
    start: &Start,
    reference: &Reference,
    probe: &Observation,
) -> Result<String, StudyError> {
    let span = facts.span;
    let mut hasher = DefaultHasher::new();
    let mut take = |values: &[f64]| values.iter().for_each(|x| hasher.write_u64(x.to_bits()));
    probe.values.iter().for_each(|values| take(values));
    take(&probe.energies);
    reference.instants().for_each(|(_, values)| take(values));
    Ok(serde_json::to_string(&(
        env!("CARGO_PKG_VERSION"),
        Target::CURRENT.to_string(),
        &facts.name,
        [span.start, span.end, span.first_output],
        &start.0,
        (facts.equations, facts.closing, hasher.finish()),
    ))?)
}

/// One setting.
pub(super) fn measured(
    subject: &dyn Subject,
    setting: &Setting,
    start: &Start,
    reference: &Reference,
    timing: Timing<'_>,
) -> Result<Entry, StudyError> {
    let stopped = |reason: String| Ok(Entry::Stopped(Stopped::new(setting, reason)));
    let run = match subject.observe(setting, start) {
        Ok(run) => run,
        Err(StudyError::Run { reason, .. }) => return stopped(reason),
        Err(error) => return Err(error),
    };
    let error = reference.error_of(subject, &run);
    let numbers = [error, run.energy_drift];
    let mut numbers = numbers.iter().chain(&run.violations);
    if !numbers.all(|number| number.is_finite()) {
        return stopped("a reading, an energy or a violation is not a finite number".into());
    }
    match time(subject, setting, start, timing) {
        Ok(time) => Ok(Entry::Row(Row::new(setting, &run, error, time))),
        Err(StudyError::Run { reason, .. }) => stopped(reason),
        Err(error) => Err(error),
    }
}

/// The time of one run.
fn time(
    subject: &dyn Subject,
    setting: &Setting,
    start: &Start,
    timing: Timing<'_>,
) -> Result<Time, StudyError> {
    let run = subject.candidate(setting, start)?;
    let mut candidates = vec![run];
    candidates.extend(
        timing
            .reference_kernel
            .map(|reference_kernel| reference_kernel()),
    );
    let timings = race(&mut candidates, timing.schedule, |_| ())?;
    let seconds = |place: usize| {
        let timing = timings.get(place)?;
        Some(1e-9 * timing.time.median)
    };
    let run = timings.first().map_or(f64::NAN, |run| {
        1e-9 * run.time.median * run.evaluations as f64
    });
    Ok(Time {
        seconds: run,
        reference_kernels: seconds(1).map(|reference_kernel| run / reference_kernel),
    })
}
