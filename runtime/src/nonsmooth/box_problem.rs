//! The linear complementarity problem with bounds.
//!
//! With a symmetric, positive semidefinite matrix `W`, look for efforts `x` within bounds with
//! residuals `w = W x + a`: `w = 0` inside, `w >= 0` at the lower bound, `w <= 0` at the upper one.
//!
//! Principal pivoting by the least index (Murty, *Note on a Bard-type scheme for solving the
//! complementarity problem*, 1974; for bounds: Judice and Pires, *A block principal pivoting
//! algorithm for large-scale strictly monotone linear complementarity problems*, 1994). It ends for
//! a positive definite matrix. A relative floor on the diagonal makes it one, and chooses small
//! efforts where rows depend on each other; refinement then takes it out again.

use crate::math::scalar::Real;

/// Where an unknown is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At its lower bound, which is also its place where both are the same.
    Lower,
    /// Between its bounds.
    Inside,
    /// At its upper bound.
    Upper,
}

/// A problem of `K` unknowns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxProblem<S, const K: usize> {
    pub(crate) matrix: [[S; K]; K],
    /// `a`.
    pub(crate) offset: [S; K],
    pub(crate) lower: [S; K],
    pub(crate) upper: [S; K],
}

/// Its solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxSolution<S, const K: usize> {
    pub(crate) efforts: [S; K],
    pub(crate) residuals: [S; K],
    pub(crate) places: [Place; K],
}

/// Rounds of refinement, which take out what the floor has put in.
const ROUNDS: usize = 3;

/// Round-off of residuals and efforts, in `EPSILON`.
const NOISE: f64 = 64.0;

/// Pivots for each unknown, at the most.
const PIVOTS: usize = 64;

impl<S: Real, const K: usize> BoxProblem<S, K> {
    /// A problem in which every effort is zero.
    pub(crate) fn at_rest(matrix: [[S; K]; K], offset: [S; K]) -> Self {
        Self {
            matrix,
            offset,
            lower: [S::zero(); K],
            upper: [S::zero(); K],
        }
    }

    /// `W x + a`.
    pub(super) fn residuals(&self, efforts: &[S; K]) -> [S; K] {
        let mut residuals = self.offset;
        for (residual, row) in residuals.iter_mut().zip(&self.matrix) {
            let terms = row.iter().zip(efforts);
            *residual = terms.fold(*residual, |sum, (&w, &x)| w.fused(x, sum));
        }
        residuals
    }

    /// The solution; `None` where pivoting does not end, or a number is not finite.
    pub(crate) fn solved(&self) -> Option<BoxSolution<S, K>> {
        let root = S::EPSILON.sqrt();
        // The lower floor tells bounds apart by more digits, the higher one always ends.
        let floors = [root * root.sqrt(), root];
        floors.into_iter().find_map(|floor| self.solved_with(floor))
    }

    fn solved_with(&self, floor: S) -> Option<BoxSolution<S, K>> {
        // Inside at first: what depends on each other then shares the effort.
        let mut places = [Place::Lower; K];
        for (place, (&lower, &upper)) in places.iter_mut().zip(self.lower.iter().zip(&self.upper)) {
            if lower < upper {
                *place = Place::Inside;
            }
        }
        let floored = self.floored(floor);
        for _ in 0..PIVOTS * (K + 1) {
            let efforts = floored.with_places(&places)?;
            let residuals = floored.residuals(&efforts);
            let Some((index, next)) = floored.pivot(&places, &efforts, &residuals) else {
                let efforts = self.refined(efforts, &places)?;
                return Some(BoxSolution {
                    efforts,
                    residuals: self.residuals(&efforts),
                    places,
                });
            };
            places[index] = next;
        }
        None
    }

    /// The same with a floor on the diagonal, so that pivoting ends.
    fn floored(&self, floor: S) -> Self {
        let mut floored = *self;
        for index in 0..K {
            let diagonal = &mut floored.matrix[index][index];
            *diagonal = *diagonal * (S::one() + floor);
        }
        floored
    }

    /// The first unknown that is not where it should be, and where it goes.
    fn pivot(
        &self,
        places: &[Place; K],
        efforts: &[S; K],
        residuals: &[S; K],
    ) -> Option<(usize, Place)> {
        // What round-off leaves is no reason for a pivot.
        let noise = S::constant(NOISE) * S::EPSILON;
        let sizes = self.sizes(efforts);
        for index in 0..K {
            let (effort, residual) = (efforts[index], residuals[index]);
            let (lower, upper) = (self.lower[index], self.upper[index]);
            let next = match places[index] {
                Place::Inside if effort < lower - noise * lower.abs() => Place::Lower,
                Place::Inside if effort > upper + noise * upper.abs() => Place::Upper,
                Place::Lower if lower < upper && residual < -noise * sizes[index] => Place::Inside,
                Place::Upper if residual > noise * sizes[index] => Place::Inside,
                same => same,
            };
            if next != places[index] {
                return Some((index, next));
            }
        }
        None
    }

    /// Of what size the terms of the residuals are.
    pub(super) fn sizes(&self, efforts: &[S; K]) -> [S; K] {
        let mut sizes = self.offset.map(|offset| offset.abs());
        for (size, row) in sizes.iter_mut().zip(&self.matrix) {
            let terms = row.iter().zip(efforts);
            *size = terms.fold(*size, |sum, (&w, &x)| w.abs().fused(x.abs(), sum));
        }
        sizes
    }

    /// The efforts with these places.
    pub(super) fn with_places(&self, places: &[Place; K]) -> Option<[S; K]> {
        let mut efforts = [S::zero(); K];
        for index in 0..K {
            efforts[index] = match places[index] {
                Place::Lower => self.lower[index],
                Place::Upper => self.upper[index],
                Place::Inside => S::zero(),
            };
        }
        self.refined(efforts, places)
    }

    /// Efforts with what is inside solved for.
    fn refined(&self, mut efforts: [S; K], places: &[Place; K]) -> Option<[S; K]> {
        let inside = places.map(|place| place == Place::Inside);
        let factors = Factors::of(&self.matrix, &inside);
        for _ in 0..ROUNDS {
            let change = factors.solve(&self.residuals(&efforts));
            for (effort, change) in efforts.iter_mut().zip(change) {
                *effort = *effort - change;
            }
        }
        let is_finite = efforts.iter().all(|effort| effort.is_finite());
        is_finite.then_some(efforts)
    }
}

/// The factors of Cholesky of some rows of a symmetric, positive semidefinite matrix, in the scale
/// of its diagonal, with a floor on it.
pub(crate) struct Factors<S, const K: usize> {
    /// The lower triangle, with the reciprocals on the diagonal.
    lower: [[S; K]; K],
    /// The roots of the diagonal, reciprocal; zero for a row that is left out.
    scales: [S; K],
}

impl<S: Real, const K: usize> Factors<S, K> {
    /// The factors of the rows that are chosen.
    pub(crate) fn of(matrix: &[[S; K]; K], chosen: &[bool; K]) -> Self {
        let mut scales = [S::zero(); K];
        for index in 0..K {
            let diagonal = matrix[index][index];
            if chosen[index] && diagonal > S::zero() {
                scales[index] = diagonal.sqrt().reciprocal();
            }
        }
        // `EPSILON^(3/4)`: refinement gains a dozen digits a round where rows are independent.
        let floor = S::EPSILON.sqrt() * S::EPSILON.sqrt().sqrt();
        let mut lower = [[S::zero(); K]; K];
        for i in 0..K {
            for j in 0..=i {
                let mut element = matrix[i][j] * scales[i] * scales[j];
                let rows = lower[i].iter().zip(&lower[j]).take(j);
                for (&a, &b) in rows {
                    element = element - a * b;
                }
                lower[i][j] = if i != j {
                    element * lower[j][j]
                } else if scales[i] > S::zero() {
                    (element + floor).max(floor).sqrt().reciprocal()
                } else {
                    S::zero()
                };
            }
        }
        Self { lower, scales }
    }

    /// `W^-1 b` of the chosen rows; zero elsewhere.
    pub(crate) fn solve(&self, right: &[S; K]) -> [S; K] {
        let mut x = *right;
        for i in 0..K {
            x[i] = x[i] * self.scales[i];
            for k in 0..i {
                x[i] = x[i] - self.lower[i][k] * x[k];
            }
            x[i] = x[i] * self.lower[i][i];
        }
        for i in (0..K).rev() {
            for k in i + 1..K {
                x[i] = x[i] - self.lower[k][i] * x[k];
            }
            x[i] = x[i] * self.lower[i][i];
        }
        for (x, &scale) in x.iter_mut().zip(&self.scales) {
            *x = *x * scale;
        }
        x
    }
}

#[cfg(test)]
mod tests;
