//! The equations of motion, linear about a state.

use nalgebra::SMatrix;

use crate::math::scalar::Real;

/// The equations of motion and `P` readings, linear about a state, in `N` coordinates and `K`
/// values: by [`IndependentCoordinates::linearise`](super::IndependentCoordinates::linearise).
///
/// In first order, the state is `x = (coordinates, rates)`, all deviations from the state that it
/// was linearised about:
///
/// ```text
/// x' = A x + B u
/// y  = C x + D u
/// ```
///
/// Of a ball the coordinates are a small turn (rad) along the axes of its rates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Linearised<const N: usize, const K: usize, const P: usize, S = f64> {
    /// Rates of coordinates by coordinates: zero but for balls that turn, whose small turns are
    /// carried round.
    pub rates_by_positions: SMatrix<S, N, N>,
    /// Accelerations by coordinates.
    pub by_positions: SMatrix<S, N, N>,
    /// Accelerations by rates.
    pub by_rates: SMatrix<S, N, N>,
    /// Accelerations by values.
    pub by_values: SMatrix<S, N, K>,
    /// Accelerations by efforts along the coordinates: the inverse of the mass matrix.
    pub by_efforts: SMatrix<S, N, N>,
    /// Readings by coordinates.
    pub readings_by_positions: SMatrix<S, P, N>,
    /// Readings by rates.
    pub readings_by_rates: SMatrix<S, P, N>,
    /// Readings by values: `D`.
    pub readings_by_values: SMatrix<S, P, K>,
}

impl<const N: usize, const K: usize, const P: usize, S: Real> Linearised<N, K, P, S> {
    pub(super) fn zeros() -> Self {
        Self {
            rates_by_positions: SMatrix::from_element(S::zero()),
            by_positions: SMatrix::from_element(S::zero()),
            by_rates: SMatrix::from_element(S::zero()),
            by_values: SMatrix::from_element(S::zero()),
            by_efforts: SMatrix::from_element(S::zero()),
            readings_by_positions: SMatrix::from_element(S::zero()),
            readings_by_rates: SMatrix::from_element(S::zero()),
            readings_by_values: SMatrix::from_element(S::zero()),
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let parts = [
            self.rates_by_positions.as_slice(),
            self.by_positions.as_slice(),
            self.by_rates.as_slice(),
            self.by_values.as_slice(),
            self.by_efforts.as_slice(),
            self.readings_by_positions.as_slice(),
            self.readings_by_rates.as_slice(),
            self.readings_by_values.as_slice(),
        ];
        // Without an early end, so that the compiler looks at several at once.
        let is_finite =
            |part: &[S]| (part.iter()).fold(true, |finite, number| finite & number.is_finite());
        parts
            .into_iter()
            .fold(true, |finite, part| finite & is_finite(part))
    }

    /// `A`, for `X = 2 N`; another `X` does not compile.
    #[must_use]
    pub fn a<const X: usize>(&self) -> SMatrix<S, X, X> {
        const { assert!(X == 2 * N, "a state has two numbers for every coordinate") };
        SMatrix::from_fn(|row, column| self.of_a(row, column))
    }

    /// An entry of `A`.
    pub(super) fn of_a(&self, row: usize, column: usize) -> S {
        match (row < N, column < N) {
            (true, true) => self.rates_by_positions[(row, column)],
            (true, false) if column == row + N => S::one(),
            (true, false) => S::zero(),
            (false, true) => self.by_positions[(row - N, column)],
            (false, false) => self.by_rates[(row - N, column - N)],
        }
    }

    /// `B` of the values.
    #[must_use]
    pub fn b<const X: usize>(&self) -> SMatrix<S, X, K> {
        const { assert!(X == 2 * N, "a state has two numbers for every coordinate") };
        lower(&self.by_values)
    }

    /// `B` of efforts (N m, N) along the coordinates, in the place of values.
    #[must_use]
    pub fn b_of_efforts<const X: usize>(&self) -> SMatrix<S, X, N> {
        const { assert!(X == 2 * N, "a state has two numbers for every coordinate") };
        lower(&self.by_efforts)
    }

    /// `C`.
    #[must_use]
    pub fn c<const X: usize>(&self) -> SMatrix<S, P, X> {
        const { assert!(X == 2 * N, "a state has two numbers for every coordinate") };
        SMatrix::from_fn(|row, column| {
            if column < N {
                self.readings_by_positions[(row, column)]
            } else {
                self.readings_by_rates[(row, column - N)]
            }
        })
    }

    /// `D`.
    #[must_use]
    pub const fn d(&self) -> SMatrix<S, P, K> {
        self.readings_by_values
    }
}

/// Rows below as many zeros.
fn lower<S: Real, const N: usize, const K: usize, const X: usize>(
    matrix: &SMatrix<S, N, K>,
) -> SMatrix<S, X, K> {
    SMatrix::from_fn(|row, column| {
        row.checked_sub(N)
            .map_or(S::zero(), |row| matrix[(row, column)])
    })
}

/// `A` and `B` for values that are held during steps of a length (s):
/// `x(t + dt) = A_d x + B_d u`, with `A_d = exp(A dt)` and `B_d` the integral of `exp(A t) B`.
///
/// By Taylor's series of a step of at most a half over the size of `A`, doubled again and again.
#[must_use]
pub fn to_discrete<S: Real, const X: usize, const K: usize>(
    a: &SMatrix<S, X, X>,
    b: &SMatrix<S, X, K>,
    dt: S,
) -> (SMatrix<S, X, X>, SMatrix<S, X, K>) {
    /// The terms of the series: the next one is below the round-off of `f64`.
    const TERMS: u32 = 16;
    let identity =
        SMatrix::<S, X, X>::from_fn(|row, column| S::constant(f64::from(u8::from(row == column))));
    let times = |a: &SMatrix<S, X, X>, b: &SMatrix<S, X, X>| {
        SMatrix::<S, X, X>::from_fn(|row, column| {
            (0..X).fold(S::zero(), |sum, k| a[(row, k)].fused(b[(k, column)], sum))
        })
    };
    let rows = (0..X).map(|row| (0..X).fold(S::zero(), |sum, k| sum + a[(row, k)].abs()));
    let size = rows.fold(S::zero(), S::max) * dt.abs();
    let mut doublings = 0;
    let mut step = dt;
    let mut left = size;
    while left > S::constant(0.5) && doublings < 200 {
        (left, step) = (left * S::constant(0.5), step * S::constant(0.5));
        doublings += 1;
    }
    // `sum of (A h)^k / (k + 1)!`, from the last term on.
    let scaled = a.map(|entry| entry * step);
    let mut series = identity;
    for term in (1..TERMS).rev() {
        let factor = S::constant(1.0 / f64::from(term + 1));
        let product = times(&scaled, &series);
        series = identity.zip_map(&product, |one, more| more.fused(factor, one));
    }
    let mut integral = series.map(|entry| entry * step);
    let power = times(&scaled, &series);
    let mut transition = identity.zip_map(&power, |one, more| one + more);
    for _ in 0..doublings {
        // Over twice the time: what has come in goes on, and as much comes in again.
        let more = times(&transition, &integral);
        integral = integral.zip_map(&more, |own, more| own + more);
        transition = times(&transition, &transition);
    }
    let input = SMatrix::<S, X, K>::from_fn(|row, column| {
        (0..X).fold(S::zero(), |sum, k| {
            integral[(row, k)].fused(b[(k, column)], sum)
        })
    });
    (transition, input)
}
