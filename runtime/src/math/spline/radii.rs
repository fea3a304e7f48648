//! The radii of curvature of a closed curve whose support function is a spline of the angle.

use super::{Spline, Table};
use crate::math::scalar::Scalar;

/// A spline of any number of points that lasts as long as the program.
pub(crate) trait Lasting: Send + Sync {
    fn table(&self) -> Table<'_>;
}

impl<const N: usize> Lasting for Spline<N> {
    fn table(&self) -> Table<'_> {
        self.table()
    }
}

impl Table<'_> {
    /// Where it repeats itself; zero of one that does not.
    pub(crate) const fn period(&self) -> f64 {
        let [period, ..] = self.ends;
        period
    }

    /// The largest absolute value at a knot.
    pub(crate) fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, value| {
            let size = value.abs();
            if size > most { size } else { most }
        })
    }

    /// The least sum of value and second derivative between the knots. A piece of it is a cubic,
    /// whose least value is at an end or where its slope is zero.
    pub(crate) fn least_radius(&self) -> f64 {
        let points = self.knots.iter().zip(self.values).zip(self.slopes);
        let pairs = points.clone().zip(points.skip(1));
        pairs.fold(f64::INFINITY, |least, (from, to)| {
            let (((&x0, &y0), &d0), ((&x1, &y1), &d1)) = (from, to);
            Scalar::min(least, least_of_piece(x1 - x0, [y0, d0], [y1, d1]))
        })
    }
}

/// The least sum of value and second derivative of a piece of a length, by values and slopes.
fn least_of_piece(length: f64, [y0, d0]: [f64; 2], [y1, d1]: [f64; 2]) -> f64 {
    let chord = (y1 - y0) / length;
    // The spline is y0 + s (d0 + s (b + s c)).
    let b = (3.0 * chord - 2.0 * d0 - d1) / length;
    let c = (d0 + d1 - 2.0 * chord) / (length * length);
    let (constant, linear) = (y0 + 2.0 * b, d0 + 6.0 * c);
    let radius = |s: f64| constant + s * (linear + s * (b + s * c));
    // Its slope is linear + 2 b s + 3 c s^2. Both roots, without a difference of near numbers.
    let root = Scalar::sqrt(b * b - 3.0 * c * linear);
    let sum = if b < 0.0 { root - b } else { -root - b };
    let ends = Scalar::min(radius(0.0), radius(length));
    [sum / (3.0 * c), linear / sum]
        .into_iter()
        .filter(|&s| s > 0.0 && s < length)
        .fold(ends, |least, s| Scalar::min(least, radius(s)))
}
