//! Newton's method on accelerations, for all that seeks equilibria.

use core::array::from_fn;

use nalgebra::{SMatrix, SVector};

use super::elimination::Elimination;
use super::equations::Factors;
use super::partition::write_rates;
use super::{Equations, IndependentCoordinates};
use crate::error::step::counted;
use crate::error::{AnalysisFault, Fault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};
use crate::mechanism::relative::rates_of_motion;
use crate::state::vector::Vector as _;

/// A state, and the accelerations there.
pub(super) type Reached<M, const N: usize, S> =
    (<M as JointCoordinates>::JointState<S>, SVector<S, N>);

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    pub(super) fn accelerations(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault> {
        self.forward(state, [S::zero(); N])
    }

    /// The state at the end of a way, and the accelerations there.
    pub(super) fn reached(
        &self,
        state: &M::JointState<S>,
        way: &[S; N],
        rates: &SVector<S, N>,
    ) -> Option<Reached<M, N, S>> {
        let next = self.displaced(state, way, rates).ok()?;
        let there = self.accelerations(&next).ok()?;
        Some((next, there))
    }

    /// What coordinates compare by: a radian, or a length of the mechanism.
    pub(super) fn scales(&self) -> [S; N] {
        self.equations
            .places
            .map(|place| self.equations.scale(place))
    }

    /// What round-off leaves of accelerations: that of efforts which balance each other.
    pub(super) fn floor(
        &self,
        state: &M::JointState<S>,
        slopes: &SMatrix<S, N, N>,
        by_efforts: &SMatrix<S, N, N>,
        scales: &[S; N],
    ) -> Result<[S; N], Fault> {
        let mass = self.mass(state)?;
        let mut efforts = [S::zero(); N];
        for (row, effort) in efforts.iter_mut().enumerate() {
            for (column, &scale) in scales.iter().enumerate() {
                let stiffness = (0..N).fold(S::zero(), |sum, k| {
                    mass[(row, k)].fused(slopes[(k, column)], sum)
                });
                *effort = *effort + stiffness.abs() * scale;
            }
        }
        let mut floor = [S::zero(); N];
        for (row, floor) in floor.iter_mut().enumerate() {
            let parts = efforts.iter().enumerate();
            let sum = parts.fold(S::zero(), |sum, (column, &effort)| {
                by_efforts[(row, column)].abs().fused(effort, sum)
            });
            *floor = sum * S::EPSILON * S::constant(100.0);
        }
        Ok(floor)
    }

    /// What round-off leaves of efforts: that of their own, and of those that inertia couples them
    /// with. About a vertical axis, say, weights leave nothing else.
    pub(super) fn noise(
        &self,
        state: &M::JointState<S>,
        stiffness: &SMatrix<S, N, N>,
        scales: &[S; N],
    ) -> Result<[S; N], Fault> {
        let mass = self.mass(state)?;
        let own = row_sizes(stiffness, scales);
        let one = |row: usize, column: usize| S::constant(f64::from(u8::from(row == column)));
        let mut inverse: [[S; N]; N] = from_fn(|row| from_fn(|column| one(row, column)));
        Factors::of(mass.data.0).solve_each(&mut inverse);
        let sum = |row: &[S; N], by: &[S; N]| {
            let parts = row.iter().zip(by);
            parts.fold(S::zero(), |sum, (entry, &by)| entry.abs().fused(by, sum))
        };
        let moved = inverse.map(|row| sum(&row, &own));
        let mut noise = [S::zero(); N];
        for (noise, row) in noise.iter_mut().zip(&mass.data.0) {
            *noise = sum(row, &moved) * S::EPSILON * S::constant(100.0);
        }
        Ok(noise)
    }

    /// A state in which coordinates that move have no part in the accelerations.
    pub(super) fn steady(
        &self,
        state: &M::JointState<S>,
        slopes: &SMatrix<S, N, N>,
        rates: &SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let rows = row_sizes(slopes, &self.scales());
        for (number, (&rate, scale)) in rates.iter().zip(self.scales()).enumerate() {
            let column = (0..N).map(|row| (slopes[(row, number)] * scale).abs());
            let depends = column
                .zip(rows)
                .any(|(entry, size)| entry > size * S::EPSILON.sqrt());
            if rate != S::zero() && depends {
                return Err(Fault::Analysis(AnalysisFault::NotSteady {
                    joint: self.joint(number),
                }));
            }
        }
        Ok(*state)
    }

    /// The state a way along the constraints from another one, with these rates. The chosen
    /// coordinates go the way exactly; the others close the loops.
    pub(super) fn displaced(
        &self,
        state: &M::JointState<S>,
        way: &[S; N],
        rates: &SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let Equations {
            constants, time, ..
        } = &self.equations;
        let partition = self.equations.partition(state)?;
        let mut slope = *state;
        write_rates::<M, N, S>(&partition, way, false, &mut slope);
        let slope = rates_of_motion::<S, M>(constants, *time, &slope);
        let mut there = self.closed(state.plus([(S::one(), &slope)]))?;
        if M::JOINT_REPORT.rewraps {
            let mut bodies = self.bodies(&there);
            M::rewrap(&self.constants, &mut bodies);
            there = self.of_bodies(&bodies);
        }
        self.with_rates(&there, *rates)
    }
}

/// The largest acceleration that is left.
pub(super) fn not_converged<S: Real, const N: usize>(
    iterations: usize,
    left: &SVector<S, N>,
) -> Fault {
    let most = left
        .iter()
        .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
    Fault::Step(StepFault::NotConverged {
        iterations: counted(iterations),
        residual: most.to_f64(),
        joint: None,
        alpha: None,
    })
}

/// The longest of some ways, in radians or lengths of the mechanism.
pub(super) fn longest<S: Real, const N: usize>(way: &[S; N], scales: &[S; N]) -> S {
    let ways = way.iter().zip(scales);
    ways.fold(S::zero(), |most: S, (way, &scale)| {
        most.max(way.abs().quotient(scale))
    })
}

/// How much each acceleration changes over a radian, or over a length of the mechanism.
pub(super) fn row_sizes<S: Real, const N: usize>(
    slopes: &SMatrix<S, N, N>,
    scales: &[S; N],
) -> [S; N] {
    let mut sizes = [S::zero(); N];
    for (size, row) in sizes.iter_mut().zip(slopes.row_iter()) {
        let entries = row.iter().zip(scales);
        *size = entries.fold(S::zero(), |sum, (entry, &scale)| sum + entry.abs() * scale);
    }
    sizes
}

/// The sum of the squares of accelerations, each by how much it can change; of those that do not
/// change, as they are.
pub(super) fn square<S: Real, const N: usize>(left: &SVector<S, N>, sizes: &[S; N]) -> S {
    let entries = left.iter().zip(sizes);
    entries.fold(S::zero(), |sum, (&left, &size)| {
        let size = if size > S::zero() { size } else { S::one() };
        let part = left.quotient(size);
        part.fused(part, sum)
    })
}

/// Unknowns of linear equations, and what of the right-hand sides none of them explains.
pub(super) struct Solved<const N: usize, const R: usize, S> {
    pub(super) ways: [[S; N]; R],
    pub(super) unexplained: [[S; N]; R],
    /// Whether an unknown has a pivot. One without stays zero.
    pub(super) has_pivot: [bool; N],
}

/// Solves `J s = r` for right-hand sides, with units of the unknowns and sizes of the rows.
pub(super) fn solved<S: Real, const N: usize, const R: usize>(
    matrix: &SMatrix<S, N, N>,
    mut rights: [[S; N]; R],
    units: &[S; N],
    sizes: &[S; N],
) -> Solved<N, R, S> {
    let mut rows = [[S::zero(); N]; N];
    for (place, row) in rows.iter_mut().zip(matrix.row_iter()) {
        place
            .iter_mut()
            .zip(row.iter())
            .for_each(|(place, &entry)| *place = entry);
    }
    let mut row_of = [S::zero(); N];
    let mut elimination = Elimination {
        entries: rows.as_flattened_mut(),
        width: N,
        sizes,
        row_of: &mut row_of,
        least: S::EPSILON.to_f64() * 16.0 * N as f64,
    };
    let unit = |column: usize| units.get(column).copied().unwrap_or(S::one());
    let columns = rights.each_mut().map(<[S; N]>::as_mut_slice);
    elimination.run(columns, unit, |_| true);
    let mut ways = [[S::zero(); N]; R];
    for (way, right) in ways.iter_mut().zip(&mut rights) {
        for (column, way) in way.iter_mut().enumerate() {
            *way = elimination.solution(column, right);
        }
        for (row, right) in right.iter_mut().enumerate() {
            if elimination.is_taken(row) {
                *right = S::zero();
            }
        }
    }
    Solved {
        ways,
        unexplained: rights,
        has_pivot: core::array::from_fn(|column| elimination.row(column).is_some()),
    }
}

/// Newton's step `J s = -a`, and what of `a` no step explains. Coordinates on which nothing depends
/// stay.
pub(super) fn newton<S: Real, const N: usize>(
    slopes: &SMatrix<S, N, N>,
    left: &SVector<S, N>,
    scales: &[S; N],
) -> ([S; N], [S; N]) {
    let right: [S; N] = (-left).into();
    let Solved {
        ways: [way],
        unexplained: [unexplained],
        ..
    } = solved(slopes, [right], scales, &row_sizes(slopes, scales));
    (way, unexplained)
}
