//! Angles and displacements of joints, to be set in a state of the bodies.
//!
//! What hangs on a joint in the spanning tree moves with it as one body, and so do its velocities,
//! as seen from what carries it. Axis, direction and point are read from the joint itself: its
//! readings are linear in the velocities, and its rows tell whether it leaves the motion free.

use core::f64::consts::TAU;

use crate::constraints::extent::farthest;
use crate::error::Fault;
use crate::math::quaternion::{
    conjugate, from_rotation_vector, normalised, product, rotate, rotate_back,
};
use crate::math::scalar::Real;
use crate::math::vec3::square;
use crate::math::vec3::{cross, minus, read, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::report::{Block, BodyKind, Carrier, JointInfo};
use crate::state::vector::{Array, StateParts, Vector};

/// A row may change by so much of what its terms would make of it, if a motion is one that the
/// joint leaves free.
const FREE: f64 = 1e-3;

/// The velocities of what hangs on a joint, which moves as one body against what carries it: global
/// axes.
#[derive(Clone, Copy)]
struct Twist<S> {
    /// Angular velocity.
    turn: [S; 3],
    /// A point.
    point: [S; 3],
    /// Its velocity.
    slide: [S; 3],
}

impl<S: Real> Twist<S> {
    fn scaled(&self, factor: S) -> Self {
        Self {
            turn: self.turn.map(|x| x * factor),
            point: self.point,
            slide: self.slide.map(|x| x * factor),
        }
    }
}

/// A body that stands and moves somewhere: global axes.
#[derive(Clone, Copy)]
struct Moving<S> {
    position: [S; 3],
    velocity: [S; 3],
    spin: [S; 3],
}

/// A joint that carries a body, at a state.
pub(crate) struct Carrying<'a, S: Real, M: Mechanism> {
    constants: &'a M::Constants<S>,
    joint: usize,
    info: &'static JointInfo,
    /// The body, by its place in the report.
    body: usize,
    /// The state, with Euler parameters of length 1.
    state: M::State<S>,
}

impl<'a, S: Real, M: Mechanism> Carrying<'a, S, M> {
    /// A joint by its index.
    pub(crate) fn of(
        constants: &'a M::Constants<S>,
        state: &M::State<S>,
        joint: usize,
    ) -> Result<Self, Fault> {
        let carriers = M::REPORT.carriers;
        let carries = |carrier: &Carrier| carrier.joint == Some(joint);
        let body = carriers.iter().position(carries);
        let (Some(info), Some(body)) = (M::REPORT.joints.get(joint), body) else {
            return Err(closes::<M>(joint));
        };
        Ok(Self {
            constants,
            joint,
            info,
            body,
            state: with_unit_orientations::<S, M>(state),
        })
    }

    /// Sets the angle (rad).
    pub(crate) fn set_angle(mut self, angle: S) -> Result<M::State<S>, Fault> {
        let axis = self.axis()?;
        let parts = M::joint_angle(self.constants, &self.state, self.joint);
        let mut now = parts.angle();
        let mut change = angle - now;
        if parts.turns.is_none() {
            match self.turns(&axis) {
                Some(counted) => {
                    now = counted(now);
                    change = angle - now;
                }
                // No element counts them: the nearest way.
                None => {
                    let turns = (change * S::constant(TAU.recip())).round();
                    change = change - turns * S::constant(TAU);
                }
            }
        }
        self.displace(&axis, change);
        self.finite()
    }

    /// Sets the rate of the angle (rad/s).
    pub(crate) fn set_angle_rate(mut self, rate: S) -> Result<M::State<S>, Fault> {
        let axis = self.axis()?;
        let now = M::joint_angle(self.constants, &self.state, self.joint).rate;
        self.accelerate(&axis.scaled(rate - now));
        self.finite()
    }

    /// Sets the displacement (m).
    pub(crate) fn set_displacement(mut self, displacement: S) -> Result<M::State<S>, Fault> {
        let direction = self.direction()?;
        self.displace(&direction, displacement - self.displacement());
        let left = displacement - self.displacement();
        let size = S::one() + displacement.abs();
        if left.abs() > S::EPSILON.sqrt() * size {
            // Its definition's displacement is not along the motion.
            return Err(self.holds());
        }
        self.finite()
    }

    /// Sets the rate of the displacement (m/s).
    pub(crate) fn set_displacement_rate(mut self, rate: S) -> Result<M::State<S>, Fault> {
        let direction = self.direction()?;
        let now = M::joint_displacement(self.constants, S::zero(), &self.state, self.joint).rate;
        self.accelerate(&direction.scaled(rate - now));
        self.finite()
    }

    /// Turns the second body against the first, so that it is turned by these Euler parameters from
    /// how it stands in the reference configuration; global axes there.
    pub(crate) fn set_orientation(mut self, orientation: &[S; 4]) -> Result<M::State<S>, Fault> {
        let [first, second] = *self.info.bodies else {
            return Err(self.holds());
        };
        let described = M::initial_state(self.constants);
        let stood = |body| orientation_of::<S, M>(&described, body);
        let stands = |body| orientation_of::<S, M>(&self.state, body);
        // From global axes in the reference configuration to where they are now, for either body.
        let turned = |body| product(&stands(body), &conjugate(&stood(body)));
        let wanted = if Some(self.body) == second {
            let to = product(&turned(first), &normalised(orientation));
            product(&to, &conjugate(&turned(second)))
        } else {
            let to = product(&turned(second), &conjugate(&normalised(orientation)));
            product(&to, &conjugate(&turned(first)))
        };
        let [e0, e1, e2, e3] = wanted;
        let vector = [e1, e2, e3];
        let sine = square(&vector).sqrt();
        let angle = S::constant(2.0) * sine.atan2(e0);
        let (one, zero) = (S::one(), S::zero());
        let point = self.centre(&[[one, zero, zero], [zero, one, zero], [zero, zero, one]])?;
        if sine > S::zero() {
            let axis = Twist {
                turn: vector.map(|x| x.quotient(sine)),
                point,
                slide: [S::zero(); 3],
            };
            self.displace(&axis, angle);
        }
        self.finite()
    }

    fn displacement(&self) -> S {
        M::joint_displacement(self.constants, S::zero(), &self.state, self.joint).value
    }

    fn finite(self) -> Result<M::State<S>, Fault> {
        if self.state.is_finite() {
            Ok(self.state)
        } else {
            Err(Fault::StateNotFinite)
        }
    }

    fn holds(&self) -> Fault {
        Fault::NotFree {
            joint: self.info.name,
        }
    }

    /// The body that carries the other one; `None` for the ground.
    fn carrier(&self) -> Option<usize> {
        let carrier = M::REPORT.carriers.get(self.body);
        carrier.and_then(|carrier| carrier.body)
    }

    /// Whether a body moves with the one that the joint carries.
    fn hangs(&self, body: usize) -> bool {
        let mut place = Some(body);
        // No way is longer than there are bodies.
        for _ in M::REPORT.bodies {
            match place {
                Some(found) if found == self.body => return true,
                Some(found) => {
                    place = M::REPORT
                        .carriers
                        .get(found)
                        .and_then(|carrier| carrier.body);
                }
                None => return false,
            }
        }
        false
    }

    /// What a reading of velocities is per unit of the carried body's, from a place of these on.
    fn gradient(&self, offset: usize, rate: impl Fn(&M::State<S>) -> S) -> [S; 3] {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        let at_rest = rate(&state);
        let body = M::REPORT.bodies.get(self.body);
        let first = body.map_or(usize::MAX, |body| body.velocity + offset);
        [0, 1, 2].map(|k| {
            let mut state = state;
            write(
                state.velocities_mut().as_mut_slice(),
                first.saturating_add(k),
                [S::one()],
            );
            rate(&state) - at_rest
        })
    }

    /// A turn about the joint's axis, by one radian of its angle; of a screw with its translation.
    fn axis(&self) -> Result<Twist<S>, Fault> {
        let rate = |state: &M::State<S>| M::joint_angle(self.constants, state, self.joint).rate;
        let axis = self.gradient(3, rate);
        let length = square(&axis).sqrt();
        if length <= S::zero() {
            return Err(self.holds());
        }
        let axis = axis.map(|x| x.quotient(length));
        let p = orientation_of::<S, M>(&self.state, Some(self.body));
        let turn = rotate(&p, &axis);
        match self.centre(&[turn]) {
            Ok(point) => Ok(Twist {
                turn,
                point,
                slide: [S::zero(); 3],
            }),
            Err(fault) => self.screw(&turn).ok_or(fault),
        }
    }

    /// A translation along the joint's direction, by one metre of its displacement; of a screw with
    /// its turn.
    fn direction(&self) -> Result<Twist<S>, Fault> {
        let rate = |state: &M::State<S>| {
            M::joint_displacement(self.constants, S::zero(), state, self.joint).rate
        };
        let slide = self.gradient(0, rate);
        let length = square(&slide);
        let twist = Twist {
            turn: [S::zero(); 3],
            point: [S::zero(); 3],
            slide: slide.map(|x| x.quotient(length)),
        };
        if length > S::zero() && self.is_free(&twist) {
            return Ok(twist);
        }
        let screw = self.screw(&slide.map(|x| x.quotient(length.sqrt())));
        let screw = screw.ok_or_else(|| self.holds())?;
        let advance = dot(&screw.slide, &slide);
        if advance.abs() > S::zero() {
            Ok(screw.scaled(advance.reciprocal()))
        } else {
            Err(self.holds())
        }
    }

    /// A turn about an axis with the translation along it that the rows demand; `None` where they
    /// leave none free.
    fn screw(&self, axis: &[S; 3]) -> Option<Twist<S>> {
        let zero = [S::zero(); 3];
        let mut points = self.points();
        points.find_map(|point| {
            let twist = |turn, slide| Twist { turn, point, slide };
            let turning = self.along_rows(&twist(*axis, zero));
            let sliding = self.along_rows(&twist(zero, *axis));
            let size = |along: S| along.abs();
            let rows = turning.map(|x| x.0).zip(sliding.map(|x| x.0));
            // Of all rows, the one that the translation changes most.
            let best = rows.fold((S::zero(), S::zero()), |best, row| {
                if size(row.1) > size(best.1) {
                    row
                } else {
                    best
                }
            });
            let (turned, slid) = best;
            let advance = -turned.quotient(slid);
            let screw = twist(*axis, axis.map(|x| x * advance));
            (size(slid) > S::zero() && self.is_free(&screw)).then_some(screw)
        })
    }

    /// The point of the joint about which it leaves turns free: that on the carried body or, where
    /// the body slides on it, that on the other one.
    fn centre(&self, turns: &[[S; 3]]) -> Result<[S; 3], Fault> {
        let mut points = self.points();
        let centre = points.find(|&point| {
            let about = |&turn: &[S; 3]| Twist {
                turn,
                point,
                slide: [S::zero(); 3],
            };
            turns.iter().all(|turn| self.is_free(&about(turn)))
        });
        centre.ok_or_else(|| self.holds())
    }

    /// The point of the joint on the carried body, then that on the other one.
    fn points(&self) -> impl Iterator<Item = [S; 3]> + '_ {
        let places = self.info.bodies.iter().enumerate();
        let own = |body: &Option<usize>| *body == Some(self.body);
        let sorted = places
            .clone()
            .filter(move |(_, body)| own(body))
            .chain(places.filter(move |(_, body)| !own(body)));
        sorted.map(|(place, &body)| {
            let arm = M::joint_point(self.constants, self.joint, place);
            let at = moving::<S, M>(&self.state, body).position;
            let arm = rotate(&orientation_of::<S, M>(&self.state, body), &arm);
            plus(&at, &arm)
        })
    }

    /// Whether the rows of the joint let its bodies move so.
    fn is_free(&self, twist: &Twist<S>) -> bool {
        let mut rows = self.along_rows(twist);
        rows.all(|(along, size)| along.abs() <= S::constant(FREE) * size)
    }

    /// What a motion changes of every row of the joint, and the sum of the sizes of its terms.
    fn along_rows(&self, twist: &Twist<S>) -> impl Iterator<Item = (S, S)> + use<S, M> {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        self.add_to(&mut state, twist);
        let jacobian = M::jacobian(self.constants, S::zero(), &self.state);
        let arm = self.round_off_of_arms();
        let (first, rows) = (self.info.row, self.info.rows);
        (first..first + rows).map(move |row| {
            let velocities = state.velocities().as_slice();
            let (mut sum, mut size) = (S::zero(), S::zero());
            let own = |block: &&Block| (block.row..block.row + block.rows).contains(&row);
            for block in M::REPORT.blocks.iter().filter(own) {
                let start = block.offset + (row - block.row) * block.columns;
                let part = |slice: &[S], place: usize, is_there: bool| -> [S; 3] {
                    if is_there {
                        read(slice, place)
                    } else {
                        [S::zero(); 3]
                    }
                };
                let turns = block.columns > 3;
                let force = part(jacobian.as_slice(), start, true);
                let moment = part(jacobian.as_slice(), start + 3, turns);
                let slide = part(velocities, block.column, true);
                let turn = part(velocities, block.column + 3, turns);
                sum = sum + dot(&force, &slide) + dot(&moment, &turn);
                let [force, moment, slide, turn] =
                    [force, moment, slide, turn].map(|vector| square(&vector).sqrt());
                size = size + force * (slide + arm * turn) + moment * turn;
            }
            (sum, size)
        })
    }

    /// What arms lose by round-off, generously: a row may take a motion that far from the joint for
    /// one that it forbids.
    fn round_off_of_arms(&self) -> S {
        let places = 0..self.info.bodies.len();
        let points = places.map(|place| M::joint_point(self.constants, self.joint, place));
        let arms = points.map(|point| square(&point).sqrt());
        let positions = self.state.coordinates().as_slice();
        let extent = arms.fold(farthest(M::REPORT.bodies, positions), S::max);
        S::EPSILON.sqrt() * extent
    }

    /// The angle with the turns that an element between the same bodies counts, from the angle
    /// without; `None` where none does.
    fn turns(&self, axis: &Twist<S>) -> Option<impl Fn(S) -> S + use<S, M>> {
        let joints = M::REPORT.joints.iter();
        let joints = joints.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
        let forces = M::REPORT.forces.iter();
        let forces = forces.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
        let rates = self.counter_rates(axis);
        let bodies = self.info.bodies;
        let is_same = |other: &[Option<usize>]| match (bodies, other) {
            ([a, b], [c, d]) => (a, b) == (c, d) || (a, b) == (d, c),
            _ => false,
        };
        for (other, first, count) in joints.chain(forces) {
            if count != 1 || !is_same(other) {
                continue;
            }
            let rate = rates.as_slice().get(first).copied();
            let counted = self.state.coordinates().as_slice().get(first).copied();
            let (Some(rate), Some(counted)) = (rate, counted) else {
                continue;
            };
            if (rate.abs() - S::one()).abs() > S::constant(FREE) {
                continue;
            }
            let whole = counted * rate;
            return Some(move |angle: S| {
                let turns = ((whole - angle) * S::constant(TAU.recip())).round();
                turns.fused(S::constant(TAU), angle)
            });
        }
        None
    }

    /// The rates of auxiliary variables, at their places.
    fn counter_rates(&self, twist: &Twist<S>) -> <M::State<S> as StateParts<S>>::Coordinates {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        self.add_to(&mut state, twist);
        M::coordinate_rates(self.constants, &state)
    }

    /// Adds a motion to the velocities of what hangs on the joint.
    fn add_to(&self, state: &mut M::State<S>, twist: &Twist<S>) {
        for (place, body) in M::REPORT.bodies.iter().enumerate() {
            if !self.hangs(place) {
                continue;
            }
            let Moving {
                position,
                velocity,
                spin,
            } = moving::<S, M>(state, Some(place));
            let sweep = cross(&twist.turn, &minus(&position, &twist.point));
            let velocity = plus(&velocity, &plus(&sweep, &twist.slide));
            let velocities = state.velocities_mut().as_mut_slice();
            write(velocities, body.velocity, velocity);
            if body.kind == BodyKind::Rigid {
                let spin = plus(&spin, &twist.turn);
                set_spin::<S, M>(state, place, &spin);
            }
        }
    }

    fn accelerate(&mut self, twist: &Twist<S>) {
        let mut state = self.state;
        self.add_to(&mut state, twist);
        self.state = state;
    }

    /// Moves what hangs on the joint by a multiple of a motion, and the angles that count turns
    /// along.
    fn displace(&mut self, twist: &Twist<S>, factor: S) {
        let Twist { turn, point, slide } = twist.scaled(factor);
        let rotation = from_rotation_vector(&turn);
        let carrier = moving::<S, M>(&self.state, self.carrier());
        let rates = self.counter_rates(twist);
        let mut state = self.state;
        let places = state.coordinates_mut().as_mut_slice().iter_mut();
        let counters = places.zip(rates.as_slice()).skip(M::REPORT.coordinates);
        for (counter, &rate) in counters {
            *counter = rate.fused(factor, *counter);
        }
        for (place, body) in M::REPORT.bodies.iter().enumerate() {
            if !self.hangs(place) {
                continue;
            }
            let now = moving::<S, M>(&self.state, Some(place));
            let arm = rotate(&rotation, &minus(&now.position, &point));
            let position = plus(&plus(&point, &arm), &slide);
            // As seen from what carries it, velocities move with it.
            let relative = minus(&now.velocity, &carrier.velocity_at(&now.position));
            let velocity = plus(
                &carrier.velocity_at(&position),
                &rotate(&rotation, &relative),
            );
            let relative = minus(&now.spin, &carrier.spin);
            let spin = plus(&carrier.spin, &rotate(&rotation, &relative));
            write(
                state.coordinates_mut().as_mut_slice(),
                body.coordinate,
                position,
            );
            let velocities = state.velocities_mut().as_mut_slice();
            write(velocities, body.velocity, velocity);
            if body.kind == BodyKind::Rigid {
                let p = orientation_of::<S, M>(&self.state, Some(place));
                let p = normalised(&product(&rotation, &p));
                let coordinates = state.coordinates_mut().as_mut_slice();
                write(coordinates, body.coordinate + 3, p);
                set_spin::<S, M>(&mut state, place, &spin);
            }
        }
        M::recount(self.constants, &mut state);
        self.state = state;
    }
}

impl<S: Real> Moving<S> {
    /// The velocity of a point that is fixed on the body.
    fn velocity_at(&self, point: &[S; 3]) -> [S; 3] {
        let arm = minus(point, &self.position);
        plus(&self.velocity, &cross(&self.spin, &arm))
    }
}

/// Why a joint that carries no body cannot be set.
fn closes<M: Mechanism>(joint: usize) -> Fault {
    let info = M::REPORT.joints.get(joint);
    let bodies = info.map_or(&[][..], |info| info.bodies);
    let carrier = |body: &Option<usize>| M::REPORT.carriers.get((*body)?)?.joint;
    let other = bodies.iter().rev().find_map(carrier);
    let other = other.and_then(|joint| M::REPORT.joints.get(joint));
    Fault::CarriesNothing {
        joint: info.map_or("", |info| info.name),
        instead: other.map(|info| info.name),
    }
}

/// Euler parameters from principal axes to global ones; of the ground and of a particle those of
/// the global axes.
fn orientation_of<S: Real, M: Mechanism>(state: &M::State<S>, body: Option<usize>) -> [S; 4] {
    let body = body.and_then(|body| M::REPORT.bodies.get(body));
    match body {
        Some(body) if body.kind == BodyKind::Rigid => {
            read(state.coordinates().as_slice(), body.coordinate + 3)
        }
        _ => [S::one(), S::zero(), S::zero(), S::zero()],
    }
}

/// How a body stands and moves; the ground is at rest at the origin.
fn moving<S: Real, M: Mechanism>(state: &M::State<S>, body: Option<usize>) -> Moving<S> {
    let zero = [S::zero(); 3];
    let Some(info) = body.and_then(|body| M::REPORT.bodies.get(body)) else {
        return Moving {
            position: zero,
            velocity: zero,
            spin: zero,
        };
    };
    let velocities = state.velocities().as_slice();
    let spin = match info.kind {
        BodyKind::Rigid => {
            let p = orientation_of::<S, M>(state, body);
            rotate(&p, &read(velocities, info.velocity + 3))
        }
        BodyKind::Particle => zero,
    };
    Moving {
        position: read(state.coordinates().as_slice(), info.coordinate),
        velocity: read(velocities, info.velocity),
        spin,
    }
}

/// Sets the angular velocity (rad/s, global) of a rigid body.
fn set_spin<S: Real, M: Mechanism>(state: &mut M::State<S>, body: usize, spin: &[S; 3]) {
    let p = orientation_of::<S, M>(state, Some(body));
    let own = rotate_back(&p, spin);
    if let Some(info) = M::REPORT.bodies.get(body) {
        write(
            state.velocities_mut().as_mut_slice(),
            info.velocity + 3,
            own,
        );
    }
}

/// `a + b`.
fn plus<S: Real>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a1 + b1, a2 + b2, a3 + b3]
}

fn dot<S: Real>(a: &[S; 3], b: &[S; 3]) -> S {
    let pairs = a.iter().zip(b);
    pairs.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
}
