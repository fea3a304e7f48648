//! What holds of vectors that turn without change of length, and saves operations where `p` is of
//! length 1.

use super::arena::{Arena, Expr};
use super::expression::{Constraint, ScalarExpr, VectorExpr};
use super::motion::Motion;
use super::vector::{Frame, Space, Triple, ZERO, dot};

/// Two vectors, fixed on two bodies.
pub(super) struct TwoVectors {
    bodies: [Option<usize>; 2],
    vectors: [Triple; 2],
}

impl TwoVectors {
    pub(super) fn of(a: &VectorExpr, b: &VectorExpr) -> Option<Self> {
        match (a, b) {
            (VectorExpr::Fixed(i, a), VectorExpr::Fixed(j, b)) if i != j => Some(Self {
                bodies: [*i, *j],
                vectors: [*a, *b],
            }),
            _ => None,
        }
    }

    /// `(a . b)''` without accelerations: with `w = w_i - w_j`,
    /// `(w . a) (w_i . b) - (w . b) (w_j . a) - (w . w) (a . b)`.
    pub(super) fn bias(&self, space: &mut Space, motion: &Motion) -> Expr {
        let spins = self.bodies.map(|body| match body {
            Some(body) => motion.spin[body],
            None => space.native(Frame::of(None), ZERO),
        });
        let [a, b] = [0, 1].map(|k| space.native(Frame::of(self.bodies[k]), self.vectors[k]));
        let relative = space.sum([(Arena::ONE, spins[0]), (-Arena::ONE, spins[1])]);
        let [ia, ib] = [a, b].map(|vector| space.dot(spins[0], vector));
        let [ja, jb] = [a, b].map(|vector| space.dot(spins[1], vector));
        let (square, share) = (space.dot(relative, relative), space.dot(a, b));
        let arena = &mut space.arena;
        let (along_a, along_b) = (arena.sub(ia, ja), arena.sub(ib, jb));
        let terms = [
            arena.mul(along_a, ib),
            -arena.mul(along_b, ja),
            -arena.mul(square, share),
        ];
        arena.sum(terms)
    }
}

/// The same constraint, every vector of a body multiplied by points of others alone:
/// `n . (p - q) = n . (p - r) - n . s`, where `n` and the point `q = r + A s` are fixed on one body
/// and the last term is a constant.
pub(super) fn from_centres(arena: &mut Arena, constraint: Constraint) -> Constraint {
    let Constraint::Scalar(ScalarExpr::Dot(a, b)) = constraint else {
        return constraint;
    };
    let (normal, line) = match (*a, *b) {
        (VectorExpr::Fixed(Some(body), n), VectorExpr::Sum(terms))
        | (VectorExpr::Sum(terms), VectorExpr::Fixed(Some(body), n)) => ((body, n), terms),
        (a, b) => return Constraint::Scalar(ScalarExpr::Dot(a.into(), b.into())),
    };
    let (body, n) = normal;
    let mut known = Arena::ZERO;
    let mut rest = Vec::new();
    for (factor, term) in line {
        match term {
            VectorExpr::Point(Some(own), s) if own == body => {
                let along = dot(arena, n, s);
                let along = arena.mul(factor, along);
                known = arena.add(known, along);
                rest.push((factor, VectorExpr::Point(Some(own), ZERO)));
            }
            term => rest.push((factor, term)),
        }
    }
    let variable = ScalarExpr::Dot(
        VectorExpr::Fixed(Some(body), n).into(),
        VectorExpr::Sum(rest).into(),
    );
    Constraint::Scalar(ScalarExpr::Sum(vec![
        (Arena::ONE, variable),
        (Arena::ONE, ScalarExpr::Constant(known)),
    ]))
}
