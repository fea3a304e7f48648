//! Settings that a user gives.

use crate::error::StartFault;
use crate::math::scalar::Real;

/// Refuses a setting that is not finite and positive.
pub(crate) fn positive<S: Real>(name: &'static str, value: S) -> Result<S, StartFault> {
    if value.is_finite() && value > S::zero() {
        Ok(value)
    } else {
        Err(StartFault::Setting {
            name,
            value: value.to_f64(),
        })
    }
}

/// The fault of an interval.
pub(crate) fn interval<S: Real>(start: S, end: S) -> StartFault {
    StartFault::Interval {
        start: start.to_f64(),
        end: end.to_f64(),
    }
}
