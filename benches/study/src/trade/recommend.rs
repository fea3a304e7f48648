//! The cheapest setting for an error, or the most exact one for a time, tried where the grid was
//! not.

use super::integration::IntegratorSetting;
use super::measure::{Timing, Trade, measured};
use super::observation::Start;
use super::record::{Entry, Row};
use super::reference::Reference;
use super::setting::Setting;
use super::subject::Subject;
use crate::error::StudyError;
use crate::format::two_digits;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// An error that no run may exceed, in the unit of the problem: the cheapest setting.
    Error(f64),
    /// Seconds that the whole run may take: the most exact setting.
    Budget(f64),
}

/// A processor that a recommendation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Processor {
    /// The one that the trade was measured on.
    Here,
    /// A Cortex-M7 with numbers in double precision at 480 MHz, by counts of operations: an
    /// estimate.
    CortexM7,
}

impl Processor {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Here, Self::CortexM7];

    /// The name on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Here => "here",
            Self::CortexM7 => "cortex-m7",
        }
    }

    /// The seconds of a run on it. `None` where nothing is known: of a formulation that iterates as
    /// often as the state asks for, and of a run that is corrected after steps.
    #[must_use]
    pub fn seconds(self, subject: &dyn Subject, setting: &Setting, row: &Row) -> Option<f64> {
        /// Instructions of an operation, with what it loads and stores, and those of a stage of a
        /// step that are there for any mechanism: between 0.7 and 1.5 times what
        /// `tests/firmware/run` counts, see `benches/tests/cortex_m7.rs`.
        const INSTRUCTIONS: f64 = 2.4;
        const STAGE: f64 = 60.0;
        const HERTZ: f64 = 480e6;
        match self {
            Self::Here => Some(row.seconds),
            Self::CortexM7 => {
                let operations = subject.operations(setting)? as f64;
                let stage = INSTRUCTIONS.mul_add(operations, STAGE);
                Some(row.evaluations as f64 * stage / HERTZ)
            }
        }
    }
}

/// A setting that does what was asked for, from every start that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Recommendation {
    /// With what to run.
    pub setting: Setting,
    /// What it took in the trade.
    pub row: Row,
    /// The seconds of the whole run on the processor that was asked for.
    pub seconds: f64,
    /// The errors from the problem's own start and from starts nearby.
    pub errors: Vec<f64>,
    /// Cheaper, or more exact, settings of the trade that failed from a start nearby, and by what
    /// error, or why.
    pub passed_over: Vec<(Setting, String)>,
}

impl Recommendation {
    /// The largest error that was seen.
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }
}

/// How many starts nearby are tried, and how far from the problem's own they are, see
/// [`Subject::start_near`].
pub const STARTS: u64 = 10;
/// See [`STARTS`].
pub const NEARBY: f64 = 0.01;
/// How much larger than the largest error that was seen the error that is asked for must be: starts
/// nearby differ, and ten of them are not all.
pub const MARGIN: f64 = 1.5;

/// The best setting of a trade for a wish, of those whose runs have no warnings and do what is
/// asked for from [`STARTS`] starts nearby as well, against integrations with tight tolerances.
///
/// `None` where there is none: the error is below what the settings reach, or the time above what
/// they take.
///
/// # Errors
/// [`StudyError`] where a reference cannot be computed, or the wish is not a positive number.
pub fn recommend(
    subject: &dyn Subject,
    trade: &Trade,
    wish: Wish,
    (processor, timing): (Processor, Timing<'_>),
    mut progress: impl FnMut(),
) -> Result<Option<Recommendation>, StudyError> {
    let (Wish::Error(asked) | Wish::Budget(asked)) = wish;
    if !(asked > 0.0 && asked < f64::INFINITY) {
        return Err(StudyError::Run {
            name: trade.facts.name.clone(),
            reason: format!("{asked} is asked for, which is no error and no time"),
        });
    }
    let runs = trade.rows.iter().zip(&trade.settings);
    let trusted = runs.filter(|(row, _)| row.is_trusted());
    let priced = trusted.filter_map(|(row, setting)| {
        let seconds = processor.seconds(subject, setting, row)?;
        Some((*setting, row.clone(), seconds))
    });
    let mut candidates: Vec<_> = priced.collect();
    match wish {
        Wish::Error(asked) => {
            candidates.retain(|(_, row, _)| row.error * MARGIN <= asked);
            candidates.sort_by(|a, b| a.2.total_cmp(&b.2));
        }
        Wish::Budget(seconds) => {
            candidates.retain(|candidate| candidate.2 <= seconds);
            candidates.sort_by(|a, b| a.1.error.total_cmp(&b.1.error));
            // Errors within a factor of two are the same: of these the cheapest.
            let least = candidates.first().map_or(0.0, |best| best.1.error);
            let alike = candidates.partition_point(|candidate| candidate.1.error <= 2.0 * least);
            candidates[..alike].sort_by(|a, b| a.2.total_cmp(&b.2));
        }
    }
    let (mut trials, mut passed_over) = (None, Vec::new());
    for (setting, row, seconds) in candidates {
        progress();
        let trials = match &trials {
            Some(trials) => trials,
            None => trials.insert(starts_nearby(subject)?),
        };
        let mut errors = vec![row.error];
        let asked = match wish {
            Wish::Error(asked) => asked,
            // What is ten times off elsewhere was right by chance.
            Wish::Budget(_) => 10.0 * row.error,
        };
        match tried(subject, &setting, trials, asked, &mut errors) {
            Ok(()) => {
                let found = Recommendation {
                    setting,
                    row,
                    seconds,
                    errors,
                    passed_over,
                };
                return Ok(Some(match wish {
                    Wish::Error(asked) => {
                        refined(subject, trade, found, asked, (processor, timing), trials)?
                    }
                    Wish::Budget(_) => found,
                }));
            }
            Err(reason) => passed_over.push((setting, reason)),
        }
    }
    Ok(None)
}

/// The same with the step, or the tolerance, that the error allows beyond that of the grid, where
/// it is cheaper and does what is asked for.
fn refined(
    subject: &dyn Subject,
    trade: &Trade,
    found: Recommendation,
    asked: f64,
    (processor, timing): (Processor, Timing<'_>),
    trials: &[(Start, Reference)],
) -> Result<Recommendation, StudyError> {
    let integration = found.setting.integration;
    let slack = 0.9 * asked / (MARGIN * found.worst());
    let factor = if integration.family.is_adaptive() {
        slack
    } else {
        slack.powf(1.0 / f64::from(integration.family.order()))
    };
    let more = two_digits(integration.step_or_tolerance * factor);
    if more.is_nan() || more <= integration.step_or_tolerance {
        return Ok(found);
    }
    let setting = Setting {
        integration: IntegratorSetting {
            step_or_tolerance: more,
            ..integration
        },
        ..found.setting
    };
    let Entry::Row(row) = measured(
        subject,
        &setting,
        &subject.start()?,
        &trade.reference,
        timing,
    )?
    else {
        return Ok(found);
    };
    let mut errors = vec![row.error];
    let seconds = processor.seconds(subject, &setting, &row);
    let holds = row.error * MARGIN <= asked
        && row.is_trusted()
        && tried(subject, &setting, trials, asked, &mut errors).is_ok();
    match seconds.filter(|&seconds| holds && seconds < found.seconds) {
        Some(seconds) => Ok(Recommendation {
            setting,
            row,
            seconds,
            errors,
            ..found
        }),
        None => Ok(found),
    }
}

/// Starts nearby with their references.
fn starts_nearby(subject: &dyn Subject) -> Result<Vec<(Start, Reference)>, StudyError> {
    let trial = |number| {
        let start = subject.start_near(NEARBY, number)?;
        let reference = Reference::of(subject, Some(&start)).map_err(|error| StudyError::Run {
            name: subject.facts().name,
            reason: format!(
                "a start nearby has nothing to be compared with, so nothing is recommended: {error}"
            ),
        })?;
        Ok((start, reference))
    };
    (1..=STARTS).map(trial).collect()
}

/// Runs a setting from all of these starts, as long as it does what is asked for.
fn tried(
    subject: &dyn Subject,
    setting: &Setting,
    trials: &[(Start, Reference)],
    asked: f64,
    errors: &mut Vec<f64>,
) -> Result<(), String> {
    for (start, reference) in trials {
        let run = subject
            .observe(setting, start)
            .map_err(|error| error.to_string())?;
        let error = reference.error_of(subject, &run);
        if error.is_nan() || error * MARGIN > asked {
            return Err(format!("an error of {error:.1e} from a start nearby"));
        }
        if let Some(warning) = run.warnings.first() {
            return Err(format!("from a start nearby: {warning}"));
        }
        errors.push(error);
    }
    Ok(())
}
