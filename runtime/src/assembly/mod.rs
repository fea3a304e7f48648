//! Assembly: a state that satisfies the constraints, on the branch that is meant.
//!
//! A correction by Newton's method goes to some solution near by. Where what was set is far from
//! the solution, that may be one of another branch. So the way there is followed in short steps,
//! from the reference configuration, in which the branch is known, to what was set.
//!
//! What was set is read from the state itself, as motions of bodies against their carriers in the
//! spanning tree (`set.rs`). The way is a homotopy (`way.rs`). Each of its steps is the compliant
//! correction of `constraints/newton.rs`, then least squares of what is left of the set motions.
//! Conjugate gradients solve these over what the constraints leave free, without a matrix. A
//! motion that the constraints forbid has no gradient there and stays.
//!
//! `set_joint.rs` sets angles and displacements in the state of the bodies and needs no generated
//! code. It moves what hangs on a joint (`subtree.rs`) along what the joint leaves free
//! (`free_motion.rs`). The tree is the table `REPORT.carriers`. Axes are gradients of the joint's
//! own readings, which are linear in the velocities.

pub(crate) mod consistent_start;
mod free_motion;
mod set;
mod set_joint;
pub(crate) mod subtree;
mod way;

use self::set::Set;
use self::way::Way;
use crate::constraints::apart::apart;
use crate::constraints::projection::{Correction, Moved, Projection};
use crate::constraints::row_units::characteristic_length;
use crate::constraints::side::{check_sides, righted};
use crate::error::{AssemblyFault, Fault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::{check_state, with_unit_orientations};
use crate::mechanism::report::JointInfo;
use crate::state::vector::StateParts;

/// A movement (rad, or lengths of the mechanism) that is round-off: no branch is that near.
const NEAR: f64 = 1e-3;

/// A movement that Newton's method may do at once, where what was set opens joints of the tree.
const MODERATE: f64 = 0.1;

/// The same of a guess of all that can move, which says itself which branch is meant.
const GUESS: f64 = 0.5;

/// Whether joints close loops: a tree has no branches but the sides of its joints.
fn has_loops<M: Mechanism>() -> bool {
    let carries = |joint: usize| {
        let mut carriers = M::REPORT.carriers.iter();
        carriers.any(|carrier| carrier.joint == Some(joint))
    };
    let joints = M::REPORT.joints.iter().enumerate();
    let mut with_equations = joints.filter(|(_, info)| info.rows > 0);
    with_equations.any(|(joint, _)| !carries(joint))
}

/// Puts a state on the constraints. The branch is that of a state to start from, which need not
/// satisfy them.
pub(crate) fn assembled<S: Real, M: Mechanism>(
    projection: &Projection<S>,
    constants: &M::Constants<S>,
    time: S,
    state: &mut M::State<S>,
    from: &M::State<S>,
) -> Result<Correction<S>, Fault> {
    let none: Option<&fn(usize) -> bool> = None;
    assembled_holding::<S, M, _>(projection, constants, time, state, from, none)
}

/// The same, where what the joints that carry some bodies have in the state is held.
pub(crate) fn assembled_holding<S: Real, M: Mechanism, F: Fn(usize) -> bool>(
    projection: &Projection<S>,
    constants: &M::Constants<S>,
    time: S,
    state: &mut M::State<S>,
    from: &M::State<S>,
    held: Option<&F>,
) -> Result<Correction<S>, Fault> {
    check_state::<S, M>(state)?;
    let given = *state;
    let length = characteristic_length::<S, M>(constants, from);
    let mut direct = given;
    let at_once = projection.correct::<M>(constants, time, &mut direct);
    let moved = |to: &M::State<S>| apart::<S, M>(&given, to, length).size;
    let is_direct = |limit: f64| {
        at_once.is_ok()
            && moved(&direct) <= S::constant(limit)
            && check_sides::<S, M>(constants, &direct).is_ok()
    };
    let finish = |to: M::State<S>, correction: Correction<S>, steps: usize, passed| {
        let most = apart::<S, M>(&given, &to, length);
        let carrier = M::REPORT.carriers.get(most.body);
        let joint = carrier.and_then(|carrier| M::REPORT.joints.get(carrier.joint?));
        let is_of = |info: &&JointInfo| info.bodies.contains(&Some(most.body));
        let joint = joint.or_else(|| M::REPORT.joints.iter().find(is_of));
        let moved = Moved {
            body: M::REPORT.bodies.get(most.body).map_or("", |info| info.name),
            joint: joint.map(|info| info.name),
            angle: most.angle,
            length: most.length,
            steps,
            passed,
        };
        Correction {
            moved: Some(moved),
            ..correction
        }
    };
    let set = Set::<S, M>::of(constants, time, &given, from, length);
    let set = match held {
        Some(held) => set.holding(&given, held),
        None => set,
    };
    // Motions of joints that were set are kept, however small they are.
    let at_once_by = match &at_once {
        Ok(correction) if set.is_clean() && correction.iterations > 0 => 0.0,
        _ if !has_loops::<M>() => f64::INFINITY,
        _ if set.is_clean() => NEAR,
        _ if set.is_all() => GUESS,
        _ => MODERATE,
    };
    if is_direct(at_once_by) {
        let correction = at_once?;
        *state = direct;
        return Ok(finish(direct, correction, 0, None));
    }
    // What was not set goes along from where the branch is known; where all was set, or nothing,
    // the state itself is the guess.
    let start = if set.is_part() { set.start() } else { &given };
    let mut start = with_unit_orientations::<S, M>(start);
    M::rewrap(constants, &mut start);
    let start = righted::<S, M>(constants, &start, from);
    let found = Way::<S, M>::new(constants, time, length, &start, &set)
        .go()
        .and_then(|end| {
            let mut to: M::State<S> = end.state;
            *to.velocities_mut() = *given.velocities();
            let correction = projection.correct::<M>(constants, time, &mut to)?;
            check_sides::<S, M>(constants, &to)?;
            let correction = Correction {
                iterations: correction.iterations + end.iterations,
                ..correction
            };
            Ok((to, finish(to, correction, end.steps, end.passed)))
        });
    match (found, at_once) {
        (Ok((to, mut correction)), direct) => {
            if let Ok(direct) = direct {
                correction.violation_before = direct.violation_before;
                correction.velocity_violation_before = direct.velocity_violation_before;
            }
            *state = to;
            Ok(correction)
        }
        (Err(fault), _) if set.is_clean() && set.is_part() => Err(fault),
        // Of two that fail, the one that names a joint says more.
        (Err(Fault::Assembly(AssemblyFault::WayEnds { joint: None, .. })), Err(fault)) => {
            Err(fault)
        }
        (Err(fault), Err(_)) => Err(fault),
        (Err(_), Ok(correction)) => {
            check_sides::<S, M>(constants, &direct)?;
            *state = direct;
            Ok(finish(direct, correction, 0, None))
        }
    }
}
