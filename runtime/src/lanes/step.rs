//! A step of all lanes at once, and of those apart that it does not fit.

use super::ensemble::Ensemble;
use super::equations::{LaneEquations, StateOfAll};
use super::exchange::{put_state, state_of};
use super::number::Lanes;
use crate::dynamics::{Dynamics, Solvable, State};
use crate::error::{Fault, SimulationError, Unheeding};
use crate::integrate::{OneStep, Slopes, StepStart, System};
use crate::math::scalar::{Real, Scalar as _};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::InputsOf;
use crate::mechanism::turns;
use crate::nonsmooth::described::refuse_limits;
use crate::run::stepper::end_of_step;
use crate::state::vector::Vector as _;

impl<P, T: Real, K, const L: usize> Ensemble<P, K, L>
where
    P: Solvable<Number = T>,
    K: OneStep<T, Dynamics<P>> + OneStep<Lanes<T, L>, LaneEquations<P, L>>,
{
    /// Moves all lanes that go on by one step of `dt` (s). Where none does, nothing is moved, and
    /// the time stays.
    ///
    /// # Errors
    /// A step that is not positive and finite, or below the resolution of the time where laws
    /// depend on it; [`StartFault::LimitsLeftOut`](crate::error::StartFault::LimitsLeftOut) of a
    /// description with limits, unless [`Ensemble::without_limits`] is said. Nothing is moved then.
    /// What a lane cannot do stops that lane ([`Ensemble::stopped`]) and is no error here.
    pub fn step(&mut self, dt: T) -> Result<(), Fault> {
        if !self.passes_limits {
            refuse_limits::<P::Mechanism>(Unheeding::Ensemble)?;
        }
        let clock = end_of_step::<T, P::Mechanism>(&self.clock, dt)?;
        if self.going == 0 {
            return Ok(());
        }
        let mut next = self.at_once(dt)?;
        if !self.equations.are_sound(&next) || !P::Coordinates::normalise_near(&mut next) {
            self.apart(&mut next, dt);
        }
        let (from, of_all) = (&self.state, Lanes::splat(dt));
        let turned = turns::carry(from, of_all, &mut next, P::Coordinates::turning);
        if !Lanes::are_within(&[turned], turns::FAR) {
            self.count(&mut next, dt);
        }
        self.state = next;
        if self.going > 0 {
            self.clock = clock;
        }
        Ok(())
    }

    /// Counts the turns of angles, lane by lane.
    #[cold]
    #[inline(never)]
    fn count(&self, next: &mut StateOfAll<P, L>, dt: T) {
        for (lane, dynamics) in self.dynamics.iter().enumerate() {
            let mut to: State<P> = state_of(next, lane);
            let turned = to.turns().last().copied();
            if turned.is_none_or(|turned| turned <= T::constant(turns::FAR)) {
                continue;
            }
            let from: State<P> = state_of(&self.state, lane);
            dynamics.count_turns(&from, dt, &mut to);
            put_state(next, lane, &to);
        }
    }

    /// The end of a step in all lanes, as it comes out.
    #[inline(never)]
    fn at_once(&mut self, dt: T) -> Result<StateOfAll<P, L>, Fault> {
        let (time, step) = (Lanes::splat(self.time()), Lanes::splat(dt));
        let (equations, state) = (&mut self.equations, &self.state);
        equations.begin();
        let mut slope = *state;
        equations.stage(time, state, &mut slope)?;
        let (start, mut stages) = (
            StepStart {
                time,
                state,
                slope: &slope,
            },
            self.scheme.stages(&slope),
        );
        let equations = &mut Slopes::new(equations);
        self.scheme.advanced(equations, start, step, &mut stages)
    }

    /// What follows a step lane by lane: those in which it is sound are normalised, the others take
    /// it alone, and stop where that is refused.
    #[inline(never)]
    fn apart(&mut self, next: &mut StateOfAll<P, L>, dt: T) {
        let (time, before) = (self.clock.time(), self.going);
        let lanes = self.dynamics.iter_mut().zip(&mut self.stopped);
        for (lane, (dynamics, stopped)) in lanes.enumerate() {
            if stopped.is_some() {
                continue;
            }
            if self.equations.is_sound(lane, next) {
                let mut state = state_of(next, lane);
                dynamics.renormalise(&mut state, None);
                put_state(next, lane, &state);
                continue;
            }
            let mut state: State<P> = state_of(&self.state, lane);
            match alone(&self.scheme, dynamics, (time, &mut state), dt) {
                Ok(()) => put_state(next, lane, &state),
                Err(fault) => {
                    self.going -= 1;
                    *stopped = Some(SimulationError {
                        time: time.to_f64(),
                        fault,
                        state,
                    });
                }
            }
        }
        if self.going < before {
            self.take_equations();
        }
    }

    /// The same with these inputs over the step, which stay until others are set.
    ///
    /// # Errors
    /// As [`Ensemble::step`] and [`Ensemble::set_inputs`].
    pub fn step_with(
        &mut self,
        inputs: &[InputsOf<P::Mechanism, P::Number>; L],
        dt: T,
    ) -> Result<(), Fault> {
        self.set_inputs(inputs)?;
        self.step(dt)
    }
}

/// A step as a [`Stepper`](crate::Stepper) takes it.
fn alone<P: Solvable, K: OneStep<P::Number, Dynamics<P>>>(
    scheme: &K,
    dynamics: &mut Dynamics<P>,
    (time, state): (P::Number, &mut State<P>),
    dt: P::Number,
) -> Result<(), Fault> {
    if !P::Coordinates::IS_RELATIVE {
        P::Coordinates::check(state)?;
    }
    scheme.step(dynamics, time, state, dt)
}
