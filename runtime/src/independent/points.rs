//! Jacobians of points.

use nalgebra::{SMatrix, Vector3};

use super::determined::Needs;
use super::elimination::at;
use super::equations::{finite_matrix, solve};
use super::partition::Partition;
use super::{Equations, IndependentCoordinates};
use crate::error::{Fault, StartFault, StepFault};
use crate::forward::Forward;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, plus, read, times};
use crate::mechanism::joint_kernels::JointParts as _;
use crate::mechanism::joint_rates::{HasJacobian, HasMassMatrix, JointRates};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::{Located, Place};
use crate::mechanism::relative::{each_body, rates_of_motion};
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, MovingState, Vector};

/// A point that is fixed on a body, from its centre of mass in principal axes.
#[derive(Clone, Copy)]
pub(super) struct Fixed<S> {
    body: Option<usize>,
    arm: [S; 3],
}

impl<S: Scalar> Fixed<S> {
    fn of<M: Mechanism>(constants: &M::Constants<S>, at: impl Located<M>) -> Self {
        match at.located() {
            Place::Body(body) => Self {
                body: Some(body.index()),
                arm: [S::zero(); 3],
            },
            Place::Point(point) => Self {
                body: point.info().and_then(|info| info.body),
                arm: M::named_point(constants, point.index()),
            },
        }
    }

    fn lifted<const K: usize>(&self) -> Fixed<Forward<S, K>> {
        Fixed {
            body: self.body,
            arm: self.arm.map(Forward::fixed),
        }
    }
}

/// Where a point of a body is (m, global), by the motions of the bodies.
fn position<S: Scalar, M: JointRates>(motions: &[S], body: usize, arm: &[S; 3]) -> [S; 3] {
    let mut found = [S::zero(); 3];
    each_body::<S, M>(motions, |number, _, motion| {
        if number == body {
            let turned = motion.rotation.map_or(*arm, |(rows, _)| {
                rows.map(|[x, y, z]| {
                    let [a, b, c] = *arm;
                    x.fused(a, y.fused(b, z * c))
                })
            });
            found = plus(motion.position, &turned);
        }
    });
    found
}

impl<M: HasJacobian, const N: usize, S: Real> Equations<M, N, S> {
    /// Column by column velocity and angular velocity.
    pub(super) fn jacobian(
        &self,
        state: &M::JointState<S>,
        partition: &Partition<M, N, S>,
        point: &Fixed<S>,
    ) -> [[S; 6]; N] {
        let Some(body) = point.body else {
            return [[S::zero(); 6]; N];
        };
        let motions = M::body_motions(&self.constants, state);
        let p = position::<S, M>(motions.as_slice(), body, &point.arm);
        let axes = M::joint_axes(&self.constants, self.time, state);
        columns(partition, axes.as_slice(), body, &p)
    }
}

/// The same of a body at a point (m, global), by the axes of the joints.
pub(super) fn columns<M: HasJacobian, const N: usize, S: Scalar>(
    partition: &Partition<M, N, S>,
    axes: &[S],
    body: usize,
    p: &[S; 3],
) -> [[S; 6]; N] {
    let mut columns = [[S::zero(); 6]; N];
    each_rate::<M, S>(axes, body, p, |rate, velocity, axis| {
        for (column, of_chosen) in columns.iter_mut().zip(&partition.columns) {
            let share = at(of_chosen.as_slice(), rate);
            let [vx, vy, vz] = times(&velocity, share);
            let [wx, wy, wz] = times(&axis, share);
            for (entry, part) in column.iter_mut().zip([vx, vy, vz, wx, wy, wz]) {
                *entry = *entry + part;
            }
        }
    });
    columns
}

/// Calls with each rate that moves a body, and with what a unit of it gives the body at a point (m,
/// global): a velocity, and an angular velocity.
pub(super) fn each_rate<M: HasJacobian, S: Scalar>(
    axes: &[S],
    body: usize,
    p: &[S; 3],
    mut then: impl FnMut(usize, [S; 3], [S; 3]),
) {
    let is_particle = M::REPORT
        .bodies
        .get(body)
        .is_none_or(|info| info.kind == BodyKind::Particle);
    for &(rate, ball) in M::MOVED_BY.get(body).copied().unwrap_or(&[]) {
        let [mut axis, origin, along] = [0, 3, 6].map(|part| read::<S, 3>(axes, 9 * rate + part));
        let moved = ball.map_or(*p, |ball| read(axes, 9 * ball + 3));
        let velocity = plus(&cross(&axis, &minus(&moved, &origin)), &along);
        if ball.is_some() || is_particle {
            axis = [S::zero(); 3];
        }
        then(rate, velocity, axis);
    }
}

impl<M: JointRates, const N: usize, S: Scalar> Equations<M, N, S> {
    /// The same over numbers that carry derivatives.
    pub(super) fn lifted<const K: usize>(&self) -> Equations<M, N, Forward<S, K>> {
        Equations {
            constants: crate::forward::lifted(&self.constants),
            places: self.places,
            time: Forward::fixed(self.time),
            length: Forward::fixed(self.length),
            sizes: crate::forward::lifted(&self.sizes),
            resolved: self.resolved,
            leaves_velocities: self.leaves_velocities,
        }
    }
}

/// A state that moves along slopes, one for each derivative, of the element at a place. The slope
/// of a pair is the rate of its angle.
pub(super) fn moved<M: JointRates, S: Scalar, const K: usize>(
    state: &M::JointState<S>,
    slopes: impl Fn(usize) -> [S; K],
) -> M::JointState<Forward<S, K>> {
    let mut here = M::JointState::<Forward<S, K>>::zeros();
    let pairs = state.pairs_slice();
    for (number, &[c, s]) in pairs.iter().enumerate() {
        let (place, turns) = (2 * number, slopes(2 * number));
        here.set_element(place, Forward::new(c, turns.map(|turn| -(s * turn))));
        here.set_element(place + 1, Forward::new(s, turns.map(|turn| c * turn)));
    }
    for place in 2 * pairs.len()..state.length() {
        here.set_element(place, Forward::new(state.element(place), slopes(place)));
    }
    let counted = here.turns_mut().iter_mut();
    for (place, &number) in counted.zip(state.turns()) {
        *place = Forward::fixed(number);
    }
    here
}

impl<M: HasJacobian, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The Jacobian of a body's centre of mass or of a named point, for unit rates of the
    /// coordinates. Rows 0 to 2 are its velocity (m/s, global), rows 3 to 5 the angular velocity of
    /// its body (rad/s, global).
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn jacobian(
        &self,
        state: &M::JointState<S>,
        at: impl Located<M>,
    ) -> Result<SMatrix<S, 6, N>, Fault> {
        let point = Fixed::of::<M>(&self.constants, at);
        let partition = self.known(state, Needs::Rates)?;
        let columns = self.equations.jacobian(state, &partition, &point);
        finite_matrix(SMatrix::from_fn(|row, column| columns[column][row]))
    }

    /// The rate of the Jacobian in the motion of the state: the point's acceleration (m/s^2) and
    /// angular acceleration (rad/s^2) are `J a + J' v`, where no driver moves.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn jacobian_rate(
        &self,
        state: &M::JointState<S>,
        at: impl Located<M>,
    ) -> Result<SMatrix<S, 6, N>, Fault> {
        self.known(state, Needs::Accelerations)?;
        let Equations {
            constants, time, ..
        } = &self.equations;
        let slope = rates_of_motion::<S, M>(constants, *time, state);
        let moved = moved::<M, S, 1>(state, |place| [slope.element(place)]);
        let mut equations = self.equations.lifted::<1>();
        equations.time = Forward::new(*time, [S::one()]);
        let point = Fixed::of::<M>(&self.constants, at).lifted();
        let partition = equations.partition(&moved)?;
        let columns = equations.jacobian(&moved, &partition, &point);
        finite_matrix(SMatrix::from_fn(|row, column| {
            let [rate] = columns[column][row].derivatives();
            rate
        }))
    }

    /// The effective mass (kg) of a point along a direction (global, of any length). A force along
    /// it accelerates the point as it would a free particle of this mass: `1 / (n J M^-1 J^T n)`.
    /// It is infinite where nothing can move along it.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`]; [`StartFault::Setting`] for a direction of length zero.
    pub fn effective_mass(
        &self,
        state: &M::JointState<S>,
        at: impl Located<M>,
        direction: Vector3<S>,
    ) -> Result<S, Fault>
    where
        M: HasMassMatrix,
    {
        let point = Fixed::of::<M>(&self.constants, at);
        let partition = self.known(state, Needs::Rates)?;
        let columns = self.equations.jacobian(state, &partition, &point);
        let size = direction
            .iter()
            .fold(S::zero(), |most: S, part| most.max(part.abs()));
        if !(size > S::zero() && size.is_finite()) {
            return Err(Fault::Start(StartFault::Setting {
                name: "direction",
                value: size.to_f64(),
            }));
        }
        let [x, y, z]: [S; 3] = direction.map(|part| part.quotient(size)).into();
        let square = x * x + y * y + z * z;
        let along = columns.map(|[vx, vy, vz, ..]| vx * x + vy * y + vz * z);
        let following = (!M::JOINT_REPORT.closing.is_empty()).then_some(&partition);
        let accelerations = solve(self.equations.mass_with(following, state), along);
        let products = along.iter().zip(accelerations);
        let mobility = products.fold(S::zero(), |sum, (&a, b)| a.fused(b, sum));
        if mobility.is_finite() {
            Ok(square.quotient(mobility))
        } else {
            Err(Fault::Step(StepFault::StateNotFinite))
        }
    }
}
