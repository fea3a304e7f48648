//! Multipliers that load no body.

use crate::constraints::retract::displaced;
use crate::constraints::rows::Speeds;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::{Block, BodyInfo, BodyKind};
use crate::state::vector::{Array, StateParts};

/// Loads that cancel to this part of what they are one by one: equations that are as good as
/// dependent.
const CANCELLED: f64 = 1e-2;

/// How far ahead a state is looked at, as a part of the extent of the mechanism (or in radians), to
/// see whether equations that nearly depend on each other will go on doing so.
const FURTHER: f64 = 1e-2;

/// On the way through a singular configuration loads that cancel there cancel this many times less
/// a short way further.
const PASSING: f64 = 10.0;

/// Whether multipliers are nearly a state of self-stress: equation by equation they load the
/// bodies, but together the loads `D^T lambda` cancel to a hundredth, on every body.
pub(crate) fn self_stressed<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> bool {
    cancellation::<S, M>(constants, time, state, multipliers) <= S::constant(CANCELLED)
}

/// Whether multipliers that are nearly a state of self-stress will not be one a short way further
/// along the velocities: the mechanism passes a singular configuration. Else its equations go on to
/// depend on each other nearly.
#[cold]
pub(crate) fn passing<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> bool {
    let speeds = Speeds::at::<M>(constants, state);
    let Some(duration) = speeds.time_for(S::constant(FURTHER)) else {
        return false;
    };
    let further = displaced::<S, M>(constants, state, state.velocities(), duration);
    let now = cancellation::<S, M>(constants, time, state, multipliers);
    cancellation::<S, M>(constants, time, &further, multipliers) > S::constant(PASSING) * now
}

/// To which part of what they are one by one the loads of multipliers cancel, on the body where
/// they do so least. A body that is loaded by no more than a hundredth of the load on another, one
/// by one, counts as if it were loaded by that.
///
/// Such multipliers exist where equations depend on each other, nearly or exactly: the loads of
/// independent equations do not cancel. Moments count as forces at the radius of gyration, so that
/// neither units nor masses weigh: a light body between heavy ones is not a dependence.
fn cancellation<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> S {
    let jacobian = M::jacobian(constants, time, state);
    let leverages = leverages::<S, M>(constants);
    // Element by element: the sum of the loads, and the sum of their squares.
    let mut together = M::Velocities::<S>::zeros();
    let mut one_by_one = M::Velocities::<S>::zeros();
    add_loads(
        M::REPORT.blocks,
        jacobian.as_slice(),
        multipliers.as_slice(),
        [together.as_mut_slice(), one_by_one.as_mut_slice()],
    );
    least_left(
        M::REPORT.bodies,
        leverages.as_slice(),
        [together.as_slice(), one_by_one.as_slice()],
    )
}

/// The loads of multipliers, which are scaled to 1: their sum, and the sum of their squares.
fn add_loads<S: Real>(
    blocks: &[Block],
    jacobian: &[S],
    multipliers: &[S],
    [together, one_by_one]: [&mut [S]; 2],
) {
    // Squares would leave the range of numbers.
    let largest = multipliers.iter();
    let largest = largest.fold(S::zero(), |largest, lambda| largest.max(lambda.abs()));
    for block in blocks {
        let values = jacobian.get(block.offset..).unwrap_or(&[]);
        let rows = values.chunks(block.columns.max(1)).take(block.rows);
        for (row, &multiplier) in rows.zip(multipliers.iter().skip(block.row)) {
            let places = together.iter_mut().zip(one_by_one.iter_mut());
            for ((sum, squares), &value) in places.skip(block.column).zip(row) {
                let load = value * multiplier.quotient(largest);
                *sum = *sum + load;
                *squares = load.fused(load, *squares);
            }
        }
    }
}

/// What is left of loads together of what they are one by one, on the body where most is left.
fn least_left<S: Real>(
    bodies: &[BodyInfo],
    leverages: &[S],
    [together, one_by_one]: [&[S]; 2],
) -> S {
    let on = |body: &BodyInfo, square: &dyn Fn(usize) -> S| {
        let own = body.velocity..body.velocity + elements(body.kind);
        own.fold(S::zero(), |sum, place| {
            let leverage = leverages.get(place).copied().unwrap_or(S::zero());
            square(place).fused(leverage, sum)
        })
    };
    let at = |values: &[S], place: usize| values.get(place).copied().unwrap_or(S::zero());
    let left = |place: usize| at(together, place) * at(together, place);
    let single = |place: usize| at(one_by_one, place);
    let most = bodies.iter();
    let most = most.fold(S::zero(), |most, body| most.max(on(body, &single)));
    let least = S::constant(CANCELLED * CANCELLED) * most;
    let worst = bodies.iter().fold(S::zero(), |worst, body| {
        let single = on(body, &single).max(least);
        if single > S::zero() {
            worst.max(on(body, &left).quotient(single))
        } else {
            worst
        }
    });
    worst.sqrt()
}

/// The velocities of a body.
fn elements(kind: BodyKind) -> usize {
    match kind {
        BodyKind::Rigid => 6,
        BodyKind::Particle => 3,
    }
}

/// What the square of a load counts: 1 for a force, `m / J` for a moment.
fn leverages<S: Real, M: Mechanism>(constants: &M::Constants<S>) -> M::Velocities<S> {
    let mut leverages = M::metric(constants);
    for body in M::REPORT.bodies {
        let own = leverages.as_mut_slice().iter_mut().skip(body.velocity);
        let mut mass = None;
        for element in own.take(elements(body.kind)) {
            let mass = *mass.get_or_insert(*element);
            *element = mass.quotient(*element);
        }
    }
    leverages
}
