//! The equations of motion as a system of ordinary differential equations.

use super::evaluate::Parts;
use super::{Dynamics, Evaluator, Solvable, vanishes};
use crate::error::{Fault, StepFault};
use crate::formulation::Formulation;
use crate::integrate::{SecondOrder, System, by_differences};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::turns;
use crate::state::vector::{Array, MovingState, Vector};

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> System<S> for Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A, Coordinates = C>,
{
    type State = C::State<S>;

    #[inline(always)]
    fn rates(&mut self, time: S, state: &C::State<S>) -> Result<C::State<S>, Fault> {
        let mut rates = C::State::zeros();
        match self.stage(time, state, &mut rates) {
            Ok(()) if rates.is_finite() => Ok(rates),
            Ok(()) | Err(Fault::Step(StepFault::StateNotFinite)) => {
                Err(self.evaluator().fault(time, state))
            }
            Err(fault) => Err(fault),
        }
    }

    // Part of every stage of an integrator: rates then reach the next stage without passing through
    // memory, or by one way through it.
    #[inline(always)]
    fn stage(
        &mut self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
    ) -> Result<(), Fault> {
        let mut multipliers = Array::zeros();
        if Evaluator::<S, M, F, A, C>::IN_PARTS {
            let parts = self
                .evaluator()
                .in_parts(time, state, rates, &mut multipliers);
            let is_far = |parts: &Parts<S>| !self.is_near(parts.pivot.relative);
            if Self::GOES_ON && !parts.as_ref().is_ok_and(is_far) {
                return self.stage_nearby(parts, (time, state), rates);
            }
            let parts = parts?;
            self.count(&parts);
            self.look(parts.pivot.relative);
            return Ok(());
        }
        let pivot = self.evaluator().slope(time, state, rates, &mut multipliers);
        if self.is_near(pivot.relative) {
            // Of a copy: a reference to the state would keep it in memory at every stage.
            if Self::GOES_ON
                && let Some(straight_on) = self.straight_on(time, *state, pivot.relative)
            {
                *rates = straight_on;
            } else if vanishes::<S, F::Terms>(pivot.relative) {
                // Why is not asked here, for the same reason.
                return Err(Fault::Step(StepFault::StateNotFinite));
            }
        }
        self.look(pivot.relative);
        Ok(())
    }

    fn diagnose(&mut self, time: S, state: &C::State<S>) -> Option<Fault> {
        Some(self.evaluator().fault(time, state))
    }

    /// Exact, by the kernels over [`Forward`](crate::Forward) numbers: a law that is a closure
    /// enters by differences of its forces. By differences of the rates for an
    /// [`AugmentedLagrangian`](crate::AugmentedLagrangian), which iterates, with interactions, and
    /// where a derivative is not finite.
    ///
    /// A column takes longer than a difference would, by bodies more than by joints.
    fn jacobian(
        &mut self,
        time: S,
        state: &C::State<S>,
        rates: &C::State<S>,
        columns: &mut <C::State<S> as Vector<S>>::Each<C::State<S>>,
    ) -> Result<usize, Fault> {
        // Near to a singular configuration rates are those of another formulation.
        if !F::ITERATED
            && !A::INTERACTS
            && !self.was_near()
            && let Some(evaluations) = self.differentiated(time, state, columns)
        {
            return Ok(evaluations);
        }
        by_differences(state, rates, columns, |state, rates| {
            self.stage(time, state, rates)
        })
    }

    #[inline]
    fn follow(&mut self, from: &C::State<S>, step: S, to: &mut C::State<S>) {
        self.has_counted = true;
        if !turns::is_known(turns::carry(from, step, to, C::turning)) {
            // A copy, as a state that others are shown stays in memory.
            let mut normal = *to;
            self.count_from(from, step, &mut normal);
            turns::copy(&normal, to);
        }
    }

    #[inline]
    fn renormalise(&mut self, state: &mut C::State<S>, rates: Option<&mut C::State<S>>) {
        let constants = &C::equations(&self.absolute, &self.own).constants;
        if let Some(norm_drift) = C::normalise(&self.absolute, constants, state, rates) {
            self.seen.drift = norm_drift;
        }
    }
}

impl<P, S: Real, M: Mechanism, C: Coordinates<M>> SecondOrder<S> for Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Coordinates = C>,
{
    #[inline]
    fn with_new_velocities(
        &mut self,
        time: S,
        state: &C::State<S>,
        step: S,
        rates: &mut C::State<S>,
    ) {
        C::with_new_velocities(self.own_constants(), time, state, step, rates);
    }
}
