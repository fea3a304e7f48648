//! What readings are compared with.

use super::integration::{Family, IntegratorSetting};
use super::observation::{Observation, Start};
use super::setting::{Choice, PostStabilisation, Setting};
use super::subject::{Facts, Subject};
use crate::chapter15::Method;
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;

/// What should be read at some times.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The times (s), growing, and what should be read.
    instants: Vec<(f64, Vec<f64>)>,
    /// By how much it may be off: of two integrations the one against the other; zero of a closed
    /// form and of published values, which say themselves how good they are.
    pub error: f64,
    /// Where it comes from.
    pub source: Source,
}

/// Where a reference comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The problem: a closed form, or published values.
    Problem,
    /// Two integrations of the study.
    IntegratorSetting,
}

/// Tolerances of the two integrations.
const TIGHT: [f64; 2] = [1e-12, 1e-13];

impl Reference {
    /// The reference of a problem from a start: its own where it starts as described and something
    /// is known, else two integrations with tight tolerances, which differ in description or, where
    /// there is but one, in formulation and correction.
    ///
    /// # Errors
    /// [`StudyError::Run`] where an integration stops.
    pub fn of(subject: &dyn Subject, start: Option<&Start>) -> Result<Self, StudyError> {
        let facts = subject.facts();
        facts.check()?;
        if start.is_none() {
            let known: Vec<_> = times(&facts.span)
                .filter_map(|time| Some((time, subject.reference(time)?)))
                .collect();
            if !known.is_empty() {
                return Ok(Self {
                    instants: known,
                    error: 0.0,
                    source: Source::Problem,
                });
            }
        }
        let own;
        let start = match start {
            Some(start) => start,
            None => {
                own = subject.start()?;
                &own
            }
        };
        let other = match facts.closing {
            Some(_) => Coordinates::Joints,
            None => Coordinates::Bodies,
        };
        let ways = [
            (Coordinates::Bodies, PostStabilisation::Projection, TIGHT[0]),
            (other, PostStabilisation::None, TIGHT[1]),
        ];
        let [first, last] = ways.map(|(coordinates, stabilisation, tolerance)| {
            observed(subject, start, coordinates, stabilisation, tolerance)
        });
        let (first, last) = (first?, last?);
        let reference = Self {
            instants: last.times.into_iter().zip(last.values).collect(),
            error: 0.0,
            source: Source::IntegratorSetting,
        };
        let error = reference.error_of(subject, &first);
        Ok(Self { error, ..reference })
    }

    /// The times (s), growing, and what should be read at them.
    pub fn instants(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.instants
            .iter()
            .map(|(time, values)| (*time, &values[..]))
    }

    /// Refuses readings that there is nothing to compare of.
    pub(super) fn check(&self, facts: &Facts, run: &Observation) -> Result<(), StudyError> {
        let refused = |reason: String| StudyError::Run {
            name: facts.name.clone(),
            reason,
        };
        let read = run.values.first().map_or(0, Vec::len);
        if read == 0 {
            return Err(refused("nothing is read: `read` returns no values".into()));
        }
        for (time, values) in self.instants() {
            if values.len() != read {
                let known = values.len();
                return Err(refused(format!(
                    "`read` returns {read} values, the reference {known} at {time} s"
                )));
            }
            if !values.iter().all(|value| value.is_finite()) {
                return Err(refused(format!("the reference is not finite at {time} s")));
            }
        }
        if !self.instants().any(|(time, _)| time > facts.span.start) {
            return Err(refused("the reference is known at the start alone".into()));
        }
        Ok(())
    }

    /// The largest error of a run at the times of the reference. NaN where a reading is, or where
    /// none is compared.
    #[must_use]
    pub fn error_of(&self, subject: &dyn Subject, run: &Observation) -> f64 {
        let mut largest = f64::NAN;
        for (time, values) in run.times.iter().zip(&run.values) {
            let Some(expected) = self.at(subject, *time) else {
                continue;
            };
            if values.len() != expected.len() {
                return f64::NAN;
            }
            let error = subject.difference(values, &expected);
            if error.is_nan() {
                return error;
            }
            largest = largest.max(error);
        }
        largest
    }

    /// What should be read at a time of a run, whose numbers may be less exact than those of the
    /// reference.
    fn at(&self, subject: &dyn Subject, time: f64) -> Option<Vec<f64>> {
        /// Of single precision, with some to spare.
        const SAME: f64 = 1e-6;
        let near = |then: f64| (then - time).abs() <= SAME * then.abs().max(time.abs());
        let place = self
            .instants
            .partition_point(|&(then, _)| then < time && !near(then));
        let (_, values) = self.instants.get(place).filter(|&&(then, _)| near(then))?;
        // A closed form is known at the very time.
        let exact = match self.source {
            Source::Problem => subject.reference(time),
            Source::IntegratorSetting => None,
        };
        Some(exact.unwrap_or_else(|| values.clone()))
    }
}

/// A run by Dormand-Prince with standard multipliers, or with an augmented Lagrangian where
/// equations are kept although they depend on others, which is for formulations with a compliance.
pub(super) fn observed(
    subject: &dyn Subject,
    start: &Start,
    coordinates: Coordinates,
    stabilisation: PostStabilisation,
    tolerance: f64,
) -> Result<Observation, StudyError> {
    let with = |method| {
        let integration = IntegratorSetting {
            family: Family::DormandPrince,
            step_or_tolerance: tolerance,
        };
        let scalar = Precision::Double;
        let (formulation, is_derived, _) =
            Choice::Derived(method).made(subject, scalar, integration);
        Setting {
            coordinates,
            formulation,
            is_derived,
            stabilisation,
            integration,
            scalar,
        }
    };
    let standard = subject.observe(&with(Method::Standard), start);
    // What standard multipliers say is what the reader should know, if neither will do.
    standard.or_else(|error| {
        let compliant = subject.observe(&with(Method::AugmentedLagrangian), start);
        compliant.map_err(|_| error)
    })
}

/// The reporting times of a span.
fn times(span: &holonom::integrate::TimeSpan<f64>) -> impl Iterator<Item = f64> + use<> {
    let span = *span;
    let whole = ((span.end - span.start) / span.first_output - 1e-9).floor() as u32;
    let multiples = (0..=whole).map(move |k| span.start + f64::from(k) * span.first_output);
    multiples.chain([span.end])
}
