//! A number that counts the operations done with it, and knows the longest chain of them behind itself.

use core::cell::Cell;
use core::ops::{Add, Mul, Neg, Sub};

use holonom::{Operations, Scalar};

thread_local! {
    static OPERATIONS: Cell<Operations> = const {
        Cell::new(Operations {
            additions: 0,
            multiplications: 0,
            divisions: 0,
            square_roots: 0,
            functions: 0,
            depth: 0,
        })
    };
    static COMPUTATION: Cell<usize> = const { Cell::new(0) };
}

/// What a call of a function counts as.
const FUNCTION: fn(&mut Operations) -> &mut usize = |count| &mut count.functions;

/// A value, and the number of operations on the longest way to it within the computation that made it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counted {
    value: f64,
    depth: usize,
    computation: usize,
}

/// The operations of a computation. `depth` is that of the deepest number among those it made; what was made before has
/// depth zero.
pub(crate) fn counted<T>(computation: impl FnOnce() -> T) -> Operations {
    OPERATIONS.set(Operations::default());
    COMPUTATION.set(COMPUTATION.get() + 1);
    computation();
    OPERATIONS.take()
}

impl Counted {
    /// The result of an operation.
    fn made<const N: usize>(
        value: f64,
        operands: [Self; N],
        kind: fn(&mut Operations) -> &mut usize,
    ) -> Self {
        let computation = COMPUTATION.get();
        let own = |operand: &&Self| operand.computation == computation;
        let before = operands.iter().filter(own).map(|operand| operand.depth);
        let depth = before.max().unwrap_or(0) + 1;
        let mut operations = OPERATIONS.get();
        *kind(&mut operations) += 1;
        operations.depth = operations.depth.max(depth);
        OPERATIONS.set(operations);
        Self {
            value,
            depth,
            computation,
        }
    }
}

impl PartialEq for Counted {
    #[inline(never)]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl Add for Counted {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self::made(self.value + other.value, [self, other], |count| {
            &mut count.additions
        })
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
        Self::made(self.value * other.value, [self, other], |count| {
            &mut count.multiplications
        })
    }
}

impl Neg for Counted {
    type Output = Self;

    /// Signs are free.
    #[inline(never)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            ..self
        }
    }
}

impl Scalar for Counted {
    #[inline(never)]
    fn constant(value: f64) -> Self {
        Self {
            value,
            depth: 0,
            computation: 0,
        }
    }

    #[inline(never)]
    fn reciprocal(self) -> Self {
        Self::made(1.0 / self.value, [self], |count| &mut count.divisions)
    }

    #[inline(never)]
    fn sqrt(self) -> Self {
        Self::made(self.value.sqrt(), [self], |count| &mut count.square_roots)
    }

    /// Two operations.
    #[inline(never)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    #[inline(never)]
    fn abs(self) -> Self {
        Self {
            value: self.value.abs(),
            ..self
        }
    }

    /// A comparison, not an operation.
    #[inline(never)]
    fn min(self, other: Self) -> Self {
        if other.value < self.value {
            other
        } else {
            self
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

    /// Not an operation, like a comparison.
    #[inline(never)]
    fn round(self) -> Self {
        Self {
            value: self.value.round(),
            ..self
        }
    }
}
