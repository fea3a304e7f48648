//! Conversion to bodies that waits until somebody looks.

use crate::math::scalar::Real;
use crate::state::vector::MovingState;

/// The last state that the integration has reached, if its bodies are not known yet: those of an
/// earlier state then stand in their place.
///
/// Euler parameters keep their signs by those of a moment ago, which holds for less than half a
/// turn since. So bodies are converted where anything may have turned by one radian.
pub(crate) struct Deferred<X> {
    state: Option<X>,
    /// What a body has turned by at most since the last conversion (rad).
    turned: f64,
    /// How long ago that was (s).
    elapsed: f64,
}

/// How far a body may turn without a conversion (rad).
const FAR: f64 = 1.0;

impl<X> Deferred<X> {
    pub(crate) const fn new() -> Self {
        Self {
            state: None,
            turned: 0.0,
            elapsed: 0.0,
        }
    }

    /// Lets the conversion of a state wait that was reached by a step (s). False where it must not:
    /// the state is then to be converted.
    ///
    /// No body turns faster than the sum of all velocities, which are about axes of length 1.
    /// Displacements are counted as angles, which makes conversions earlier, not later.
    #[inline]
    pub(crate) fn defer<S: Real>(&mut self, state: &X, step: S) -> bool
    where
        X: MovingState<S>,
    {
        let rates = state.rates_slice().iter();
        let speed = rates.fold(0.0, |sum, rate| sum + rate.to_f64().abs());
        self.turned += step.to_f64() * speed;
        self.elapsed += step.to_f64();
        let may_wait = self.turned < FAR;
        if may_wait {
            self.state = Some(*state);
        } else {
            self.clear();
        }
        may_wait
    }

    /// How long ago (s) the bodies are known of.
    #[inline]
    pub(crate) fn elapsed<S: Real>(&self) -> S {
        S::constant(self.elapsed)
    }

    /// The state that waits, to be converted now.
    #[inline]
    pub(crate) fn take(&mut self) -> Option<X> {
        let state = self.state.take();
        self.clear();
        state
    }

    /// Forgets the state: bodies of a later one are known.
    #[inline]
    pub(crate) fn clear(&mut self) {
        *self = Self::new();
    }
}
