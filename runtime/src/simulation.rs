//! A run of a mechanism over an interval of time.

use core::marker::PhantomData;
use core::ops::{ControlFlow, RangeInclusive};

use crate::array::{Array, StateParts};
use crate::dynamics::{Dynamics, Iterations};
use crate::error::{Fault, SimulationError};
use crate::formulation::Formulation;
use crate::integrate::{Counts, Course, Integrator, Span};
use crate::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::{Mechanism, Normalised, Orientation};
use crate::project::{Projection, settle};
use crate::reporting::{Reporting, Schedule, check_interval};
use crate::rotation::check_state;
use crate::sample::Sample;
use crate::scalar::Real;

/// A mechanism, a formulation and an integrator, ready to run.
///
/// `P` says how Euler parameters are read ([`Normalised`] or [`Raw`](crate::Raw)), `A` which forces come on top of those of
/// the description.
pub struct Simulation<'a, S: Real, M: Mechanism, F, I, P = Normalised, A = NoForces> {
    mechanism: &'a M,
    formulation: F,
    integrator: I,
    forces: A,
    initial: Option<M::State<S>>,
    assemble: Option<Projection<S>>,
    projection: Option<Projection<S>>,
    orientation: PhantomData<P>,
}

/// What a run came to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunReport<S, X> {
    /// Evaluations of the rates by the integrator.
    pub evaluations: usize,
    /// Steps that were accepted.
    pub accepted: usize,
    /// Steps that were tried and rejected.
    pub rejected: usize,
    /// The largest `Phi^T Phi` at a reporting time.
    pub worst_violation: S,
    /// How often the augmented Lagrangian solved its system; zero for other formulations.
    pub iterations: Iterations,
    /// The time (s) of the last state: the end, or the reporting time at which the observer stopped the run.
    pub time: S,
    /// The last state.
    pub state: X,
    /// Whether the observer stopped the run.
    pub stopped: bool,
}

/// The report of a run, or why it could not go on.
pub type RunResult<S, M> =
    Result<RunReport<S, <M as Mechanism>::State<S>>, SimulationError<<M as Mechanism>::State<S>>>;

impl<'a, S: Real, M: Mechanism, F: Formulation<S>, I: Integrator<S>> Simulation<'a, S, M, F, I> {
    /// A simulation from the state that the attributes describe, with Euler parameters normalised inside the
    /// evaluation, without further forces and without corrections.
    #[must_use]
    pub fn new(mechanism: &'a M, formulation: F, integrator: I) -> Self {
        Self {
            mechanism,
            formulation,
            integrator,
            forces: NoForces,
            initial: None,
            assemble: None,
            projection: None,
            orientation: PhantomData,
        }
    }
}

impl<'a, S, M, F, I, P, A> Simulation<'a, S, M, F, I, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Integrator<S>,
    P: Orientation,
{
    /// Starts from this state.
    #[must_use]
    pub fn initial_state(mut self, state: M::State<S>) -> Self {
        self.initial = Some(state);
        self
    }

    /// Corrects the initial state onto the constraints, see [`Projection`].
    #[must_use]
    pub fn assembled(mut self) -> Self {
        self.assemble = Some(Projection::default());
        self
    }

    /// Corrects the state onto the constraints after every step, and every state that is reported.
    #[must_use]
    pub fn projection(mut self, projection: Projection<S>) -> Self {
        self.projection = Some(projection);
        self
    }

    /// Reads Euler parameters in another way: `.orientation::<Raw>()`.
    #[must_use]
    pub fn orientation<P2: Orientation>(self) -> Simulation<'a, S, M, F, I, P2, A> {
        self.exchange(|forces| forces)
    }

    /// Applies forces as a function of time and state, `|time, state, loads| loads.force(body, ...)`.
    ///
    /// The evaluation is then done in its parts instead of fused, at a higher cost.
    #[must_use]
    pub fn forces<G>(self, law: G) -> Simulation<'a, S, M, F, I, P, ForceLaw<G>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        self.exchange(|_| ForceLaw(law))
    }

    fn exchange<P2, A2>(self, forces: impl FnOnce(A) -> A2) -> Simulation<'a, S, M, F, I, P2, A2> {
        Simulation {
            mechanism: self.mechanism,
            formulation: self.formulation,
            integrator: self.integrator,
            forces: forces(self.forces),
            initial: self.initial,
            assemble: self.assemble,
            projection: self.projection,
            orientation: PhantomData,
        }
    }
}

impl<S, M, F, I, P, A> Simulation<'_, S, M, F, I, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Integrator<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// Runs over an interval of time (s) and shows the state to `observe` at the start, at the reporting times and at the
    /// end; `ControlFlow::Break(())` stops the run, so an observer that never does so ends with `ControlFlow::Continue(())`.
    ///
    /// An interval of length zero reports once and evaluates nothing.
    ///
    /// # Errors
    /// Time, cause and last good state where the run cannot go on: a parameter, a coefficient or a setting that is not
    /// acceptable, a singular configuration, no convergence, a step too small, numbers out of range. The state is of zeros where a
    /// parameter was refused and no initial state had been given.
    pub fn run<O>(
        &self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        mut observe: O,
    ) -> RunResult<S, M>
    where
        O: FnMut(&Sample<'_, S, M>) -> ControlFlow<()>,
    {
        let (start, end) = interval.into_inner();
        let zeros = || M::State::from_parts(Array::zeros(), Array::zeros());
        let mut last_good = (start, self.initial.unwrap_or_else(zeros));
        self.attempt(start, end, reporting, &mut observe, &mut last_good)
            .map_err(|fault| {
                let (time, state) = last_good;
                SimulationError {
                    time: time.to_f64(),
                    fault,
                    state,
                }
            })
    }

    fn attempt(
        &self,
        start: S,
        end: S,
        reporting: Reporting<S>,
        observe: &mut impl FnMut(&Sample<'_, S, M>) -> ControlFlow<()>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<RunReport<S, M::State<S>>, Fault> {
        let mut dynamics =
            Dynamics::new(self.mechanism, self.formulation)?.exchange::<P, &A>(|_| &self.forces);
        let constants = *dynamics.constants();
        let mut state = self.initial.unwrap_or_else(|| M::initial_state(&constants));
        last_good.1 = state;
        check_interval(start, end)?;
        let mut schedule = Schedule::new(start, end, reporting)?;
        check_state::<S, M>(&state)?;
        M::recount(&constants, &mut state);
        if let Some(projection) = self.assemble {
            projection.correct::<M>(&constants, start, &mut state)?;
            last_good.1 = state;
        }
        let mut log = Log {
            observe,
            worst_violation: S::zero(),
        };
        if start >= end {
            let flow = log.show(&dynamics, start, &state);
            return Ok(log.report(Counts::default(), Iterations::default(), start, state, flow));
        }
        let span = Span {
            start,
            end,
            first_output: schedule.first(),
        };
        let mut course = self.integrator.start(&mut dynamics, span, state)?;
        let mut flow = log.show(&dynamics, start, &state);
        let mut shown = (start, state);
        while course.time() < end && flow.is_continue() {
            if let Err(fault) = course.advance(&mut dynamics) {
                return Err(dynamics.explained(fault, course.time(), course.state()));
            }
            while let Some(time) = schedule.within(course.time()) {
                let mut state = course.at(&mut dynamics, time)?;
                if let Some(projection) = self.projection {
                    projection.correct_in_motion::<M>(&constants, time, &mut state)?;
                }
                shown = (time, state);
                *last_good = shown;
                flow = log.show(&dynamics, time, &state);
                if flow.is_break() {
                    break;
                }
            }
            if flow.is_break() {
                break;
            }
            if self.projection.is_some() || M::REPORT.auxiliaries > 0 {
                let mut state = *course.state();
                settle::<S, M>(self.projection, &constants, course.time(), &mut state)?;
                course.replace(state);
            }
            *last_good = (course.time(), *course.state());
            if let Some(time) = schedule.at(course.time()) {
                shown = (time, *course.state());
                flow = log.show(&dynamics, time, course.state());
            }
        }
        let (time, state) = shown;
        Ok(log.report(course.counts(), dynamics.iterations(), time, state, flow))
    }
}

/// Shows states to the observer and keeps the worst violation.
struct Log<'a, S, O> {
    observe: &'a mut O,
    worst_violation: S,
}

impl<S: Real, O> Log<'_, S, O> {
    fn show<M, F, P, A>(
        &mut self,
        dynamics: &Dynamics<S, M, F, P, A>,
        time: S,
        state: &M::State<S>,
    ) -> ControlFlow<()>
    where
        M: Mechanism,
        F: Formulation<S>,
        P: Orientation,
        A: AppliedForces<S, M>,
        O: FnMut(&Sample<'_, S, M>) -> ControlFlow<()>,
    {
        let view = dynamics.view(time, state);
        self.worst_violation = self.worst_violation.max(view.violation());
        (self.observe)(&Sample::new(view, dynamics))
    }

    fn report<X>(
        &self,
        counts: Counts,
        iterations: Iterations,
        time: S,
        state: X,
        flow: ControlFlow<()>,
    ) -> RunReport<S, X> {
        RunReport {
            evaluations: counts.evaluations,
            accepted: counts.accepted,
            rejected: counts.rejected,
            worst_violation: self.worst_violation,
            iterations,
            time,
            state,
            stopped: flow.is_break(),
        }
    }
}
