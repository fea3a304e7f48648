//! What drives a joint from outside.

use crate::math::scalar::Scalar;

/// An input with its first and second derivative in time (`#[input(order = 2)]`). It prescribes the
/// motion of a driver from outside, in the units of the motion (rad or m, per s, per s^2).
///
/// The three belong to one instant and to one motion: rate and acceleration are its derivatives.
/// Within a step of a run they are held, as all inputs are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint<S = f64> {
    /// The value.
    pub value: S,
    /// Its first derivative.
    pub rate: S,
    /// Its second derivative.
    pub acceleration: S,
}

impl<S: Scalar> Setpoint<S> {
    /// A value that does not change.
    #[must_use]
    pub fn at_rest(value: S) -> Self {
        Self {
            value,
            rate: S::zero(),
            acceleration: S::zero(),
        }
    }

    /// The same over other numbers.
    #[doc(hidden)]
    #[must_use]
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Setpoint<T> {
        Setpoint {
            value: f(self.value),
            rate: f(self.rate),
            acceleration: f(self.acceleration),
        }
    }
}
