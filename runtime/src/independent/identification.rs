//! Inertial parameters from measured efforts.

use core::fmt;
use std::vec::Vec;

use nalgebra::{DMatrix, DVector, SVector};

use super::IndependentCoordinates;
use super::base_parameters::BaseParameters;
use super::equations::finite;
use crate::error::setting::positive;
use crate::error::{Fault, StartFault};
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::joint_rates::{HasInverse, HasJacobian, JointRates};

/// Motions and efforts that were measured, from which the inertial parameters of `B` bodies are
/// identified. By [`IndependentCoordinates::identification`].
pub struct Identification<M: JointRates, const N: usize, const B: usize> {
    space: IndependentCoordinates<M, N>,
    bodies: [BodyHandle<M>; B],
    described: [SVector<f64, 10>; B],
    threshold: f64,
    /// The regressor row by row, `N` rows an observation.
    rows: Vec<f64>,
    /// The efforts of the bodies, one for each row.
    efforts: Vec<f64>,
}

/// Base parameters with their values.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identified<const B: usize> {
    /// The combinations.
    pub base: BaseParameters<B>,
    /// Their values in the order of [`BaseParameters::independent`]: kg, kg m, kg m^2.
    pub values: DVector<f64>,
    /// The standard deviations of the values, likewise, as the residual has them.
    pub deviations: DVector<f64>,
    /// The root mean square of what is left of the efforts, in the given standard deviations of
    /// them: 1 where these are right and nothing but noise is left.
    pub residual: f64,
}

impl<M: HasJacobian, const N: usize> IndependentCoordinates<M, N> {
    /// An identification of the inertial parameters of these bodies, each named once, without
    /// observations. Other bodies, springs, dampers and motors are taken as they are described. See
    /// [`guide::identification`](crate::guide::identification).
    #[must_use]
    pub fn identification<const B: usize>(
        &self,
        bodies: [BodyHandle<M>; B],
    ) -> Identification<M, N, B> {
        Identification {
            space: *self,
            bodies,
            described: bodies.map(|body| self.inertial_parameters(body)),
            threshold: Identification::<M, N, B>::THRESHOLD,
            rows: Vec::new(),
            efforts: Vec::new(),
        }
    }
}

impl<M: HasJacobian, const N: usize, const B: usize> Identification<M, N, B> {
    /// The threshold of a new identification.
    pub const THRESHOLD: f64 = 1e-8;

    /// Sets below which part of the largest pivot a column of the regressor counts as dependent.
    /// Pivots are lengths of columns, over all observations. In them, lengths are measured by that
    /// of the mechanism, so that units do not matter.
    ///
    /// # Errors
    /// [`StartFault::Setting`] for a threshold that is not finite and positive.
    pub fn with_threshold(mut self, threshold: f64) -> Result<Self, StartFault> {
        self.threshold = positive("threshold", threshold)?;
        Ok(self)
    }

    /// Takes an observation: at a state, with these accelerations (rad/s^2, m/s^2), these efforts
    /// (N m, N) acted along the coordinates, beside the described forces.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::inverse`];
    /// [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite) for efforts that are
    /// not finite. The observation is then not taken.
    pub fn observe(
        &mut self,
        state: &M::JointState<f64>,
        accelerations: impl Into<SVector<f64, N>>,
        efforts: impl Into<SVector<f64, N>>,
    ) -> Result<(), Fault>
    where
        M: HasInverse,
    {
        let accelerations = accelerations.into();
        let blocks = self.space.regressors(state, accelerations, self.bodies)?;
        // What the bodies take is what was measured, less what everything else takes.
        let mut own = efforts.into() - self.space.inverse(state, accelerations)?;
        for (block, parameters) in blocks.iter().zip(&self.described) {
            own += block * parameters;
        }
        let own: [f64; N] = own.into();
        let own = finite(own)?;
        for row in 0..N {
            for block in &blocks {
                self.rows.extend(block.row(row).iter());
            }
        }
        self.efforts.extend(own.iter());
        Ok(())
    }

    /// The bodies.
    #[must_use]
    pub const fn bodies(&self) -> [BodyHandle<M>; B] {
        self.bodies
    }

    /// The parameters of the bodies as they are described, see
    /// [`IndependentCoordinates::inertial_parameters`].
    #[must_use]
    pub const fn described(&self) -> &[SVector<f64, 10>; B] {
        &self.described
    }

    /// The combinations of parameters on which efforts depend in the observed motions: at most all
    /// that any motion shows.
    #[must_use]
    pub fn base_parameters(&self) -> BaseParameters<B> {
        let length = self.space.equations.length;
        let mut rows = self.regressor();
        let turns = self
            .space
            .equations
            .places
            .map(|place| self.space.equations.scale(place));
        for (mut row, turn) in rows.row_iter_mut().zip(turns.into_iter().cycle()) {
            row *= turn;
        }
        let scales = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2].map(|power| length.powi(power));
        let scales: Vec<f64> = scales.into_iter().cycle().take(10 * B).collect();
        BaseParameters::of(
            self.bodies.map(BodyHandle::name),
            rows,
            &scales,
            self.threshold,
        )
    }

    /// The base parameters that fit the measured efforts best, by least squares, each effort
    /// weighed by its standard deviation (N m, N), one for each coordinate. Only their ratios
    /// matter.
    ///
    /// # Errors
    /// [`StartFault::Setting`]: a standard deviation that is not finite and positive; not more rows
    /// (`surplus of rows`) than base parameters.
    /// [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite) where numbers
    /// overflow.
    pub fn identify(&self, deviations: impl Into<SVector<f64, N>>) -> Result<Identified<B>, Fault> {
        let deviations = deviations.into();
        for &deviation in &deviations {
            positive("standard deviation", deviation)?;
        }
        let base = self.base_parameters();
        let surplus = self.efforts.len() as f64 - base.count() as f64;
        positive("surplus of rows", surplus)?;
        let mut columns = base.columns(&self.regressor());
        let mut efforts = DVector::from_column_slice(&self.efforts);
        let weights = deviations.iter().map(|deviation| deviation.recip()).cycle();
        let rows = columns.row_iter_mut().zip(&mut efforts).zip(weights);
        for ((mut row, effort), weight) in rows {
            row *= weight;
            *effort *= weight;
        }
        solved(base, columns, efforts)
    }

    fn regressor(&self) -> DMatrix<f64> {
        DMatrix::from_row_slice(self.efforts.len(), 10 * B, &self.rows)
    }
}

/// Least squares by QR, with more rows than columns.
fn solved<const B: usize>(
    base: BaseParameters<B>,
    mut columns: DMatrix<f64>,
    mut efforts: DVector<f64>,
) -> Result<Identified<B>, Fault> {
    let (height, rank) = columns.shape();
    // Of length 1, whatever the units.
    let lengths = DVector::from_iterator(rank, columns.column_iter().map(|column| column.norm()));
    for (mut column, length) in columns.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let factors = columns.qr();
    factors.q_tr_mul(&mut efforts);
    let upper = factors.unpack_r();
    let mut values = efforts.rows(0, rank).clone_owned();
    let mut inverse = DMatrix::identity(rank, rank);
    let is_regular = upper.solve_upper_triangular_mut(&mut values)
        && upper.solve_upper_triangular_mut(&mut inverse);
    let left = efforts.rows(rank, height - rank).norm();
    let residual = left / ((height - rank) as f64).sqrt();
    let rows = inverse.row_iter().map(|row| row.norm() * residual);
    let mut deviations = DVector::from_iterator(rank, rows);
    values.component_div_assign(&lengths);
    deviations.component_div_assign(&lengths);
    let numbers = [&values, &deviations].map(|numbers| numbers.sum());
    if is_regular && residual.is_finite() && numbers.iter().all(|sum| sum.is_finite()) {
        Ok(Identified {
            base,
            values,
            deviations,
            residual,
        })
    } else {
        Err(super::equations::not_finite())
    }
}

impl<M: JointRates, const N: usize, const B: usize> Clone for Identification<M, N, B> {
    fn clone(&self) -> Self {
        Self {
            space: self.space,
            bodies: self.bodies,
            described: self.described,
            threshold: self.threshold,
            rows: self.rows.clone(),
            efforts: self.efforts.clone(),
        }
    }
}

impl<M: JointRates, const N: usize, const B: usize> fmt::Debug for Identification<M, N, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Identification")
            .field("bodies", &self.bodies)
            .field("rows", &self.efforts.len())
            .finish_non_exhaustive()
    }
}
