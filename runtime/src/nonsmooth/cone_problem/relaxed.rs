//! A solution to few digits, by relaxation: where the search for directions of slip may start.

use crate::math::scalar::Real;
use crate::nonsmooth::cone_problem::choices::{Role, Rough};
use crate::nonsmooth::cone_problem::{ConeProblem, length};
use crate::nonsmooth::tied::{at, residuals};

/// Sweeps at the most.
const SWEEPS: usize = 200;

/// A sweep that changes no effort by more than this part of the largest one is the last.
const SETTLED: f64 = 1e-9;

/// How far an effort goes towards what makes its residual zero: friction is no potential, so whole
/// ways may go in circles.
const WAY: f64 = 0.5;

impl<S: Real, const K: usize> ConeProblem<S, K> {
    /// The residuals where every effort in turn goes towards what makes its own zero, within what
    /// it may be (Jean, *The non-smooth contact dynamics method*, 1999). It need not end at a
    /// solution.
    pub(super) fn relaxed(&self) -> [S; K] {
        let mut efforts = [S::zero(); K];
        for _ in 0..SWEEPS {
            let before = efforts;
            for index in 0..K {
                self.relax(index, &mut efforts);
            }
            let mut largest = S::zero();
            let mut change = S::zero();
            for (&now, &before) in efforts.iter().zip(&before) {
                largest = largest.max(now.abs());
                change = change.max((now - before).abs());
            }
            if change <= S::constant(SETTLED) * largest {
                break;
            }
        }
        residuals(&self.matrix, &self.offset, &efforts)
    }

    fn relax(&self, index: usize, efforts: &mut [S; K]) {
        match self.roles[index] {
            Role::Given(effort) => efforts[index] = effort,
            Role::Within { bounds, .. } => {
                efforts[index] = self.nearer(index, efforts).max(bounds[0]).min(bounds[1]);
            }
            Role::Pushes { sign, least, rough } => {
                efforts[index] = sign * (sign * self.nearer(index, efforts)).max(least);
                if let Some(rough) = rough {
                    self.rub(&rough, index, efforts);
                }
            }
            Role::Tangent => {}
        }
    }

    /// The friction of a contact within its cone.
    fn rub(&self, rough: &Rough<S>, contact: usize, efforts: &mut [S; K]) {
        let bears = rough.coefficient * efforts[contact].abs();
        let components = match rough.slip {
            Some(slip) => slip.map(|component| -(bears * component)),
            None => {
                let nearer = |index: Option<usize>| {
                    index.map_or(S::zero(), |index| self.nearer(index, efforts))
                };
                let friction = rough.tangents.map(nearer);
                let size = length(friction);
                if size > bears {
                    friction.map(|component| bears * component.quotient(size))
                } else {
                    friction
                }
            }
        };
        for (tangent, component) in rough.tangents.into_iter().zip(components) {
            if let Some(effort) = tangent.and_then(|tangent| efforts.get_mut(tangent)) {
                *effort = component;
            }
        }
    }

    /// An effort nearer to what makes its residual zero.
    fn nearer(&self, index: usize, efforts: &[S; K]) -> S {
        let (Some(row), effort) = (self.matrix.get(index), at(efforts, index)) else {
            return S::zero();
        };
        let diagonal = at(row, index);
        if diagonal <= S::zero() {
            return effort;
        }
        let terms = row.iter().zip(efforts);
        let rate = terms.fold(at(&self.offset, index), |sum, (&w, &x)| w.fused(x, sum));
        effort - S::constant(WAY) * rate.quotient(diagonal)
    }
}
