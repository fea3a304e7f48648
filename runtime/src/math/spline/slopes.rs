//! The slopes of splines at their knots.
//!
//! All of it runs in the compiler, which knows loops and no iterators there. The table was checked
//! by `fault`: it has two points at least.

use super::fault::SplineFault;

/// What is wrong with a table.
pub(super) const fn fault<const N: usize>(
    knots: &[f64; N],
    values: &[f64; N],
    ends: [f64; 2],
) -> Option<SplineFault> {
    if N < 2 {
        return Some(SplineFault::TooFewPoints);
    }
    if !are_finite(knots) || !are_finite(values) || !are_finite(&ends) {
        return Some(SplineFault::NotFinite);
    }
    let mut k = 1;
    while k < N {
        if knots[k] <= knots[k - 1] {
            return Some(SplineFault::KnotsNotIncreasing);
        }
        k += 1;
    }
    None
}

pub(super) const fn are_finite<const N: usize>(numbers: &[f64; N]) -> bool {
    let mut k = 0;
    while k < N {
        if !numbers[k].is_finite() {
            return false;
        }
        k += 1;
    }
    true
}

const fn distance<const N: usize>(knots: &[f64; N], k: usize) -> f64 {
    knots[k + 1] - knots[k]
}

const fn chord<const N: usize>(knots: &[f64; N], values: &[f64; N], k: usize) -> f64 {
    (values[k + 1] - values[k]) / distance(knots, k)
}

/// Equations `below d[k - 1] + middle d[k] + above d[k + 1] = right` for the slopes.
struct Tridiagonal<const N: usize> {
    below: [f64; N],
    middle: [f64; N],
    above: [f64; N],
    right: [f64; N],
}

impl<const N: usize> Tridiagonal<N> {
    /// The second derivative is continuous at every inner knot. The first and the last equation say
    /// that the slopes there are zero.
    const fn new(knots: &[f64; N], values: &[f64; N]) -> Self {
        let mut rows = Self {
            below: [0.0; N],
            middle: [1.0; N],
            above: [0.0; N],
            right: [0.0; N],
        };
        let mut k = 1;
        while k + 1 < N {
            let (former, next) = (distance(knots, k - 1), distance(knots, k));
            rows.continuous(
                k,
                [former, next],
                [chord(knots, values, k - 1), chord(knots, values, k)],
            );
            k += 1;
        }
        rows
    }

    const fn continuous(&mut self, k: usize, [former, next]: [f64; 2], chords: [f64; 2]) {
        // Divided by their sum, so that sizes of knots do not matter.
        let total = former + next;
        let (a, b) = (next / total, former / total);
        self.below[k] = a;
        self.middle[k] = 2.0;
        self.above[k] = b;
        self.right[k] = 3.0 * (a * chords[0] + b * chords[1]);
    }

    /// The solution of the first `count` equations, which are diagonally dominant.
    const fn solved(&self, count: usize) -> [f64; N] {
        let (mut above, mut slopes) = (self.above, self.right);
        let mut pivot = self.middle[0];
        above[0] /= pivot;
        slopes[0] /= pivot;
        let mut k = 1;
        while k < count {
            pivot = self.middle[k] - self.below[k] * above[k - 1];
            above[k] /= pivot;
            slopes[k] = (slopes[k] - self.below[k] * slopes[k - 1]) / pivot;
            k += 1;
        }
        let mut k = count - 1;
        while k > 0 {
            k -= 1;
            slopes[k] -= above[k] * slopes[k + 1];
        }
        slopes
    }
}

pub(super) const fn natural<const N: usize>(knots: &[f64; N], values: &[f64; N]) -> [f64; N] {
    let mut rows = Tridiagonal::new(knots, values);
    rows.middle[0] = 2.0;
    rows.above[0] = 1.0;
    rows.right[0] = 3.0 * chord(knots, values, 0);
    rows.below[N - 1] = 1.0;
    rows.middle[N - 1] = 2.0;
    rows.right[N - 1] = 3.0 * chord(knots, values, N - 2);
    rows.solved(N)
}

pub(super) const fn clamped<const N: usize>(
    knots: &[f64; N],
    values: &[f64; N],
    ends: [f64; 2],
) -> [f64; N] {
    let mut rows = Tridiagonal::new(knots, values);
    rows.right[0] = ends[0];
    rows.right[N - 1] = ends[1];
    rows.solved(N)
}

/// Of three points at least. The slope before the last is set apart: without it the equations are
/// tridiagonal, and it follows from its own.
pub(super) const fn periodic<const N: usize>(knots: &[f64; N], values: &[f64; N]) -> [f64; N] {
    let mut rows = Tridiagonal::new(knots, values);
    let apart = N - 2;
    rows.continuous(
        0,
        [distance(knots, N - 2), distance(knots, 0)],
        [chord(knots, values, N - 2), chord(knots, values, 0)],
    );
    // What the slope that is set apart adds to the others, where it is one.
    let mut by_it = Tridiagonal {
        right: [0.0; N],
        below: rows.below,
        middle: rows.middle,
        above: rows.above,
    };
    by_it.right[0] -= rows.below[0];
    by_it.right[apart - 1] -= rows.above[apart - 1];
    let (alone, by_it) = (rows.solved(apart), by_it.solved(apart));
    let (below, above) = (rows.below[apart], rows.above[apart]);
    let rest = rows.right[apart] - below * alone[apart - 1] - above * alone[0];
    let factor = rows.middle[apart] + below * by_it[apart - 1] + above * by_it[0];
    let slope = rest / factor;
    let mut slopes = [slope; N];
    let mut k = 0;
    while k < apart {
        slopes[k] = alone[k] + slope * by_it[k];
        k += 1;
    }
    slopes[N - 1] = slopes[0];
    slopes
}

pub(super) const fn monotone<const N: usize>(knots: &[f64; N], values: &[f64; N]) -> [f64; N] {
    let mut slopes = [chord(knots, values, 0); N];
    if N == 2 {
        return slopes;
    }
    let mut k = 1;
    while k + 1 < N {
        let (former, next) = (distance(knots, k - 1), distance(knots, k));
        let chords = [chord(knots, values, k - 1), chord(knots, values, k)];
        slopes[k] = if same_sign(chords[0], chords[1]) {
            // A weighted harmonic mean.
            let (a, b) = (former + 2.0 * next, 2.0 * former + next);
            (a + b) / (a / chords[0] + b / chords[1])
        } else {
            0.0
        };
        k += 1;
    }
    slopes[0] = at_end(
        [distance(knots, 0), distance(knots, 1)],
        [chord(knots, values, 0), chord(knots, values, 1)],
    );
    slopes[N - 1] = at_end(
        [distance(knots, N - 2), distance(knots, N - 3)],
        [chord(knots, values, N - 2), chord(knots, values, N - 3)],
    );
    slopes
}

const fn same_sign(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

/// The slope of the parabola through three points, if it has the sign of the first chord, else
/// zero. Where the chords differ in sign it is at most three times the first.
const fn at_end([near, far]: [f64; 2], [first, second]: [f64; 2]) -> f64 {
    let slope = ((2.0 * near + far) * first - near * second) / (near + far);
    if !same_sign(slope, first) {
        0.0
    } else if !same_sign(first, second) && slope.abs() > 3.0 * first.abs() {
        3.0 * first
    } else {
        slope
    }
}
