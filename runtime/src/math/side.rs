//! On which side of zero a number is: what laws that switch are made of.

use crate::math::scalar::Scalar;

/// The side that is held, 1 or -1. Where none is (0), the sign of a reading, which is 0 at zero.
///
/// NaN of a reading travels, derivatives do not.
#[inline]
pub fn side<S: Scalar>(held: S, reading: S) -> S {
    let (zero, one) = (S::zero(), S::one());
    // Left are zero and NaN, which are their own integers.
    let own = reading.select(zero, -one, zero.select(reading, one, reading.round()));
    held.select(zero, -one, zero.select(held, one, own))
}

/// `value` where a side is not negative, else zero.
#[inline]
pub fn above<S: Scalar>(side: S, value: S) -> S {
    let zero = S::zero();
    // A side that is NaN is neither below nor above zero.
    side.select(zero, zero, zero.select(side, value, value + side))
}

/// `value` where a side is negative, else zero.
#[inline]
pub fn below<S: Scalar>(side: S, value: S) -> S {
    side.select(S::zero(), value, S::zero())
}

#[cfg(test)]
mod tests {
    use super::{above, below, side};

    #[test]
    fn a_side_is_that_of_the_reading_unless_one_is_held() {
        for reading in [-2.5, -1e-300, 1e-300, 7.0_f64] {
            assert_eq!(side(0.0, reading), reading.signum());
            assert_eq!(side(1.0, reading), 1.0);
            assert_eq!(side(-1.0, reading), -1.0);
        }
        assert_eq!(side(0.0, 0.0_f64), 0.0);
        assert!(side(0.0, f64::NAN).is_nan());
        assert_eq!(side(0.0, f64::NEG_INFINITY), -1.0);
    }

    #[test]
    fn one_of_two_is_chosen_exactly() {
        let (a, b) = (0.1_f64 + 0.2, 1e30);
        let choose = |side| above(side, a) + below(side, b);
        assert_eq!([choose(1.0), choose(0.0), choose(-1.0)], [a, a, b]);
        // What is not chosen has no say, be it infinite; a side that is none has.
        assert_eq!(above(1.0, a) + below(1.0, f64::INFINITY), a);
        assert_eq!(above(-1.0, f64::NAN) + below(-1.0, b), b);
        assert!(above(f64::NAN, a).is_nan());
    }
}
