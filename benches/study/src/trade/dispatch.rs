//! From a setting as a value to the types that a mechanism is run with.

use std::ops::ControlFlow;

use holonom::{
    __study::DirectCorrection,
    AugmentedLagrangian, Baumgarte, JointCoordinates, Mechanism, Penalty, Projection, Real, Sample,
    Simulation, StandardLagrange,
    dynamics::Dynamics,
    every,
    integrate::Span,
    measure::NoForces,
    mechanism::{Absolute, Kernel, Relative},
    run::{TreeRecovery, VelocityProjection},
};

use super::integration::{Integration, with_own_type};
use super::movable::{Described, Movable, Studied};
use super::observation::{Observation, Start, state, stopped};
use super::problem::Problem;
use super::setting::{Formulated, Setting, Treatment, augmented_lagrangian, baumgarte, penalty};
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;
use crate::run::contestant;
use crate::timing::Contestant;

/// Something to be done with a mechanism, once it is known with which numbers, which formulation,
/// which treatment and which coordinates.
pub(super) trait Task<'a, P: Problem + 'a> {
    type Outcome;

    fn run<S: Real + 'static, F: Studied<S> + 'static, C: Described<P::Mechanism>>(
        self,
        formulation: F,
        treated: Treated<'a, S, P::Mechanism>,
    ) -> Result<Self::Outcome, StudyError>;
}

/// What is done to states after steps.
pub(super) type Treated<'a, S, M> = Option<Box<dyn holonom::run::Treatment<S, M> + 'a>>;

/// The coordinates that a mechanism offers: those in which it has the fewest equations, and
/// absolute ones.
pub(super) trait Offered<P: Problem> {
    /// Equations that remain in joint coordinates, where there are any.
    const CLOSING: Option<usize>;
    const KERNELS: &'static [Kernel];

    /// The treatment along the tree of the joints.
    fn recovery<'a, S: Real + 'static>(
        problem: &'a P,
    ) -> Result<Treated<'a, S, P::Mechanism>, StudyError>;

    /// Runs a task in joint coordinates.
    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        task: T,
        formulation: F,
        treated: Treated<'a, S, P::Mechanism>,
    ) -> Result<T::Outcome, StudyError>
    where
        P: 'a;
}

impl<P: Problem<Mechanism: JointCoordinates>> Offered<P> for Relative {
    const CLOSING: Option<usize> = Some(P::Mechanism::JOINT_REPORT.closing.len());
    const KERNELS: &'static [Kernel] = P::Mechanism::JOINT_REPORT.kernels;

    fn recovery<'a, S: Real + 'static>(
        problem: &'a P,
    ) -> Result<Treated<'a, S, P::Mechanism>, StudyError> {
        let recovery = TreeRecovery::<S, P::Mechanism>::new(problem.mechanism());
        match recovery {
            Ok(recovery) => Ok(Some(Box::new(recovery))),
            Err(fault) => Err(stopped(problem, &fault)),
        }
    }

    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        task: T,
        formulation: F,
        treated: Treated<'a, S, P::Mechanism>,
    ) -> Result<T::Outcome, StudyError>
    where
        P: 'a,
    {
        task.run::<S, F, Self>(formulation, treated)
    }
}

impl<P: Problem> Offered<P> for Absolute {
    const CLOSING: Option<usize> = None;
    const KERNELS: &'static [Kernel] = &[];

    fn recovery<'a, S: Real + 'static>(
        _problem: &'a P,
    ) -> Result<Treated<'a, S, P::Mechanism>, StudyError> {
        Err(without_joints())
    }

    fn by_joints<'a, S: Real + 'static, F: Studied<S> + 'static, T: Task<'a, P>>(
        _task: T,
        _formulation: F,
        _treated: Treated<'a, S, P::Mechanism>,
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
    let treated: Treated<'a, S, P::Mechanism> = match setting.treatment {
        Treatment::None => None,
        Treatment::Projection => Some(Box::new(Projection::default())),
        Treatment::DirectCorrection => Some(Box::new(DirectCorrection::default())),
        Treatment::VelocityProjection => Some(Box::new(VelocityProjection::default())),
        Treatment::TreeRecovery => J::recovery(problem)?,
    };
    let by = setting.coordinates;
    match &setting.formulation {
        Formulated::Standard => described::<S, J, P, T, _>(task, by, StandardLagrange, treated),
        Formulated::Baumgarte(of) => {
            let formulation: Baumgarte<S> = baumgarte(of);
            described::<S, J, P, T, _>(task, by, formulation, treated)
        }
        Formulated::Penalty(of) => {
            let formulation: Penalty<S> = penalty(of);
            described::<S, J, P, T, _>(task, by, formulation, treated)
        }
        Formulated::AugmentedLagrangian(of) => {
            let formulation: AugmentedLagrangian<S> = augmented_lagrangian(of);
            described::<S, J, P, T, _>(task, by, formulation, treated)
        }
    }
}

fn described<'a, S, J, P, T, F>(
    task: T,
    by: Coordinates,
    formulation: F,
    treated: Treated<'a, S, P::Mechanism>,
) -> Result<T::Outcome, StudyError>
where
    S: Real + 'static,
    J: Offered<P>,
    P: Problem + 'a,
    T: Task<'a, P>,
    F: Studied<S> + 'static,
{
    match by {
        Coordinates::Bodies => task.run::<S, F, Absolute>(formulation, treated),
        Coordinates::Joints => J::by_joints::<S, F, T>(task, formulation, treated),
    }
}

fn span_of<S: Real>(span: &Span<f64>) -> Span<S> {
    Span {
        start: S::constant(span.start),
        end: S::constant(span.end),
        first_output: S::constant(span.first_output),
    }
}

/// A simulation, in absolute coordinates.
fn simulation<'a, S: Real, P: Problem, F: Studied<S> + 'static>(
    problem: &'a P,
    formulation: F,
    (integration, start): (Integration, <P::Mechanism as Mechanism>::State<S>),
    treated: &'a Treated<'_, S, P::Mechanism>,
) -> Simulation<'a, S, P::Mechanism, F, Integration, NoForces, Absolute> {
    let simulation =
        Simulation::new(problem.mechanism(), formulation, integration).absolute_coordinates();
    let simulation = simulation.initial_state(start);
    match treated {
        Some(treatment) => simulation.treatment(&**treatment),
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
        treated: Treated<'a, S, P::Mechanism>,
    ) -> Result<Observation, StudyError> {
        let with = (
            self.setting.integration,
            state::<S, P::Mechanism>(self.start),
        );
        let run = simulation::<S, P, F>(self.problem, formulation, with, &treated);
        observed(self.problem, &run.coordinates::<C>())
    }
}

type Run<'a, S, M, F, C> = Simulation<'a, S, M, F, Integration, NoForces, C>;

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
    let watch = report.watch.as_ref();
    Ok(Observation {
        evaluations: report.evaluations as u64,
        accepted: report.accepted as u64,
        rejected: report.rejected as u64,
        energy_drift: watch.map_or(f64::NAN, |watch| watch.unaccounted_energy().to_f64().abs()),
        doubts: report
            .doubts()
            .into_iter()
            .map(|doubt| doubt.to_string())
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
    fn bare<S, Y>(&self, system: Y, start: Y::State) -> Contestant<'a>
    where
        S: Real + 'a,
        Y: Movable<S> + 'a,
    {
        let (span, name) = (span_of::<S>(&self.problem.span()), self.setting.name());
        let integration = self.setting.integration;
        if P::IS_INLINED {
            with_own_type!(
                integration,
                integrator => contestant(name, system, integrator, span, start),
                contestant(name, system, integration, span, start)
            )
        } else {
            contestant(name, system, integration, span, start)
        }
    }
}

/// A run without watch and readings; its evaluations.
fn bare_run<S: Real, P: Problem, F: Studied<S>, C>(
    problem: &P,
    run: Run<'_, S, P::Mechanism, F, C>,
) -> Result<u64, StudyError>
where
    C: Described<P::Mechanism>,
{
    let span = span_of::<S>(&problem.span());
    let report = run
        .unwatched()
        .run(span.start..=span.end, every(span.first_output), |sample| {
            std::hint::black_box(sample.state());
            ControlFlow::Continue(())
        });
    let report = report.map_err(|error| stopped(problem, &error))?;
    Ok(report.evaluations as u64)
}

impl<'a, P: Problem> Task<'a, P> for Time<'a, '_, P> {
    type Outcome = Contestant<'a>;

    fn run<S: Real + 'static, F: Studied<S> + 'static, C: Described<P::Mechanism>>(
        self,
        formulation: F,
        treated: Treated<'a, S, P::Mechanism>,
    ) -> Result<Contestant<'a>, StudyError> {
        let (problem, start) = (self.problem, state::<S, P::Mechanism>(self.start));
        if treated.is_some() {
            let with = (self.setting.integration, start);
            return Ok(Contestant::new(self.setting.name(), move || {
                let run = simulation::<S, P, F>(problem, formulation, with, &treated);
                bare_run(problem, run.coordinates::<C>())
            }));
        }
        let dynamics = Dynamics::<S, _, _>::new(problem.mechanism(), formulation);
        let dynamics = dynamics.map_err(|fault| stopped(problem, &fault))?;
        let dynamics = dynamics.coordinates::<C>();
        let start = dynamics
            .state_of(&start)
            .map_err(|fault| stopped(problem, &fault))?;
        Ok(self.bare(dynamics, start))
    }
}
