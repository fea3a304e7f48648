//! The combinations of inertial parameters that efforts depend on.

use core::fmt;
use std::vec::Vec;

use nalgebra::{DMatrix, DVector, SVector};

use super::regressor::INERTIAL_PARAMETERS;

/// One of the ten inertial parameters of a body, written as `Izz of forearm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct InertialParameter {
    /// The field of the body.
    pub body: &'static str,
    /// Which one, as [`INERTIAL_PARAMETERS`] names it.
    pub quantity: &'static str,
}

impl fmt::Display for InertialParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One text, so that a width is one of the whole.
        f.pad(&std::format!("{} of {}", self.quantity, self.body))
    }
}

/// Base parameters: the combinations of the inertial parameters of `B` bodies that efforts depend
/// on, and thus all that measured efforts can tell. By
/// [`Identification::base_parameters`](super::Identification::base_parameters).
///
/// Each is one independent parameter plus multiples of dependent ones. Which parameters count as
/// independent is a choice: those with the largest columns of the regressor, found by QR with
/// column pivoting (Gautier, *J. Robotic Systems* 8, 1991).
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameters<const B: usize> {
    bodies: [&'static str; B],
    /// The places of the independent parameters among all, ten a body, in rising order.
    independent: Vec<usize>,
    /// Row by row the combinations: one on the independent parameter, multiples of dependent ones.
    combinations: DMatrix<f64>,
    pivots: [f64; 2],
}

impl<const B: usize> BaseParameters<B> {
    /// Of stacked rows, which are consumed. Parameters are multiples of their scales there.
    pub(super) fn of(
        bodies: [&'static str; B],
        rows: DMatrix<f64>,
        scales: &[f64],
        threshold: f64,
    ) -> Self {
        let (independent, combinations, pivots) = combined(rows, scales, threshold);
        Self {
            bodies,
            independent,
            combinations,
            pivots,
        }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.independent.len()
    }

    /// The independent parameters: one for each base parameter, in the order of the bodies.
    pub fn independent(&self) -> impl ExactSizeIterator<Item = InertialParameter> {
        self.independent.iter().map(|&place| self.parameter(place))
    }

    /// The parameters in a base parameter, by its number from 0, with their factors: 1 for the
    /// independent one, whose unit the sum has. Nothing for a number out of range.
    pub fn combination(&self, number: usize) -> impl Iterator<Item = (InertialParameter, f64)> {
        let places = (0..10 * B).filter_map(move |place| {
            let factor = *self.combinations.get((number, place))?;
            Some((place, factor)).filter(|&(_, factor)| factor.abs() > 0.0)
        });
        places.map(|(place, factor)| (self.parameter(place), factor))
    }

    /// The parameters that no effort depends on.
    pub fn without_effect(&self) -> impl Iterator<Item = InertialParameter> {
        let columns = (0..10 * B).zip(self.combinations.column_iter());
        let idle = columns.filter(|(_, column)| column.iter().all(|factor| factor.abs() <= 0.0));
        idle.map(|(place, _)| self.parameter(place))
    }

    /// The base parameters of inertial parameters.
    #[must_use]
    pub fn values(&self, parameters: &[SVector<f64, 10>; B]) -> DVector<f64> {
        &self.combinations * stacked(parameters)
    }

    /// Inertial parameters with these base parameters: the dependent ones as they are given, the
    /// independent ones so that efforts are right. Numbers that are missing count as zero.
    #[must_use]
    pub fn parameters(
        &self,
        values: &DVector<f64>,
        given: &[SVector<f64, 10>; B],
    ) -> [SVector<f64, 10>; B] {
        let mut all = stacked(given);
        let known = &self.combinations * &all;
        for (number, &place) in self.independent.iter().enumerate() {
            all[place] += values.get(number).copied().unwrap_or(0.0) - known[number];
        }
        core::array::from_fn(|body| SVector::from_fn(|place, _| all[10 * body + place]))
    }

    /// The smallest pivot that counted and the largest that did not, of the largest of all. The
    /// rank is certain where many powers of ten lie between them.
    #[must_use]
    pub const fn pivots(&self) -> [f64; 2] {
        self.pivots
    }

    /// The columns of the base parameters, of rows of all parameters.
    pub(super) fn columns(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        rows.select_columns(&self.independent)
    }

    fn parameter(&self, place: usize) -> InertialParameter {
        InertialParameter {
            body: self.bodies[place / 10],
            quantity: INERTIAL_PARAMETERS[place % 10],
        }
    }
}

fn stacked(parameters: &[SVector<f64, 10>]) -> DVector<f64> {
    DVector::from_iterator(10 * parameters.len(), parameters.iter().flatten().copied())
}

/// Independent columns, all columns as combinations of them, and pivots: by Gram and Schmidt's
/// method with the longest column first.
fn combined(
    mut rows: DMatrix<f64>,
    scales: &[f64],
    threshold: f64,
) -> (Vec<usize>, DMatrix<f64>, [f64; 2]) {
    /// By how much a later column has to be longer: not by round-off.
    const LONGER: f64 = 1.0 + 1e-9;
    let width = rows.ncols();
    let size = rows.amax();
    if size > 0.0 {
        rows /= size;
    }
    for (mut column, &scale) in rows.column_iter_mut().zip(scales) {
        column *= scale;
    }
    let mut taken: Vec<usize> = Vec::new();
    let mut upper = DMatrix::zeros(width, width);
    let mut pivots = [1.0, 0.0];
    let mut largest = 0.0;
    while taken.len() < width {
        let mut best = (0.0, 0);
        for place in (0..width).filter(|place| !taken.contains(place)) {
            let length = rows.column(place).norm();
            if length > best.0 * LONGER {
                best = (length, place);
            }
        }
        let (length, place) = best;
        if taken.is_empty() {
            largest = length;
        }
        if length <= threshold * largest {
            pivots[1] = if largest > 0.0 { length / largest } else { 0.0 };
            break;
        }
        pivots[0] = length / largest;
        let direction = rows.column(place) / length;
        let row = taken.len();
        upper[(row, place)] = length;
        taken.push(place);
        for other in (0..width).filter(|other| !taken.contains(other)) {
            let share = direction.dot(&rows.column(other));
            upper[(row, other)] = share;
            rows.column_mut(other).axpy(-share, &direction, 1.0);
        }
    }
    let rank = taken.len();
    let upper = upper.rows(0, rank);
    let mut combinations = upper.clone_owned();
    let square = upper.select_columns(&taken);
    // Regular: pivots are on its diagonal.
    let _ = square.solve_upper_triangular_mut(&mut combinations);
    let mut order: Vec<usize> = (0..rank).collect();
    order.sort_by_key(|&row| taken[row]);
    let independent: Vec<usize> = order.iter().map(|&row| taken[row]).collect();
    let combinations = DMatrix::from_fn(rank, width, |number, place| {
        let own = independent[number];
        if taken.contains(&place) {
            return if place == own { 1.0 } else { 0.0 };
        }
        let factor = combinations[(order[number], place)];
        if factor.abs() > threshold {
            factor * scales[own] / scales[place]
        } else {
            0.0
        }
    });
    (independent, combinations, pivots)
}
