//! An integration of the equations of motion, as a run has it.

#[cfg(feature = "std")]
use core::fmt::Debug;

use super::branching::Branching;
use super::deferred::Deferred;
use super::followed::bodies_within;
use super::marching::{Advanced, Marching, Settings};
use crate::dynamics::equations::Equations;
use crate::dynamics::{Dynamics, Solvable, State};
use crate::error::{Fault, StartFault};
use crate::integrate::{
    Advance as _, Counts, Integration as _, Integrator, Memory, Reader, System as _, TimeSpan,
};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{MovingState, Vector};

/// Elements of rates smaller than this part of the largest one are as large as this.
const LITTLE: f64 = 1e-6;

/// The equations with a method, and the integration that is under way.
pub(crate) struct March<P, I>
where
    P: Solvable,
    I: Integrator<P::Number, Dynamics<P>>,
{
    dynamics: Dynamics<P>,
    integrator: I,
    /// The state in which the integration has begun, and the integration.
    under_way: Option<(State<P>, I::Integration)>,
    deferred: Deferred<State<P>>,
    branching: Branching<P::Number>,
}

impl<P, S: Real, M: Mechanism, I> March<P, I>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Integrator<S, Dynamics<P>>,
{
    pub(crate) fn new(mut dynamics: Dynamics<P>, integrator: I) -> Self {
        let is_controlled = integrator.fixed_step().is_none();
        dynamics.begin_near(is_controlled);
        Self {
            dynamics,
            integrator,
            under_way: None,
            deferred: Deferred::new(),
            branching: Branching::of(is_controlled),
        }
    }

    fn begin(&mut self, span: TimeSpan<S>, whole: S, state: State<P>) -> Result<(), Fault> {
        self.under_way = None;
        let integrator = self.integrator.for_duration(whole);
        let integration = integrator.start(&mut self.dynamics, span, state)?;
        self.under_way = Some((state, integration));
        Ok(())
    }

    /// The rates at the end of the last step, or of bodies between two integrations.
    fn rates(&mut self, between: Option<(S, &M::State<S>)>) -> Result<State<P>, Fault> {
        let (time, state) = match (between, &self.under_way) {
            (Some((time, bodies)), _) => (time, self.dynamics.nearest(bodies)),
            (None, Some((_, integration))) => (integration.time(), *integration.state()),
            (None, None) => return Err(not_begun()),
        };
        self.dynamics.rates(time, &state)
    }
}

/// What is known of a method that moves equations of motion.
pub(crate) fn settings<P, I>(integrator: &I) -> Settings<P::Number>
where
    P: Solvable,
    I: Integrator<P::Number, Dynamics<P>>,
{
    Settings {
        fixed_step: integrator.fixed_step(),
        tolerance: integrator.tolerance(),
        budget: integrator.budget().unwrap_or(usize::MAX),
        interacts: P::Forces::INTERACTS,
        may_defer: P::Coordinates::IS_RELATIVE && !P::Forces::PRESENT,
        may_branch: Dynamics::<P>::CLOSES,
    }
}

impl<P, S: Real, M: Mechanism, I> Marching<S, M> for March<P, I>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Integrator<S, Dynamics<P>>,
{
    fn equations(&self) -> &dyn Equations<S, M> {
        &self.dynamics
    }

    fn equations_mut(&mut self) -> &mut dyn Equations<S, M> {
        &mut self.dynamics
    }

    fn settings(&self) -> Settings<S> {
        settings::<P, I>(&self.integrator)
    }

    #[cfg(feature = "std")]
    fn method(&self) -> &dyn Debug {
        &self.integrator
    }

    fn start(&mut self, span: TimeSpan<S>, whole: S, bodies: &M::State<S>) -> Result<(), Fault> {
        let state = self.dynamics.nearest(bodies);
        self.begin(span, whole, state)
    }

    fn start_again(&mut self, span: TimeSpan<S>, whole: S, elements: &[S]) -> Result<bool, Fault> {
        match vector(elements) {
            Some(state) => self.begin(span, whole, state).map(|()| true),
            None => Ok(false),
        }
    }

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        let under_way = self.under_way.as_mut();
        under_way.is_some_and(|(_, integration)| integration.remember(memory))
    }

    #[cfg(feature = "std")]
    fn visit_start(&self, visit: &mut dyn FnMut(S)) {
        if let Some((state, _)) = &self.under_way {
            each_element(state, visit);
        }
    }

    fn time(&self) -> S {
        let under_way = self.under_way.as_ref();
        under_way.map_or(S::zero(), |(_, integration)| integration.time())
    }

    fn counts(&self) -> Counts {
        let under_way = self.under_way.as_ref();
        under_way.map_or(Counts::default(), |(_, integration)| integration.counts())
    }

    fn estimate(&self) -> Option<S> {
        let (_, integration) = self.under_way.as_ref()?;
        integration.estimate()
    }

    fn advance(&mut self) -> Result<Advanced<S>, Fault> {
        let Some((_, integration)) = &mut self.under_way else {
            return Err(not_begun());
        };
        integration.advance(&mut self.dynamics)?;
        Ok(Advanced {
            end: integration.time(),
            knows_turns: self.dynamics.knows_turns(integration.state()),
        })
    }

    fn recount(&mut self, start: (S, &M::State<S>)) -> Result<(), Fault> {
        if let Some((_, integration)) = &mut self.under_way {
            let end = integration.time();
            let bodies = bodies_within(&mut self.dynamics, integration, start, end)?;
            integration.recount(bodies.turns());
        }
        Ok(())
    }

    fn bodies(&self, near: &M::State<S>) -> M::State<S> {
        match &self.under_way {
            Some((_, integration)) => self.dynamics.bodies_counted(integration.state(), near),
            None => *near,
        }
    }

    fn bodies_near(&self, near: &M::State<S>) -> M::State<S> {
        match &self.under_way {
            Some((_, integration)) => self.dynamics.bodies_near(integration.state(), near),
            None => *near,
        }
    }

    fn at(&mut self, time: S, near: &M::State<S>) -> Result<M::State<S>, Fault> {
        let Some((_, integration)) = &mut self.under_way else {
            return Err(not_begun());
        };
        let state = integration.at(&mut self.dynamics, time)?;
        Ok(self.dynamics.bodies_near(&state, near))
    }

    fn within(&mut self, from: (S, &M::State<S>), time: S) -> Result<M::State<S>, Fault> {
        let Some((_, integration)) = &mut self.under_way else {
            return Err(not_begun());
        };
        bodies_within(&mut self.dynamics, integration, from, time)
    }

    fn replace(&mut self, bodies: &M::State<S>) {
        if let Some((_, integration)) = &mut self.under_way {
            integration.replace(self.dynamics.nearest_to(bodies, integration.state()));
        }
    }

    fn hold_modes(&mut self, bodies: &mut M::State<S>) -> Result<(), Fault> {
        if let Some((_, integration)) = &mut self.under_way
            && let Some(held) = self
                .dynamics
                .held(integration.time(), integration.state())?
        {
            *bodies = self.dynamics.bodies_near(&held, bodies);
            integration.replace(held);
        }
        Ok(())
    }

    fn defers(&mut self, step: S) -> bool {
        let under_way = self.under_way.as_ref();
        !self.branching.is_near()
            && under_way.is_some_and(|(_, integration)| {
                let state = integration.state();
                self.deferred.defer(state, step)
            })
    }

    fn deferred_since(&self) -> S {
        self.deferred.elapsed()
    }

    fn convert(&mut self, bodies: &mut M::State<S>) {
        if let Some(state) = self.deferred.take() {
            *bodies = self.dynamics.bodies_counted(&state, bodies);
        }
    }

    fn forget_deferred(&mut self) {
        self.deferred.clear();
    }

    fn better_end(&mut self, near: &M::State<S>) -> Option<M::State<S>> {
        let (_, integration) = self.under_way.as_ref()?;
        let dynamics = &mut self.dynamics;
        let (seen, iterations) = (dynamics.seen(), dynamics.iterations());
        // Where there is a fault the run will find it.
        let better = integration.better_end(dynamics).ok().flatten();
        dynamics.recall(seen);
        dynamics.iterations = iterations;
        better.map(|state| dynamics.bodies_near(&state, near))
    }

    fn power_at_end(&self, lead: Option<S>, bodies: &M::State<S>) -> Option<S> {
        let (_, integration) = self.under_way.as_ref()?;
        let (time, state) = (integration.time(), integration.state());
        self.dynamics.power_with(lead, time, state, bodies)
    }

    fn power_at_event(&self, lead: Option<S>, (time, bodies): (S, &M::State<S>)) -> Option<S> {
        let state = self.dynamics.nearest(bodies);
        self.dynamics.power_with(lead, time, &state, bodies)
    }

    fn power_within(&mut self, time: S, near: &M::State<S>) -> Option<S> {
        let (_, integration) = self.under_way.as_mut()?;
        let state = integration.at(&mut self.dynamics, time).ok()?;
        let bodies = self.dynamics.bodies_near(&state, near);
        self.dynamics.power_with(None, time, &state, &bodies)
    }

    fn look_for_branches(&mut self) {
        if let Some((_, integration)) = &self.under_way {
            let (time, state) = (integration.time(), integration.state());
            self.branching.step(&mut self.dynamics, time, state);
        }
    }

    fn is_near_to_branches(&self) -> bool {
        self.branching.is_near()
    }

    fn remember_branches(&mut self, memory: &mut Memory<'_, S>) {
        if const { Dynamics::<P>::CLOSES } {
            self.branching.remember(memory, &mut self.dynamics.near);
        }
    }

    #[cfg(feature = "std")]
    fn visit_rates(
        &mut self,
        between: Option<(S, &M::State<S>)>,
        visit: &mut dyn FnMut(S),
    ) -> Result<(), Fault> {
        let (seen, iterations) = (self.dynamics.seen(), self.dynamics.iterations());
        let rates = self.rates(between)?;
        self.dynamics.recall(seen);
        self.dynamics.iterations = iterations;
        each_element(&rates, visit);
        Ok(())
    }

    fn differs(
        &mut self,
        between: Option<(S, &M::State<S>)>,
        elements: &[S],
    ) -> Result<Option<S>, Fault> {
        let Some(others) = vector::<S, State<P>>(elements) else {
            return Ok(None);
        };
        let rates = self.rates(between)?;
        let mut largest = S::zero();
        rates.for_each(|rate| largest = largest.max(rate.abs()));
        let (mut difference, floor) = (S::zero(), S::constant(LITTLE) * largest);
        let apart = rates.zip(&others, |rate, other| {
            let size = rate.abs().max(other.abs()).max(floor);
            if rate == other {
                S::zero()
            } else {
                (rate - other).abs().quotient(size)
            }
        });
        apart.for_each(|apart| difference = difference.max(apart));
        Ok(Some(difference))
    }
}

/// No integration was begun: its interval has no length.
#[cold]
fn not_begun() -> Fault {
    Fault::Start(StartFault::Interval {
        start: 0.0,
        end: 0.0,
    })
}

/// The state of its elements, if there are as many.
fn vector<S: Real, X: MovingState<S> + Vector<S>>(elements: &[S]) -> Option<X> {
    let mut vector = X::zeros();
    let mut reader = Reader::new(elements, &[]);
    Memory::new(&mut reader).vector(&mut vector);
    reader.is_done().then_some(vector)
}

/// Visits the elements as a [`Memory`] has them.
#[cfg(feature = "std")]
fn each_element<S: Real, X: Vector<S>>(vector: &X, visit: &mut dyn FnMut(S)) {
    vector.for_each(&mut *visit);
    vector.turns().iter().for_each(|&turn| visit(turn));
}
