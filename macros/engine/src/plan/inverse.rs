//! The inverses of pivots.

use super::collect::shortest_dot;
use super::symmetric::Symmetric;
use crate::symbolic::arena::{Arena, Expr};

/// The inverse of a pivot.
#[derive(Clone, Debug)]
pub(super) enum Inverse {
    /// Entry by entry.
    Matrix(Vec<Vec<Expr>>),
    /// Of accelerations that know nothing of each other.
    Diagonal(Vec<Expr>),
    /// Of `[A C; C 0]` with numbers 1 and -1 on the diagonal `C`: `C` and `A`.
    Carried {
        signs: Vec<Expr>,
        mass: Vec<Vec<Expr>>,
    },
    /// Of `[A C^T; C 0]`: `C`, its adjugate and its determinant, `C^-1`, and `A`.
    Forbidden {
        coupling: [[Expr; 2]; 2],
        adjugate: [[Expr; 2]; 2],
        determinant: Expr,
        inverse: [[Expr; 2]; 2],
        mass: [[Expr; 2]; 2],
    },
    /// Of `[a c; c 0]`: `1 / c` and `a`.
    Dependent { reciprocal: Expr, mass: Expr },
}

pub(super) fn dot(arena: &mut Arena, x: &[Expr], y: &[Expr]) -> Expr {
    let mut sum = Arena::ZERO;
    for (&x, &y) in x.iter().zip(y) {
        let product = arena.mul(x, y);
        sum = arena.add(sum, product);
    }
    sum
}

/// `a / b`, which is a number where one is the other with a sign.
fn ratio(arena: &mut Arena, a: Expr, b: Expr) -> Expr {
    if a == -b {
        let ratio = arena.div(-a, b);
        return -ratio;
    }
    arena.div(a, b)
}

impl Inverse {
    /// `P^-1 b` where no row determines the accelerations.
    pub(super) fn apply(&self, arena: &mut Arena, b: &[Expr]) -> Vec<Expr> {
        match self {
            Self::Matrix(rows) => rows.iter().map(|row| dot(arena, row, b)).collect(),
            Self::Diagonal(inverses) => {
                let products = inverses.iter().zip(b);
                products.map(|(&x, &y)| arena.mul(x, y)).collect()
            }
            Self::Carried { .. } | Self::Dependent { .. } | Self::Forbidden { .. } => {
                unreachable!("what rows determine is not asked for by the whole inverse")
            }
        }
    }

    /// `C^-T y`: the multipliers of the rows of a block from what the accelerations leave of its
    /// upper part.
    pub(super) fn multipliers(&self, arena: &mut Arena, y: &[Expr]) -> Vec<Expr> {
        match self {
            Self::Matrix(_) | Self::Diagonal(_) => Vec::new(),
            Self::Carried { signs, .. } => {
                let products = signs.iter().zip(y);
                products.map(|(&sign, &y)| arena.mul(sign, y)).collect()
            }
            Self::Dependent { reciprocal, .. } => vec![arena.mul(*reciprocal, y[0])],
            Self::Forbidden {
                inverse: [first, second],
                ..
            } => {
                let columns = [0, 1].map(|k| [first[k], second[k]]);
                columns.map(|column| dot(arena, &column, y)).into()
            }
        }
    }

    /// Where rows determine the accelerations, `b` being `(u, v)`: these, `x = C^-1 v`, and what
    /// they leave of the upper part, `u - A x`. For other blocks nothing.
    pub(super) fn determined(&self, arena: &mut Arena, b: &[Expr]) -> [Vec<Expr>; 2] {
        match self {
            Self::Matrix(_) | Self::Diagonal(_) => [Vec::new(), Vec::new()],
            Self::Carried { signs, mass } => {
                let (upper, lower) = b.split_at(signs.len());
                let x = signs.iter().zip(lower);
                let x: Vec<Expr> = x.map(|(&sign, &v)| arena.mul(sign, v)).collect();
                let left = upper.iter().zip(mass).map(|(&u, mass)| {
                    let inertia = dot(arena, mass, &x);
                    arena.sub(u, inertia)
                });
                let left = left.collect();
                [x, left]
            }
            Self::Dependent { reciprocal, mass } => {
                let x = arena.mul(*reciprocal, b[1]);
                let inertia = arena.mul(*mass, x);
                [vec![x], vec![arena.sub(b[0], inertia)]]
            }
            Self::Forbidden {
                adjugate,
                determinant,
                inverse,
                mass,
                ..
            } => {
                let (upper, lower) = b.split_at(2);
                let is_determinant = |v: &Expr| v.abs() == determinant.abs();
                let x: Vec<Expr> = if lower.iter().any(is_determinant) {
                    let scaled = [0, 1].map(|k| ratio(arena, lower[k], *determinant));
                    adjugate
                        .iter()
                        .map(|row| dot(arena, row, &scaled))
                        .collect()
                } else {
                    inverse.iter().map(|row| dot(arena, row, lower)).collect()
                };
                let left = [0, 1].map(|k| {
                    let inertia = dot(arena, &mass[k], &x);
                    arena.sub(upper[k], inertia)
                });
                [x, left.to_vec()]
            }
        }
    }
}

pub(super) fn invert(arena: &mut Arena, matrix: &Symmetric, unknowns: &[usize]) -> Vec<Vec<Expr>> {
    match *unknowns {
        [k] => vec![vec![arena.reciprocal(matrix.get(k, k))]],
        [k, l] => {
            let (a, b, c) = (matrix.get(k, k), matrix.get(k, l), matrix.get(l, l));
            let (ac, bb) = (arena.mul(a, c), arena.square(b));
            let determinant = arena.sub(ac, bb);
            let inverse = arena.reciprocal(determinant);
            let (a, b, c) = (
                arena.mul(a, inverse),
                arena.mul(b, inverse),
                arena.mul(c, inverse),
            );
            vec![vec![c, -b], vec![-b, a]]
        }
        _ => unreachable!("a pivot that is inverted entry by entry has one or two unknowns"),
    }
}

/// What accelerations that rows determine add to an entry, from the columns `(u, v)` of two
/// unknowns and what [`Inverse::determined`] makes of them: `x_i . u_j + (u_i - A x_i) . x_j`,
/// which is symmetric.
pub(super) fn by_determined(
    arena: &mut Arena,
    [one, other]: [(&[Expr], &[Vec<Expr>; 2]); 2],
) -> Expr {
    let of = |(column, [x, left]): (&'_ [Expr], &'_ [Vec<Expr>; 2])| {
        [column[..x.len()].to_vec(), x.clone(), left.clone()]
    };
    let (one, other) = (of(one), of(other));
    if one == other {
        let [u, x, left] = one;
        let sum: Vec<Expr> = u
            .iter()
            .zip(&left)
            .map(|(&u, &left)| arena.add(u, left))
            .collect();
        return shortest_dot(arena, &x, &sum);
    }
    let products = |a: &[Expr], b: &[Expr]| {
        let pairs = a.iter().zip(b);
        pairs
            .filter(|&(&a, &b)| a != Arena::ZERO && b != Arena::ZERO)
            .count()
    };
    let ways = [[&one, &other], [&other, &one]];
    let fewest = ways
        .into_iter()
        .min_by_key(|[[_, x, left], [u, y, _]]| products(x, u) + products(left, y));
    let [[_, x, left], [u, y, _]] = fewest.expect("there are two ways");
    let (first, second) = (shortest_dot(arena, x, u), shortest_dot(arena, left, y));
    arena.add(first, second)
}

/// The inverse of `[A C^T; C 0]`, and the determinant of `C`.
pub(super) fn invert_forbidden(
    arena: &mut Arena,
    matrix: &Symmetric,
    accelerations: [usize; 2],
    rows: [usize; 2],
) -> (Inverse, Expr) {
    let coupling = rows.map(|row| accelerations.map(|k| matrix.get(row, k)));
    let [[a, b], [c, d]] = coupling;
    let (ad, bc) = (arena.mul(a, d), arena.mul(b, c));
    let determinant = arena.sub(ad, bc);
    let reciprocal = arena.reciprocal(determinant);
    // Rows are accelerations, columns are rows of C.
    let adjugate = [[d, -b], [-c, a]];
    let inverse = adjugate.map(|row| row.map(|entry| arena.mul(entry, reciprocal)));
    let mass = accelerations.map(|k| accelerations.map(|l| matrix.get(k, l)));
    let inverse = Inverse::Forbidden {
        coupling,
        adjugate,
        determinant,
        inverse,
        mass,
    };
    (inverse, determinant)
}
