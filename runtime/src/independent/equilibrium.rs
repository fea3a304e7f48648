//! States in which nothing accelerates: at rest, and in steady motion.

use nalgebra::{SMatrix, SVector};

use super::equations::solve;
use super::partition::Magnitude;
use super::states::write_rates;
use super::{Equations, IndependentCoordinates};
use crate::constraints::projection::Projection;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};
use crate::mechanism::relative::bodies_of;
use crate::state::vector::Vector as _;

/// Steps that may be tried.
const TRIALS: usize = 200;

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real + Magnitude,
{
    /// The equilibrium near a state: the positions in which the coordinates do not accelerate under
    /// the described forces, with the rates that they have in `guess`. These are zero for a
    /// mechanism at rest. A coordinate on whose position nothing depends, the angle of a shaft, may
    /// have one: then the motion is steady.
    ///
    /// By Levenberg's and Marquardt's method on exact derivatives, to round-off. Which equilibrium
    /// is found, where there are several, depends on the guess. Whether it is stable is told by
    /// [`Linearised::modes`](super::Linearised::modes) there.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A rod on a hinge, held by a spring.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Lever {
    ///     #[body(mass = 2.0, inertia = [0.2, 0.2, 0.2], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    ///     #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], stiffness = 30.0)]
    ///     spring: TorsionalSpringDamper,
    /// }
    ///
    /// let (lever, h) = (Lever::default(), Lever::HANDLES);
    /// let space = lever.coordinates([h.hinge])?;
    /// let rest = space.equilibrium(&space.state([0.0], [0.0])?)?;
    /// let angle = space.positions(&rest)?[0];
    /// // The moment of the spring holds the weight.
    /// assert!((30.0 * angle + 9.81 * angle.cos()).abs() < 1e-13);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// [`Fault::NotSteady`] for a rate of a coordinate on which something depends;
    /// [`Fault::NotConverged`] with the largest acceleration that is left (rad/s^2, m/s^2); what
    /// [`IndependentCoordinates::linearise`] refuses.
    pub fn equilibrium(&self, guess: &M::JointState<S>) -> Result<M::JointState<S>, Fault> {
        /// What is left, in lengths and angles of a linear mechanism.
        const CONVERGED: f64 = 1e3;
        let rates = self.rates(guess);
        let mut state = *guess;
        let mut left = self.accelerations(&state)?;
        let mut damping = S::constant(1e-3);
        let mut slopes = self.linearise(&state, [], |_| [])?.by_positions;
        for trial in 0..TRIALS {
            let size = slopes
                .iter()
                .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
            let most = left
                .iter()
                .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
            let way = step(&slopes, &left, damping);
            let longest = way
                .iter()
                .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
            let next = self.displaced(&state, &way, &rates);
            let next = next.and_then(|next| Ok((next, self.accelerations(&next)?)));
            let is_less = |there: &SVector<S, N>| square(there) < square(&left);
            match next {
                Ok((next, there)) if is_less(&there) => {
                    (state, left) = (next, there);
                    slopes = self.linearise(&state, [], |_| [])?.by_positions;
                    damping = damping * S::constant(0.1);
                }
                _ if most <= size * S::EPSILON * S::constant(CONVERGED) => {
                    return self.steady(&state, &slopes, &rates);
                }
                _ if longest <= S::EPSILON || !damping.is_finite() => {
                    return Err(Fault::NotConverged {
                        iterations: trial,
                        residual: most.to_f64(),
                        joint: None,
                        alpha: None,
                    });
                }
                _ => damping = damping * S::constant(10.0),
            }
        }
        let most = left
            .iter()
            .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
        Err(Fault::NotConverged {
            iterations: TRIALS,
            residual: most.to_f64(),
            joint: None,
            alpha: None,
        })
    }

    fn accelerations(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault> {
        self.forward(state, [S::zero(); N])
    }

    /// A state in which coordinates that move have no part in the accelerations.
    fn steady(
        &self,
        state: &M::JointState<S>,
        slopes: &SMatrix<S, N, N>,
        rates: &SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let size = slopes
            .iter()
            .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
        for (column, rate) in slopes.column_iter().zip(rates.iter()) {
            let depends = column
                .iter()
                .any(|entry| entry.abs() > size * S::EPSILON.sqrt());
            if *rate != S::zero() && depends {
                let moving = rates.iter().position(|other| other == rate).unwrap_or(0);
                return Err(Fault::NotSteady {
                    joint: self.joint(moving),
                });
            }
        }
        Ok(*state)
    }

    /// The state a way along the constraints from another one, with these rates.
    fn displaced(
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
        let slope = M::joint_coordinate_rates(constants, *time, &slope);
        let mut there = state.plus([(S::one(), &slope)]);
        if !M::JOINT_REPORT.closing.is_empty() {
            let mut bodies = bodies_of::<S, M>(constants, &there);
            Projection::default().correct::<M>(&self.constants, *time, &mut bodies)?;
            there = M::joint_state(constants, &bodies);
        }
        self.with_rates(&there, *rates)
    }
}

fn square<S: Real, const N: usize>(numbers: &SVector<S, N>) -> S {
    numbers.iter().fold(S::zero(), |sum, &x| x.fused(x, sum))
}

/// Levenberg's and Marquardt's step: `(J^T J + m diag(J^T J)) s = -J^T r`.
fn step<S: Real, const N: usize>(
    slopes: &SMatrix<S, N, N>,
    left: &SVector<S, N>,
    damping: S,
) -> [S; N] {
    let dot = |a: usize, b: usize| {
        let rows = slopes.row_iter();
        rows.fold(S::zero(), |sum, row| row[a].fused(row[b], sum))
    };
    let mut matrix: [[S; N]; N] =
        core::array::from_fn(|row| core::array::from_fn(|column| dot(row, column)));
    let diagonal = (0..N).map(|k| dot(k, k));
    let most = diagonal.fold(S::zero(), |most: S, entry| most.max(entry));
    // What nothing depends on stays where it is.
    let floor = most * S::EPSILON + S::smallest();
    for (k, row) in matrix.iter_mut().enumerate() {
        if let Some(entry) = row.get_mut(k) {
            *entry = *entry + damping * *entry + floor;
        }
    }
    let right = core::array::from_fn(|column| {
        let rows = slopes.row_iter().zip(left.iter());
        -rows.fold(S::zero(), |sum, (row, &left)| row[column].fused(left, sum))
    });
    solve(matrix, right)
}
