//! The four runs, and the race that times them.

use holonom::{
    AugmentedLagrangian, Baumgarte, BodyHandle, DormandPrince, Fault, Formulation, JointHandle,
    Mechanism, Penalty, Runs, Sample, StandardLagrange, Tolerance,
    dynamics::{Dynamics, Problem},
    integrate::TimeSpan,
    mechanism::{Absolute, HasAngle},
};

use super::outcome::{Instant, Outcome, Prices};
use super::{Chapter15, Method, Settings};
use crate::error::StudyError;
use crate::pendulum::{RigidPendulum, from_vertical};
use crate::run::{Recording, candidate, record};
use crate::timing::{Candidate, Schedule, Timing, race};

/// The pendulum: a mechanism with its rod and its pivot, described as in table 15.1.
#[derive(Debug)]
pub struct Subject<'a, M, J> {
    /// The mechanism.
    pub mechanism: &'a M,
    /// The rod, along +y at the start.
    pub rod: BodyHandle<M>,
    /// The joint between ground and rod, its axis along +x.
    pub pivot: JointHandle<M, J>,
}

/// What kind of code a rival is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Bodies and joints are chosen at run time.
    Assembler,
    /// One mechanism, with matrices of static size.
    StaticMatrices,
}

/// Other code for one of the formulations, that runs through the same integrator.
#[derive(Debug)]
pub struct Rival<'a> {
    /// The formulation.
    pub method: Method,
    /// What kind of code it is.
    pub kind: Kind,
    /// The code.
    pub candidate: Candidate<'a>,
}

impl Settings {
    /// From zero to the end, with the first report.
    #[must_use]
    pub const fn span(&self) -> TimeSpan<f64> {
        TimeSpan {
            start: 0.0,
            end: self.end,
            first_output: self.reporting,
        }
    }

    /// The integrator of the chapter.
    #[must_use]
    pub const fn integrator(&self) -> DormandPrince<f64> {
        DormandPrince::new(Tolerance {
            relative: self.relative,
            absolute: self.absolute,
        })
    }

    const fn for_baumgarte(&self) -> Baumgarte<f64> {
        Baumgarte {
            alpha: self.baumgarte.0,
            beta: self.baumgarte.1,
        }
    }

    const fn for_penalty(&self) -> Penalty<f64> {
        let (alpha, omega, mu) = self.penalty;
        Penalty::new(alpha, omega, mu)
    }

    const fn for_augmented_lagrangian(&self) -> AugmentedLagrangian<f64> {
        let (alpha, omega, mu) = self.penalty;
        let (tolerance, max_iterations) = (self.iteration_tolerance, self.iteration_cap);
        AugmentedLagrangian {
            alpha,
            omega,
            mu,
            radian: None,
            tolerance,
            max_iterations,
            is_exact: false,
        }
    }
}

/// Runs the four formulations, times them and their rivals in one race.
///
/// `progress` is called with the part of the work that is done, from 0 to 1.
///
/// # Errors
/// [`StudyError::Run`] where a run stops, [`StudyError::NotFinite`] where a time cannot be told.
pub fn compare<M: Mechanism, J: HasAngle>(
    subject: &Subject<'_, M, J>,
    settings: &Settings,
    rivals: Vec<Rival<'_>>,
    schedule: Schedule,
    mut progress: impl FnMut(f64),
) -> Result<Vec<Outcome>, StudyError> {
    let work = (Method::ALL.len() + schedule.rounds) as f64;
    let (mut recordings, mut entries) = (Vec::new(), Vec::new());
    for (done, method) in Method::ALL.into_iter().enumerate() {
        let (recording, ours) = match method {
            Method::Standard => subject.enter(method, StandardLagrange, settings),
            Method::Baumgarte => subject.enter(method, settings.for_baumgarte(), settings),
            Method::Penalty => subject.enter(method, settings.for_penalty(), settings),
            Method::AugmentedLagrangian => {
                subject.enter(method, settings.for_augmented_lagrangian(), settings)
            }
        }?;
        recordings.push((method, recording));
        entries.push((method, None, ours));
        progress((done + 1) as f64 / work);
    }
    entries.extend(
        rivals
            .into_iter()
            .map(|r| (r.method, Some(r.kind), r.candidate)),
    );

    let mut candidates = Vec::with_capacity(entries.len());
    let mut labels = Vec::with_capacity(entries.len());
    for (method, kind, candidate) in entries {
        labels.push((method, kind));
        candidates.push(candidate);
    }
    let timings = race(&mut candidates, schedule, |rounds| {
        progress((Method::ALL.len() + rounds) as f64 / work);
    })?;

    let timed: Vec<_> = labels.into_iter().zip(timings).collect();
    let outcome = |(method, recording)| outcome(method, recording, &timed);
    recordings.into_iter().map(outcome).collect()
}

type Timed = ((Method, Option<Kind>), Timing);

fn outcome(
    method: Method,
    recording: Recording<Instant>,
    timed: &[Timed],
) -> Result<Outcome, StudyError> {
    let of = |kind: Option<Kind>| {
        let wanted = move |entry: &&Timed| entry.0 == (method, kind);
        timed
            .iter()
            .filter(wanted)
            .map(|(_, timing)| timing.clone())
    };
    let generated = of(None).next().ok_or_else(|| StudyError::NotFinite {
        what: format!("the time per evaluation of {}", method.name()),
    })?;
    Ok(Outcome {
        method,
        evaluations: recording.evaluations,
        accepted: recording.accepted,
        rejected: recording.rejected,
        iterations: recording.iterations,
        instants: recording.reports,
        prices: Prices {
            generated,
            assembler: of(Some(Kind::Assembler)).collect(),
            static_matrices: of(Some(Kind::StaticMatrices)).collect(),
        },
    })
}

impl<M: Mechanism, J: HasAngle> Subject<'_, M, J> {
    /// Runs one formulation, and enters it for the race.
    fn enter<'a, F: Formulation<f64> + 'a>(
        &self,
        method: Method,
        formulation: F,
        settings: &Settings,
    ) -> Result<(Recording<Instant>, Candidate<'a>), StudyError> {
        let (span, integrator) = (settings.span(), settings.integrator());
        let recording = self.record(method, formulation, integrator, span)?;
        let dynamics =
            Dynamics::<Problem<M, F>>::new(self.mechanism, formulation).map_err(|fault| {
                StudyError::Run {
                    name: method.name().into(),
                    reason: fault.to_string(),
                }
            })?;
        let dynamics = dynamics.orientation::<Chapter15>();
        let start = M::initial_state(dynamics.constants());
        Ok((
            recording,
            candidate("generated", dynamics, integrator, span, start),
        ))
    }

    /// Runs one formulation, Euler parameters read as the chapter's programs do, and reads what the
    /// study compares.
    ///
    /// # Errors
    /// [`StudyError::Run`] where the run stops.
    pub fn record<F: Formulation<f64>, I: Runs<Problem<M, F, f64, Absolute<Chapter15>>>>(
        &self,
        method: Method,
        formulation: F,
        integrator: I,
        span: TimeSpan<f64>,
    ) -> Result<Recording<Instant>, StudyError> {
        let read = |sample: &Sample<'_, f64, M>| self.read(sample);
        record::<Chapter15, _, _, _, _>(
            method.name(),
            self.mechanism,
            (formulation, integrator),
            span,
            read,
        )
    }

    fn read(&self, sample: &Sample<'_, f64, M>) -> Result<Instant, Fault> {
        let theta = sample.angle(self.pivot);
        Ok(Instant {
            time: sample.time(),
            angle: from_vertical(theta, RigidPendulum::CHAPTER_15.amplitude),
            energy: sample.energy(),
            violation: sample.violation(),
            force: sample.reaction(self.pivot, self.rod)?.force.into(),
        })
    }
}
