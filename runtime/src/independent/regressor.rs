//! The regressor of inverse dynamics, which is linear in ten numbers of each body.

use nalgebra::{SMatrix, SVector};

use super::IndependentCoordinates;
use super::determined::Needs;
use super::elimination::at;
use super::equations::{finite, finite_matrix};
use super::partition::{Partition, put_velocities};
use super::points::{each_rate, moved};
use crate::error::Fault;
use crate::forward::Forward;
use crate::math::quaternion::{rotate, rotate_back};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, plus, read};
use crate::measure::view::View;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::joint_rates::{HasJacobian, JointRates};
use crate::mechanism::relative::{BodyMotion, each_body, rates_of_motion};
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, Vector as _};

/// The inertial parameters of a body, in the order of the columns of
/// [`IndependentCoordinates::regressor`]: mass (kg), first moments (kg m), inertia (kg m^2).
pub const INERTIAL_PARAMETERS: [&str; 10] = [
    "m", "mx", "my", "mz", "Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz",
];

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The ten inertial parameters of a body as it is described, along its described axes. The
    /// point of reference is its described centre of mass.
    ///
    /// - The mass (kg).
    /// - The three first moments (kg m): the mass times the way from the described centre of mass
    ///   to the true one. They are zero of a described body.
    /// - The entries xx, yy, zz, xy, xz and yz of the inertia tensor (kg m^2) about the described
    ///   centre of mass. Entries have the signs of `inertia = [[..], [..], [..]]`: `Ixy` is minus
    ///   the integral of `x y`.
    ///
    /// With a true centre of mass at `c` and a tensor `J` about it, the parameters are `m`, `m c`
    /// and `J + m (|c|^2 1 - c c^T)`. A particle has its mass alone.
    #[must_use]
    pub fn inertial_parameters(&self, body: BodyHandle<M>) -> SVector<S, 10> {
        let mut parameters = SVector::from_element(S::zero());
        let Some(info) = M::REPORT.bodies.get(body.index()) else {
            return parameters;
        };
        let mass = M::mass::<S>(&self.constants);
        [parameters[0]] = read(mass.as_slice(), info.velocity);
        if info.kind == BodyKind::Rigid {
            let moments: [S; 3] = read(mass.as_slice(), info.velocity + 3);
            let axes = M::user_axes(body.index()).map(S::constant);
            // Column by column `C^T J C`.
            let [x, y, z] = units().map(|unit| {
                let [a, b, c] = rotate(&axes, &unit);
                let [ja, jb, jc] = moments;
                rotate_back(&axes, &[ja * a, jb * b, jc * c])
            });
            let entries = [x[0], y[1], z[2], x[1], x[2], y[2]];
            let places = parameters.iter_mut().skip(4);
            places
                .zip(entries)
                .for_each(|(place, entry)| *place = entry);
        }
        parameters
    }
}

impl<M: HasJacobian, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The block of a body in the regressor `Y(q, v, a)` of inverse dynamics: the efforts (N m, N),
    /// one a row, by its inertial parameters, as [`IndependentCoordinates::inertial_parameters`]
    /// has them.
    ///
    /// The sum over all bodies of block times parameters is what
    /// [`IndependentCoordinates::inverse`] gives without described forces: inertia and gravity. It
    /// holds for any parameters, so that those of the real mechanism can be found from measured
    /// efforts. In closed loops the efforts are those along the chosen coordinates.
    ///
    /// `kernels = [jacobian]` suffices. Several bodies cost little more than one, by
    /// [`IndependentCoordinates::regressors`].
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A rod on a hinge.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [jacobian])]
    /// struct Pendulum {
    ///     #[body(mass = 2.0, inertia = [0.5, 0.1, 0.5], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (pendulum, h) = (Pendulum::default(), Pendulum::HANDLES);
    /// let space = pendulum.coordinates([h.hinge])?;
    /// let level = space.state([0.0], [0.0])?;
    /// let block = space.regressor(&level, [2.0], h.rod)?;
    /// let torque = (block * space.inertial_parameters(h.rod))[0];
    /// assert!((torque - (2.0 * (0.5 + 2.0 * 0.25) + 2.0 * 9.81 * 0.5)).abs() < 1e-14);
    /// // A kilogram metre along y more on the rod: twice the arm, and the weight.
    /// assert!((block[(0, 2)] - (2.0 * 2.0 * 0.5 + 9.81)).abs() < 1e-14);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// Each body is a 6 x 10 matrix of Newton and Euler under its Jacobian (Atkeson, An and
    /// Hollerbach, *Int. J. Robotics Research* 5, 1986; Khalil and Dombre, *Modeling,
    /// Identification and Control of Robots*, 2002, chapter 12).
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`];
    /// [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite) for accelerations
    /// that are not finite.
    pub fn regressor(
        &self,
        state: &M::JointState<S>,
        accelerations: impl Into<SVector<S, N>>,
        body: BodyHandle<M>,
    ) -> Result<SMatrix<S, N, 10>, Fault> {
        let [block] = self.regressors(state, accelerations, [body])?;
        Ok(block)
    }

    /// The blocks of several bodies, in their order.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::regressor`].
    pub fn regressors<const B: usize>(
        &self,
        state: &M::JointState<S>,
        accelerations: impl Into<SVector<S, N>>,
        bodies: [BodyHandle<M>; B],
    ) -> Result<[SMatrix<S, N, 10>; B], Fault> {
        let equations = &self.equations;
        let accelerations: [S; N] = accelerations.into().into();
        let accelerations: [S; N] = finite(accelerations)?.into();
        let partition = self.known(state, Needs::Accelerations)?;
        let all = equations.accelerations(Some(&partition), &accelerations);
        let mut slope = rates_of_motion::<S, M>(&equations.constants, equations.time, state);
        put_velocities::<M, S>(&all, &mut slope);
        let moving = moved::<M, S, 1>(state, |place| [slope.element(place)]);
        let motions = M::body_motions(&equations.lifted::<1>().constants, &moving);
        let axes = M::joint_axes(&equations.constants, equations.time, state);
        let gravity = self.gravity_field(state);
        let mut blocks = [SMatrix::from_element(S::zero()); B];
        each_body::<_, M>(motions.as_slice(), |number, _, motion| {
            let mut places = blocks.iter_mut().zip(&bodies);
            let Some((first, _)) = places.find(|(_, body)| body.index() == number) else {
                return;
            };
            let body = Twisting::of(&motion, M::user_axes(number).map(S::constant));
            *first = self.block(&partition, (axes.as_slice(), &gravity), number, &body);
            let block = *first;
            for (place, _) in places.filter(|(_, body)| body.index() == number) {
                *place = block;
            }
        });
        for block in blocks {
            finite_matrix(block)?;
        }
        Ok(blocks)
    }

    /// The block of a body: row by row what does work on a rate, and so on the chosen ones.
    fn block(
        &self,
        partition: &Partition<M, N, S>,
        (axes, gravity): (&[S], &[S; 3]),
        number: usize,
        body: &Twisting<S>,
    ) -> SMatrix<S, N, 10> {
        let wrenches = body.wrenches(gravity);
        let mut block = SMatrix::<S, N, 10>::from_element(S::zero());
        each_rate::<M, S>(axes, number, &body.position, |rate, velocity, axis| {
            let efforts = wrenches.efforts(&body.along_axes(&velocity), &body.along_axes(&axis));
            if M::JOINT_REPORT.closing.is_empty() {
                // All rates are chosen.
                let chosen = self
                    .equations
                    .places
                    .iter()
                    .position(|&place| place == rate);
                let mut row = block.row_iter_mut().nth(chosen.unwrap_or(N));
                let places = row.iter_mut().flat_map(|row| row.iter_mut());
                places
                    .zip(efforts)
                    .for_each(|(place, effort)| *place = effort);
                return;
            }
            for (mut row, of_chosen) in block.row_iter_mut().zip(&partition.columns) {
                let share = at(of_chosen.as_slice(), rate);
                let places = row.iter_mut().zip(efforts);
                places.for_each(|(place, effort)| *place = effort.fused(share, *place));
            }
        });
        block
    }

    /// Gravity (m/s^2, global), by the body that described forces push least: it need not be
    /// exact to all digits beside a stiff spring.
    fn gravity_field(&self, state: &M::JointState<S>) -> [S; 3] {
        // It is the same everywhere: where nothing pushes the first body as it is described, no
        // orientation has to be found.
        let described = M::initial_state(&self.constants);
        let view = View::<S, M>::new(&self.constants, self.equations.time, &described);
        let (gravity, pushed) = view.gravity_by(0);
        if pushed <= S::zero() {
            return gravity;
        }
        let bodies = self.bodies(state);
        let view = View::<S, M>::new(&self.constants, self.equations.time, &bodies);
        let not_known = [S::constant(f64::NAN); 3];
        let mut best = (not_known, S::constant(f64::INFINITY));
        for body in 0..M::REPORT.bodies.len() {
            let (gravity, pushed) = view.gravity_by(body);
            if pushed < best.1 {
                best = (gravity, pushed);
            }
            if best.1 <= S::zero() {
                break;
            }
        }
        best.0
    }
}

/// A body in motion.
struct Twisting<S> {
    /// The described centre of mass (m, global).
    position: [S; 3],
    /// Its acceleration (m/s^2, global).
    acceleration: [S; 3],
    /// The described axes, in global ones.
    axes: [[S; 3]; 3],
    /// Angular velocity (rad/s) and acceleration (rad/s^2), in described axes.
    spin: [S; 3],
    turning: [S; 3],
}

impl<S: Scalar> Twisting<S> {
    fn of(motion: &BodyMotion<'_, Forward<S, 1>>, axes: [S; 4]) -> Self {
        let values = |numbers: &[Forward<S, 1>; 3]| numbers.map(|number| number.value());
        let slopes = |numbers: &[Forward<S, 1>; 3]| {
            numbers.map(|number| {
                let [slope] = number.derivatives();
                slope
            })
        };
        let still = [S::zero(); 3];
        let (rotation, spin, turning) = match &motion.rotation {
            Some((rows, spin)) => (rows.each_ref().map(values), values(spin), slopes(spin)),
            None => (units(), still, still),
        };
        Self {
            position: values(motion.position),
            acceleration: slopes(motion.velocity),
            axes: units().map(|unit| {
                let unit = rotate(&axes, &unit);
                rotation.map(|row| dot(&row, &unit))
            }),
            spin: rotate_back(&axes, &spin),
            turning: rotate_back(&axes, &turning),
        }
    }

    /// Components along the described axes of a global vector.
    fn along_axes(&self, vector: &[S; 3]) -> [S; 3] {
        self.axes.each_ref().map(|axis| dot(axis, vector))
    }

    /// By parameter the force and the moment about the described centre of mass that the motion
    /// takes, in described axes: `F = m a + w' x h + w x (w x h)`, `N = h x a + I w' + w x I w`.
    fn wrenches(&self, gravity: &[S; 3]) -> Wrenches<S> {
        let Self { spin, turning, .. } = self;
        let a = self.along_axes(&minus(&self.acceleration, gravity));
        let by_moments = units().map(|unit| {
            let inwards = cross(spin, &cross(spin, &unit));
            (plus(&cross(turning, &unit), &inwards), cross(&unit, &a))
        });
        let (momenta, rates) = (by_inertia(spin), by_inertia(turning));
        let mut by_inertia = rates;
        for (moment, momentum) in by_inertia.iter_mut().zip(&momenta) {
            *moment = plus(moment, &cross(spin, momentum));
        }
        Wrenches {
            by_mass: a,
            by_moments,
            by_inertia,
        }
    }
}

/// What the motion of a body takes, by its inertial parameters.
struct Wrenches<S> {
    /// A force.
    by_mass: [S; 3],
    /// By first moments, forces and moments.
    by_moments: [([S; 3], [S; 3]); 3],
    /// By the tensor, moments.
    by_inertia: [[S; 3]; 6],
}

impl<S: Scalar> Wrenches<S> {
    /// The work on a velocity and an angular velocity.
    fn efforts(&self, v: &[S; 3], w: &[S; 3]) -> [S; 10] {
        let [hx, hy, hz] = self
            .by_moments
            .each_ref()
            .map(|(force, moment)| dot(v, force) + dot(w, moment));
        let [xx, yy, zz, xy, xz, yz] = self.by_inertia.each_ref().map(|moment| dot(w, moment));
        [dot(v, &self.by_mass), hx, hy, hz, xx, yy, zz, xy, xz, yz]
    }
}

/// `I w` for a unit of each entry of the tensor.
fn by_inertia<S: Scalar>([x, y, z]: &[S; 3]) -> [[S; 3]; 6] {
    let (x, y, z, o) = (*x, *y, *z, S::zero());
    [
        [x, o, o],
        [o, y, o],
        [o, o, z],
        [y, x, o],
        [z, o, x],
        [o, z, y],
    ]
}

fn units<S: Scalar>() -> [[S; 3]; 3] {
    let (i, o) = (S::one(), S::zero());
    [[i, o, o], [o, i, o], [o, o, i]]
}

fn dot<S: Scalar>([x, y, z]: &[S; 3], [a, b, c]: &[S; 3]) -> S {
    *x * *a + *y * *b + *z * *c
}
