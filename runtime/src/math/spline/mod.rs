//! Splines: functions of one number from tables.
//!
//! A piece is a cubic by its values and slopes at both knots (Hermite's form). So all kinds differ
//! in their slopes alone (`slopes.rs`). `pieces.rs` evaluates them over any numbers.

mod fault;
mod pieces;
pub(crate) mod radii;
mod slopes;

pub use fault::SplineFault;
pub use pieces::Order;
use pieces::{Part, evaluate};

use crate::math::scalar::Scalar;

/// A cubic spline through `N` points: a function of one number from a table, for cams, recorded
/// motions and curves of forces.
///
/// Knots are the arguments, in increasing order; values are given at the knots, in any unit. Every
/// constructor is `const`, so that a table lies in the program itself:
///
/// ```
/// use holonom::spline::{Spline, uniform_knots};
///
/// /// A lift (m) over an angle (rad).
/// const LIFT: Spline<5> = Spline::periodic(
///     uniform_knots(0.0, core::f64::consts::TAU),
///     [0.0, 0.01, 0.02, 0.01, 0.0],
/// );
///
/// assert!((LIFT.value(core::f64::consts::PI) - 0.02).abs() < 1e-15);
/// // The same a turn later.
/// assert!((LIFT.value(3.0 * core::f64::consts::PI) - 0.02).abs() < 1e-15);
/// assert!(LIFT.slope(core::f64::consts::PI).abs() < 1e-15);
/// ```
///
/// | constructor | continuous derivatives | at the ends |
/// |---|---|---|
/// | [`Spline::natural`] | two | second derivative zero |
/// | [`Spline::clamped`] | two | slopes are given |
/// | [`Spline::periodic`] | two | as at the other end |
/// | [`Spline::monotone`] | one | a formula of three points |
///
/// Outside of its knots a periodic spline repeats itself. Any other goes on along a straight line
/// with the slope of its end; [`Spline::held`] keeps the value of its end instead.
///
/// A table that is none is a [`SplineFault`]: [`Spline::fault`] tells it, and every value is NaN.
/// A mechanism refuses such a table, see [`guide::data`](mod@crate::guide::data).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spline<const N: usize> {
    knots: [f64; N],
    values: [f64; N],
    slopes: [f64; N],
    ends: Ends,
    fault: Option<SplineFault>,
}

/// What is outside of the knots.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ends {
    /// Where the spline repeats itself; else zero.
    period: f64,
    /// `1 / period`, or zero.
    inverse_period: f64,
    /// The slopes outside.
    before: f64,
    after: f64,
}

impl Ends {
    /// In the order in which they are read.
    const fn listed(self) -> [f64; 4] {
        [self.period, self.inverse_period, self.before, self.after]
    }
}

/// `N` knots at equal distances, from `first` to `last`.
///
/// ```
/// assert_eq!(holonom::spline::uniform_knots(1.0, 2.0), [1.0, 1.25, 1.5, 1.75, 2.0]);
/// ```
#[must_use]
pub const fn uniform_knots<const N: usize>(first: f64, last: f64) -> [f64; N] {
    let mut knots = [first; N];
    let mut k = 1;
    while k < N {
        let share = k as f64 / (N - 1) as f64;
        knots[k] = first * (1.0 - share) + last * share;
        k += 1;
    }
    if N > 1 {
        knots[N - 1] = last;
    }
    knots
}

impl<const N: usize> Spline<N> {
    /// A spline with two continuous derivatives, the second of which is zero at both ends.
    #[must_use]
    pub const fn natural(knots: [f64; N], values: [f64; N]) -> Self {
        let fault = slopes::fault(&knots, &values, [0.0; 2]);
        let mut spline = Self::unfilled(knots, values, fault);
        if fault.is_none() {
            spline = spline.filled(slopes::natural(&knots, &values));
        }
        spline
    }

    /// A spline with two continuous derivatives and given slopes at its ends.
    ///
    /// With slopes of zero and [`Spline::held`] a motion begins and ends at rest.
    #[must_use]
    pub const fn clamped(knots: [f64; N], values: [f64; N], ends: [f64; 2]) -> Self {
        let fault = slopes::fault(&knots, &values, ends);
        let mut spline = Self::unfilled(knots, values, fault);
        if fault.is_none() {
            spline = spline.filled(slopes::clamped(&knots, &values, ends));
        }
        spline
    }

    /// A spline with two continuous derivatives that repeats itself. The last value is the first
    /// one, a period later.
    #[must_use]
    pub const fn periodic(knots: [f64; N], values: [f64; N]) -> Self {
        let fault = match slopes::fault(&knots, &values, [0.0; 2]) {
            None if N < 3 => Some(SplineFault::TooFewPoints),
            None if values[0] != values[N - 1] => Some(SplineFault::EndsDiffer),
            fault => fault,
        };
        let mut spline = Self::unfilled(knots, values, fault);
        if fault.is_none() {
            spline = spline.filled(slopes::periodic(&knots, &values));
            spline.ends.period = knots[N - 1] - knots[0];
            spline.ends.inverse_period = 1.0 / spline.ends.period;
        }
        spline
    }

    /// A spline that increases where the values do and decreases where they do: it overshoots
    /// nowhere. Its second derivative jumps at the knots.
    ///
    /// Its slopes are those of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984) with the
    /// weights of Brodlie for knots of unequal distances. They satisfy the conditions of Fritsch
    /// and Carlson (SIAM J. Numer. Anal. 17, 1980). Take it for forces: a driver with it has
    /// accelerations that jump.
    #[must_use]
    pub const fn monotone(knots: [f64; N], values: [f64; N]) -> Self {
        let fault = slopes::fault(&knots, &values, [0.0; 2]);
        let mut spline = Self::unfilled(knots, values, fault);
        if fault.is_none() {
            spline = spline.filled(slopes::monotone(&knots, &values));
        }
        spline
    }

    /// The same, which keeps the value of its end outside of its knots. A periodic spline has no
    /// outside.
    #[must_use]
    pub const fn held(mut self) -> Self {
        if self.ends.period == 0.0 {
            self.ends.before = 0.0;
            self.ends.after = 0.0;
        }
        self
    }

    /// What is wrong with the table; `None` if it makes a spline.
    #[must_use]
    pub const fn fault(&self) -> Option<SplineFault> {
        self.fault
    }

    /// The knots.
    #[must_use]
    pub const fn knots(&self) -> &[f64; N] {
        &self.knots
    }

    /// The values at the knots.
    #[must_use]
    pub const fn values(&self) -> &[f64; N] {
        &self.values
    }

    /// The slopes at the knots.
    #[must_use]
    pub const fn slopes(&self) -> &[f64; N] {
        &self.slopes
    }

    /// The value at `x`.
    #[must_use]
    pub fn value<S: Scalar>(&self, x: S) -> S {
        self.table().evaluate(Order::Value, x)
    }

    /// The first derivative at `x`; at a knot that of the piece behind it.
    #[must_use]
    pub fn slope<S: Scalar>(&self, x: S) -> S {
        self.table().evaluate(Order::Slope, x)
    }

    /// The second derivative at `x`, likewise.
    #[must_use]
    pub fn curvature<S: Scalar>(&self, x: S) -> S {
        self.table().evaluate(Order::Curvature, x)
    }

    /// What kernels read of it.
    #[doc(hidden)]
    #[must_use]
    pub const fn table(&self) -> Table<'_> {
        Table {
            ends: self.ends.listed(),
            knots: &self.knots,
            values: &self.values,
            slopes: &self.slopes,
            fault: self.fault,
        }
    }

    const fn unfilled(knots: [f64; N], values: [f64; N], fault: Option<SplineFault>) -> Self {
        Self {
            knots,
            values,
            slopes: [f64::NAN; N],
            ends: Ends {
                period: 0.0,
                inverse_period: 0.0,
                before: f64::NAN,
                after: f64::NAN,
            },
            fault,
        }
    }

    const fn filled(mut self, slopes: [f64; N]) -> Self {
        self.slopes = slopes;
        self.ends.before = slopes[0];
        self.ends.after = slopes[N - 1];
        if !slopes::are_finite(&slopes) {
            self.fault = Some(SplineFault::OutOfRange);
        }
        self
    }
}

/// A spline of any number of points, as kernels read it.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    ends: [f64; 4],
    knots: &'a [f64],
    values: &'a [f64],
    slopes: &'a [f64],
    fault: Option<SplineFault>,
}

impl Table<'_> {
    /// What is wrong with it.
    #[must_use]
    pub const fn fault(&self) -> Option<SplineFault> {
        self.fault
    }

    /// The value or a derivative.
    #[inline]
    #[must_use]
    pub fn evaluate<S: Scalar>(&self, order: Order, x: S) -> S {
        let [number] = self.evaluate_each([order], x);
        number
    }

    /// Several of these.
    #[inline]
    pub(crate) fn evaluate_each<S: Scalar, const K: usize>(
        &self,
        orders: [Order; K],
        x: S,
    ) -> [S; K] {
        let at = |part: Part, place: usize| {
            let numbers = match part {
                Part::End => &self.ends[..],
                Part::Knot => self.knots,
                Part::Value => self.values,
                Part::Slope => self.slopes,
            };
            S::constant(numbers.get(place).copied().unwrap_or(f64::NAN))
        };
        evaluate(self.knots.len(), at, orders, x)
    }

    /// Its numbers one after the other: ends, knots, values, slopes.
    fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let points = self.knots.iter().chain(self.values).chain(self.slopes);
        self.ends.iter().chain(points).copied()
    }

    /// Puts its numbers where [`evaluate_numbers`] finds them.
    pub fn put<S: Scalar>(&self, numbers: &mut [S]) {
        for (place, number) in numbers.iter_mut().zip(self.numbers()) {
            *place = S::constant(number);
        }
    }
}

/// The value or a derivative of a spline by its numbers, see [`Table::put`].
#[inline]
#[must_use]
pub fn evaluate_numbers<S: Scalar>(numbers: &[S], order: Order, x: S) -> S {
    let count = numbers.len().saturating_sub(4) / 3;
    let at = |part: Part, place: usize| {
        let first = match part {
            Part::End => 0,
            Part::Knot => 4,
            Part::Value => 4 + count,
            Part::Slope => 4 + 2 * count,
        };
        let number = numbers.get(first + place).copied();
        number.unwrap_or_else(|| S::constant(f64::NAN))
    };
    let [number] = evaluate(count, at, [order], x);
    number
}
