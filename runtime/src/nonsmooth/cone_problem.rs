//! The complementarity problem of contacts with Coulomb's cone, beside limits and dry friction.
//!
//! With a symmetric, positive semidefinite matrix `W`, look for efforts `x` with residuals
//! `w = W x + a`. At a contact, with the normal effort `N` and the friction `T` of its plane:
//! `N >= 0`, `w_n >= 0`, `N w_n = 0`, and `|T| <= mu N`, with `T = -mu N w_t / |w_t|` where `w_t`
//! is not zero (Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988).
//! Where the contact slips already, the direction of `T` is against that slip.
//!
//! Friction has no potential: there may be no solution, or several with different motions
//! (Painleve's paradox). So all choices of modes are tried, and what is found is told. Efforts that
//! depend on each other, as of a block on four corners, are shared: normal ones evenly, those of
//! friction in proportion to what each contact can bear.

mod admissible;
mod choices;
mod relaxed;
mod search;

use crate::math::scalar::Real;
pub(super) use crate::nonsmooth::cone_problem::choices::{Role, Rough};

/// Round-off of residuals and efforts, in `EPSILON`.
const UNCERTAIN: f64 = 256.0;

/// Where an unknown is in a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome<S> {
    /// Nothing is held, or what acts is known.
    Given,
    /// It holds: a limit that bears, friction that sticks.
    Holds,
    /// Friction that slides at a rate of this sign.
    Slides(S),
    /// Friction of a contact, with the direction of its slip.
    Slips([S; 2]),
}

/// A problem of `K` unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeProblem<S, const K: usize> {
    pub(super) matrix: [[S; K]; K],
    pub(super) offset: [S; K],
    pub(super) roles: [Role<S>; K],
}

/// Its solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeSolution<S, const K: usize> {
    pub(super) efforts: [S; K],
    pub(super) residuals: [S; K],
    pub(super) outcomes: [Outcome<S>; K],
    /// At how many contacts slip begins without an acceleration, as others hold them, less those
    /// that were found at the end of their sticking.
    idle: isize,
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoSolution {
    /// No choice of modes is a solution.
    None,
    /// Several are, with different motions.
    Several,
    /// There are too many choices.
    TooMany,
}

impl<S: Real, const K: usize> ConeProblem<S, K> {
    /// Of what size the terms of the residuals are, beside the largest one in the metric of the
    /// mass: offsets are differences of what is as large.
    fn sizes(&self, efforts: &[S; K]) -> [S; K] {
        let mut sizes = self.offset.map(|offset| offset.abs());
        for (size, row) in sizes.iter_mut().zip(&self.matrix) {
            let terms = row.iter().zip(efforts);
            *size = terms.fold(*size, |sum, (&w, &x)| w.abs().fused(x.abs(), sum));
        }
        let root = |index: usize| self.matrix[index][index].max(S::zero()).sqrt();
        let mut strength = S::zero();
        for (index, &size) in sizes.iter().enumerate() {
            if root(index) > S::zero() {
                strength = strength.max(size.quotient(root(index)));
            }
        }
        core::array::from_fn(|index| sizes[index].max(strength * root(index)))
    }
}

/// The length of a vector in a plane.
pub(super) fn length<S: Real>([x, y]: [S; 2]) -> S {
    // In the scale of the larger one, whose square may not be a number.
    let largest = x.abs().max(y.abs());
    if largest <= S::smallest() {
        return largest;
    }
    let (x, y) = (x.quotient(largest), y.quotient(largest));
    largest * x.fused(x, y * y).sqrt()
}

#[cfg(test)]
mod tests;
