//! Where a reading passes zero.
//!
//! The Illinois method: the rule of false position after Dowell and Jarratt, *A modified regula
//! falsi method for computing the root of an equation* (1971). It bisects wherever two steps have
//! not halved the bracket. It needs no derivative, and some eight readings.

use crate::math::scalar::Real;

/// A bracket shorter than so many units in the last place of the time is not divided.
const SHORTEST: f64 = 4.0;

/// More than it ever takes: two divisions halve the bracket, or a third bisects it.
pub(crate) const MOST: usize = 192;

/// The first time in `(low, high]` at which a reading has passed zero, to some units in the last
/// place; the reading is negative before, and at `high` it is not. One that is positive at `low`
/// passes there.
pub(crate) fn locate<S: Real, E>(
    (mut low, mut high): (S, S),
    mut at_high: S,
    mut read: impl FnMut(S) -> Result<S, E>,
    most: usize,
) -> Result<S, E> {
    let mut at_low = read(low)?;
    if at_low >= S::zero() {
        return Ok(low);
    }
    let half = S::constant(0.5);
    let tolerance = S::constant(SHORTEST) * low.abs().max(high.abs()).ulp();
    let mut widths = [S::constant(4.0) * (high - low); 2];
    let mut last_was_high = None;
    for _ in 0..most {
        let width = high - low;
        if width <= tolerance || at_high <= S::zero() {
            break;
        }
        let middle = low + half * width;
        let mut time = high - at_high * width.quotient(at_high - at_low);
        // From either side the bracket closes.
        time = time.max(low + half * tolerance);
        time = time.min(high - half * tolerance);
        let is_slow = width > half * widths[0];
        if is_slow || !(time > low && time < high) {
            time = middle;
        }
        if !(time > low && time < high) {
            break;
        }
        widths = [widths[1], width];
        let reading = read(time)?;
        let is_high = reading >= S::zero();
        let is_again = last_was_high == Some(is_high);
        if is_high {
            (high, at_high) = (time, reading);
            if is_again {
                at_low = half * at_low;
            }
        } else {
            (low, at_low) = (time, reading);
            if is_again {
                at_high = half * at_high;
            }
        }
        last_was_high = Some(is_high);
    }
    Ok(high)
}

#[cfg(test)]
mod tests {
    use super::{MOST, locate};

    fn root(read: impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, usize) {
        let mut readings = 0;
        let counted = |time: f64| {
            readings += 1;
            Ok::<_, ()>(read(time))
        };
        let found = locate((from, to), read(to), counted, MOST).expect("no fault");
        (found, readings)
    }

    #[test]
    fn roots_are_found_to_the_last_digits() {
        let (found, readings) = root(|t| t * t - 2.0, 0.0, 2.0);
        assert!((found - 2.0_f64.sqrt()).abs() < 4.0 * f64::EPSILON && found * found >= 2.0);
        assert!(readings < 16, "{readings}");
        // Flat at the root, steep beyond it, and a jump.
        let (found, readings) = root(|t| (t - 0.3).powi(9), 0.0, 1.0);
        assert!((found - 0.3).abs() < 1e-15 && readings < MOST);
        let (found, readings) = root(|t| (40.0 * (t - 0.3)).exp() - 1.0, 0.0, 1.0);
        assert!((found - 0.3).abs() < 1e-15 && readings < 64);
        let (found, readings) = root(|t| if t < 0.7 { -1e-9 } else { 1e9 }, 0.0, 1.0);
        assert!((found - 0.7).abs() < 1e-15 && readings < MOST);
        assert_eq!(root(|t| t, 0.0, 1.0).0, 0.0);
        assert_eq!(root(|t| t - 1.0, 0.0, 1.0).0, 1.0);
        let far = 1e9;
        let (found, _) = root(|t| t - (far + 0.1), far, far + 1.0);
        assert!((found - (far + 0.1)).abs() < 1e-6);
    }
}
