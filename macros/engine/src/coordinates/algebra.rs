//! Components and tensors in one frame.

use super::frames::Tensor;
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::vector::{Triple, ZERO, dot};

/// `a + b`.
pub(super) fn add(arena: &mut Arena, a: Triple, b: Triple) -> Triple {
    [0, 1, 2].map(|k| arena.add(a[k], b[k]))
}

/// `a - b`.
pub(super) fn sub(arena: &mut Arena, a: Triple, b: Triple) -> Triple {
    [0, 1, 2].map(|k| arena.sub(a[k], b[k]))
}

/// `factor a`.
pub(super) fn scale(arena: &mut Arena, factor: Expr, a: Triple) -> Triple {
    a.map(|component| arena.mul(factor, component))
}

/// A matrix times a vector.
pub(super) fn apply(arena: &mut Arena, matrix: [Triple; 3], v: Triple) -> Triple {
    matrix.map(|row| dot(arena, row, v))
}

/// The zero tensor.
pub(super) const NOTHING: Tensor = [ZERO; 3];

/// The sum of two tensors.
pub(super) fn add_tensors(arena: &mut Arena, a: Tensor, b: Tensor) -> Tensor {
    [0, 1, 2].map(|k| add(arena, a[k], b[k]))
}

/// `factor t`.
pub(super) fn scale_tensor(arena: &mut Arena, factor: Expr, t: Tensor) -> Tensor {
    t.map(|row| scale(arena, factor, row))
}

/// `(p . p) I - p p^T`: the inertia of a unit mass at `p`.
fn point_inertia(arena: &mut Arena, p: Triple) -> Tensor {
    let mut tensor = NOTHING;
    for k in 0..3 {
        for l in k..3 {
            let entry = if k == l {
                let (m, n) = ((k + 1) % 3, (k + 2) % 3);
                let (first, second) = (arena.square(p[m.min(n)]), arena.square(p[m.max(n)]));
                arena.add(first, second)
            } else {
                -arena.mul(p[k], p[l])
            };
            tensor[k][l] = entry;
            tensor[l][k] = entry;
        }
    }
    tensor
}

/// `2 (p . h) I - p h^T - h p^T`: what a first moment `h` adds to the inertia where its origin is
/// seen at `p`.
pub(super) fn cross_inertia(arena: &mut Arena, p: Triple, h: Triple) -> Tensor {
    let products = p.map(|a| h.map(|b| arena.mul(a, b)));
    let mut tensor = NOTHING;
    for k in 0..3 {
        for l in k..3 {
            let entry = if k == l {
                let (m, n) = ((k + 1) % 3, (k + 2) % 3);
                let sum = arena.add(products[m][m], products[n][n]);
                arena.add(sum, sum)
            } else {
                -arena.add(products[k][l], products[l][k])
            };
            tensor[k][l] = entry;
            tensor[l][k] = entry;
        }
    }
    tensor
}

/// Mass, first moment and inertia about an origin, all in one frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia {
    pub(super) mass: Expr,
    pub(super) first: Triple,
    pub(super) tensor: Tensor,
}

impl Inertia {
    /// Nothing there.
    pub(super) const NONE: Self = Self {
        mass: Arena::ZERO,
        first: ZERO,
        tensor: NOTHING,
    };

    /// The sum.
    pub(super) fn plus(self, arena: &mut Arena, other: Self) -> Self {
        Self {
            mass: arena.add(self.mass, other.mass),
            first: add(arena, self.first, other.first),
            tensor: add_tensors(arena, self.tensor, other.tensor),
        }
    }

    /// The same about an origin from which its own one is seen at `offset` (Huygens, Steiner).
    pub(super) fn seen_at(self, arena: &mut Arena, offset: Triple) -> Self {
        let moved = scale(arena, self.mass, offset);
        let own = point_inertia(arena, offset);
        let own = scale_tensor(arena, self.mass, own);
        let mixed = cross_inertia(arena, offset, self.first);
        let tensor = add_tensors(arena, self.tensor, own);
        Self {
            mass: self.mass,
            first: add(arena, self.first, moved),
            tensor: add_tensors(arena, tensor, mixed),
        }
    }

    /// A point.
    pub(super) fn point(arena: &mut Arena, mass: Expr, at: Triple) -> Self {
        Self { mass, ..Self::NONE }.seen_at(arena, at)
    }
}
