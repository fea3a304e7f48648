//! Mass matrix, efforts and accelerations.

use nalgebra::{ArrayStorage, SMatrix, SVector};

use super::determined::Needs;
use super::elimination::at;
use super::partition::{Partition, joint_rates};
use super::{Equations, IndependentCoordinates};
use crate::error::{Fault, NotFinite, StepFault};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_rates::{
    HasCoriolis, HasGravity, HasInverse, HasMassMatrix, JointRates,
};
use crate::mechanism::relative::bodies_of;
use crate::state::sums::zero_if_finite;
use crate::state::vector::Array;

impl<M: JointRates, const N: usize, S: Real> Equations<M, N, S> {
    /// How what is not chosen follows; `None` in a tree, where everything is chosen.
    pub(super) fn following(
        &self,
        state: &M::JointState<S>,
    ) -> Result<Option<Partition<M, N, S>>, Fault> {
        if M::JOINT_REPORT.closing.is_empty() {
            return Ok(None);
        }
        self.partition(state).map(Some)
    }

    /// The accelerations of all joints, `B z' + b`.
    #[inline]
    pub(super) fn accelerations(
        &self,
        following: Option<&Partition<M, N, S>>,
        chosen: &[S; N],
    ) -> M::JointVelocities<S> {
        let Some(partition) = following else {
            let mut all = M::JointVelocities::zeros();
            self.places.put(chosen, all.as_mut_slice());
            return all;
        };
        let mut all = partition.bias;
        for (column, &chosen) in partition.columns.iter().zip(chosen) {
            let places = all.as_mut_slice().iter_mut().zip(column.as_slice());
            places.for_each(|(place, &entry)| *place = entry.fused(chosen, *place));
        }
        all
    }

    /// The efforts along the chosen coordinates, `B^T f`.
    #[inline]
    fn efforts(
        &self,
        following: Option<&Partition<M, N, S>>,
        all: &M::JointVelocities<S>,
    ) -> [S; N] {
        let Some(partition) = following else {
            return self.places.take(all.as_slice());
        };
        partition.columns.map(|column| {
            let products = column.as_slice().iter().zip(all.as_slice());
            products.fold(S::zero(), |sum, (&entry, &effort)| entry.fused(effort, sum))
        })
    }

    /// `B^T M B`.
    pub(super) fn mass_with(
        &self,
        following: Option<&Partition<M, N, S>>,
        state: &M::JointState<S>,
    ) -> [[S; N]; N]
    where
        M: HasMassMatrix,
    {
        if following.is_some() || !self.places.are_all {
            return self.mass_of_chosen(following, state);
        }
        let mut rows = [[S::zero(); N]; N];
        M::mass_matrix_into(&self.constants, self.time, state, rows.as_flattened_mut());
        rows
    }

    /// The same where these are not all rates in their order. Not inlined: inlined, it shares a
    /// copy of the matrix with what needs none, 5 of 20 ns of a UR5.
    #[inline(never)]
    fn mass_of_chosen(
        &self,
        following: Option<&Partition<M, N, S>>,
        state: &M::JointState<S>,
    ) -> [[S; N]; N]
    where
        M: HasMassMatrix,
    {
        let all = M::mass_matrix(&self.constants, self.time, state);
        let all = all.as_slice();
        let width = M::JointVelocities::<S>::zeros().as_slice().len();
        let Some(partition) = following else {
            let mut rows = [[S::zero(); N]; N];
            for (row, &place) in rows.iter_mut().zip(self.places.iter()) {
                for (entry, &other) in row.iter_mut().zip(self.places.iter()) {
                    *entry = at(all, place * width + other);
                }
            }
            return rows;
        };
        partition.columns.map(|rates| {
            // The momenta of unit rates.
            let mut momenta = M::JointVelocities::<S>::zeros();
            let places = momenta.as_mut_slice().iter_mut();
            for (momentum, row) in places.zip(all.chunks_exact(width.max(1))) {
                let entries = row.iter().zip(rates.as_slice());
                *momentum = entries.fold(S::zero(), |sum, (&entry, &rate)| entry.fused(rate, sum));
            }
            self.efforts(following, &momenta)
        })
    }

    /// The efforts of these accelerations.
    ///
    /// Always inlined: else the compiler does so or not by what stands beside it, and a further
    /// copy of numbers just written takes those of a UR5 from 31 to 54 ns.
    #[inline(always)]
    pub(super) fn inverse_with(
        &self,
        following: Option<&Partition<M, N, S>>,
        state: &M::JointState<S>,
        accelerations: &[S; N],
    ) -> [S; N]
    where
        M: HasInverse,
    {
        let all = self.accelerations(following, accelerations);
        let efforts = M::inverse_dynamics(&self.constants, self.time, state, &all);
        self.efforts(following, &efforts)
    }

    /// The accelerations of these efforts, by their kernel where it is there, else by `L D L^T` of
    /// the mass matrix.
    #[inline]
    pub(super) fn forward_with(
        &self,
        following: Option<&Partition<M, N, S>>,
        state: &M::JointState<S>,
        efforts: &[S; N],
    ) -> [S; N]
    where
        M: HasInverse + HasMassMatrix,
    {
        if M::HAS_FORWARD && following.is_none() {
            let all = self.accelerations(None, efforts);
            let all = M::forward_dynamics(&self.constants, self.time, state, &all);
            return self.efforts(None, &all);
        }
        let mass = self.mass_with(following, state);
        let bias = self.inverse_with(following, state, &[S::zero(); N]);
        let mut right = *efforts;
        for (right, bias) in right.iter_mut().zip(bias) {
            *right = *right - bias;
        }
        solve(mass, right)
    }
}

/// Solves a symmetric positive definite system by `L D L^T`; not finite where it is not.
pub(super) fn solve<S: Scalar, const N: usize>(matrix: [[S; N]; N], right: [S; N]) -> [S; N] {
    Factors::of(matrix).solve(right)
}

/// `L D L^T` of a symmetric positive definite matrix.
pub(super) struct Factors<S, const N: usize> {
    /// `L` below the diagonal.
    rows: [[S; N]; N],
    /// Of `D`.
    inverses: [S; N],
}

impl<S: Scalar, const N: usize> Factors<S, N> {
    pub(super) fn of(mut matrix: [[S; N]; N]) -> Self {
        let mut inverses = [S::zero(); N];
        for k in 0..N {
            let (done, below) = matrix.split_at_mut(k + 1);
            let Some(pivot_row) = done.last() else { break };
            let inverse = pivot_row[k].reciprocal();
            inverses[k] = inverse;
            // The column under the pivot, before it becomes one of `L`.
            let mut column = [S::zero(); N];
            for (entry, row) in column.iter_mut().skip(k + 1).zip(below.iter()) {
                *entry = row[k];
            }
            for row in below {
                let factor = row[k] * inverse;
                let entries = row.iter_mut().zip(&column).skip(k + 1);
                entries.for_each(|(entry, &under)| *entry = *entry - factor * under);
                row[k] = factor;
            }
        }
        Self {
            rows: matrix,
            inverses,
        }
    }

    pub(super) fn solve(&self, right: [S; N]) -> [S; N] {
        let mut right = right.map(|number| [number]);
        self.solve_each(&mut right);
        right.map(|[number]| number)
    }

    /// The same of several right-hand sides, side by side in each row.
    pub(super) fn solve_each<const K: usize>(&self, sides: &mut [[S; K]; N]) {
        let subtract = |from: &mut [S; K], factor: S, known: &[S; K]| {
            for (number, &known) in from.iter_mut().zip(known) {
                *number = *number - factor * known;
            }
        };
        for k in 1..N {
            let (done, here) = sides.split_at_mut(k);
            let Some(here) = here.first_mut() else { break };
            for (&entry, known) in self.rows[k].iter().zip(done.iter()) {
                subtract(here, entry, known);
            }
        }
        for k in (0..N).rev() {
            let (here, above) = sides.split_at_mut(k + 1);
            let Some(here) = here.last_mut() else { break };
            for number in here.iter_mut() {
                *number = *number * self.inverses[k];
            }
            for (row, above) in self.rows.iter().skip(k + 1).zip(above.iter()) {
                subtract(here, row[k], above);
            }
        }
    }
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The mass matrix `M(q)`, symmetric and positive definite: kg m^2 between angles, kg between
    /// displacements, kg m between the two.
    ///
    /// # Errors
    /// - [`AnalysisFault::NotAssembled`](crate::error::AnalysisFault::NotAssembled): the state does
    ///   not satisfy the constraints.
    /// - [`AnalysisFault::NotDetermined`]: the chosen coordinates do not determine the others here,
    ///   or not to the digits that the state has.
    /// - [`AnalysisFault::NotIndependent`]: closed loops restrict the chosen coordinates.
    ///
    /// [`AnalysisFault::NotDetermined`]: crate::error::AnalysisFault::NotDetermined
    /// [`AnalysisFault::NotIndependent`]: crate::error::AnalysisFault::NotIndependent
    #[inline]
    pub fn mass(&self, state: &M::JointState<S>) -> Result<SMatrix<S, N, N>, Fault>
    where
        M: HasMassMatrix,
    {
        let following = self.determined(state, Needs::Rates)?;
        let (following, equations) = (following.as_ref(), &self.equations);
        // It is symmetric: its rows are its columns.
        if following.is_some() || !equations.places.are_all {
            let rows = equations.mass_of_chosen(following, state);
            return finite_matrix(SMatrix::from_data(ArrayStorage(rows)));
        }
        self.mass_of_all(state)
    }

    /// The mass matrix of all rates in their order.
    ///
    /// Not inlined: the kernel is part of it, and its entries go to where they are returned. With a
    /// copy, a UR5 takes 20 ns instead of 14.
    #[inline(never)]
    fn mass_of_all(&self, state: &M::JointState<S>) -> Result<SMatrix<S, N, N>, Fault>
    where
        M: HasMassMatrix,
    {
        let (constants, time) = (&self.equations.constants, self.equations.time);
        let mut rows = [[S::zero(); N]; N];
        if M::mass_matrix_into(constants, time, state, rows.as_flattened_mut()) == S::zero() {
            Ok(SMatrix::from_data(ArrayStorage(rows)))
        } else {
            Err(not_finite())
        }
    }

    /// Inverse dynamics: the efforts that have to act along the coordinates, beside the described
    /// forces, for these accelerations (rad/s^2, m/s^2). `M(q) a + h(q, v)`.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    #[inline]
    pub fn inverse(
        &self,
        state: &M::JointState<S>,
        accelerations: impl Into<SVector<S, N>>,
    ) -> Result<SVector<S, N>, Fault>
    where
        M: HasInverse,
    {
        let accelerations: [S; N] = accelerations.into().into();
        let following = self.determined(state, Needs::Accelerations)?;
        let following = following.as_ref();
        finite((self.equations).inverse_with(following, state, &accelerations))
    }

    /// `h(q, v)`: [`IndependentCoordinates::inverse`] without accelerations. What velocities and
    /// weights take, less the described forces.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn bias(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault>
    where
        M: HasInverse,
    {
        self.inverse(state, [S::zero(); N])
    }

    /// The efforts that hold the weights: the gradient of the potential of gravity.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn gravity(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault>
    where
        M: HasGravity,
    {
        let equations = &self.equations;
        let following = self.determined(state, Needs::Rates)?;
        let efforts = M::gravity_efforts(&equations.constants, equations.time, state);
        finite(equations.efforts(following.as_ref(), &efforts))
    }

    /// The efforts that velocities take without accelerations of the coordinates: centrifugal,
    /// Coriolis and gyroscopic terms, quadratic in the rates. `C(q, v) v`. Of drivers also what
    /// their laws accelerate.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn coriolis(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault>
    where
        M: HasCoriolis,
    {
        let equations = &self.equations;
        let following = self.determined(state, Needs::Accelerations)?;
        let all = equations.accelerations(following.as_ref(), &[S::zero(); N]);
        let efforts = M::coriolis_efforts(&equations.constants, equations.time, state, &all);
        finite(equations.efforts(following.as_ref(), &efforts))
    }

    /// Forward dynamics: the accelerations (rad/s^2, m/s^2) under these efforts along the
    /// coordinates and the described forces. `M(q)^-1 (f - h(q, v))`.
    ///
    /// In a tree with `kernels = [.., forward]` it is one kernel. Else the mass matrix is
    /// factorised.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    #[inline]
    pub fn forward(
        &self,
        state: &M::JointState<S>,
        efforts: impl Into<SVector<S, N>>,
    ) -> Result<SVector<S, N>, Fault>
    where
        M: HasInverse + HasMassMatrix,
    {
        let efforts: [S; N] = efforts.into().into();
        let following = self.determined(state, Needs::Accelerations)?;
        finite((self.equations).forward_with(following.as_ref(), state, &efforts))
    }

    /// The rates of the coordinates (rad/s, m/s) at a state.
    #[must_use]
    pub fn rates(&self, state: &M::JointState<S>) -> SVector<S, N> {
        SVector::from(self.rates_of(state))
    }

    /// The same of a state of other numbers, such as those that carry derivatives.
    pub(crate) fn rates_of<T: Scalar>(&self, state: &M::JointState<T>) -> [T; N] {
        self.chosen_of(&joint_rates::<M, T>(state))
    }

    /// Those of the chosen coordinates among numbers of all rates.
    pub(crate) fn chosen_of<T: Scalar>(&self, numbers: &M::JointVelocities<T>) -> [T; N] {
        self.equations.places.take(numbers.as_slice())
    }

    /// What the kernels take that does not change with a state.
    #[cfg(feature = "std")]
    pub(crate) const fn joint_constants(&self) -> &M::JointConstants<S> {
        &self.equations.constants
    }

    /// Kinetic energy (J).
    #[must_use]
    pub fn kinetic_energy(&self, state: &M::JointState<S>) -> S {
        let bodies = bodies_of::<S, M>(&self.equations.constants, state);
        M::kinetic_energy(&self.constants, &bodies)
    }

    /// Potential energy (J) of gravity and of described forces that have one.
    #[must_use]
    pub fn potential_energy(&self, state: &M::JointState<S>) -> S {
        let bodies = bodies_of::<S, M>(&self.equations.constants, state);
        M::potential_energy(&self.constants, self.equations.time, &bodies)
    }
}

/// Numbers that may go on.
#[inline]
pub(super) fn finite<S: Real, const N: usize>(numbers: [S; N]) -> Result<SVector<S, N>, Fault> {
    finite_matrix(SVector::from(numbers))
}

/// The same of a matrix.
#[inline]
pub(super) fn finite_matrix<S: Real, const R: usize, const C: usize>(
    matrix: SMatrix<S, R, C>,
) -> Result<SMatrix<S, R, C>, Fault> {
    if are_finite(matrix.as_slice()) {
        Ok(matrix)
    } else {
        Err(not_finite())
    }
}

/// Whether all are, without an early end, so that the compiler looks at several at once.
#[inline]
pub(super) fn are_finite<S: Real>(numbers: &[S]) -> bool {
    zero_if_finite(numbers) == S::zero()
}

/// The fault of numbers that may not.
pub(crate) const fn not_finite() -> Fault {
    Fault::Step(StepFault::RatesNotFinite {
        origin: NotFinite::Unknown,
    })
}
