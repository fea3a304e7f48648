//! Angles of joints over many turns.
//!
//! A state counts them, see [`Vector::turns`]: the angle of every joint that has one when it
//! was counted last, and how far any may have turned since. That is by the sum of all rates, or by
//! the greatest rate of a joint where each is one motion of a tree. Angles are counted anew where
//! it may be a radian, so a step of a slow motion costs a sum. Sine and cosine tell an angle up to
//! whole turns. These are the ones that bring it nearest to what was counted last and the mean of
//! both rates times the time between.

use core::f64::consts::{FRAC_PI_2, TAU};

use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::readout::AngleParts;
use crate::state::sums::sum_of_sizes_in_both;
use crate::state::vector::{MovingState, Vector};

/// How far angles may have turned (rad) since they were counted.
pub(crate) const FAR: f64 = 1.0;

/// Half a turn, and round-off beside it: an angle of `pi` that nothing was counted of stays one.
const HALF: f64 = 0.500_001;

/// The joints that have an angle, in the order of the account.
fn joints<M: Mechanism>() -> impl Iterator<Item = usize> {
    let joints = M::REPORT.joints.iter().enumerate();
    joints.filter_map(|(joint, info)| info.has_angle.then_some(joint))
}

/// The place of a joint in the account.
pub(crate) fn place_of<M: Mechanism>(joint: usize) -> Option<usize> {
    joints::<M>().position(|other| other == joint)
}

/// Which of the angles that differ by turns is nearest to another one (rad).
pub(crate) fn nearest<S: Scalar>(angle: S, to: S) -> S {
    let turns = (to - angle) * S::constant(TAU.recip());
    let whole = turns
        .abs()
        .select(S::constant(HALF), S::zero(), turns.round());
    whole.fused(S::constant(TAU), angle)
}

/// The angle of a joint (rad) over all turns that the state has counted.
pub(crate) fn angle<S: Scalar, M: Mechanism>(
    constants: &M::Constants<S>,
    bodies: &M::State<S>,
    joint: usize,
) -> S {
    let parts = M::joint_angle(constants, bodies, joint);
    let last = place_of::<M>(joint).and_then(|place| bodies.turns().get(place).copied());
    counted(&parts, last)
}

/// The same of its parts, near to what was counted last.
fn counted<S: Scalar>(parts: &AngleParts<S>, last: Option<S>) -> S {
    match (parts.turns, last) {
        (None, Some(last)) => nearest(parts.angle(), last),
        _ => parts.angle(),
    }
}

/// Says of a joint's angle (rad) over all turns what it is.
pub(crate) fn set<S: Scalar, M: Mechanism, X: Vector<S>>(state: &mut X, joint: usize, angle: S) {
    let place = place_of::<M>(joint);
    if let Some(counted) = place.and_then(|place| state.turns_mut().get_mut(place)) {
        *counted = angle;
    }
}

/// Takes over what another state has counted.
#[inline(always)]
pub(crate) fn copy<S: Scalar, X: Vector<S>, Y: Vector<S>>(from: &X, to: &mut Y) {
    let counted = from.turns();
    if let Some(own) = to.turns_mut().get_mut(..counted.len()) {
        own.copy_from_slice(counted);
    }
}

/// Takes over what a state has counted that was left some time (s) ago. How far (rad) angles may
/// have turned since they were counted, by the sum of the speeds (rad/s) in both states: beyond
/// [`FAR`] they are to be counted, by [`count`].
#[inline]
pub(crate) fn carry<S: Scalar, X: MovingState<S>>(
    from: &X,
    time: S,
    to: &mut X,
    speeds: impl Fn(&X, &X) -> S,
) -> S {
    let Some(&since) = from.turns().last() else {
        return S::zero();
    };
    // The mean of both speeds is at least half of the greater one. So an angle turns by less than
    // two radians before it is counted, and half a turn is more.
    let turned = speeds(from, to).fused(S::constant(0.5) * time.abs(), since);
    copy(from, to);
    if let Some(since) = to.turns_mut().last_mut() {
        *since = turned;
    }
    turned
}

/// Whether angles that may have turned so far (rad) since they were counted need no count.
#[inline]
pub(crate) fn is_known<S: Real>(since: S) -> bool {
    since <= S::constant(FAR)
}

/// Brings the account of bodies up to date that were left some time (s) ago. Whether it is known:
/// rates hardly differ, so that their mean tells the turns.
#[inline]
pub(crate) fn follow<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    from: &M::State<S>,
    time: S,
    to: &mut M::State<S>,
) -> bool {
    let speeds = |from: &M::State<S>, to: &M::State<S>| {
        sum_of_sizes_in_both(from.rates_slice(), to.rates_slice())
    };
    is_known(carry(from, time, to, speeds)) || count::<S, M>(constants, from, time, to)
}

/// Counts all angles of a state that was reached from another one in some time (s); whether they
/// are known.
#[cold]
#[inline(never)]
pub(crate) fn count<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    from: &M::State<S>,
    time: S,
    to: &mut M::State<S>,
) -> bool {
    count_by::<S, M>(constants, (from, time), to, |_, [begin, end]| {
        S::constant(0.5) * (begin + end)
    })
}

/// Counts them by Simpson's rule, with the bodies half of the time (s) before. It is exact for
/// rates that are cubics of the time.
#[cold]
#[inline(never)]
pub(crate) fn count_through<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    [from, middle]: [&M::State<S>; 2],
    time: S,
    to: &mut M::State<S>,
) {
    count_by::<S, M>(constants, (from, time), to, |joint, [begin, end]| {
        let between = M::joint_angle(constants, middle, joint).rate;
        let sum = S::constant(4.0).fused(between, begin + end);
        sum * S::constant(6.0_f64.recip())
    });
    are_counted(to);
}

/// Counts all angles by the means of their rates, of a joint whose rates at both ends are these;
/// whether the rates differ so little that any mean of them tells the turns.
fn count_by<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (from, time): (&M::State<S>, S),
    to: &mut M::State<S>,
    mean: impl Fn(usize, [S; 2]) -> S,
) -> bool {
    let mut is_sure = true;
    for (place, joint) in joints::<M>().enumerate() {
        let before = M::joint_angle(constants, from, joint);
        let after = M::joint_angle(constants, to, joint);
        let begin = counted(&before, from.turns().get(place).copied());
        let mean = mean(joint, [before.rate, after.rate]);
        let end = counted(&after, Some(mean.fused(time, begin)));
        let spread = (after.rate - before.rate) * time;
        let is_wide = spread.abs() > S::constant(FRAC_PI_2);
        is_sure &= after.turns.is_some() || !is_wide;
        if let Some(counted) = to.turns_mut().get_mut(place) {
            *counted = end;
        }
    }
    // Where they are not known, they are as far as before.
    if is_sure {
        are_counted(to);
    }
    is_sure
}

/// Says that angles are counted here.
fn are_counted<S: Scalar, X: Vector<S>>(state: &mut X) {
    if let Some(since) = state.turns_mut().last_mut() {
        *since = S::zero();
    }
}
