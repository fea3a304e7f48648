//! The equations of motion as a system of ordinary differential equations.

use super::{Dynamics, coordinate_rates, vanishes};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{AlphaEnd, AlphaStep, System, by_differences};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::kernels::{Mechanism, Orientation};
use crate::mechanism::orientations::{bring_to_unit_length, stretch};
use crate::state::vector::{Array, StateParts, Vector};

impl<S, M, F, P, A> System<S> for Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    type State = M::State<S>;

    #[inline(always)]
    fn rates(&mut self, time: S, state: &M::State<S>) -> Result<M::State<S>, Fault> {
        let mut rates = M::State::from_parts(Array::zeros(), Array::zeros());
        match self.stage(time, state, &mut rates) {
            Ok(()) if rates.is_finite() => Ok(rates),
            Ok(()) | Err(Fault::StateNotFinite) => Err(self.fault(time, state)),
            Err(fault) => Err(fault),
        }
    }

    // Part of every stage of an integrator: rates then reach the next stage without passing through
    // memory, or by one way through it.
    #[inline(always)]
    fn stage(
        &mut self,
        time: S,
        state: &M::State<S>,
        rates: &mut M::State<S>,
    ) -> Result<(), Fault> {
        let mut multipliers = Array::zeros();
        if Self::IN_PARTS {
            let parts = self.evaluate_in_parts(time, state, rates, &mut multipliers)?;
            self.gather(&parts, &multipliers);
            return Ok(());
        }
        let pivot = self.straight(time, state, rates, &mut multipliers);
        if vanishes::<S, F::Terms>(pivot.relative) {
            // Why is not asked here: a reference to the state would keep it in memory at every
            // stage.
            return Err(Fault::StateNotFinite);
        }
        self.look(pivot.relative, &multipliers);
        Ok(())
    }

    fn why(&mut self, time: S, state: &M::State<S>) -> Option<Fault> {
        Some(self.fault(time, state))
    }

    /// Exact, by the kernels over [`Forward`](crate::Forward) numbers: a law that is a closure
    /// enters by differences of its forces. By differences of the rates for an
    /// [`AugmentedLagrangian`](crate::AugmentedLagrangian), which iterates, and where a derivative
    /// is not finite.
    ///
    /// A column takes longer than a difference would, by bodies more than by joints.
    fn jacobian(
        &mut self,
        time: S,
        state: &M::State<S>,
        rates: &M::State<S>,
        columns: &mut <M::State<S> as Vector<S>>::Each<M::State<S>>,
    ) -> Result<usize, Fault> {
        if !F::ITERATED
            && let Some(evaluations) = self.differentiated(time, state, columns)
        {
            return Ok(evaluations);
        }
        by_differences(state, rates, columns, |state, rates| {
            self.stage(time, state, rates)
        })
    }

    #[inline]
    fn with_new_velocities(
        &mut self,
        _time: S,
        state: &M::State<S>,
        step: S,
        rates: &mut M::State<S>,
    ) -> Result<(), Fault> {
        let mut end = Self::read(state);
        let velocities = end.velocities_mut().as_mut_slice().iter_mut();
        for (velocity, &rate) in velocities.zip(rates.velocities().as_slice()) {
            *velocity = rate.fused(step, *velocity);
        }
        *rates.coordinates_mut() = coordinate_rates::<S, M, P>(&self.constants, state, &end);
        Ok(())
    }

    fn step_on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, M::State<S>>,
    ) -> Result<AlphaEnd<M::State<S>>, Fault> {
        self.solved_on_constraints(&asked)
    }

    #[inline]
    fn settle(&mut self, state: &mut M::State<S>, rates: Option<&mut M::State<S>>) {
        let stretch = if P::NORMALISED && !P::NORMALISED_RATES {
            bring_to_unit_length::<S, M>(state, rates)
        } else {
            stretch::<S, M>(state)
        };
        self.seen.stretch = stretch;
        M::recount(&self.constants, state);
    }
}
