//! A state at a time, to be read.

use core::borrow::Borrow;
use core::fmt::{self, Debug};
use core::marker::PhantomData;

use nalgebra::Vector3;

use crate::error::ReadingFault;
use crate::math::scalar::Scalar;
use crate::math::vec3::{minus, read, square, times};
use crate::math::without_bounds::copied;
use crate::measure::access::{MechanismExt, Pose};
use crate::measure::reaction::{Wrench, wrench};
use crate::mechanism::handle::{
    BodyHandle, Driven, ForceHandle, HasAngle, HasContact, HasDisplacement, JointHandle,
    StateHandle,
};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::readout::{AngleParts, ContactPoint, DisplacementParts, ForceParts};
use crate::mechanism::report::{BodyInfo, MarkerKind};
use crate::mechanism::turns;
use crate::state::vector::Array;

/// A state at a time, with everything that can be read from it by handle.
///
/// ```
/// use holonom::prelude::*;
///
/// /// A rod of 1 m on a hinge about x.
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let (rod, handles) = (Rod::default(), Rod::HANDLES);
/// let mut state = rod.described_state()?;
/// rod.set_angle(&mut state, handles.hinge, 0.5)?;
/// let view = rod.view(0.0, &state)?;
/// assert!((view.angle(handles.hinge) - 0.5_f64).abs() < 1e-12);     // rad
/// assert!((view.position(handles.rod).z - 0.5 * 0.5_f64.sin()).abs() < 1e-12); // m
/// assert!(view.violation() < 1e-24);
/// # Ok::<(), Fault>(())
/// ```
///
/// [`Viewed::view`](crate::measure::Viewed::view) makes one of a state at hand. Observers and
/// steppers have one. `K` says whether the constants of the mechanism are borrowed, as in a run, or
/// held ([`OwnedView`]). All that is read is the same.
pub struct View<'a, S: Scalar, M: Mechanism, K = &'a <M as Mechanism>::Constants<S>> {
    constants: K,
    time: S,
    state: &'a M::State<S>,
    mechanism: PhantomData<fn() -> M>,
}

/// A [`View`] that holds the constants of its mechanism, see
/// [`Viewed::view`](crate::measure::Viewed::view). [`View::borrowed`] of it is what a function
/// takes that asks for a `View<'_, S, M>`.
pub type OwnedView<'a, S, M> = View<'a, S, M, <M as Mechanism>::Constants<S>>;

copied!([S: Scalar, M: Mechanism, K: Copy] View<'_, S, M, K>);

/// The name of the mechanism, the time and the state.
impl<S: Scalar, M: Mechanism, K> Debug for View<'_, S, M, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("View")
            .field("mechanism", &M::REPORT.name)
            .field("time", &self.time)
            .field("state", self.state)
            .finish_non_exhaustive()
    }
}

impl<'a, S: Scalar, M: Mechanism> View<'a, S, M> {
    /// A view of a state; for the kernels it is read with Euler parameters of length 1.
    ///
    /// Constants and state do not tell the mechanism: two may have the same sizes. A handle does;
    /// where none is used, write `View::<_, Swing>::new(..)`.
    #[must_use]
    pub fn new(constants: &'a M::Constants<S>, time: S, state: &'a M::State<S>) -> Self {
        Self::of(constants, time, state)
    }

    /// The same of another state at that time.
    pub(crate) fn of_state<'b>(&self, state: &'b M::State<S>) -> View<'b, S, M>
    where
        'a: 'b,
    {
        View::new(self.constants, self.time, state)
    }
}

impl<'a, S: Scalar, M: Mechanism, K: Borrow<M::Constants<S>>> View<'a, S, M, K> {
    pub(crate) fn of(constants: K, time: S, state: &'a M::State<S>) -> Self {
        Self {
            constants,
            time,
            state,
            mechanism: PhantomData,
        }
    }

    /// The same view, whose constants are borrowed from this one.
    #[must_use]
    pub fn borrowed(&self) -> View<'_, S, M> {
        View::new(self.constants(), self.time, self.state)
    }

    /// For the kernels of [`Mechanism`].
    #[doc(hidden)]
    #[must_use]
    pub fn constants(&self) -> &M::Constants<S> {
        self.constants.borrow()
    }

    /// The time (s).
    #[must_use]
    pub fn time(&self) -> S {
        self.time
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &'a M::State<S> {
        self.state
    }

    /// Position (m, global) of the centre of mass, and orientation from the user's body axes to the
    /// global axes.
    #[must_use]
    pub fn pose(&self, body: BodyHandle<M>) -> Pose<S> {
        M::pose(self.state, body)
    }

    /// The angular velocity (rad/s) along the user's body axes.
    #[must_use]
    pub fn angular_velocity(&self, body: BodyHandle<M>) -> Vector3<S> {
        M::angular_velocity(self.state, body)
    }

    /// The angular velocity (rad/s) along the global axes.
    #[must_use]
    pub fn angular_velocity_global(&self, body: BodyHandle<M>) -> Vector3<S> {
        M::angular_velocity_global(self.state, body)
    }

    /// A point of a body (m, global), given from the centre of mass along the user's body axes (m).
    #[must_use]
    pub fn point(&self, body: BodyHandle<M>, point: Vector3<S>) -> Vector3<S> {
        M::point(self.state, body, point)
    }

    /// The velocity of a point of a body (m/s, global), given as in [`View::point`].
    #[must_use]
    pub fn point_velocity(&self, body: BodyHandle<M>, point: Vector3<S>) -> Vector3<S> {
        M::point_velocity(self.state, body, point)
    }

    /// A point (m, global) or direction (global) that a joint or force names, by its place in
    /// [`Report::markers`](crate::Report::markers). Zeros for a marker that is not there.
    #[must_use]
    pub fn marker(&self, place: usize) -> Vector3<S> {
        let components = M::marker(self.constants(), place);
        let marker = M::REPORT.markers.get(place);
        let Some((marker, body)) = marker.and_then(|marker| Some((marker, marker.body?))) else {
            return Vector3::from(components);
        };
        let (state, body) = (self.state_of_kernels(), BodyHandle::<M>::new(body));
        let [x, y, z] = crate::measure::reaction::in_global_axes::<S, M>(&state, body, components);
        let turned = Vector3::new(x, y, z);
        match marker.kind {
            MarkerKind::Point => {
                let [x0, y0, z0] = self.pose(body).position.into();
                Vector3::new(x0 + x, y0 + y, z0 + z)
            }
            MarkerKind::Axis | MarkerKind::Vector => turned,
        }
    }

    /// The sizes (m) of a shape by its place in
    /// [`Report::shapes`](crate::Report::shapes). Zeros for a shape that is not there.
    #[must_use]
    pub fn shape(&self, place: usize) -> [S; 3] {
        M::shape(self.constants(), place)
    }

    /// Gravity (m/s^2, global): the force on the first body with a mass less that of every force
    /// field on it, over its mass. Zero without a body.
    #[must_use]
    pub fn gravity(&self) -> Vector3<S> {
        let mass = M::mass::<S>(self.constants());
        let has_mass = |body: &BodyInfo| {
            let [own] = read(mass.as_slice(), body.velocity);
            own != S::zero()
        };
        let first = M::REPORT.bodies.iter().position(has_mass);
        let (gravity, _) = self.gravity_by(first.unwrap_or(0));
        Vector3::from(gravity)
    }

    /// The same by any body, and what force fields do to it (m/s^2): as many digits are lost as
    /// that is larger.
    pub(crate) fn gravity_by(&self, body: usize) -> ([S; 3], S) {
        let Some(info) = M::REPORT.bodies.get(body) else {
            return ([S::zero(); 3], S::zero());
        };
        let state = self.state_of_kernels();
        let forces = M::forces(self.constants(), self.time, &state);
        let mut weight: [S; 3] = read(forces.as_slice(), info.velocity);
        let mut pushed = S::zero();
        for (index, force) in M::REPORT.forces.iter().enumerate() {
            let places = force.bodies.iter().enumerate();
            for (place, _) in places.filter(|(_, of)| **of == Some(body)) {
                let load = M::force_load(self.constants(), self.time, &state, index, place);
                let [fx, fy, fz, ..] = load;
                weight = minus(&weight, &[fx, fy, fz]);
                pushed = pushed + fx.abs() + fy.abs() + fz.abs();
            }
        }
        let [mass] = read(M::mass::<S>(self.constants()).as_slice(), info.velocity);
        let part = mass.reciprocal();
        (times(&weight, part), pushed * part)
    }

    /// The angle of a joint (rad), zero in the configuration that the attributes describe, positive
    /// as the second body turns about the joint's axis against the first.
    ///
    /// It goes on over any number of turns, and has no jump: the state counts them where a run or a
    /// [`Stepper`](crate::Stepper) moves it. Setting an angle sets the count. In a state of which
    /// nothing was counted, it is the angle nearest to the described configuration.
    #[must_use]
    pub fn angle<J: HasAngle>(&self, joint: JointHandle<M, J>) -> S {
        self.angle_of(joint.index())
    }

    /// The same from `-pi` to `pi`, where it jumps.
    #[must_use]
    pub fn wrapped_angle<J: HasAngle>(&self, joint: JointHandle<M, J>) -> S {
        let parts = self.angle_parts(joint.index());
        parts.sine.atan2(parts.cosine)
    }

    /// The rate of the angle of a joint (rad/s), with the sign of [`View::angle`].
    #[must_use]
    pub fn angle_rate<J: HasAngle>(&self, joint: JointHandle<M, J>) -> S {
        self.angle_parts(joint.index()).rate
    }

    /// The displacement of a joint (m), with the zero and the sign of its definition.
    #[must_use]
    pub fn displacement<J: HasDisplacement>(&self, joint: JointHandle<M, J>) -> S {
        self.displacement_parts(joint.index()).value
    }

    /// The rate of the displacement of a joint (m/s), with the sign of [`View::displacement`].
    #[must_use]
    pub fn displacement_rate<J: HasDisplacement>(&self, joint: JointHandle<M, J>) -> S {
        self.displacement_parts(joint.index()).rate
    }

    /// The contact of a joint: where its second body touches the first.
    #[must_use]
    pub fn contact<J: HasContact>(&self, joint: JointHandle<M, J>) -> ContactPoint<S> {
        let (time, state) = (self.time, self.state);
        ContactPoint::of(M::joint_contact(
            self.constants(),
            time,
            state,
            joint.index(),
        ))
    }

    /// The value of a state of the user's own, in the unit that its rate and its start have.
    #[must_use]
    pub fn state_value(&self, of: StateHandle<M>) -> S {
        M::state_value(self.state, of)
    }

    /// The rate of a state of the user's own, in its unit a second.
    #[must_use]
    pub fn state_rate(&self, of: StateHandle<M>) -> S {
        let mut rates = Array::zeros();
        let state = self.state_of_kernels();
        M::state_rates_into(self.constants(), self.time, &state, &mut rates);
        let [rate] = read(rates.as_slice(), of.coordinate());
        rate
    }

    /// The effort of a driver: the generalised force with which it acts on the quantity that it
    /// drives, from the multipliers at this state; N for a length, N m for an angle. A positive
    /// effort pushes the quantity upwards, so that effort times rate is the power that the driver
    /// puts in.
    ///
    /// # Errors
    /// [`ReadingFault::NoEffort`] where the driver's equation was left out as redundant: other
    /// joints carry what it would.
    pub fn driving_effort<J: Driven>(
        &self,
        multipliers: &M::Multipliers<S>,
        joint: JointHandle<M, J>,
    ) -> Result<S, ReadingFault> {
        let row = joint.row(J::ROW);
        let multiplier = row.and_then(|row| multipliers.as_slice().get(row));
        multiplier
            .map(|&multiplier| -multiplier)
            .ok_or(ReadingFault::NoEffort {
                joint: joint.name(),
            })
    }

    /// What a joint exerts on one of its bodies: force and moment (N, N m, global) reduced to the
    /// joint's point on that body, from the multipliers at this state.
    ///
    /// # Errors
    /// [`ReadingFault::NotBetween`] for a body that is not of the joint.
    pub fn reaction<J>(
        &self,
        multipliers: &M::Multipliers<S>,
        joint: JointHandle<M, J>,
        body: BodyHandle<M>,
    ) -> Result<Wrench<S>, ReadingFault> {
        let bodies = joint.info().map_or(&[][..], |info| info.bodies);
        let place = place_of(bodies, joint.name(), body)?;
        self.reaction_on_place(multipliers, joint, place)
    }

    /// The same by the place of the body in `between`: 0 is the first, which may be the ground.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchPlace`] for a place that `between` does not have.
    pub fn reaction_on_place<J>(
        &self,
        multipliers: &M::Multipliers<S>,
        joint: JointHandle<M, J>,
        place: usize,
    ) -> Result<Wrench<S>, ReadingFault> {
        let state = self.state_of_kernels();
        let (constants, time, index) = (self.constants(), self.time, joint.index());
        wrench::<S, M>(constants, time, &state, multipliers, index, place).ok_or_else(|| {
            ReadingFault::NoSuchPlace {
                joint: joint.name(),
                place,
                places: joint.info().map_or(0, |info| info.bodies.len()),
            }
        })
    }

    /// Kinetic energy (J).
    #[must_use]
    pub fn kinetic_energy(&self) -> S {
        M::kinetic_energy(self.constants(), self.state)
    }

    /// Potential energy (J), see [`Mechanism::potential_energy`].
    #[must_use]
    pub fn potential_energy(&self) -> S {
        M::potential_energy(self.constants(), self.time, self.state)
    }

    /// The power (W) of the forces of the language that have no potential, see
    /// [`Mechanism::power`]: what changes the energy of a mechanism without drivers and without a
    /// force closure.
    #[must_use]
    pub fn power(&self) -> S {
        M::power(self.constants(), self.time, self.state)
    }

    /// Potential energy (J) and power (W) of one force.
    #[must_use]
    pub fn force_parts<F>(&self, force: ForceHandle<M, F>) -> ForceParts<S> {
        M::force_parts(self.constants(), self.time, self.state, force.index())
    }

    /// What a force exerts on one of its bodies: force and moment (N, N m, global) about the body's
    /// centre of mass.
    ///
    /// # Errors
    /// [`ReadingFault::NotBetween`] for a body that is not in the force's `between`.
    pub fn load<F>(
        &self,
        force: ForceHandle<M, F>,
        body: BodyHandle<M>,
    ) -> Result<Wrench<S>, ReadingFault> {
        let bodies = force.info().map_or(&[][..], |info| info.bodies);
        let place = place_of(bodies, force.name(), body)?;
        let [fx, fy, fz, mx, my, mz] = M::force_load(
            self.constants(),
            self.time,
            self.state,
            force.index(),
            place,
        );
        let state = self.state_of_kernels();
        let moment = crate::measure::reaction::in_global_axes::<S, M>(&state, body, [mx, my, mz]);
        Ok(Wrench {
            force: Vector3::new(fx, fy, fz),
            moment: Vector3::from(moment),
            point: self.pose(body).position,
            is_unique: true,
        })
    }

    /// Kinetic and potential energy together (J).
    #[must_use]
    pub fn energy(&self) -> S {
        self.kinetic_energy() + self.potential_energy()
    }

    /// `Phi`, one element per equation, with the Euler parameters as they are stored.
    #[must_use]
    pub fn constraints(&self) -> M::Multipliers<S> {
        M::constraints(self.constants(), self.time, self.state)
    }

    /// The violation of the constraints: `Phi^T Phi`.
    #[must_use]
    pub fn violation(&self) -> S {
        square(self.constraints().as_slice())
    }

    /// The violation of the constraints by the velocities: `Phi'^T Phi'`.
    #[must_use]
    pub fn velocity_violation(&self) -> S {
        square(M::constraint_rates(self.constants(), self.time, self.state).as_slice())
    }

    /// The violation of the constraints by accelerations: the square of `D u' - gamma`.
    #[must_use]
    pub fn acceleration_violation(&self, accelerations: &M::Velocities<S>) -> S {
        let state = self.state_of_kernels();
        let jacobian = M::jacobian(self.constants(), self.time, &state);
        let mut rest = M::gamma(self.constants(), self.time, &state);
        for block in M::REPORT.blocks {
            let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
            let rows = rest
                .as_mut_slice()
                .iter_mut()
                .skip(block.row)
                .take(block.rows);
            for (rest, row) in rows.zip(values.chunks(block.columns.max(1))) {
                let columns = accelerations.as_slice().iter().skip(block.column);
                for (&value, &acceleration) in row.iter().zip(columns) {
                    *rest = *rest - value * acceleration;
                }
            }
        }
        square(rest.as_slice())
    }

    /// [`View::angle`] of a joint by its index.
    pub(crate) fn angle_of(&self, joint: usize) -> S {
        turns::angle::<S, M>(self.constants(), self.state, joint)
    }

    pub(crate) fn angle_parts(&self, joint: usize) -> AngleParts<S> {
        M::joint_angle(self.constants(), self.state, joint)
    }

    pub(crate) fn displacement_parts(&self, joint: usize) -> DisplacementParts<S> {
        M::joint_displacement(self.constants(), self.time, self.state, joint)
    }

    /// The state as the kernels of the saddle system read it.
    pub(super) fn state_of_kernels(&self) -> M::State<S> {
        with_unit_orientations::<S, M>(self.state)
    }
}

/// The place of a body among those of a joint or force.
fn place_of<M: Mechanism>(
    bodies: &[Option<usize>],
    element: &'static str,
    body: BodyHandle<M>,
) -> Result<usize, ReadingFault> {
    let place = bodies.iter().position(|&b| b == Some(body.index()));
    place.ok_or_else(|| ReadingFault::NotBetween {
        element,
        body: body.name(),
    })
}
