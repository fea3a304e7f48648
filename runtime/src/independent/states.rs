//! From coordinates and rates to states, and back.

use core::f64::consts::TAU;

use nalgebra::SVector;

use super::equations::finite;
use super::partition::{Magnitude, Partition, at, velocities};
use super::{Equations, IndependentCoordinates};
use crate::assembly::assembled;
use crate::assembly::subtree::Subtree;
use crate::constraints::projection::Projection;
use crate::error::Fault;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_kernels::{Freedom, JointMotion};
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::relative::bodies_of;
use crate::state::vector::{Array, MovingState, Vector as _};

impl<M: JointRates, const N: usize, S: Real + Magnitude> IndependentCoordinates<M, N, S> {
    /// The coordinates (rad, m) at a state, zero in the reference configuration: an angle is from
    /// `-pi` to `pi`, that of a screw counts turns.
    ///
    /// # Errors
    /// [`Fault::NotFree`] for a chosen component of an angular velocity, which is the rate of no
    /// coordinate.
    pub fn positions(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault> {
        let mut positions = [S::zero(); N];
        for (position, &place) in positions.iter_mut().zip(&self.equations.places) {
            let (number, motion) = motion_at::<M>(place)?;
            let joint = motion.joint;
            *position = M::JOINT_REPORT
                .coordinate(number, state)
                .ok_or(Fault::NotFree { joint })?;
        }
        Ok(SVector::from(positions))
    }

    /// The state with these coordinates (rad, m) and rates (rad/s, m/s). Loops are closed on the
    /// branch of the described state, see
    /// [`MechanismExt::assemble`](crate::MechanismExt::assemble).
    ///
    /// # Errors
    /// What [`MechanismExt::set_angle`](crate::MechanismExt::set_angle) and
    /// [`MechanismExt::assemble`](crate::MechanismExt::assemble) refuse; a choice that fails there.
    pub fn state(
        &self,
        positions: impl Into<SVector<S, N>>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        let from = M::initial_state(&self.constants);
        self.state_from(&from, positions.into().into(), rates.into().into())
    }

    /// The same on the branch of another state.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::state`].
    pub fn state_near(
        &self,
        near: &M::JointState<S>,
        positions: impl Into<SVector<S, N>>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        let from = self.bodies(near);
        self.state_from(&from, positions.into().into(), rates.into().into())
    }

    fn state_from(
        &self,
        from: &M::State<S>,
        positions: [S; N],
        rates: [S; N],
    ) -> Result<M::JointState<S>, Fault> {
        let Equations {
            constants,
            places,
            time,
        } = &self.equations;
        let mut bodies = *from;
        for (position, &place) in positions.into_iter().zip(places) {
            let (_, motion) = motion_at::<M>(place)?;
            let refused = Fault::NotFree {
                joint: motion.joint,
            };
            let mut joints = M::REPORT.joints.iter();
            let joint = joints.position(|info| info.name == motion.joint);
            let joint = joint.ok_or(refused)?;
            let subtree = Subtree::<S, M>::of(&self.constants, &bodies, joint)?;
            bodies = match motion.freedom {
                Freedom::Turn { .. } | Freedom::Screw { .. } => subtree.set_angle(position)?,
                Freedom::Slide => subtree.set_displacement(position)?,
                Freedom::Ball => return Err(refused),
            };
        }
        if !M::JOINT_REPORT.closing.is_empty() {
            let projection = Projection::default();
            assembled::<S, M>(&projection, &self.constants, *time, &mut bodies, from)?;
        }
        let mut state = M::joint_state(constants, &bodies);
        if !M::JOINT_REPORT.closing.is_empty() {
            state = self.moved_to(&state, &positions)?;
        }
        self.with_rates(&state, rates)
    }

    /// A state that is nearly there, moved along the constraints so that the chosen coordinates
    /// have these values to round-off: assembly closes loops by moving all of them a little.
    fn moved_to(
        &self,
        state: &M::JointState<S>,
        positions: &[S; N],
    ) -> Result<M::JointState<S>, Fault> {
        let Equations {
            constants,
            places,
            time,
        } = &self.equations;
        let mut left = [S::zero(); N];
        let present = self.positions(state)?;
        let pairs = positions.iter().zip(present.iter()).zip(places);
        for (left, ((&wanted, &present), &place)) in left.iter_mut().zip(pairs) {
            let (_, motion) = motion_at::<M>(place)?;
            *left = wanted - present;
            if matches!(motion.freedom, Freedom::Turn { .. }) {
                let turns = (*left * S::constant(TAU.recip())).round();
                *left = *left - turns * S::constant(TAU);
            }
        }
        let partition = self.equations.partition(state)?;
        let mut way = *state;
        write_rates::<M, N, S>(&partition, &left, false, &mut way);
        let way = M::joint_coordinate_rates(constants, *time, &way);
        Ok(state.plus([(S::one(), &way)]))
    }

    /// The same configuration with these rates (rad/s, m/s).
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    pub fn with_rates(
        &self,
        state: &M::JointState<S>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        let rates: SVector<S, N> = finite(rates.into().into())?;
        let partition = self.equations.partition(state)?;
        let mut state = *state;
        write_rates::<M, N, S>(&partition, &rates.into(), true, &mut state);
        Ok(state)
    }

    /// How the bodies stand and move in a state, to be read by
    /// [`Viewed::view`](crate::prelude::Viewed::view).
    #[must_use]
    pub fn bodies(&self, state: &M::JointState<S>) -> M::State<S> {
        bodies_of::<S, M>(&self.equations.constants, state)
    }

    /// The state in which bodies stand and move so.
    #[must_use]
    pub fn of_bodies(&self, bodies: &M::State<S>) -> M::JointState<S> {
        M::joint_state(&self.equations.constants, bodies)
    }
}

/// Writes the velocities of a state that belong to chosen rates; with those of drivers, if wanted.
pub(super) fn write_rates<M: JointRates, const N: usize, S: Scalar>(
    partition: &Partition<M, N, S>,
    rates: &[S; N],
    are_driven: bool,
    state: &mut M::JointState<S>,
) {
    let mut all = M::JointVelocities::<S>::zeros();
    if are_driven {
        all = partition.drift;
    }
    for (column, &rate) in partition.columns.iter().zip(rates) {
        let places = all.as_mut_slice().iter_mut().zip(column.as_slice());
        places.for_each(|(place, &entry)| *place = entry.fused(rate, *place));
    }
    put_velocities::<M, S>(&all, state);
}

/// Writes the velocities of a state whose joints have these rates.
pub(super) fn put_velocities<M: JointRates, S: Scalar>(
    rates: &M::JointVelocities<S>,
    state: &mut M::JointState<S>,
) {
    let velocities = velocities::<M, S>(rates);
    for (place, velocity) in state.rates_slice_mut().iter_mut().enumerate() {
        *velocity = at(velocities.as_slice(), place);
    }
}

/// The motion that a rate belongs to, and its number.
fn motion_at<M: JointRates>(rate: usize) -> Result<(usize, &'static JointMotion), Fault> {
    let motions = M::JOINT_REPORT.motions.iter().enumerate();
    let before = motions.rev().find(|(_, motion)| motion.velocity <= rate);
    before.ok_or(Fault::NotFree { joint: "" })
}
