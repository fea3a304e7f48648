//! The equations of several mechanisms, as a step of all of them takes them.

use core::marker::PhantomData;

use super::Lanes;
use super::exchange::put;
use crate::dynamics::{Dynamics, vanishes};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{SecondOrder, System};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::{copied, opaque};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Mechanism, Terms};
use crate::state::vector::{Array, MovingState, Vector};

/// The equations of motion of several mechanisms of one type, a lane for each: what a scheme moves
/// in a step of an [`Ensemble`](super::Ensemble).
pub struct LaneEquations<T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize> {
    constants: C::Constants<Lanes<T, L>>,
    coefficients: C::Coefficients<Lanes<T, L>>,
    /// The smallest relative pivot of the stages of a step.
    pivot: Lanes<T, L>,
    terms: PhantomData<E>,
}

impl<T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize>
    LaneEquations<T, M, C, E, L>
{
    pub(super) fn zeros() -> Self {
        Self {
            constants: Array::zeros(),
            coefficients: Array::zeros(),
            pivot: Lanes::one(),
            terms: PhantomData,
        }
    }

    /// Takes the equations of one mechanism into a lane.
    pub(super) fn put<F: Formulation<T, Terms = E>, A>(
        &mut self,
        lane: usize,
        dynamics: &Dynamics<T, M, F, A, C>,
    ) {
        let equations = dynamics.own_equations();
        put(&mut self.constants, lane, &equations.constants);
        put(&mut self.coefficients, lane, &equations.coefficients);
    }

    /// Takes what depends on the inputs of one mechanism into a lane.
    pub(super) fn put_inputs<F: Formulation<T, Terms = E>, A>(
        &mut self,
        lane: usize,
        dynamics: &Dynamics<T, M, F, A, C>,
    ) {
        put(&mut self.constants, lane, dynamics.own_constants());
    }

    /// Begins a step.
    #[inline(always)]
    pub(super) fn begin(&mut self) {
        self.pivot = Lanes::one();
    }

    /// Whether a step has led to numbers in all lanes, with no pivot that vanished on the way.
    #[inline(always)]
    pub(super) fn are_sound(&self, state: &C::State<Lanes<T, L>>) -> bool {
        self.pivot.all(|pivot| !vanishes::<T, E>(pivot))
            && unless_finite(state).all(|x| x == T::zero())
    }

    /// The same in one lane.
    pub(super) fn is_sound(&self, lane: usize, state: &C::State<Lanes<T, L>>) -> bool {
        let pivot = self.pivot.lane(lane);
        pivot.is_some_and(|pivot| !vanishes::<T, E>(pivot))
            && unless_finite(state).lane(lane) == Some(T::zero())
    }
}

copied! {
    [T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize]
        LaneEquations<T, M, C, E, L>;
}

opaque! {
    [T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize]
        LaneEquations<T, M, C, E, L>, "LaneEquations";
}

/// Zero in lanes where all numbers are finite, else NaN.
#[inline(always)]
fn unless_finite<T: Real, X: Vector<Lanes<T, L>>, const L: usize>(state: &X) -> Lanes<T, L> {
    let mut sum = -Lanes::zero();
    state.for_each(|x| sum = x.fused(-Lanes::zero(), sum));
    sum
}

impl<T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize> System<Lanes<T, L>>
    for LaneEquations<T, M, C, E, L>
{
    type State = C::State<Lanes<T, L>>;

    #[inline(always)]
    fn rates(&mut self, time: Lanes<T, L>, state: &Self::State) -> Result<Self::State, Fault> {
        let mut rates = Self::State::zeros();
        self.stage(time, state, &mut rates)?;
        Ok(rates)
    }

    #[inline(always)]
    fn stage(
        &mut self,
        time: Lanes<T, L>,
        state: &Self::State,
        rates: &mut Self::State,
    ) -> Result<(), Fault> {
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let mut multipliers = Array::zeros();
        let pivot = C::rates_into::<Lanes<T, L>, E>(
            constants,
            coefficients,
            time,
            state,
            rates,
            &mut multipliers,
        );
        self.pivot = self.pivot.min(pivot.relative);
        Ok(())
    }

    /// Each lane says why by itself.
    fn diagnose(&mut self, _time: Lanes<T, L>, _state: &Self::State) -> Option<Fault> {
        None
    }
}

impl<T: Real, M: Mechanism, C: Coordinates<M>, E: Terms, const L: usize> SecondOrder<Lanes<T, L>>
    for LaneEquations<T, M, C, E, L>
{
    #[inline(always)]
    fn with_new_velocities(
        &mut self,
        time: Lanes<T, L>,
        state: &Self::State,
        step: Lanes<T, L>,
        rates: &mut Self::State,
    ) {
        C::with_new_velocities(&self.constants, time, state, step, rates);
    }
}
