//! What hangs on a joint in the spanning tree. It moves with the joint as one body, and so do its
//! velocities, as seen from what carries it.

use crate::error::{AssemblyFault, Fault};
use crate::math::quaternion::{from_rotation_vector, normalised, product, rotate, rotate_back};
use crate::math::scalar::Real;
use crate::math::vec3::{cross, minus, read, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::report::{BodyKind, Carrier, JointInfo};
use crate::mechanism::turns;
use crate::state::vector::{Array, StateParts};

/// The velocities of what hangs on a joint, which moves as one body against what carries it: global
/// axes.
#[derive(Clone, Copy)]
pub(super) struct Twist<S> {
    /// Angular velocity.
    pub(super) turn: [S; 3],
    /// A point.
    pub(super) point: [S; 3],
    /// Its velocity.
    pub(super) slide: [S; 3],
}

impl<S: Real> Twist<S> {
    pub(super) fn scaled(&self, factor: S) -> Self {
        Self {
            turn: self.turn.map(|x| x * factor),
            point: self.point,
            slide: self.slide.map(|x| x * factor),
        }
    }
}

/// A body that stands and moves somewhere: global axes.
#[derive(Clone, Copy)]
pub(super) struct Moving<S> {
    pub(super) position: [S; 3],
    pub(super) velocity: [S; 3],
    pub(super) spin: [S; 3],
}

/// A joint that carries a body, and what hangs on it, at a state.
pub(crate) struct Subtree<'a, S: Real, M: Mechanism> {
    pub(super) constants: &'a M::Constants<S>,
    pub(super) joint: usize,
    pub(super) info: &'static JointInfo,
    /// The body, by its place in the report.
    pub(super) body: usize,
    /// The state, with Euler parameters of length 1.
    pub(super) state: M::State<S>,
}

impl<'a, S: Real, M: Mechanism> Subtree<'a, S, M> {
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

    pub(super) fn holds(&self) -> Fault {
        Fault::Assembly(AssemblyFault::NotFree {
            joint: self.info.name,
        })
    }

    /// The body that carries the other one; `None` for the ground.
    fn carrier(&self) -> Option<usize> {
        let carrier = M::REPORT.carriers.get(self.body);
        carrier.and_then(|carrier| carrier.body)
    }

    /// Whether a body moves with the one that the joint carries.
    pub(super) fn hangs(&self, body: usize) -> bool {
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

    /// The rates of auxiliary variables, at their places.
    pub(super) fn counter_rates(
        &self,
        twist: &Twist<S>,
    ) -> <M::State<S> as StateParts<S>>::Coordinates {
        let mut state = self.state;
        *state.velocities_mut() = Array::zeros();
        self.add_to(&mut state, twist);
        M::coordinate_rates(self.constants, &state)
    }

    /// Adds a motion to the velocities of what hangs on the joint.
    pub(super) fn add_to(&self, state: &mut M::State<S>, twist: &Twist<S>) {
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

    pub(super) fn accelerate(&mut self, twist: &Twist<S>) {
        let mut state = self.state;
        self.add_to(&mut state, twist);
        self.state = state;
    }

    /// Moves what hangs on the joint by a multiple of a motion, and the angles that count turns
    /// along.
    pub(super) fn displace(&mut self, twist: &Twist<S>, factor: S) {
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
        M::rewrap(self.constants, &mut state);
        // Over many turns, as they would be seen in the motion.
        let [mut from, mut to] = [self.state, state];
        for moving in [&mut from, &mut to] {
            *moving.velocities_mut() = Array::zeros();
            self.add_to(moving, twist);
        }
        turns::count::<S, M>(self.constants, &from, factor, &mut to);
        turns::copy(&to, &mut state);
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

/// Euler parameters from principal axes to global ones; of the ground and of a particle those of
/// the global axes.
pub(super) fn orientation_of<S: Real, M: Mechanism>(
    state: &M::State<S>,
    body: Option<usize>,
) -> [S; 4] {
    let body = body.and_then(|body| M::REPORT.bodies.get(body));
    match body {
        Some(body) if body.kind == BodyKind::Rigid => {
            read(state.coordinates().as_slice(), body.coordinate + 3)
        }
        _ => [S::one(), S::zero(), S::zero(), S::zero()],
    }
}

/// How a body stands and moves; the ground is at rest at the origin.
pub(super) fn moving<S: Real, M: Mechanism>(state: &M::State<S>, body: Option<usize>) -> Moving<S> {
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
pub(super) fn plus<S: Real>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a1 + b1, a2 + b2, a3 + b3]
}

/// Why a joint that carries no body cannot be set or held.
pub(crate) fn closes<M: Mechanism>(joint: usize) -> Fault {
    let info = M::REPORT.joints.get(joint);
    let bodies = info.map_or(&[][..], |info| info.bodies);
    let carrier = |body: &Option<usize>| M::REPORT.carriers.get((*body)?)?.joint;
    let other = bodies.iter().rev().find_map(carrier);
    let other = other.and_then(|joint| M::REPORT.joints.get(joint));
    Fault::Assembly(AssemblyFault::CarriesNothing {
        joint: info.map_or("", |info| info.name),
        instead: other.map(|info| info.name),
    })
}
