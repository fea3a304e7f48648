//! From a setting as a value to the types that a mechanism is run with.

use std::ops::ControlFlow;

use holonom::{
    AugmentedLagrangian, Baumgarte, JointCoordinates, Mechanism, Penalty, Projection, Real, Sample,
    Simulation, StandardLagrange, dynamics,
    dynamics::Dynamics,
    every,
    integrate::TimeSpan,
    mechanism::{Absolute, Kernel, Relative},
    run::{TreeRecovery, VelocityProjection},
};

use super::direct::DirectCorrection;
use super::integration::{IntegratorSetting, with_own_type};
use super::movable::{Described, Movable, Studied};
use super::observation::{Observation, Start, state, stopped};
use super::problem::Problem;
use super::setting::{
    Formulated, PostStabilisation, Setting, augmented_lagrangian, baumgarte, penalty,
};
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;
use crate::run::candidate;
use crate::timing::Candidate;

/// Something to be done with a mechanism, once it is known with which numbers, which formulation,
/// which stabilisation and which coordinates.
pub(super) trait Task<'a, P: Problem + 'a> {
    type Outcome;

    fn run<S: Real + 'static, F: Studied<S> + 'static, C: Described<P::Mechanism>>(
        self,
        formulation: F,
        stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<Self::Outcome, StudyError>;
}

/// What is done to states after steps.
pub(super) type Stabilisation<'a, S, M> =
    Option<Box<dyn holonom::run::PostStabilisation<S, M> + 'a>>;

/// The coordinates that a mechanism offers: those in which it has the fewest equations, and
/// absolute ones.
pub(super) trait Offered<P: Problem> {
    /// Equations that remain in joint coordinates, where there are any.
    const CLOSING: Option<usize>;
    const KERNELS: &'static [Kernel];

    /// The stabilisation along the tree of the joints.
    fn recovery<'a, S: Real + 'static>(
        problem: &'a P,
    ) -> Result<Stabilisation<'a, S, P::Mechanism>, StudyError>;

    /// Runs a task in joint coordinates.
    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        task: T,
        formulation: F,
        stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<T::Outcome, StudyError>
    where
        P: 'a;
}

impl<P: Problem<Mechanism: JointCoordinates>> Offered<P> for Relative {
    const CLOSING: Option<usize> = Some(P::Mechanism::JOINT_REPORT.closing.len());
    const KERNELS: &'static [Kernel] = P::Mechanism::JOINT_REPORT.kernels;

    fn recovery<'a, S: Real + 'static>(
        problem: &'a P,
    ) -> Result<Stabilisation<'a, S, P::Mechanism>, StudyError> {
        let recovery = TreeRecovery::<S, P::Mechanism>::new(problem.mechanism());
        match recovery {
            Ok(recovery) => Ok(Some(Box::new(recovery))),
            Err(fault) => Err(stopped(problem, &fault)),
        }
    }

    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        task: T,
        formulation: F,
        stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<T::Outcome, StudyError>
    where
        P: 'a,
    {
        task.run::<S, F, Self>(formulation, stabilisation)
    }
}

impl<P: Problem> Offered<P> for Absolute {
    const CLOSING: Option<usize> = None;
    const KERNELS: &'static [Kernel] = &[];

    fn recovery<'a, S: Real + 'static>(
        _problem: &'a P,
    ) -> Result<Stabilisation<'a, S, P::Mechanism>, StudyError> {
        Err(without_joints())
    }

    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        _task: T,
        _formulation: F,
        _stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<T::Outcome, StudyError>
    where
        P: 'a,
    {
        Err(without_joints())
    }
}

fn without_joints() -> StudyError {
    StudyError::Run {
        name: "joints".into(),
        reason: "the mechanism is not described by joint coordinates: write #[mechanism(coordinates = \"both\")]".into(),
    }
}

pub(super) fn with_formulation<'a, J: Offered<P>, P: Problem, T: Task<'a, P>>(
    problem: &'a P,
    task: T,
    setting: &Setting,
) -> Result<T::Outcome, StudyError> {
    match setting.scalar {
        Precision::Double => with_numbers::<f64, J, P, T>(problem, task, setting),
        Precision::Single => with_numbers::<f32, J, P, T>(problem, task, setting),
    }
}

fn with_numbers<'a, S: Real + 'static, J: Offered<P>, P: Problem, T: Task<'a, P>>(
    problem: &'a P,
    task: T,
    setting: &Setting,
) -> Result<T::Outcome, StudyError> {
    let stabilisation: Stabilisation<'a, S, P::Mechanism> = match setting.stabilisation {
        PostStabilisation::None => None,
        PostStabilisation::Projection => Some(Box::new(Projection::default())),
        PostStabilisation::DirectCorrection => Some(Box::new(DirectCorrection::default())),
        PostStabilisation::VelocityProjection => Some(Box::new(VelocityProjection::default())),
        PostStabilisation::TreeRecovery => J::recovery(problem)?,
    };
    let by = setting.coordinates;
    match &setting.formulation {
        Formulated::Standard => {
            described::<S, J, P, T, _>(task, by, StandardLagrange, stabilisation)
        }
        Formulated::Baumgarte(of) => {
            let formulation: Baumgarte<S> = baumgarte(of);
            described::<S, J, P, T, _>(task, by, formulation, stabilisation)
        }
        Formulated::Penalty(of) => {
            let formulation: Penalty<S> = penalty(of);
            described::<S, J, P, T, _>(task, by, formulation, stabilisation)
        }
        Formulated::AugmentedLagrangian(of) => {
            let formulation: AugmentedLagrangian<S> = augmented_lagrangian(of);
            described::<S, J, P, T, _>(task, by, formulation, stabilisation)
        }
    }
}

fn described<'a, S, J, P, T, F>(
    task: T,
    by: Coordinates,
    formulation: F,
    stabilisation: Stabilisation<'a, S, P::Mechanism>,
) -> Result<T::Outcome, StudyError>
where
    S: Real + 'static,
    J: Offered<P>,
    P: Problem + 'a,
    T: Task<'a, P>,
    F: Studied<S> + 'static,
{
    match by {
        Coordinates::Bodies => task.run::<S, F, Absolute>(formulation, stabilisation),
        Coordinates::Joints => J::by_joints::<S, F, T>(task, formulation, stabilisation),
    }
}

fn span_of<S: Real>(span: &TimeSpan<f64>) -> TimeSpan<S> {
    TimeSpan {
        start: S::constant(span.start),
        end: S::constant(span.end),
        first_output: S::constant(span.first_output),
    }
}

/// A simulation, in absolute coordinates.
fn simulation<'a, S: Real, P: Problem, F: Studied<S> + 'static>(
    problem: &'a P,
    formulation: F,
    (integration, start): (IntegratorSetting, <P::Mechanism as Mechanism>::State<S>),
    stabilisation: &'a Stabilisation<'_, S, P::Mechanism>,
) -> Simulation<'a, dynamics::Problem<P::Mechanism, F, S, Absolute>, IntegratorSetting> {
    let simulation =
        Simulation::new(problem.mechanism(), formulation, integration).absolute_coordinates();
    let simulation = simulation.initial_state(start);
    match stabilisation {
        Some(stabilisation) => simulation.post_stabilisation(&**stabilisation),
        None => simulation,
    }
}

/// The run that is read.
pub(super) struct Observe<'a, P> {
    pub(super) problem: &'a P,
    pub(super) setting: &'a Setting,
    pub(super) start: &'a Start,
}

impl<'a, P: Problem + 'a> Task<'a, P> for Observe<'_, P> {
    type Outcome = Observation;

    fn run<S: Real + 'static, F: Studied<S> + 'static, C: Described<P::Mechanism>>(
        self,
        formulation: F,
        stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<Observation, StudyError> {
        let with = (
            self.setting.integration,
            state::<S, P::Mechanism>(self.start),
        );
        let run = simulation::<S, P, F>(self.problem, formulation, with, &stabilisation);
        observed(self.problem, &run.coordinates::<C>())
    }
}

type Run<'a, S, M, F, C> = Simulation<'a, dynamics::Problem<M, F, S, C>, IntegratorSetting>;

fn observed<S: Real, P: Problem, F: Studied<S>, C>(
    problem: &P,
    run: &Run<'_, S, P::Mechanism, F, C>,
) -> Result<Observation, StudyError>
where
    C: Described<P::Mechanism>,
{
    let span = span_of::<S>(&problem.span());
    let mut seen = Observation::default();
    let mut look = |sample: &Sample<'_, S, P::Mechanism>| {
        seen.times.push(sample.time().to_f64());
        seen.values.push(problem.read(sample));
        seen.violations.push(sample.violation().to_f64().sqrt());
        seen.energies.push(sample.energy().to_f64());
        ControlFlow::Continue(())
    };
    let report = run
        .run(span.start..=span.end, every(span.first_output), &mut look)
        .map_err(|error| stopped(problem, &error))?;
    let monitor = report.monitor.as_ref();
    Ok(Observation {
        evaluations: report.evaluations as u64,
        accepted: report.accepted as u64,
        rejected: report.rejected as u64,
        energy_drift: monitor.map_or(f64::NAN, |monitor| {
            monitor.unaccounted_energy().to_f64().abs()
        }),
        warnings: report
            .warnings()
            .into_iter()
            .map(|warning| warning.to_string())
            .collect(),
        ..seen
    })
}

/// The run that is timed.
pub(super) struct Time<'a, 's, P> {
    pub(super) problem: &'a P,
    pub(super) setting: Setting,
    pub(super) start: &'s Start,
}

impl<'a, P: Problem> Time<'a, '_, P> {
    fn bare<S, Y>(&self, system: Y, start: Y::State) -> Candidate<'a>
    where
        S: Real + 'a,
        Y: Movable<S> + 'a,
    {
        let (span, name) = (span_of::<S>(&self.problem.span()), self.setting.name());
        let integration = self.setting.integration;
        if P::IS_INLINED {
            with_own_type!(
                integration,
                integrator => candidate(name, system, integrator, span, start),
                candidate(name, system, integration, span, start)
            )
        } else {
            candidate(name, system, integration, span, start)
        }
    }
}

/// A run without monitor and readings; its evaluations.
fn bare_run<S: Real, P: Problem, F: Studied<S>, C>(
    problem: &P,
    run: Run<'_, S, P::Mechanism, F, C>,
) -> Result<u64, StudyError>
where
    C: Described<P::Mechanism>,
{
    let span = span_of::<S>(&problem.span());
    let report = run
        .unmonitored()
        .run(span.start..=span.end, every(span.first_output), |sample| {
            std::hint::black_box(sample.state());
            ControlFlow::Continue(())
        });
    let report = report.map_err(|error| stopped(problem, &error))?;
    Ok(report.evaluations as u64)
}

impl<'a, P: Problem> Task<'a, P> for Time<'a, '_, P> {
    type Outcome = Candidate<'a>;

    fn run<S: Real + 'static, F: Studied<S> + 'static, C: Described<P::Mechanism>>(
        self,
        formulation: F,
        stabilisation: Stabilisation<'a, S, P::Mechanism>,
    ) -> Result<Candidate<'a>, StudyError> {
        let (problem, start) = (self.problem, state::<S, P::Mechanism>(self.start));
        if stabilisation.is_some() {
            let with = (self.setting.integration, start);
            return Ok(Candidate::new(self.setting.name(), move || {
                let run = simulation::<S, P, F>(problem, formulation, with, &stabilisation);
                bare_run(problem, run.coordinates::<C>())
            }));
        }
        let dynamics =
            Dynamics::<dynamics::Problem<_, _, S>>::new(problem.mechanism(), formulation);
        let dynamics = dynamics.map_err(|fault| stopped(problem, &fault))?;
        let dynamics = dynamics.coordinates::<C>();
        let start = dynamics
            .state_of(&start)
            .map_err(|fault| stopped(problem, &fault))?;
        Ok(self.bare(dynamics, start))
    }
}
