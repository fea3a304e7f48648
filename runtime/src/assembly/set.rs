//! What was set in a state: which bodies stand otherwise against what carries them than in another
//! state.

use crate::constraints::apart::angle_between;
use crate::constraints::frames::{axes_of, carrier_axes, carrier_of, centre_of, hanging_point};
use crate::constraints::newton::Iterate;
use crate::math::quaternion::{conjugate, from_rotation_vector, product, rotate, rotate_back};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::norm;
use crate::math::vec3::{minus, over, read, times, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::mechanism::turns;
use crate::state::vector::{Array, StateParts};

/// A violation, in sizes of its row, that opens a joint: setting an angle opens none of the tree.
const OPENS: f64 = 1e-6;

/// The motions of bodies against what carries them in the spanning tree, from one state to another.
pub(super) struct Set<S: Scalar, M: Mechanism> {
    /// Of each body in the places of its velocities: how the point of its joint moves (m) and how
    /// it turns (rad), in the axes of what carries it. Zeros where it was not set.
    motion: M::Velocities<S>,
    /// How bodies stand before.
    from: M::State<S>,
    /// Bodies that stand otherwise, and bodies that do not although they could.
    changed: usize,
    kept: usize,
    /// Whether no joint of the tree was opened.
    is_closed: bool,
    /// Of each body in the place of its first velocity: one where what carries it is held.
    held: M::Velocities<S>,
    /// Whether any is.
    pub(super) has_held: bool,
}

/// Where a body is, seen from what carries it: its joint's point, and its orientation.
#[derive(Clone, Copy)]
struct Relative<S> {
    point: [S; 3],
    orientation: [S; 4],
}

impl<S: Real, M: Mechanism> Set<S, M> {
    pub(super) fn of(
        constants: &M::Constants<S>,
        time: S,
        given: &M::State<S>,
        from: &M::State<S>,
        length: S,
    ) -> Self {
        let mut set = Self {
            motion: M::Velocities::<S>::zeros(),
            from: *from,
            changed: 0,
            kept: 0,
            is_closed: closes_tree::<S, M>(constants, time, given),
            held: M::Velocities::<S>::zeros(),
            has_held: false,
        };
        let least = S::EPSILON.sqrt();
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            let before = relative::<S, M>(constants, from, body);
            let after = relative::<S, M>(constants, given, body);
            let slide = minus(&after.point, &before.point);
            let is_rigid = info.kind == BodyKind::Rigid;
            let angle = if is_rigid {
                angle_between(&before.orientation, &after.orientation)
            } else {
                S::zero()
            };
            if angle > least || norm(&slide) > least * length {
                set.changed += 1;
                let mut turn = rotation_vector(&before.orientation, &after.orientation);
                if let Some(whole) = counted::<S, M>(given, from, body, &turn, constants) {
                    turn = whole;
                }
                let motion = set.motion.as_mut_slice();
                write(motion, info.velocity, slide);
                if is_rigid {
                    write(motion, info.velocity + 3, turn);
                }
            } else if is_movable::<M>(body) {
                set.kept += 1;
            }
        }
        set
    }

    /// The same, to hold what the joints that carry some bodies have in a state. The others begin
    /// there, as a guess, where one of them was set, and else where they were before.
    pub(super) fn holding(self, given: &M::State<S>, held: &impl Fn(usize) -> bool) -> Self {
        let mut holding = Self {
            motion: M::Velocities::<S>::zeros(),
            changed: 0,
            kept: 0,
            is_closed: true,
            has_held: true,
            ..self
        };
        let bodies = || M::REPORT.bodies.iter().enumerate();
        let mut others = bodies().filter(|&(body, _)| !held(body));
        let is_guess = others.any(|(body, _)| self.holds(body));
        if is_guess {
            holding.from = *given;
        }
        for (body, info) in bodies() {
            let place = info.velocity;
            if held(body) {
                holding.changed += 1;
                if let Some(flag) = holding.held.as_mut_slice().get_mut(place) {
                    *flag = S::one();
                }
                if !is_guess {
                    let motion = holding.motion.as_mut_slice();
                    let own = self.motion.as_slice();
                    write(motion, place, read::<S, 3>(own, place));
                    if info.kind == BodyKind::Rigid {
                        write(motion, place + 3, read::<S, 3>(own, place + 3));
                    }
                }
            } else if is_movable::<M>(body) {
                holding.kept += 1;
            }
        }
        holding
    }

    /// The state that the others are moved from.
    pub(super) const fn start(&self) -> &M::State<S> {
        &self.from
    }

    /// Whether some bodies were set and others not, or some are held.
    pub(super) fn is_part(&self) -> bool {
        self.changed > 0 && (self.kept > 0 || self.has_held)
    }

    /// Whether all was set that can move.
    pub(super) fn is_all(&self) -> bool {
        self.changed > 0 && self.kept == 0
    }

    /// Whether what was set are motions of joints, of which others are left to follow.
    pub(super) fn is_clean(&self) -> bool {
        self.is_closed && self.is_part()
    }

    /// Whether there are no more motions than a mechanism of independent equations leaves free:
    /// then they do not contradict each other.
    pub(super) fn may_be_free(&self) -> bool {
        let free = usize::try_from(M::REPORT.degrees_of_freedom);
        // Equations of velocities leave all configurations.
        free.is_ok_and(|free| self.changed <= free + M::REPORT.velocity_rows.len())
    }

    /// The largest turn (rad), or slide in lengths of the mechanism.
    pub(super) fn size(&self, length: S) -> S {
        crate::constraints::apart::reach::<S, M>(&self.motion, length).size
    }

    /// Whether a body is to be moved against what carries it.
    pub(super) fn holds(&self, body: usize) -> bool {
        let place = M::REPORT
            .bodies
            .get(body)
            .map_or(usize::MAX, |info| info.velocity);
        let [held]: [S; 1] = read(self.held.as_slice(), place);
        if held > S::zero() {
            return true;
        }
        let motion: [S; 6] = read(self.motion.as_slice(), place);
        let [a, b, c, d, e, f] = motion;
        let rotation = match M::REPORT.bodies.get(body).map(|info| info.kind) {
            Some(BodyKind::Rigid) => norm(&[d, e, f]),
            _ => S::zero(),
        };
        rotation > S::zero() || norm(&[a, b, c]) > S::zero()
    }

    /// What is left of the motions up to a share of the way, in a state: slides of the joints'
    /// points over the length, and turns, both along global axes, in the places of the velocities
    /// of the bodies.
    pub(super) fn left(
        &self,
        constants: &M::Constants<S>,
        state: &M::State<S>,
        share: S,
        length: S,
    ) -> M::Velocities<S> {
        let mut left = M::Velocities::<S>::zeros();
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            if !self.holds(body) {
                continue;
            }
            let before = relative::<S, M>(constants, &self.from, body);
            let now = relative::<S, M>(constants, state, body);
            let motion = self.motion.as_slice();
            let slide = read::<S, 3>(motion, info.velocity);
            let [x, y, z] = times(&slide, share);
            let [a, b, c] = before.point;
            let axes = carrier_axes::<S, M>(state, body);
            let slide = rotate(&axes, &minus(&[a + x, b + y, c + z], &now.point));
            let slide = over(&slide, length);
            write(left.as_mut_slice(), info.velocity, slide);
            if info.kind == BodyKind::Rigid {
                let turn = times(&read::<S, 3>(motion, info.velocity + 3), share);
                let wanted = product(&from_rotation_vector(&turn), &before.orientation);
                let turn = rotate(&axes, &rotation_vector(&now.orientation, &wanted));
                write(left.as_mut_slice(), info.velocity + 3, turn);
            }
        }
        left
    }
}

/// Whether a body could stand otherwise against what carries it.
fn is_movable<M: Mechanism>(body: usize) -> bool {
    let carrier = M::REPORT.carriers.get(body);
    let joint = carrier.and_then(|carrier| carrier.joint);
    let joint = joint.and_then(|joint| M::REPORT.joints.get(joint));
    joint.is_none_or(|info| info.rows < 6)
}

/// Whether the joints of the spanning tree are closed in a state.
fn closes_tree<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> bool {
    let at = Iterate::<S, M>::positions(constants, time, state);
    let mut violation = at.violation;
    for (place, joint) in M::REPORT.joints.iter().enumerate() {
        let carries = |carrier: &crate::mechanism::report::Carrier| carrier.joint == Some(place);
        if !M::REPORT.carriers.iter().any(carries) {
            let rows = violation.as_mut_slice().iter_mut();
            let own = rows.skip(joint.row).take(joint.rows);
            own.for_each(|row| *row = S::zero());
        }
    }
    at.sizes.within(&violation, S::constant(OPENS))
}

fn relative<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    body: usize,
) -> Relative<S> {
    let axes = carrier_axes::<S, M>(state, body);
    let point = hanging_point::<S, M>(constants, state, body);
    let origin = centre_of::<S, M>(state, carrier_of::<M>(body));
    Relative {
        point: rotate_back(&axes, &minus(&point, &origin)),
        orientation: product(&conjugate(&axes), &axes_of::<S, M>(state, Some(body))),
    }
}

/// The rotation vector (rad, up to half a turn) from one orientation to another, along the axes
/// that both refer to.
fn rotation_vector<S: Real>(from: &[S; 4], to: &[S; 4]) -> [S; 3] {
    let [e0, e1, e2, e3] = product(to, &conjugate(from));
    let sine = norm(&[e1, e2, e3]);
    if sine <= S::zero() {
        return [S::zero(); 3];
    }
    let sign = if e0 < S::zero() { -S::one() } else { S::one() };
    let angle = S::constant(2.0) * sine.atan2(e0 * sign);
    [e1, e2, e3].map(|e| (e * sign).quotient(sine) * angle)
}

/// The rotation vector with the turns that an element counts between a body and what carries it.
fn counted<S: Real, M: Mechanism>(
    given: &M::State<S>,
    from: &M::State<S>,
    body: usize,
    turn: &[S; 3],
    constants: &M::Constants<S>,
) -> Option<[S; 3]> {
    use core::f64::consts::TAU;
    /// Off one, the rate of a counter is that of another angle.
    const ALIKE: f64 = 1e-3;
    let carrier = carrier_of::<M>(body);
    let is_pair = |bodies: &[Option<usize>]| match bodies {
        [a, b] => (*a, *b) == (carrier, Some(body)) || (*a, *b) == (Some(body), carrier),
        _ => false,
    };
    let joints = M::REPORT.joints.iter();
    let joints = joints.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
    let forces = M::REPORT.forces.iter();
    let forces = forces.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
    let mut counters = joints.chain(forces);
    let counter = counters.find(|(bodies, _, count)| *count == 1 && is_pair(bodies));
    let angle = norm(turn);
    if angle <= S::zero() {
        return None;
    }
    let axis = over(turn, angle);
    // What is counted as the body turns about the axis.
    let mut turning = *from;
    *turning.velocities_mut() = Array::zeros();
    let info = M::REPORT.bodies.get(body)?;
    let global = rotate(&carrier_axes::<S, M>(from, body), &axis);
    let own = rotate_back(&axes_of::<S, M>(from, Some(body)), &global);
    write(
        turning.velocities_mut().as_mut_slice(),
        info.velocity + 3,
        own,
    );
    let (rate, whole) = match counter {
        Some((_, place, _)) => {
            let rates = M::coordinate_rates(constants, &turning);
            let [rate] = read(rates.as_slice(), place);
            let counter =
                |state: &M::State<S>| read::<S, 1>(state.coordinates().as_slice(), place)[0];
            (rate, counter(given) - counter(from))
        }
        // The account of the joint that carries it.
        None => {
            let joint = M::REPORT.carriers.get(body)?.joint?;
            turns::place_of::<M>(joint)?;
            let rate = M::joint_angle(constants, &turning, joint).rate;
            let angle = |state| turns::angle::<S, M>(constants, state, joint);
            (rate, angle(given) - angle(from))
        }
    };
    if (rate.abs() - S::one()).abs() > S::constant(ALIKE) {
        return None;
    }
    let whole = whole * rate;
    let turns = ((whole - angle) * S::constant(TAU.recip())).round();
    let whole = turns.fused(S::constant(TAU), angle);
    Some(times(&axis, whole))
}
