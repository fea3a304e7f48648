//! The equations of several mechanisms, as a step of all of them takes them.

use super::Lanes;
use super::exchange::put;
use crate::dynamics::{Dynamics, Posed, Solvable, vanishes};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{SecondOrder, System};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::{copied, opaque};
use crate::mechanism::coordinates::Coordinates;
use crate::state::vector::{Array, MovingState, Vector};

/// The equations of motion of several mechanisms of one type, a lane for each: what a scheme moves
/// in a step of an [`Ensemble`](super::Ensemble).
pub struct LaneEquations<P: Solvable, const L: usize> {
    constants: <P::Coordinates as Coordinates<P::Mechanism>>::Constants<Lanes<P::Number, L>>,
    coefficients: <P::Coordinates as Coordinates<P::Mechanism>>::Coefficients<Lanes<P::Number, L>>,
    /// The smallest relative pivot of the stages of a step.
    pivot: Lanes<P::Number, L>,
}

/// The states of all lanes.
pub(super) type StateOfAll<P, const L: usize> = <<P as Posed>::Coordinates as Coordinates<
    <P as Posed>::Mechanism,
>>::State<Lanes<<P as Posed>::Number, L>>;

/// The terms of the saddle system.
type TermsOf<P> = <<P as Posed>::Formulation as Formulation<<P as Posed>::Number>>::Terms;

impl<P: Solvable, const L: usize> LaneEquations<P, L> {
    pub(super) fn zeros() -> Self {
        Self {
            constants: Array::zeros(),
            coefficients: Array::zeros(),
            pivot: Lanes::one(),
        }
    }

    /// Takes the equations of one mechanism into a lane.
    pub(super) fn put(&mut self, lane: usize, dynamics: &Dynamics<P>) {
        let equations = dynamics.own_equations();
        put(&mut self.constants, lane, &equations.constants);
        put(&mut self.coefficients, lane, &equations.coefficients);
    }

    /// Takes what depends on the inputs of one mechanism into a lane.
    pub(super) fn put_inputs(&mut self, lane: usize, dynamics: &Dynamics<P>) {
        put(&mut self.constants, lane, dynamics.own_constants());
    }

    /// Begins a step.
    #[inline(always)]
    pub(super) fn begin(&mut self) {
        self.pivot = Lanes::one();
    }

    /// Whether a step has led to numbers in all lanes, with no pivot that vanished on the way.
    #[inline(always)]
    pub(super) fn are_sound(&self, state: &StateOfAll<P, L>) -> bool {
        self.pivot
            .all(|pivot| !vanishes::<P::Number, TermsOf<P>>(pivot))
            && unless_finite(state).all(|x| x == P::Number::zero())
    }

    /// The same in one lane.
    pub(super) fn is_sound(&self, lane: usize, state: &StateOfAll<P, L>) -> bool {
        let pivot = self.pivot.lane(lane);
        pivot.is_some_and(|pivot| !vanishes::<P::Number, TermsOf<P>>(pivot))
            && unless_finite(state).lane(lane) == Some(P::Number::zero())
    }
}

copied! {
    [P: Solvable, const L: usize] LaneEquations<P, L>;
}

opaque! {
    [P: Solvable, const L: usize] LaneEquations<P, L>, "LaneEquations";
}

/// Zero in lanes where all numbers are finite, else NaN.
#[inline(always)]
fn unless_finite<T: Real, X: Vector<Lanes<T, L>>, const L: usize>(state: &X) -> Lanes<T, L> {
    let mut sum = -Lanes::zero();
    state.for_each(|x| sum = x.fused(-Lanes::zero(), sum));
    sum
}

impl<P: Solvable<Number = T>, T: Real, const L: usize> System<Lanes<T, L>> for LaneEquations<P, L> {
    type State = StateOfAll<P, L>;

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
        let pivot = P::Coordinates::rates_into::<Lanes<T, L>, TermsOf<P>>(
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

impl<P, T: Real, const L: usize> SecondOrder<Lanes<T, L>> for LaneEquations<P, L>
where
    P: Solvable<Number = T>,
{
    #[inline(always)]
    fn with_new_velocities(
        &mut self,
        time: Lanes<T, L>,
        state: &Self::State,
        step: Lanes<T, L>,
        rates: &mut Self::State,
    ) {
        P::Coordinates::with_new_velocities(&self.constants, time, state, step, rates);
    }
}
