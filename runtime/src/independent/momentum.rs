//! Jacobians of the centre of mass and of the momenta.

use nalgebra::SMatrix;

use super::IndependentCoordinates;
use super::determined::Needs;
use super::equations::finite_matrix;
use super::points::columns;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::math::vec3::{cross, dot, minus, plus, read, times};
use crate::measure::momentum::{masses, total_mass};
use crate::mechanism::bodies::Bodies;
use crate::mechanism::joint_rates::HasJacobian;
use crate::mechanism::relative::each_body;
use crate::state::vector::Array as _;

impl<M: HasJacobian, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The Jacobian of the centre of mass of some bodies, `..` for all: its velocity (m/s, global)
    /// for unit rates of the coordinates.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`];
    /// [`ReadingFault::NoMass`](crate::error::ReadingFault::NoMass) where their masses add up to
    /// zero.
    pub fn centre_of_mass_jacobian(
        &self,
        state: &M::JointState<S>,
        of: impl Bodies<M>,
    ) -> Result<SMatrix<S, 3, N>, Fault> {
        let total = total_mass::<S, M>(&self.constants, &of)?;
        let matrix = self.momentum_matrix(state, of)?;
        finite_matrix(SMatrix::from_fn(|row, column| {
            matrix[(row, column)].quotient(total)
        }))
    }

    /// The centroidal momentum matrix of some bodies, `..` for all (Orin and Goswami 2008). Rows 0
    /// to 2 are their linear momentum (kg m/s, global) for unit rates of the coordinates, rows 3 to
    /// 5 their angular momentum about their centre of mass (kg m^2/s, global).
    ///
    /// # Errors
    /// As [`IndependentCoordinates::centre_of_mass_jacobian`].
    pub fn momentum_matrix(
        &self,
        state: &M::JointState<S>,
        of: impl Bodies<M>,
    ) -> Result<SMatrix<S, 6, N>, Fault> {
        let total = total_mass::<S, M>(&self.constants, &of)?;
        let partition = self.known(state, Needs::Rates)?;
        let constants = &self.equations.constants;
        let motions = M::body_motions(constants, state);
        let axes = M::joint_axes(constants, self.equations.time, state);
        let inertias = M::mass::<S>(&self.constants);
        let mut centre = [S::zero(); 3];
        let mut shares = masses::<S, M>(&self.constants, &of).peekable();
        each_body::<S, M>(motions.as_slice(), |number, _, motion| {
            if let Some((_, mass)) = shares.next_if(|&(body, _)| body == number) {
                centre = plus(&centre, &times(motion.position, mass.quotient(total)));
            }
        });
        let mut matrix = SMatrix::<S, 6, N>::from_element(S::zero());
        let mut masses = masses::<S, M>(&self.constants, &of).peekable();
        each_body::<S, M>(motions.as_slice(), |number, info, motion| {
            let Some((_, mass)) = masses.next_if(|&(body, _)| body == number) else {
                return;
            };
            let arm = minus(motion.position, &centre);
            let moments: [S; 3] = read(inertias.as_slice(), info.velocity + 3);
            let moved = columns(&partition, axes.as_slice(), number, motion.position);
            for (column, [vx, vy, vz, wx, wy, wz]) in moved.into_iter().enumerate() {
                let linear = times(&[vx, vy, vz], mass);
                let mut angular = cross(&arm, &linear);
                if let Some((rows, _)) = motion.rotation {
                    angular = plus(&angular, &turned(rows, &moments, &[wx, wy, wz]));
                }
                for (row, part) in linear.into_iter().chain(angular).enumerate() {
                    matrix[(row, column)] = matrix[(row, column)] + part;
                }
            }
        });
        finite_matrix(matrix)
    }
}

/// `R J R^T w`, with the rows of `R`.
fn turned<S: Real>(rows: &[[S; 3]; 3], moments: &[S; 3], w: &[S; 3]) -> [S; 3] {
    let along = [0, 1, 2].map(|k| dot(&rows.map(|row| row[k]), w) * moments[k]);
    rows.map(|row| dot(&row, &along))
}
