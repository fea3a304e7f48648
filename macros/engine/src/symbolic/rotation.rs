//! Rotation matrices from Euler parameters, and what holds of their entries.

use super::arena::{Arena, Expr};
use super::vector::{Space, Triple, dot};

/// `(e0^2 - e.e) I + 2 e e^T + 2 e0 e~`, row by row: `|p|^2` times a rotation (Nikravesh 1988, eq.
/// 6.18). 26 operations.
pub fn homogeneous_rotation(arena: &mut Arena, p: [Expr; 4]) -> [Triple; 3] {
    let doubled = [1, 2, 3].map(|k| arena.add(p[k], p[k]));
    let [ww, xx, yy, zz] = p.map(|e| arena.square(e));
    let (sum_x, sum_yz) = (arena.add(ww, xx), arena.add(yy, zz));
    let (difference_x, difference_yz) = (arena.sub(ww, xx), arena.sub(yy, zz));
    let diagonal = [
        arena.sub(sum_x, sum_yz),
        arena.add(difference_x, difference_yz),
        arena.sub(difference_x, difference_yz),
    ];
    with_diagonal(arena, p, doubled, diagonal)
}

/// The rotation of `p / |p|`, row by row. The vector part is doubled and divided by `p.p` at once,
/// so that no square root stands in the way. 33 operations.
pub fn normalised_rotation(arena: &mut Arena, p: [Expr; 4]) -> [Triple; 3] {
    let squares = p.map(|e| arena.square(e));
    let (first, second) = (
        arena.add(squares[0], squares[1]),
        arena.add(squares[2], squares[3]),
    );
    let norm = arena.add(first, second);
    let reciprocal = arena.reciprocal(norm);
    let scale = arena.add(reciprocal, reciprocal);
    let doubled = [1, 2, 3].map(|k| arena.mul(scale, p[k]));
    let [xx, yy, zz] = [0, 1, 2].map(|k| arena.mul(doubled[k], p[k + 1]));
    let diagonal = [(yy, zz), (zz, xx), (xx, yy)].map(|(a, b)| {
        let sum = arena.add(a, b);
        arena.sub(Arena::ONE, sum)
    });
    with_diagonal(arena, p, doubled, diagonal)
}

fn with_diagonal(
    arena: &mut Arena,
    p: [Expr; 4],
    doubled: Triple,
    diagonal: Triple,
) -> [Triple; 3] {
    let [x2, y2, z2] = doubled;
    let (xy, xz, yz) = (
        arena.mul(x2, p[2]),
        arena.mul(x2, p[3]),
        arena.mul(y2, p[3]),
    );
    let (wx, wy, wz) = (
        arena.mul(x2, p[0]),
        arena.mul(y2, p[0]),
        arena.mul(z2, p[0]),
    );
    [
        [diagonal[0], arena.sub(xy, wz), arena.add(xz, wy)],
        [arena.add(xy, wz), diagonal[1], arena.sub(yz, wx)],
        [arena.sub(xz, wy), arena.add(yz, wx), diagonal[2]],
    ]
}

/// Declares that every entry of a rotation matrix is its own cofactor.
pub(super) fn own_cofactors(arena: &mut Arena, a: &[Triple; 3]) {
    for k in 0..3 {
        for l in 0..3 {
            let (k1, k2, l1, l2) = ((k + 1) % 3, (k + 2) % 3, (l + 1) % 3, (l + 2) % 3);
            let forth = arena.mul(a[k1][l1], a[k2][l2]);
            let back = arena.mul(a[k1][l2], a[k2][l1]);
            let cofactor = arena.sub(forth, back);
            arena.identify(cofactor, a[k][l]);
        }
    }
}

/// The columns of a rotation matrix `a` complete each other: declares that `a1 a1^T + a2 a2^T` is
/// `I - a3 a3^T`.
pub(super) fn complete(arena: &mut Arena, a: &[Triple; 3]) {
    for i in 0..3 {
        for j in 0..=i {
            let products = [0, 1, 2].map(|k| arena.mul(a[i][k], a[j][k]));
            let whole = if i == j { Arena::ONE } else { Arena::ZERO };
            for k in 0..3 {
                let sum = arena.add(products[(k + 1) % 3], products[(k + 2) % 3]);
                let rest = arena.sub(whole, products[k]);
                arena.identify(sum, rest);
            }
        }
    }
}

/// The entries of the rotation from a body to another one, `A^T B`, that are known.
fn known_between(arena: &mut Arena, a: &[Triple; 3], b: &[Triple; 3]) -> [[Option<Expr>; 3]; 3] {
    [0, 1, 2].map(|k| {
        [0, 1, 2].map(|l| {
            let (mark, nodes) = (arena.mark(), arena.len());
            let entry = dot(arena, column(a, k), column(b, l));
            let is_known = arena.len() == nodes;
            arena.rollback(mark);
            is_known.then_some(entry)
        })
    })
}

fn column(rows: &[Triple; 3], k: usize) -> Triple {
    [rows[0][k], rows[1][k], rows[2][k]]
}

/// The places of an entry and of those that its cofactor is made of.
fn cofactor_places(k: usize, l: usize) -> [(usize, usize); 4] {
    let (k1, k2, l1, l2) = ((k + 1) % 3, (k + 2) % 3, (l + 1) % 3, (l + 2) % 3);
    [(k1, l1), (k2, l2), (k1, l2), (k2, l1)]
}

/// Declares that the entries of the rotation between two bodies are their own cofactors, as far as
/// they are known, and that vectors may be turned by it.
pub fn relate(space: &mut Space, one: usize, other: usize) {
    let (Some(a), Some(b)) = (space.rotation(one).copied(), space.rotation(other).copied()) else {
        return;
    };
    let arena = &mut space.arena;
    let known = known_between(arena, &a, &b);
    for k in 0..3 {
        for l in 0..3 {
            let parts = cofactor_places(k, l).map(|(k, l)| known[k][l]);
            let ([Some(p), Some(q), Some(r), Some(s)], Some(entry)) = (parts, known[k][l]) else {
                continue;
            };
            let (forth, back) = (arena.mul(p, q), arena.mul(r, s));
            let cofactor = arena.sub(forth, back);
            arena.identify(cofactor, entry);
        }
    }
    space.know_relation(one, other);
}

/// Components in the axes of a body, in those of another one: by the rotation between them, whose
/// entries are known, cofactors of known ones, or scalar products.
pub(super) fn turn_between(
    arena: &mut Arena,
    components: Triple,
    from: &[Triple; 3],
    to: &[Triple; 3],
) -> Triple {
    let known = known_between(arena, to, from);
    [0, 1, 2].map(|k| {
        let mut entry = |l: usize| {
            if components[l] == Arena::ZERO {
                return Arena::ZERO;
            }
            if let Some(known) = known[k][l] {
                return known;
            }
            match cofactor_places(k, l).map(|(k, l)| known[k][l]) {
                [Some(p), Some(q), Some(r), Some(s)] => {
                    let (forth, back) = (arena.mul(p, q), arena.mul(r, s));
                    arena.sub(forth, back)
                }
                _ => dot(arena, column(to, k), column(from, l)),
            }
        };
        let row = [entry(0), entry(1), entry(2)];
        dot(arena, row, components)
    })
}
