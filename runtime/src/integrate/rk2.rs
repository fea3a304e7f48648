//! Runge-Kutta methods of order 2.

use super::{FixedStep, NoStages, Scheme, Start, Stride, System, dense};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// The explicit midpoint method of order 2, of Runge: two evaluations a step, no estimate of the
/// error.
///
/// Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, (II.1.4). Output within
/// a step is by the cubic through states and slopes at both ends.
///
/// A step of Euler parameters at a constant angular velocity `w` multiplies `|p|^2` by
/// `1 + z^4 / 4` with `z = |w| h / 2`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Midpoint;

/// The method of Heun of order 2, the trapezoidal rule with a predictor: two evaluations a step, at
/// its start and at its end, no estimate of the error.
///
/// Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, exercise II.1.1. Output
/// within a step is by the cubic through states and slopes at both ends; Euler parameters lose
/// their length as with [`Midpoint`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heun;

impl Midpoint {
    /// This method with a fixed step (s), for [`Simulation`](crate::Simulation).
    #[must_use]
    pub const fn every<S>(step: S) -> FixedStep<S, Self> {
        FixedStep { step, scheme: Self }
    }
}

impl Heun {
    /// This method with a fixed step (s), for [`Simulation`](crate::Simulation).
    #[must_use]
    pub const fn every<S>(step: S) -> FixedStep<S, Self> {
        FixedStep { step, scheme: Self }
    }
}

/// Half the angle of a step, `z`, times the ratio of `z^3 / 3`, by which an angle is off after it,
/// and `z^4 / 8`, by which `|p|` is.
const TURNING_ERROR_OF_SHORT_STEPS: f64 = 8.0 / 3.0;
/// The ratio for steps of a radian.
const TURNING_ERROR: f64 = 2.0 * TURNING_ERROR_OF_SHORT_STEPS;

impl<S: Real> Scheme<S> for Midpoint {
    type Stages<X: Vector<S>> = NoStages;

    const IS_JUDGED: bool = true;

    fn stages<X: Vector<S>>(&self, _like: &X) -> NoStages {
        NoStages
    }

    #[inline]
    fn stride<Y: System<S>>(
        &self,
        system: &mut Y,
        Start { time, state, slope }: Start<'_, S, Y::State>,
        step: S,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let half = S::constant(0.5) * step;
        let mut middle = slope.clone();
        system.stage(time + half, &state.plus([(half, slope)]), &mut middle)?;
        Ok(state.plus([(step, &middle)]))
    }

    fn turning_error(&self) -> f64 {
        TURNING_ERROR
    }

    fn turning_error_of_short_steps(&self) -> f64 {
        TURNING_ERROR_OF_SHORT_STEPS
    }

    fn silent_phase(&self) -> f64 {
        1.0 / 6.0
    }

    fn interpolate<X: Vector<S>>(&self, stride: Stride<'_, S, X, NoStages>, theta: S) -> X {
        dense::cubic(&stride, theta)
    }
}

impl<S: Real> Scheme<S> for Heun {
    type Stages<X: Vector<S>> = NoStages;

    const IS_JUDGED: bool = true;

    fn stages<X: Vector<S>>(&self, _like: &X) -> NoStages {
        NoStages
    }

    #[inline]
    fn stride<Y: System<S>>(
        &self,
        system: &mut Y,
        Start { time, state, slope }: Start<'_, S, Y::State>,
        step: S,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let half = S::constant(0.5) * step;
        let mut last = slope.clone();
        system.stage(time + step, &state.plus([(step, slope)]), &mut last)?;
        Ok(state.plus([(half, slope), (half, &last)]))
    }

    fn turning_error(&self) -> f64 {
        TURNING_ERROR
    }

    fn turning_error_of_short_steps(&self) -> f64 {
        TURNING_ERROR_OF_SHORT_STEPS
    }

    fn silent_phase(&self) -> f64 {
        1.0 / 6.0
    }

    fn interpolate<X: Vector<S>>(&self, stride: Stride<'_, S, X, NoStages>, theta: S) -> X {
        dense::cubic(&stride, theta)
    }
}
