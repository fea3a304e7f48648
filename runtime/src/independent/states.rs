//! From coordinates and rates to states, and back.

use core::f64::consts::TAU;

use nalgebra::SVector;

use super::determined::Needs;
use super::equations::are_finite;
use super::partition::{Partition, put_velocities, write_rates};
use super::{Equations, IndependentCoordinates};
use crate::assembly::assembled;
use crate::constraints::projection::Projection;
use crate::error::step::counted;
use crate::error::{AnalysisFault, AssemblyFault, Fault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::joint_kernels::{Freedom, JointMotion};
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::relative::{bodies_of, joint_state_of, rates_of_motion};
use crate::mechanism::turns;
use crate::state::vector::{Array, MovingState, Vector as _};

/// What an angle is turned at once while loops are closed (rad).
const STRIDE: f64 = 1.0;
/// As many strides as anybody waits for.
const MANY: f64 = 1e5;
/// Corrections that close loops.
const CORRECTIONS: usize = 25;

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// The coordinates (rad, m) at a state, zero in the reference configuration: the angle of a
    /// joint over all turns that the state has counted, as [`View::angle`](crate::View::angle)
    /// reads it. An angle of a joint that has several, such as a universal joint, is from `-pi` to
    /// `pi`.
    ///
    /// # Errors
    /// [`AnalysisFault::NoPosition`] for a chosen component of an angular velocity, which is the
    /// rate of no coordinate.
    pub fn positions(&self, state: &M::JointState<S>) -> Result<SVector<S, N>, Fault> {
        self.positions_of(state).map(SVector::from)
    }

    /// The same of a state of other numbers, such as those that carry derivatives.
    pub(crate) fn positions_of<T: Real>(&self, state: &M::JointState<T>) -> Result<[T; N], Fault> {
        let mut positions = [T::zero(); N];
        let places = &self.equations.places;
        for (position, (&place, counted)) in positions.iter_mut().zip(places.with_counted()) {
            let (number, motion) = motion_at::<M>(place)?;
            let joint = motion.mover();
            let coordinate = M::JOINT_REPORT.coordinate(number, state);
            let coordinate =
                coordinate.ok_or(Fault::Analysis(AnalysisFault::NoPosition { joint }))?;
            *position = match counted.and_then(|place| state.turns().get(place)) {
                Some(&counted) => turns::nearest(coordinate, counted),
                None => coordinate,
            };
        }
        Ok(positions)
    }

    /// The state with these coordinates (rad, m) and rates (rad/s, m/s).
    ///
    /// Loops are closed on the branch of the described state, as by
    /// [`MechanismExt::assemble`](crate::MechanismExt::assemble). That is done in strides of one
    /// radian, so that what is geared to a coordinate turns as often as it has to. Limits of the
    /// description do not count; [`IndependentCoordinates::check_limits`] asks for them.
    ///
    /// # Errors
    /// [`StepFault::StateNotFinite`]; [`AnalysisFault::NoPosition`] for a chosen component of an
    /// angular velocity; what
    /// [`MechanismExt::assemble`](crate::MechanismExt::assemble) refuses; a choice that fails on
    /// the way.
    #[inline]
    pub fn state(
        &self,
        positions: impl Into<SVector<S, N>>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        let [positions, rates]: [SVector<S, N>; 2] = [positions.into(), rates.into()];
        if let Some((from, begin)) = &self.described {
            let (positions, rates) = (given::<S, N>(positions.into())?, given(rates.into())?);
            let begin = SVector::from(*begin);
            let way = positions.zip_map(&begin, |wanted, begin| wanted - begin);
            return self.moved(from, &begin, &way, rates);
        }
        let described = M::initial_state(&self.constants);
        let mut from = self.of_bodies(&described);
        if !M::JOINT_REPORT.closing.is_empty() {
            let mut bodies = described;
            let (projection, time) = (Projection::default(), self.equations.time);
            assembled::<S, M>(&projection, &self.constants, time, &mut bodies, &described)?;
            from = self.of_bodies(&bodies);
        }
        self.state_from(&from, false, positions.into(), rates.into())
    }

    /// Finds the described state of a tree, which parameters change.
    pub(super) fn describe(&mut self) {
        self.described = None;
        if M::JOINT_REPORT.closing.is_empty() {
            let described = self.of_bodies(&M::initial_state(&self.constants));
            let positions = self.positions_of(&described).ok();
            self.described = positions.map(|positions| (described, positions));
        }
    }

    /// A state of a tree on a way from another one, whose coordinates are known.
    #[inline]
    fn moved(
        &self,
        from: &M::JointState<S>,
        begin: &SVector<S, N>,
        way: &SVector<S, N>,
        rates: SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let mut state = self.turned(from, &(*way).into());
        if M::JOINT_REPORT.rewraps {
            let mut bodies = self.bodies(&state);
            M::rewrap(&self.constants, &mut bodies);
            state = self.of_bodies(&bodies);
        }
        let positions = begin.iter().zip(way).map(|(&begin, &way)| begin + way);
        self.equations.places.count(positions, state.turns_mut());
        self.with_rates(&state, rates)
    }

    /// The same on the branch of another state, by the nearest turns: of an angle and those that
    /// differ from it by whole turns, the one is taken that is nearest to the other state's.
    ///
    /// # Errors
    /// As [`IndependentCoordinates::state`].
    pub fn state_near(
        &self,
        near: &M::JointState<S>,
        positions: impl Into<SVector<S, N>>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        self.state_from(near, true, positions.into().into(), rates.into().into())
    }

    fn state_from(
        &self,
        from: &M::JointState<S>,
        is_nearest: bool,
        positions: [S; N],
        rates: [S; N],
    ) -> Result<M::JointState<S>, Fault> {
        let [positions, rates]: [SVector<S, N>; 2] = [given(positions)?, given(rates)?];
        let mut state = *from;
        let begin = self.positions(&state)?;
        let way = if is_nearest {
            self.left(&state, &positions)?.into()
        } else {
            positions.zip_map(&begin, |wanted, present| wanted - present)
        };
        if M::JOINT_REPORT.closing.is_empty() {
            return self.moved(from, &begin, &way, rates);
        }
        // In steps, so that what is geared to a coordinate is taken along over any number of turns.
        let angles = self.angles(&way);
        let widest = angles.into_iter().fold(S::zero(), S::max);
        let steps = (widest * S::constant(1.0 / STRIDE)).to_f64();
        if steps > MANY {
            return Err(Fault::Assembly(AssemblyFault::WayEnds {
                joint: angles
                    .iter()
                    .position(|&angle| angle == widest)
                    .map(|number| self.joint(number)),
                share: MANY / steps,
            }));
        }
        let steps = 1 + steps as u32;
        for step in 1..=steps {
            let share = S::constant(f64::from(step) / f64::from(steps));
            let wanted = SVector::from_fn(|row, _| way[row].fused(share, begin[row]));
            let wanted = if step == steps { positions } else { wanted };
            let next = self.stepped(&state, &wanted).or_else(|fault| {
                let followed = self.followed(&state, &wanted);
                followed.map_err(|own| match own {
                    Fault::Analysis(AnalysisFault::NotDetermined { .. }) => own,
                    _ => fault,
                })
            });
            let next = next.map_err(|fault| match fault {
                Fault::Assembly(AssemblyFault::WayEnds { joint, share }) => {
                    Fault::Assembly(AssemblyFault::WayEnds {
                        joint,
                        share: (f64::from(step - 1) + share) / f64::from(steps),
                    })
                }
                fault => fault,
            })?;
            let [before, mut bodies] = [&state, &next].map(|state| self.bodies(state));
            turns::count::<S, M>(&self.constants, &before, S::zero(), &mut bodies);
            state = next;
            turns::copy(&bodies, &mut state);
        }
        self.with_rates(&state, rates)
    }

    /// How far angles turn (rad), of a way.
    fn angles(&self, way: &SVector<S, N>) -> [S; N] {
        let mut angles = [S::zero(); N];
        let places = angles
            .iter_mut()
            .zip(way.iter())
            .zip(self.equations.places.iter());
        for ((angle, &way), &place) in places {
            let freedom = motion_at::<M>(place).map(|(_, motion)| motion.freedom);
            if !matches!(freedom, Ok(Freedom::Slide)) {
                *angle = way.abs();
            }
        }
        angles
    }

    /// A state whose chosen joints are moved by a way while the others of the tree stay.
    #[inline]
    fn turned(&self, state: &M::JointState<S>, way: &[S; N]) -> M::JointState<S> {
        let Equations {
            constants,
            places,
            time,
            ..
        } = &self.equations;
        let mut rates = M::JointVelocities::<S>::zeros();
        places.put(way, rates.as_mut_slice());
        let mut moving = *state;
        put_velocities::<M, S>(&rates, &mut moving);
        let slope = rates_of_motion::<S, M>(constants, *time, &moving);
        state.plus([(S::one(), &slope)])
    }

    /// A state near another one, with loops closed and these coordinates.
    fn stepped(
        &self,
        from: &M::JointState<S>,
        wanted: &SVector<S, N>,
    ) -> Result<M::JointState<S>, Fault> {
        let left = self.left(from, wanted)?;
        let before = self.bodies(from);
        let mut bodies = self.bodies(&self.turned(from, &left));
        let projection = Projection::default();
        let time = self.equations.time;
        assembled::<S, M>(&projection, &self.constants, time, &mut bodies, &before)?;
        let state = self.of_bodies(&bodies);
        // Assembly closes loops by moving everything a little: back to the coordinates, along the
        // constraints.
        let left = self.left(&state, wanted)?;
        let partition = self.equations.partition(&state)?;
        let mut way = state;
        write_rates::<M, N, S>(&partition, &left, false, &mut way);
        let way = rates_of_motion::<S, M>(&self.equations.constants, time, &way);
        self.closed(state.plus([(S::one(), &way)]))
    }

    /// The state near one in which loops are closed, at the same chosen coordinates.
    pub(super) fn closed(&self, state: M::JointState<S>) -> Result<M::JointState<S>, Fault> {
        self.closed_by(state).map(|(state, _)| state)
    }

    /// The same, and how far the first correction led (rad, or lengths of the mechanism).
    pub(super) fn closed_by(
        &self,
        mut state: M::JointState<S>,
    ) -> Result<(M::JointState<S>, f64), Fault> {
        if M::JOINT_REPORT.closing.is_empty() {
            return Ok((state, 0.0));
        }
        let Equations {
            constants, time, ..
        } = &self.equations;
        let (mut before, mut first) = (S::one(), 0.0);
        for taken in 0..CORRECTIONS {
            let Partition {
                closing, standing, ..
            } = self.equations.partition(&state)?;
            let mut open = S::zero();
            for (place, &number) in closing.as_slice().iter().enumerate() {
                open = Real::max(open, number.abs().quotient(self.equations.scale(place)));
            }
            // Near a singular configuration corrections stay large though nothing is open.
            let is_small = open < S::EPSILON.powf(0.75) || self.equations.is_resolved(&standing);
            if open <= S::EPSILON || is_small && open * S::constant(2.0) > before {
                return Ok((state, first));
            }
            if taken == 0 {
                first = open.to_f64();
            }
            if open.to_f64().is_nan() || open > before {
                return Err(Fault::Step(StepFault::NotConverged {
                    iterations: counted(taken),
                    residual: open.to_f64(),
                    joint: None,
                    alpha: None,
                }));
            }
            before = open;
            let mut slope = state;
            put_velocities::<M, S>(&closing, &mut slope);
            let slope = rates_of_motion::<S, M>(constants, *time, &slope);
            state = state.plus([(S::one(), &slope)]);
        }
        Ok((state, first))
    }

    /// What is left of the way to coordinates, by the nearest turn.
    pub(super) fn left(
        &self,
        state: &M::JointState<S>,
        wanted: &SVector<S, N>,
    ) -> Result<[S; N], Fault> {
        let present = self.positions(state)?;
        let left = wanted.zip_map(&present, |wanted, present| wanted - present);
        let mut left: [S; N] = left.into();
        for (left, &place) in left.iter_mut().zip(self.equations.places.iter()) {
            let (_, motion) = motion_at::<M>(place)?;
            if matches!(motion.freedom, Freedom::Turn { .. }) {
                let turns = (*left * S::constant(TAU.recip())).round();
                *left = *left - turns * S::constant(TAU);
            }
        }
        Ok(left)
    }

    /// The same configuration with these rates (rad/s, m/s).
    ///
    /// # Errors
    /// As [`IndependentCoordinates::mass`].
    #[inline]
    pub fn with_rates(
        &self,
        state: &M::JointState<S>,
        rates: impl Into<SVector<S, N>>,
    ) -> Result<M::JointState<S>, Fault> {
        let rates: [S; N] = given::<S, N>(rates.into().into())?.into();
        let mut state = *state;
        // Those it has leave their round-off in what drivers move.
        state.rates_slice_mut().fill(S::zero());
        if M::JOINT_REPORT.closing.is_empty() {
            let mut all = M::JointVelocities::<S>::zeros();
            self.equations.places.put(&rates, all.as_mut_slice());
            put_velocities::<M, S>(&all, &mut state);
            return Ok(state);
        }
        let partition = self.known(&state, Needs::Rates)?;
        write_rates::<M, N, S>(&partition, &rates, true, &mut state);
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
        let mut counted = *bodies;
        turns::count::<S, M>(&self.constants, bodies, S::zero(), &mut counted);
        joint_state_of::<S, M>(&self.equations.constants, &counted)
    }
}

/// Numbers that a state may hold.
#[inline]
fn given<S: Real, const N: usize>(numbers: [S; N]) -> Result<SVector<S, N>, Fault> {
    if are_finite(&numbers) {
        Ok(SVector::from(numbers))
    } else {
        Err(Fault::Step(StepFault::StateNotFinite))
    }
}

/// The motion that a rate belongs to, and its number.
fn motion_at<M: JointRates>(rate: usize) -> Result<(usize, &'static JointMotion), Fault> {
    let motion = M::JOINT_REPORT.motion_of_rate(rate);
    motion.ok_or(Fault::Analysis(AnalysisFault::NoPosition { joint: "" }))
}
