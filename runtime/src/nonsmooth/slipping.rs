//! Efforts of friction that slides, where its capacity goes with the efforts.
//!
//! With the loads affine in the efforts, and what is held eliminated, friction that slides has
//! `x = c (|a1 + D1 x| + |a2 + D2 x| + ..)`. Here `c` is the coefficient against the rate, with the
//! forces at both ends of its bearing and along it. `G = |c| (|D1| + |D2| + ..)` bounds what a
//! change of efforts brings about. Where its spectral radius is below 1, the right side is a
//! contraction and `x` is unique. Of one effort the bound is sharp: from 1 on the convex function
//! `|c| (|a1 + D1 x| + ..) - |x|` has no zero on the side of `x`, or two, or touches it (Painleve's
//! paradox).
//!
//! `I - G` has positive pivots exactly where the radius is below 1 (Berman and Plemmons,
//! *Nonnegative Matrices in the Mathematical Sciences*, 1979, chapter 6). Then the Jacobians of all
//! Newton steps have pivots without an exchange of rows, too.

use crate::math::scalar::Real;
use crate::math::vec3::norm;
use crate::nonsmooth::bearing::Ends;
use crate::nonsmooth::box_problem::Factors;
use crate::nonsmooth::loads::{BearingLoads, add, size};

/// Rounds of refinement of what is held: they take out the floor of the factors.
const ROUNDS: usize = 3;

/// Steps of Newton's method, or of the contraction where one of these does not halve what is left.
const STEPS: usize = 200;

/// Round-off of efforts, in `EPSILON`.
const NOISE: f64 = 16.0;

/// A pivot of `I - G` below this is none: no digits of the effort would be left.
const PIVOT: f64 = 1e-9;

/// Why there are no efforts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The effort of this one does not exist, or is not known to be unique.
    NotUnique(usize),
    NotFinite,
}

/// What is held, and what slides by its load.
pub(super) struct Slipping<'a, S, const K: usize> {
    /// What efforts do to the accelerations of all quantities.
    pub(super) matrix: &'a [[S; K]; K],
    pub(super) loads: &'a BearingLoads<S, K>,
    pub(super) holds: [bool; K],
    /// The effort over the load of what slides by it: the coefficient, with the sign against the
    /// rate.
    pub(super) coefficients: [Option<S>; K],
}

/// `x = c (|a + D x|)`, with what is held eliminated.
struct Reduced<S, const K: usize> {
    coefficients: [S; K],
    start: [Ends<S>; K],
    slopes: [[Ends<S>; K]; K],
}

impl<S: Real, const K: usize> Slipping<'_, S, K> {
    /// All efforts, where accelerations without them and those that are given are known: zero of
    /// what slides by its load. What is held begins with what is given, and keeps its share where
    /// the efforts depend on each other.
    pub(super) fn efforts(&self, offset: &[S; K], given: &[S; K]) -> Result<[S; K], Refusal> {
        let factors = Factors::of(self.matrix, &self.holds);
        let base = held(&factors, self.matrix, offset, given);
        let nothing = [S::zero(); K];
        let mut reduced = Reduced {
            coefficients: self.coefficients.map(|given| given.unwrap_or(S::zero())),
            start: core::array::from_fn(|index| self.loads.at(index, &base)),
            slopes: [[super::loads::zeros(); K]; K],
        };
        let mut responses = [nothing; K];
        for (index, coefficient) in self.coefficients.iter().enumerate() {
            if coefficient.is_none() {
                continue;
            }
            let mut unit = nothing;
            unit[index] = S::one();
            responses[index] = held(&factors, self.matrix, &nothing, &unit);
            for (row, slopes) in reduced.slopes.iter_mut().enumerate() {
                slopes[index] = self.loads.along(row, &responses[index]);
            }
        }
        let slipping = reduced.solved()?;
        let mut efforts = base;
        for (response, &effort) in responses.iter().zip(&slipping) {
            for (sum, &part) in efforts.iter_mut().zip(response) {
                *sum = part.fused(effort, *sum);
            }
        }
        Ok(efforts)
    }
}

/// Efforts that are given, with those of what is held.
pub(super) fn held<S: Real, const K: usize>(
    factors: &Factors<S, K>,
    matrix: &[[S; K]; K],
    offset: &[S; K],
    given: &[S; K],
) -> [S; K] {
    let mut efforts = *given;
    for _ in 0..ROUNDS {
        let mut residuals = *offset;
        for (residual, row) in residuals.iter_mut().zip(matrix) {
            let terms = row.iter().zip(&efforts);
            *residual = terms.fold(*residual, |sum, (&w, &x)| w.fused(x, sum));
        }
        let change = factors.solve(&residuals);
        for (effort, change) in efforts.iter_mut().zip(change) {
            *effort = *effort - change;
        }
    }
    efforts
}

impl<S: Real, const K: usize> Reduced<S, K> {
    fn solved(&self) -> Result<[S; K], Refusal> {
        let mut excess = [[S::zero(); K]; K];
        for (i, row) in excess.iter_mut().enumerate() {
            for (j, element) in row.iter_mut().enumerate() {
                let growth = self.coefficients[i].abs() * size(&self.slopes[i][j]);
                *element = if i == j { S::one() - growth } else { -growth };
            }
        }
        let numbers = excess.iter().flatten().chain(&self.coefficients);
        let starts = self.start.iter().flatten().flatten();
        if !numbers.chain(starts).all(|number| number.is_finite()) {
            return Err(Refusal::NotFinite);
        }
        // In these weights the right side is a contraction.
        let weights = eliminated(excess, [S::one(); K]).map_err(Refusal::NotUnique)?;
        let mut efforts = [S::zero(); K];
        let mut steps = STEPS;
        let mut residuals = self.residuals(&efforts);
        loop {
            let Some(worst) = self.worst(&efforts, &residuals) else {
                return Ok(efforts);
            };
            if steps == 0 {
                return Err(Refusal::NotUnique(worst));
            }
            steps -= 1;
            let step = eliminated(self.jacobian(&efforts), residuals).unwrap_or(residuals);
            let mut next = less(&efforts, &step);
            let mut left = self.residuals(&next);
            let halves =
                weighted(&left, &weights) <= S::constant(0.5) * weighted(&residuals, &weights);
            if !halves {
                next = less(&efforts, &residuals);
                left = self.residuals(&next);
            }
            (efforts, residuals) = (next, left);
        }
    }

    /// The forces at the ends of a bearing.
    fn ends(&self, index: usize, efforts: &[S; K]) -> Ends<S> {
        let mut ends = self.start[index];
        for (slope, &effort) in self.slopes[index].iter().zip(efforts) {
            add(effort, slope, &mut ends);
        }
        ends
    }

    /// `x - c (|a + D x|)`.
    fn residuals(&self, efforts: &[S; K]) -> [S; K] {
        core::array::from_fn(|index| {
            let load = size(&self.ends(index, efforts));
            efforts[index] - self.coefficients[index] * load
        })
    }

    /// The first unknown whose residual is more than round-off.
    fn worst(&self, efforts: &[S; K], residuals: &[S; K]) -> Option<usize> {
        let noise = S::constant(NOISE) * S::EPSILON;
        (0..K).find(|&index| {
            let terms = self.slopes[index].iter().zip(efforts);
            let load = terms.fold(size(&self.start[index]), |sum, (slope, &effort)| {
                size(slope).fused(effort.abs(), sum)
            });
            let scale = efforts[index].abs() + self.coefficients[index].abs() * load;
            let is_round_off = residuals[index].abs() <= noise * scale;
            !is_round_off
        })
    }

    fn jacobian(&self, efforts: &[S; K]) -> [[S; K]; K] {
        let mut jacobian = [[S::zero(); K]; K];
        for (i, row) in jacobian.iter_mut().enumerate() {
            let ends = self.ends(i, efforts);
            let directions = ends.map(|end| {
                let length = norm(&end);
                let is_long = length > S::smallest();
                end.map(|component| {
                    if is_long {
                        component.quotient(length)
                    } else {
                        S::zero()
                    }
                })
            });
            for (j, element) in row.iter_mut().enumerate() {
                let slope = self.slopes[i][j].iter().flatten();
                let terms = directions.iter().flatten().zip(slope);
                let growth = terms.fold(S::zero(), |sum, (&u, &d)| u.fused(d, sum));
                let own = if i == j { S::one() } else { S::zero() };
                *element = own - self.coefficients[i] * growth;
            }
        }
        jacobian
    }
}

/// `a - b`.
fn less<S: Real, const K: usize>(a: &[S; K], b: &[S; K]) -> [S; K] {
    core::array::from_fn(|index| a[index] - b[index])
}

/// The largest element over its weight.
fn weighted<S: Real, const K: usize>(elements: &[S; K], weights: &[S; K]) -> S {
    let pairs = elements.iter().zip(weights);
    pairs.fold(S::zero(), |most, (element, &weight)| {
        most.max(element.abs().quotient(weight))
    })
}

/// The solution of linear equations by elimination without an exchange of rows; the row of a pivot
/// that is not positive.
fn eliminated<S: Real, const K: usize>(
    mut matrix: [[S; K]; K],
    mut right: [S; K],
) -> Result<[S; K], usize> {
    for k in 0..K {
        let row = matrix[k];
        let pivot = row[k];
        let is_positive = pivot > S::constant(PIVOT);
        if !is_positive {
            return Err(k);
        }
        for i in k + 1..K {
            let factor = matrix[i][k].quotient(pivot);
            for (element, &above) in matrix[i].iter_mut().zip(&row).skip(k) {
                *element = *element - factor * above;
            }
            right[i] = right[i] - factor * right[k];
        }
    }
    for k in (0..K).rev() {
        let rest = right[k];
        let terms = matrix[k].iter().zip(&right).skip(k + 1);
        let rest = terms.fold(rest, |rest, (&m, &x)| (-m).fused(x, rest));
        right[k] = rest.quotient(matrix[k][k]);
    }
    Ok(right)
}

#[cfg(test)]
mod tests;
