//! Poses and velocities by handle, in the axes that the user gave.

use nalgebra::{Quaternion, Vector3};

use crate::assembly::subtree::{Subtree, closes};
use crate::assembly::{assembled, assembled_holding};
use crate::constraints::projection::{Correction, Projection};
use crate::error::{AssemblyFault, Fault, ParameterError};
use crate::math::quaternion::{
    conjugate, normalised, normalised_or_zero, product, rotate, rotate_back,
};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, read, write};
use crate::mechanism::bodies::Joints;
use crate::mechanism::handle::{
    BodyHandle, CountsTurns, HasAngle, HasDisplacement, Joint, JointHandle, StateHandle,
};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;
use crate::state::vector::{Array, StateParts};

/// Where a body is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        into = "crate::measure::written::WrittenPose<S>",
        from = "crate::measure::written::WrittenPose<S>",
        bound(
            serialize = "S: serde::Serialize",
            deserialize = "S: serde::Deserialize<'de>"
        )
    )
)]
pub struct Pose<S: Scalar> {
    /// The centre of mass (m, global).
    pub position: Vector3<S>,
    /// The rotation from the user's body axes to the global axes, of length 1.
    pub orientation: Quaternion<S>,
}

/// Access to the state of a mechanism by handle.
///
/// A state stores the orientation and the angular velocity of a body in principal axes; these
/// functions speak the axes in which the user described the body. With `A(p)` from principal to
/// global axes and `A(c)` from the user's to the principal axes ([`Mechanism::user_axes`]), the
/// user's axes are turned by `A(p) A(c)`, and an angular velocity `w` along principal axes is
/// `A(c)^T w` along the user's.
///
/// A particle has no orientation: its axes are the global ones, its angular velocity is zero, and
/// what is set is ignored.
pub trait MechanismExt: Mechanism {
    /// What depends on the parameters of this value alone, as the kernels take it.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn constants<S: Scalar>(&self) -> Result<Self::Constants<S>, ParameterError> {
        Ok(Self::prepare(&self.parameters()?))
    }

    /// The state that the attributes of the bodies describe.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    fn described_state<S: Scalar>(&self) -> Result<Self::State<S>, ParameterError> {
        Ok(Self::initial_state(&self.constants()?))
    }

    /// Corrects positions and velocities so that they satisfy the constraints at a time, on the
    /// branch of the described state.
    ///
    /// What stands otherwise against what carries it in the spanning tree
    /// ([`Report::carriers`](crate::Report::carriers)) than in the described state was set, and is
    /// moved there in steps of at most 0.2 rad, or lengths of the mechanism; the other bodies
    /// follow the constraints. So what was set by [`MechanismExt::set_angle`] and its like is kept.
    /// A state that opens joints of the tree by less than a tenth of a radian, or a guess of all
    /// bodies up to half a radian, is corrected at once, see [`Projection`]. Joints come out on the
    /// side that is meant ([`Mechanism::joint_side`]). [`Correction::moved`] says how far the state
    /// was moved.
    ///
    /// # Errors
    /// A parameter that is not acceptable; [`AssemblyFault::WayEnds`] where the branch does not
    /// reach what was set; [`StepFault::NotConverged`](crate::error::StepFault::NotConverged);
    /// [`AssemblyFault::WrongSide`]. The state is then as before.
    fn assemble<S: Real>(
        &self,
        time: S,
        state: &mut Self::State<S>,
    ) -> Result<Correction<S>, Fault> {
        let constants = self.constants()?;
        let from = Self::initial_state(&constants);
        assembled::<S, Self>(&Projection::default(), &constants, time, state, &from)
    }

    /// [`MechanismExt::assemble`] from another state than the described one: the last that
    /// satisfied the constraints, whose branch is to be kept.
    ///
    /// # Errors
    /// As [`MechanismExt::assemble`].
    fn assemble_from<S: Real>(
        &self,
        time: S,
        state: &mut Self::State<S>,
        from: &Self::State<S>,
    ) -> Result<Correction<S>, Fault> {
        let constants = self.constants()?;
        check_state::<S, Self>(from)?;
        assembled::<S, Self>(&Projection::default(), &constants, time, state, from)
    }

    /// [`MechanismExt::assemble`] that holds chosen joints: their angles, displacements and
    /// relative orientations stay what they are in the state, to round-off, and all others follow.
    ///
    /// The others begin where the described state has them. If the state has one of them elsewhere,
    /// they begin where it has them all, as a guess. Rates are not held: velocities change as in
    /// [`MechanismExt::assemble`].
    ///
    /// # Errors
    /// As [`MechanismExt::assemble`]; [`AssemblyFault::WayEnds`] also where the constraints do not
    /// let all of these joints be held. [`AssemblyFault::CarriesNothing`] for a joint that carries
    /// no body: it closes a loop, or drives. The state is then as before.
    fn assemble_holding<S: Real>(
        &self,
        time: S,
        state: &mut Self::State<S>,
        held: impl Joints<Self>,
    ) -> Result<Correction<S>, Fault> {
        let constants = self.constants()?;
        let from = Self::initial_state(&constants);
        let carriers = || Self::REPORT.carriers.iter();
        for joint in (0..Self::REPORT.joints.len()).filter(|&joint| held.has_joint(joint)) {
            if !carriers().any(|carrier| carrier.joint == Some(joint)) {
                return Err(closes::<Self>(joint));
            }
        }
        let carrier = |body: usize| Self::REPORT.carriers.get(body)?.joint;
        let held = |body: usize| carrier(body).is_some_and(|joint| held.has_joint(joint));
        let projection = Projection::default();
        assembled_holding::<S, Self, _>(&projection, &constants, time, state, &from, Some(&held))
    }

    /// The Euler parameters (scalar first, of length 1) of the rotation from the user's body axes
    /// to the global axes.
    fn orientation<S: Scalar>(state: &Self::State<S>, body: BodyHandle<Self>) -> [S; 4] {
        match body.orientation() {
            Some((_, place)) => {
                let p = normalised(&read(state.coordinates().as_slice(), place));
                product(&p, &Self::user_axes(body.index()).map(S::constant))
            }
            None => [S::one(), S::zero(), S::zero(), S::zero()],
        }
    }

    /// Position and orientation of a body.
    fn pose<S: Scalar>(state: &Self::State<S>, body: BodyHandle<Self>) -> Pose<S> {
        let [e0, e1, e2, e3] = Self::orientation(state, body);
        Pose {
            position: Vector3::from(position(state, body)),
            orientation: Quaternion::new(e0, e1, e2, e3),
        }
    }

    /// Sets position and orientation of a body; the orientation may have any length but zero, which
    /// whatever uses the state refuses with
    /// [`StepFault::ZeroOrientation`](crate::error::StepFault::ZeroOrientation).
    ///
    /// **A pose does not tell turns.** Angles that count them
    /// ([`Report::auxiliaries`](crate::Report::auxiliaries): of screws, gears, racks, drivers of
    /// angles, torsional springs and actuators) stay as they are in the state. A run,
    /// [`MechanismExt::assemble`] and [`Mechanism::rewrap`] take the whole turns from there and
    /// the rest from the orientations: right for a pose that is less than half a turn away from the
    /// one before. For any other say the angles too, with [`MechanismExt::set_unwrapped_angles`].
    fn set_pose<S: Scalar>(state: &mut Self::State<S>, body: BodyHandle<Self>, pose: Pose<S>) {
        let Some(info) = body.info() else { return };
        let coordinates = state.coordinates_mut().as_mut_slice();
        write(coordinates, info.coordinate, pose.position.into());
        if let Some((_, place)) = body.orientation() {
            let [x, y, z, w] = pose.orientation.coords.into();
            let axes = Self::user_axes(body.index()).map(S::constant);
            let p = product(&normalised_or_zero(&[w, x, y, z]), &conjugate(&axes));
            write(coordinates, place, p);
        }
    }

    /// The angles (rad) that a joint or a force counts turns of, as they stand in the state: in the
    /// order of its definition, zero in the reference configuration, without elements where it
    /// counts none.
    fn unwrapped_angles<S: Scalar, E: CountsTurns<Self>>(
        state: &Self::State<S>,
        element: E,
    ) -> &[S] {
        let angles = state.coordinates().as_slice().get(element.counters());
        angles.unwrap_or(&[])
    }

    /// Sets the angles (rad) that a joint or a force counts turns of, see
    /// [`MechanismExt::unwrapped_angles`]: one for most, two for a `Gear` (of `j`, of `i`).
    ///
    /// Only the count of turns is taken from them: whatever uses the state takes the angles that
    /// its orientations have and that are nearest to these, which may be off by up to half a turn.
    ///
    /// # Errors
    /// [`AssemblyFault::CountedAngles`] for another number of angles than the joint or force
    /// counts; the state is then as before.
    fn set_unwrapped_angles<S: Scalar, E: CountsTurns<Self>>(
        state: &mut Self::State<S>,
        element: E,
        angles: &[S],
    ) -> Result<(), AssemblyFault> {
        let coordinates = state.coordinates_mut().as_mut_slice();
        let places = coordinates.get_mut(element.counters()).unwrap_or(&mut []);
        if places.len() != angles.len() {
            return Err(AssemblyFault::CountedAngles {
                element: element.element(),
                counted: places.len(),
                given: angles.len(),
            });
        }
        for (place, &angle) in places.iter_mut().zip(angles) {
            *place = angle;
        }
        Ok(())
    }

    /// The value of a state of the user's own, in the unit that its rate and its start have.
    fn state_value<S: Scalar>(state: &Self::State<S>, of: StateHandle<Self>) -> S {
        let [value] = read(state.coordinates().as_slice(), of.coordinate());
        value
    }

    /// Sets a state of the user's own. It moves no body.
    fn set_state_value<S: Scalar>(state: &mut Self::State<S>, of: StateHandle<Self>, value: S) {
        write(
            state.coordinates_mut().as_mut_slice(),
            of.coordinate(),
            [value],
        );
    }

    /// Sets the angle of a joint (rad), as [`View::angle`](crate::View::angle) reads it: what the
    /// joint carries in the spanning tree ([`Report::carriers`](crate::Report::carriers)), and all
    /// that hangs on that, turns about the joint's axis as one body.
    ///
    /// No other joint of the tree is opened, the velocities of all joints stay what they were, and
    /// so angles may be set in any order. A joint that closes a loop is opened: see
    /// [`MechanismExt::assemble`]. Angles that count turns go along: by the whole way where the
    /// joint, or an element between the same two bodies, counts turns of this angle, else by the
    /// nearest one.
    ///
    /// # Errors
    /// [`AssemblyFault::CarriesNothing`] for a joint that carries no body: it closes a loop, or
    /// drives what another one carries. [`AssemblyFault::NotFree`] for one whose angle is not that
    /// of its motion. [`StepFault::StateNotFinite`](crate::error::StepFault::StateNotFinite), a
    /// parameter that is not acceptable. The state is then as before.
    fn set_angle<S: Real, J: HasAngle>(
        &self,
        state: &mut Self::State<S>,
        joint: JointHandle<Self, J>,
        angle: S,
    ) -> Result<(), Fault> {
        with_subtree(self, state, joint.index(), |behind| behind.set_angle(angle))
    }

    /// Sets the rate of the angle of a joint (rad/s), as
    /// [`View::angle_rate`](crate::View::angle_rate) reads it, in the present configuration: what
    /// hangs on the joint goes along as one body. Rates of other joints stay what they were.
    ///
    /// # Errors
    /// As [`MechanismExt::set_angle`].
    fn set_angle_rate<S: Real, J: HasAngle>(
        &self,
        state: &mut Self::State<S>,
        joint: JointHandle<Self, J>,
        rate: S,
    ) -> Result<(), Fault> {
        with_subtree(self, state, joint.index(), |behind| {
            behind.set_angle_rate(rate)
        })
    }

    /// Sets the displacement of a joint (m), as [`View::displacement`](crate::View::displacement)
    /// reads it: what hangs on the joint is moved along its direction as one body, see
    /// [`MechanismExt::set_angle`].
    ///
    /// # Errors
    /// As [`MechanismExt::set_angle`].
    fn set_displacement<S: Real, J: HasDisplacement>(
        &self,
        state: &mut Self::State<S>,
        joint: JointHandle<Self, J>,
        displacement: S,
    ) -> Result<(), Fault> {
        with_subtree(self, state, joint.index(), |behind| {
            behind.set_displacement(displacement)
        })
    }

    /// Sets the rate of the displacement of a joint (m/s), as
    /// [`View::displacement_rate`](crate::View::displacement_rate) reads it, in the present
    /// configuration.
    ///
    /// # Errors
    /// As [`MechanismExt::set_angle`].
    fn set_displacement_rate<S: Real, J: HasDisplacement>(
        &self,
        state: &mut Self::State<S>,
        joint: JointHandle<Self, J>,
        rate: S,
    ) -> Result<(), Fault> {
        with_subtree(self, state, joint.index(), |behind| {
            behind.set_displacement_rate(rate)
        })
    }

    /// Sets how the second body of a ball joint is turned against the first, from the reference
    /// configuration on: 1 is the reference one, and where the first body stands as described, the
    /// second is turned by this rotation, global axes. What hangs on the joint turns about its
    /// point as one body, see [`MechanismExt::set_angle`].
    ///
    /// The quaternion may have any length but zero, which is refused with
    /// [`StepFault::StateNotFinite`](crate::error::StepFault::StateNotFinite).
    ///
    /// # Errors
    /// As [`MechanismExt::set_angle`]; [`AssemblyFault::NotFree`] for a joint that does not leave
    /// all rotations free.
    fn set_relative_orientation<S: Real, J: Joint>(
        &self,
        state: &mut Self::State<S>,
        joint: JointHandle<Self, J>,
        orientation: Quaternion<S>,
    ) -> Result<(), Fault> {
        let [x, y, z, w] = orientation.coords.into();
        with_subtree(self, state, joint.index(), |behind| {
            behind.set_orientation(&[w, x, y, z])
        })
    }

    /// The velocity of the centre of mass (m/s, global).
    fn velocity<S: Scalar>(state: &Self::State<S>, body: BodyHandle<Self>) -> Vector3<S> {
        Vector3::from(velocity(state, body))
    }

    /// Sets the velocity of the centre of mass (m/s, global).
    fn set_velocity<S: Scalar>(
        state: &mut Self::State<S>,
        body: BodyHandle<Self>,
        velocity: Vector3<S>,
    ) {
        if let Some(info) = body.info() {
            write(
                state.velocities_mut().as_mut_slice(),
                info.velocity,
                velocity.into(),
            );
        }
    }

    /// The angular velocity (rad/s) along the user's body axes.
    fn angular_velocity<S: Scalar>(state: &Self::State<S>, body: BodyHandle<Self>) -> Vector3<S> {
        let axes = Self::user_axes(body.index()).map(S::constant);
        Vector3::from(rotate_back(&axes, &spin(state, body)))
    }

    /// Sets the angular velocity (rad/s) along the user's body axes.
    fn set_angular_velocity<S: Scalar>(
        state: &mut Self::State<S>,
        body: BodyHandle<Self>,
        angular_velocity: Vector3<S>,
    ) {
        if let Some((info, _)) = body.orientation() {
            let axes = Self::user_axes(body.index()).map(S::constant);
            let w = rotate(&axes, &angular_velocity.into());
            write(state.velocities_mut().as_mut_slice(), info.velocity + 3, w);
        }
    }

    /// The angular velocity (rad/s) along the global axes.
    fn angular_velocity_global<S: Scalar>(
        state: &Self::State<S>,
        body: BodyHandle<Self>,
    ) -> Vector3<S> {
        Vector3::from(global_spin(state, body))
    }

    /// Sets the angular velocity (rad/s) along the global axes, for the present orientation.
    fn set_angular_velocity_global<S: Scalar>(
        state: &mut Self::State<S>,
        body: BodyHandle<Self>,
        angular_velocity: Vector3<S>,
    ) {
        let turned = rotate_back(&Self::orientation(state, body), &angular_velocity.into());
        Self::set_angular_velocity(state, body, Vector3::from(turned));
    }

    /// A point of a body (m, global), given from the centre of mass along the user's body axes (m).
    fn point<S: Scalar>(
        state: &Self::State<S>,
        body: BodyHandle<Self>,
        point: Vector3<S>,
    ) -> Vector3<S> {
        let [x, y, z] = position(state, body);
        let [sx, sy, sz] = rotate(&Self::orientation(state, body), &point.into());
        Vector3::new(x + sx, y + sy, z + sz)
    }

    /// The velocity of a point of a body (m/s, global), given from the centre of mass along the
    /// user's body axes (m).
    fn point_velocity<S: Scalar>(
        state: &Self::State<S>,
        body: BodyHandle<Self>,
        point: Vector3<S>,
    ) -> Vector3<S> {
        let arm = rotate(&Self::orientation(state, body), &point.into());
        let [x, y, z] = velocity(state, body);
        let [sx, sy, sz] = cross(&global_spin(state, body), &arm);
        Vector3::new(x + sx, y + sy, z + sz)
    }
}

impl<M: Mechanism> MechanismExt for M {}

/// The state with what hangs on a joint in the spanning tree set; as before where that fails.
fn with_subtree<S: Real, M: Mechanism>(
    mechanism: &M,
    state: &mut M::State<S>,
    joint: usize,
    set: impl FnOnce(Subtree<'_, S, M>) -> Result<M::State<S>, Fault>,
) -> Result<(), Fault> {
    let constants = mechanism.constants::<S>()?;
    *state = set(Subtree::of(&constants, state, joint)?)?;
    Ok(())
}

/// `r` (m, global).
pub(crate) fn position<S: Scalar, M: Mechanism>(
    state: &M::State<S>,
    body: BodyHandle<M>,
) -> [S; 3] {
    let place = body.info().map_or(usize::MAX, |info| info.coordinate);
    read(state.coordinates().as_slice(), place)
}

/// `v` (m/s, global).
fn velocity<S: Scalar, M: Mechanism>(state: &M::State<S>, body: BodyHandle<M>) -> [S; 3] {
    let place = body.info().map_or(usize::MAX, |info| info.velocity);
    read(state.velocities().as_slice(), place)
}

/// `w` (rad/s, principal axes).
fn spin<S: Scalar, M: Mechanism>(state: &M::State<S>, body: BodyHandle<M>) -> [S; 3] {
    let place = body
        .orientation()
        .map_or(usize::MAX, |(info, _)| info.velocity + 3);
    read(state.velocities().as_slice(), place)
}

/// `A(p) w` (rad/s, global).
fn global_spin<S: Scalar, M: Mechanism>(state: &M::State<S>, body: BodyHandle<M>) -> [S; 3] {
    let w = M::angular_velocity(state, body);
    rotate(&M::orientation(state, body), &w.into())
}
