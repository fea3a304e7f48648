//! States in which nothing accelerates: at rest, and in steady motion.

use nalgebra::{SMatrix, SVector};

use super::states::write_rates;
use super::{Equations, IndependentCoordinates};
use crate::constraints::projection::Projection;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix};
use crate::mechanism::relative::bodies_of;
use crate::state::vector::Vector as _;

/// Steps that may be taken.
const STEPS: usize = 200;
/// Halvings of a step.
const HALVINGS: usize = 12;
/// Steps along the accelerations, where Newton's lead nowhere.
const FALLS: usize = 25;

/// A state, and the accelerations there.
type Reached<M, const N: usize, S> = (<M as JointCoordinates>::JointState<S>, SVector<S, N>);

impl<M, const N: usize, S> IndependentCoordinates<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// The equilibrium near a state: the positions in which the coordinates do not accelerate under
    /// the described forces, with the rates that they have in `guess`. These are zero for a
    /// mechanism at rest. A coordinate on whose position nothing depends, the angle of a shaft, may
    /// have one: then the motion is steady.
    ///
    /// By Newton's method on exact derivatives, in steps of at most a radian or a length of the
    /// mechanism. Where that does not lead on, it steps down along the accelerations. Which
    /// equilibrium is found, where there are several, depends on the guess: near one it is that,
    /// from afar rather one below. Whether it is stable is told by
    /// [`Linearised::modes`](super::Linearised::modes).
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
        let rates = self.rates(guess);
        let scales = self.scales();
        let tolerance = S::EPSILON.powf(0.75);
        let mut state = *guess;
        let mut falls = 0;
        let mut left = self.accelerations(&state)?;
        for taken in 0..STEPS {
            let linear = self.linearise(&state, [], |_| [])?;
            let slopes = linear.by_positions;
            let (way, unexplained) = newton(&slopes, &left, &scales);
            let widest = longest(&way, &scales);
            let floor = self.floor(&state, &slopes, &linear.by_efforts, &scales)?;
            let is_explained = unexplained
                .iter()
                .zip(floor)
                .all(|(off, floor)| off.abs() <= floor);
            if widest <= tolerance && is_explained {
                // As near as the numbers go.
                if let Ok(next) = self.displaced(&state, &way, &rates) {
                    state = next;
                }
                return self.steady(&state, &slopes, &rates);
            }
            let rows = row_sizes(&slopes, &scales);
            let before = square(&left, &rows);
            let mut share = S::one();
            if widest > S::one() {
                share = widest.reciprocal();
            }
            // From afar rather down than up.
            let may_fall = falls < FALLS;
            let is_up = widest > S::one() && self.power(&state, &left, &way)? < S::zero();
            let mut found = None;
            if !(is_up && may_fall) {
                found = self.halved(&state, (&way, share), &rates, |there, share| {
                    square(there, &rows) < before * (S::one() - share * S::constant(1e-4))
                });
            }
            if found.is_none() && may_fall {
                falls += 1;
                found = self.fallen(&state, &left, &rates);
            }
            let Some(next) = found else {
                // The cause, where something moves that should not.
                self.steady(&state, &slopes, &rates)?;
                return Err(not_converged(taken, &left));
            };
            (state, left) = next;
        }
        Err(not_converged(STEPS, &left))
    }

    fn accelerations(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault> {
        self.forward(state, [S::zero(); N])
    }

    /// A share of a way, halved until what is wanted of the accelerations holds there.
    fn halved(
        &self,
        state: &M::JointState<S>,
        (way, mut share): (&[S; N], S),
        rates: &SVector<S, N>,
        is_wanted: impl Fn(&SVector<S, N>, S) -> bool,
    ) -> Option<Reached<M, N, S>> {
        for _ in 0..HALVINGS {
            let step = way.map(|way| way * share);
            let next = self.reached(state, &step, rates);
            if let Some((_, there)) = &next
                && is_wanted(there, share)
            {
                return next;
            }
            share = share * S::constant(0.5);
        }
        None
    }

    /// A step along the accelerations.
    fn fallen(
        &self,
        state: &M::JointState<S>,
        left: &SVector<S, N>,
        rates: &SVector<S, N>,
    ) -> Option<Reached<M, N, S>> {
        /// Its length (rad, lengths of the mechanism).
        const FALL: f64 = 0.2;
        let scales = self.scales();
        let mut down: [S; N] = (*left).into();
        for (down, &scale) in down.iter_mut().zip(&scales) {
            *down = *down * scale;
        }
        let longest = longest(&down, &scales);
        if longest <= S::zero() {
            return None;
        }
        let step = down.map(|down| (down * S::constant(FALL)).quotient(longest));
        self.reached(state, &step, rates)
    }

    /// The state at the end of a way, and the accelerations there.
    fn reached(
        &self,
        state: &M::JointState<S>,
        way: &[S; N],
        rates: &SVector<S, N>,
    ) -> Option<Reached<M, N, S>> {
        let next = self.displaced(state, way, rates).ok()?;
        let there = self.accelerations(&next).ok()?;
        Some((next, there))
    }

    /// The work that the forces of these accelerations would do on a way.
    fn power(
        &self,
        state: &M::JointState<S>,
        left: &SVector<S, N>,
        way: &[S; N],
    ) -> Result<S, Fault> {
        let mass = self.mass(state)?;
        let entries = (0..N).flat_map(|row| (0..N).map(move |column| (row, column)));
        Ok(entries.fold(S::zero(), |sum, (row, column)| {
            (mass[(row, column)] * left[column]).fused(way[row], sum)
        }))
    }

    /// What coordinates compare by: a radian, or a length of the mechanism.
    fn scales(&self) -> [S; N] {
        self.equations
            .places
            .map(|place| self.equations.scale(place))
    }

    /// What round-off leaves of accelerations: that of efforts which balance each other.
    fn floor(
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

    /// A state in which coordinates that move have no part in the accelerations.
    fn steady(
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
                return Err(Fault::NotSteady {
                    joint: self.joint(number),
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

/// The largest acceleration that is left.
fn not_converged<S: Real, const N: usize>(iterations: usize, left: &SVector<S, N>) -> Fault {
    let most = left
        .iter()
        .fold(S::zero(), |most: S, entry| most.max(entry.abs()));
    Fault::NotConverged {
        iterations,
        residual: most.to_f64(),
        joint: None,
        alpha: None,
    }
}

/// The longest of some ways, in radians or lengths of the mechanism.
fn longest<S: Real, const N: usize>(way: &[S; N], scales: &[S; N]) -> S {
    let ways = way.iter().zip(scales);
    ways.fold(S::zero(), |most: S, (way, &scale)| {
        most.max(way.abs().quotient(scale))
    })
}

/// How much each acceleration changes over a radian, or over a length of the mechanism.
fn row_sizes<S: Real, const N: usize>(slopes: &SMatrix<S, N, N>, scales: &[S; N]) -> [S; N] {
    let mut sizes = [S::zero(); N];
    for (size, row) in sizes.iter_mut().zip(slopes.row_iter()) {
        let entries = row.iter().zip(scales);
        *size = entries.fold(S::zero(), |sum, (entry, &scale)| sum + entry.abs() * scale);
    }
    sizes
}

/// The sum of the squares of accelerations, each by how much it can change; of those that do not
/// change, as they are.
fn square<S: Real, const N: usize>(left: &SVector<S, N>, sizes: &[S; N]) -> S {
    let entries = left.iter().zip(sizes);
    entries.fold(S::zero(), |sum, (&left, &size)| {
        let size = if size > S::zero() { size } else { S::one() };
        let part = left.quotient(size);
        part.fused(part, sum)
    })
}

/// Newton's step `J s = -a`, by elimination with the largest pivots first, and what of `a` no step
/// explains. Coordinates on which nothing depends stay.
fn newton<S: Real, const N: usize>(
    slopes: &SMatrix<S, N, N>,
    left: &SVector<S, N>,
    scales: &[S; N],
) -> ([S; N], [S; N]) {
    let mut matrix = *slopes;
    let mut right: [S; N] = (*left).into();
    right.iter_mut().for_each(|right| *right = -*right);
    let sizes = row_sizes(slopes, scales);
    let mut row_of = [None; N];
    let mut is_taken = [false; N];
    for _ in 0..N {
        let mut best = (S::EPSILON * S::constant(16.0 * N as f64), None);
        for row in (0..N).filter(|&row| !is_taken[row] && sizes[row] > S::zero()) {
            for column in (0..N).filter(|&column| row_of[column].is_none()) {
                let size = (matrix[(row, column)] * scales[column])
                    .abs()
                    .quotient(sizes[row]);
                if size > best.0 {
                    best = (size, Some((row, column)));
                }
            }
        }
        let Some((row, column)) = best.1 else { break };
        (is_taken[row], row_of[column]) = (true, Some(row));
        for other in (0..N).filter(|&other| other != row) {
            let factor = matrix[(other, column)].quotient(matrix[(row, column)]);
            for place in 0..N {
                matrix[(other, place)] = matrix[(other, place)] - factor * matrix[(row, place)];
            }
            right[other] = right[other] - factor * right[row];
            matrix[(other, column)] = S::zero();
        }
    }
    let mut way = [S::zero(); N];
    for (column, way) in way.iter_mut().enumerate() {
        if let Some(row) = row_of[column] {
            *way = right[row].quotient(matrix[(row, column)]);
        }
    }
    for (right, is_taken) in right.iter_mut().zip(is_taken) {
        if is_taken {
            *right = S::zero();
        }
    }
    (way, right)
}
