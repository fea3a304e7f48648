//! A number that counts the operations done with it, and knows the longest chain of them behind
//! itself.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use holonom::{Real, Scalar, mechanism::Operations};

thread_local! {
    static OPERATIONS: Cell<Operations> = const { Cell::new(Operations::NONE) };
    static COMPUTATION: Cell<u64> = const { Cell::new(0) };
}

/// What a call of a function counts as.
const FUNCTION: fn(&mut Operations) -> &mut usize = |count| &mut count.functions;

/// A value, and the number of operations on the longest way to it within the computation that made
/// it.
///
/// Counts are those of [`Operations`]: a fused multiply-add is two, signs, comparisons and rounding
/// to an integer are free. The operations are not inlined: a kernel of thousands of them would take
/// minutes to compile.
///
/// Two words, which travel in registers: a kernel of thousands of larger ones would keep all of
/// them in memory, and take minutes to compile again.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    value: f64,
    place: u64,
}

/// How far depths reach in a place; the number of the computation stands above.
const DEPTHS: u32 = 32;

/// The operations of a computation, and what came of it. `depth` is that of the deepest number
/// among those it made; what was made before has depth zero.
pub fn counted<T>(computation: impl FnOnce() -> T) -> (Operations, T) {
    OPERATIONS.set(Operations::NONE);
    COMPUTATION.set(COMPUTATION.get() + 1);
    let result = computation();
    (OPERATIONS.take(), result)
}

impl Counted {
    /// The result of an operation.
    fn made<const N: usize>(
        value: f64,
        operands: [Self; N],
        kind: fn(&mut Operations) -> &mut usize,
    ) -> Self {
        let computation = COMPUTATION.get();
        let own = |operand: &&Self| operand.place >> DEPTHS == computation;
        let depth = |operand: &Self| operand.place & ((1 << DEPTHS) - 1);
        let before = operands.iter().filter(own).map(depth);
        let depth = before.max().unwrap_or(0) + 1;
        let mut operations = OPERATIONS.get();
        *kind(&mut operations) += 1;
        operations.depth = operations.depth.max(depth as usize);
        OPERATIONS.set(operations);
        Self {
            value,
            place: computation << DEPTHS | depth,
        }
    }

    /// Another value at the same place of the computation.
    fn with(self, value: f64) -> Self {
        Self { value, ..self }
    }
}

impl PartialEq for Counted {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add for Counted {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        let sum = self.value + other.value;
        Self::made(sum, [self, other], |count| &mut count.additions)
    }
}

impl Sub for Counted {
    type Output = Self;

    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Counted {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let product = self.value * other.value;
        Self::made(product, [self, other], |count| &mut count.multiplications)
    }
}

impl Neg for Counted {
    type Output = Self;

    #[inline(never)]
    fn neg(self) -> Self {
        self.with(-self.value)
    }
}

impl Scalar for Counted {
    #[inline(never)]
    fn constant(value: f64) -> Self {
        Self { value, place: 0 }
    }

    #[inline(never)]
    fn reciprocal(self) -> Self {
        Self::made(1.0 / self.value, [self], |count| &mut count.divisions)
    }

    #[inline(never)]
    fn sqrt(self) -> Self {
        Self::made(self.value.sqrt(), [self], |count| &mut count.square_roots)
    }

    #[inline(never)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    #[inline(never)]
    fn abs(self) -> Self {
        self.with(self.value.abs())
    }

    #[inline(never)]
    fn min(self, other: Self) -> Self {
        if self.value < other.value || self.value.is_nan() {
            self
        } else {
            other
        }
    }

    #[inline(never)]
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        if self.value < bound.value {
            less
        } else {
            otherwise
        }
    }

    #[inline(never)]
    fn sin(self) -> Self {
        Self::made(self.value.sin(), [self], FUNCTION)
    }

    #[inline(never)]
    fn cos(self) -> Self {
        Self::made(self.value.cos(), [self], FUNCTION)
    }

    #[inline(never)]
    fn exp(self) -> Self {
        Self::made(self.value.exp(), [self], FUNCTION)
    }

    #[inline(never)]
    fn atan2(self, cosine: Self) -> Self {
        Self::made(self.value.atan2(cosine.value), [self, cosine], FUNCTION)
    }

    #[inline(never)]
    fn round(self) -> Self {
        self.with(self.value.round())
    }
}

impl Real for Counted {
    const EPSILON: Self = Self {
        value: f64::EPSILON,
        place: 0,
    };
    const ZERO: Self = Self {
        value: 0.0,
        place: 0,
    };

    fn to_f64(self) -> f64 {
        self.value
    }

    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    fn powf(self, exponent: f64) -> Self {
        Self::made(self.value.powf(exponent), [self], FUNCTION)
    }

    fn quotient(self, divisor: Self) -> Self {
        let quotient = self.value / divisor.value;
        Self::made(quotient, [self, divisor], |count| &mut count.divisions)
    }
}

#[cfg(test)]
mod tests {
    use super::{Counted, counted};
    use holonom::{Real as _, Scalar as _};

    #[test]
    fn operations_and_the_longest_chain_are_counted() {
        let [a, b] = [3.0, 4.0].map(Counted::constant);
        let (count, length) = counted(|| -(a.fused(a, b * b)).sqrt());
        assert_eq!(length.to_f64(), -5.0);
        assert_eq!((count.total(), count.depth), (4, 3));
        assert_eq!(
            (count.multiplications, count.additions, count.square_roots),
            (2, 1, 1)
        );
        let (count, _) = counted(|| length * a - b);
        assert_eq!(
            (count.total(), count.depth),
            (2, 2),
            "what was there before is no part of it"
        );
    }
}
