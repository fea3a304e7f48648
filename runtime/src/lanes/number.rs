//! Numbers that are several numbers, computed side by side.

use core::array::from_fn;
use core::ops::{Add, Mul, Neg, Sub};

use crate::math::scalar::{Real, Scalar};
use crate::math::versine;

/// `L` numbers in the place of one: every operation is done in each lane, and no lane knows of the
/// others.
///
/// A kernel over such numbers evaluates `L` mechanisms at once. A compiler that may use the vector
/// instructions of the processor makes one instruction of the lanes of an operation: build with
/// `RUSTFLAGS="-C target-cpu=native"`. As many lanes as fill one or two vector registers are best:
/// with AVX2 4 or 8 of `f64`, 8 or 16 of `f32`; one register where the mechanism is large.
///
/// A lane has, bit for bit, the number that the same operations give of single numbers. NaN stays
/// in its lane, and [`Scalar::select`] chooses in each lane.
///
/// ```
/// use holonom::{Scalar, lanes::Lanes};
///
/// let angles = Lanes::new([0.1, 0.5, 1.0, f64::NAN]);
/// let sines = angles.sin() + Lanes::constant(1.0);
/// assert_eq!(sines.lane(1), Some(0.5_f64.sin() + 1.0));
/// assert!(sines.to_array()[3].is_nan());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lanes<T, const L: usize>([T; L]);

impl<T: Real, const L: usize> Lanes<T, L> {
    /// A number for every lane.
    #[inline(always)]
    #[must_use]
    pub const fn new(numbers: [T; L]) -> Self {
        Self(numbers)
    }

    /// The same number in every lane.
    #[inline(always)]
    #[must_use]
    pub const fn splat(number: T) -> Self {
        Self([number; L])
    }

    /// The numbers of all lanes.
    #[inline(always)]
    #[must_use]
    pub const fn to_array(self) -> [T; L] {
        self.0
    }

    /// The number of a lane; `None` where there is no such lane.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, lane: usize) -> Option<T> {
        self.0.get(lane).copied()
    }

    /// Writes the number of a lane, if there is such a lane.
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, number: T) {
        if let Some(place) = self.0.get_mut(lane) {
            *place = number;
        }
    }

    #[inline(always)]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        Self(from_fn(|k| f(self.0[k])))
    }

    #[inline(always)]
    fn both(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self(from_fn(|k| f(self.0[k], other.0[k])))
    }

    /// Whether something holds in all lanes, without a branch for each.
    #[inline(always)]
    pub(super) fn all(&self, holds: impl Fn(T) -> bool) -> bool {
        self.0.iter().fold(true, |all, &x| all & holds(x))
    }
}

impl<T: Real, const L: usize> Add for Lanes<T, L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.both(other, |x, y| x + y)
    }
}

impl<T: Real, const L: usize> Sub for Lanes<T, L> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.both(other, |x, y| x - y)
    }
}

impl<T: Real, const L: usize> Mul for Lanes<T, L> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.both(other, |x, y| x * y)
    }
}

impl<T: Real, const L: usize> Neg for Lanes<T, L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}

impl<T: Real, const L: usize> Scalar for Lanes<T, L> {
    const SEVEN_DIGITS: bool = T::SEVEN_DIGITS;
    const HAS_LANES: bool = true;
    const IS_WIDE: bool = true;

    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::splat(T::constant(value))
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        self.each(T::reciprocal)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.each(T::sqrt)
    }

    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        Self(from_fn(|k| self.0[k].fused(factor.0[k], addend.0[k])))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.each(T::abs)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.both(other, T::min)
    }

    #[inline(always)]
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        Self(from_fn(|k| {
            self.0[k].select(bound.0[k], less.0[k], otherwise.0[k])
        }))
    }

    #[inline]
    fn sin(self) -> Self {
        self.each(T::sin)
    }

    #[inline]
    fn cos(self) -> Self {
        self.each(T::cos)
    }

    #[inline]
    fn exp(self) -> Self {
        self.each(T::exp)
    }

    #[inline]
    fn atan2(self, cosine: Self) -> Self {
        self.both(cosine, T::atan2)
    }

    #[inline]
    fn round(self) -> Self {
        self.each(T::round)
    }

    #[inline]
    fn bounds_passed(self, count: usize, bound: impl Fn(usize) -> Self) -> Option<usize> {
        let mut agreed = None;
        for (k, lane) in self.0.iter().enumerate() {
            let passed = lane.bounds_passed(count, |place| bound(place).0[k])?;
            if *agreed.get_or_insert(passed) != passed {
                return None;
            }
        }
        agreed
    }

    #[inline(always)]
    fn are_within<const N: usize>(numbers: &[Self; N], bound: f64) -> bool {
        let bound = T::constant(bound);
        let beyond = |number: &Self| {
            number
                .0
                .iter()
                .fold(false, |any, x| any | (x.abs() > bound))
        };
        !numbers
            .iter()
            .fold(false, |any, number| any | beyond(number))
    }

    /// By polynomials where all angles of all lanes are below 0.9 rad. Else lane by lane.
    #[inline(always)]
    fn sines_and_versines<const N: usize>(angles: &[Self; N]) -> [[Self; 2]; N] {
        let bound = T::constant(versine::SMALL);
        let small = |angle: &Self| angle.all(|x| x.abs() < bound);
        let mut turns = [[Self::splat(T::zero()); 2]; N];
        if angles.iter().fold(true, |all, angle| all & small(angle)) {
            for (turn, angle) in turns.iter_mut().zip(angles) {
                *turn = of_small(*angle);
            }
        } else {
            for (turn, angle) in turns.iter_mut().zip(angles) {
                *turn = lane_by_lane(angle);
            }
        }
        turns
    }
}

/// Sine and versine of an angle that is small in all lanes.
#[inline(always)]
fn of_small<T: Real, const L: usize>(angle: Lanes<T, L>) -> [Lanes<T, L>; 2] {
    if T::SEVEN_DIGITS {
        versine::of_small(angle, &versine::THREE, versine::three)
    } else {
        versine::of_small(angle, &versine::SIX, versine::six)
    }
}

/// Sine and versine of an angle in each lane, whatever the others are.
#[cold]
#[inline(never)]
fn lane_by_lane<T: Real, const L: usize>(angle: &Lanes<T, L>) -> [Lanes<T, L>; 2] {
    let mut turn = [Lanes::splat(T::zero()); 2];
    let [sine, versine] = &mut turn;
    let places = sine.0.iter_mut().zip(&mut versine.0);
    for ((sine, versine), turn) in places.zip(T::sines_and_versines(&angle.0)) {
        [*sine, *versine] = turn;
    }
    turn
}
