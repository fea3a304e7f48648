//! Where rates that are not finite began: a force, a closure, a joint or a body.

use crate::error::NotFinite;
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Mechanism, Terms};
use crate::mechanism::report::{BodyInfo, BodyKind, Report};
use crate::state::vector::Array;

/// The first thing that is not finite of those that accelerations are made of, at a state as the
/// kernels read it: forces of the description, what a closure has made of their sum, equations.
/// Only what the terms
/// ask for is looked at: a user compiles no kernel for a message that nothing else needs.
#[cold]
#[inline(never)]
pub(crate) fn before_accelerations<S: Real, M: Mechanism, T: Terms>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    applied: Option<&M::Velocities<S>>,
) -> Option<NotFinite> {
    let force = M::REPORT.forces.iter().enumerate().find(|(index, info)| {
        (0..info.bodies.len()).any(|place| {
            let load = M::force_load(constants, time, state, *index, place);
            !all_finite(load.iter())
        })
    });
    if let Some((_, force)) = force {
        return Some(NotFinite::Force(force.name));
    }
    let described = M::forces(constants, time, state);
    if let Some(body) = body(&M::REPORT, described.as_slice()) {
        return Some(NotFinite::Body(body));
    }
    if let Some(body) = applied.and_then(|applied| body(&M::REPORT, applied.as_slice())) {
        return Some(NotFinite::Closure(body));
    }
    let mut rows = [M::Multipliers::<S>::zeros(); 3];
    // Without the time and without positions it is made of rotations and of what `D` is made of.
    if const { M::REPORT.time.constraints || M::REPORT.curved } {
        rows[0] = M::gamma(constants, time, state);
    }
    if T::STABILISED || T::COMPLIANT {
        rows[1] = M::constraints(constants, time, state);
        rows[2] = M::constraint_rates(constants, time, state);
    }
    let jacobian = M::jacobian(constants, time, state);
    let [gamma, constraints, rates] = &rows;
    let rows = [gamma.as_slice(), constraints.as_slice(), rates.as_slice()];
    joint(&M::REPORT, rows, jacobian.as_slice()).map(NotFinite::Joint)
}

/// The first of the user's own states whose rate is not finite.
#[cold]
pub(crate) fn state_of<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> Option<NotFinite> {
    let mut rates = Array::zeros();
    M::state_rates_into(constants, time, state, &mut rates);
    let mut states = M::REPORT.states.iter();
    let found = states.find(|info| {
        let rate = rates.as_slice().get(info.coordinate);
        !all_finite(rate.into_iter())
    });
    found.map(|info| NotFinite::Rate(info.name))
}

/// The first joint with an element that is not finite, in a value for each row or in `D`.
fn joint<S: Real>(report: &Report, rows: [&[S]; 3], jacobian: &[S]) -> Option<&'static str> {
    let mut joints = report.joints.iter().enumerate();
    let joint = joints.find(|(index, info)| {
        let of_rows = |values: &[S]| all_finite(values.iter().skip(info.row).take(info.rows));
        let mut blocks = report.blocks.iter().filter(|b| b.joint == *index);
        !rows.iter().all(|values| of_rows(values))
            || !blocks.all(|block| {
                let values = jacobian.iter().skip(block.offset);
                all_finite(values.take(block.rows * block.columns))
            })
    });
    joint.map(|(_, joint)| joint.name)
}

/// The first body with an element that is not finite.
fn body<S: Real>(report: &Report, elements: &[S]) -> Option<&'static str> {
    let of = |body: &&BodyInfo| !all_finite(elements.iter().skip(body.velocity).take(count(body)));
    report.bodies.iter().find(of).map(|body| body.name)
}

/// The first body on which two loads differ in any digit.
pub(crate) fn differing<S: Real>(report: &Report, [a, b]: [&[S]; 2]) -> Option<&'static str> {
    let of = |body: &&BodyInfo| {
        let pairs = a.iter().zip(b).skip(body.velocity);
        let mut pairs = pairs.take(count(body));
        !pairs.all(|(x, y)| x == y || !(x.is_finite() || y.is_finite()))
    };
    report.bodies.iter().find(of).map(|body| body.name)
}

/// Velocities of a body.
fn count(body: &BodyInfo) -> usize {
    match body.kind {
        BodyKind::Rigid => 6,
        BodyKind::Particle => 3,
    }
}

fn all_finite<'a, S: Real>(mut elements: impl Iterator<Item = &'a S>) -> bool {
    elements.all(|element| element.is_finite())
}
