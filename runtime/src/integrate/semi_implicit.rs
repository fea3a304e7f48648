//! The semi-implicit Euler method.

use super::{ErrorModel, Look, NoStages, OneStep, Scheme, SecondOrder, Slopes, StepStart};
use crate::error::Fault;
use crate::math::scalar::Scalar;
use crate::state::vector::Vector;

/// The semi-implicit (symplectic) Euler method of order 1: velocities by the accelerations at the
/// start of the step, then coordinates by the velocities at its end. One evaluation a step, no
/// estimate of the error.
///
/// The energy of a conservative mechanism swings with an amplitude of the order of the step, but
/// does not drift as with the explicit method of Euler, where neither forces nor masses depend on
/// velocities: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, (I.1.9). It moves
/// states of coordinates and velocities alone: a system of one's own implements [`SecondOrder`].
/// Output within a step is by the cubic through states and slopes at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SemiImplicitEuler;

impl<S: Scalar> Scheme<S> for SemiImplicitEuler {
    type Stages<X: Vector<S>> = NoStages;

    fn stages<X: Vector<S>>(&self, _like: &X) -> NoStages {
        NoStages
    }

    /// `|p|` grows by `z^2 / 2` and an angle is off by `z^3 / 3`: less than `|p|`, for steps below
    /// a radian. Coordinates go by velocities of the ends of steps, which are those of their
    /// middles half a step on.
    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            angle_error: 1.0,
            stagger: 0.5,
            ..Default::default()
        }
    }
}

impl<S: Scalar, Y: SecondOrder<S>> OneStep<S, Y> for SemiImplicitEuler {
    #[inline]
    fn advanced<L: Look<S, Y::State>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        StepStart { time, state, slope }: StepStart<'_, S, Y::State>,
        step: S,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let mut slope = slope.clone();
        system.with_new_velocities(time, state, step, &mut slope);
        Ok(state.plus([(step, &slope)]))
    }
}
