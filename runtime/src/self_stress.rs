//! Multipliers that load no body.

use crate::array::{Array, StateParts};
use crate::displace::displaced;
use crate::mechanism::Mechanism;
use crate::report::BodyKind;
use crate::rows::Rows;
use crate::scalar::Real;

/// Loads that cancel to this part of what they are one by one: equations that are as good as dependent.
const CANCELLED: f64 = 1e-2;

/// How far ahead a state is looked at, as a part of the extent of the mechanism (or in radians), to see whether equations that nearly depend on
/// each other will go on doing so.
const FURTHER: f64 = 1e-2;

/// On the way through a singular configuration loads that cancel there cancel this many times less a short way further.
const PASSING: f64 = 10.0;

/// Whether multipliers are nearly a state of self-stress: equation by equation they load the bodies, but together the loads
/// `D^T lambda` cancel to a hundredth, on every body.
pub(crate) fn self_stressed<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> bool {
    cancellation::<S, M>(constants, time, state, multipliers) <= S::constant(CANCELLED)
}

/// Whether multipliers that are nearly a state of self-stress will not be one a short way further along the velocities: the
/// mechanism passes a singular configuration. Else its equations go on to depend on each other nearly.
#[cold]
pub(crate) fn passing<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> bool {
    let speed = Rows::<S, M>::at(constants, time, state).speeds(state);
    let Some(duration) = speed.time_for(S::constant(FURTHER)) else {
        return false;
    };
    let further = displaced::<S, M>(constants, state, state.velocities(), duration);
    let now = cancellation::<S, M>(constants, time, state, multipliers);
    cancellation::<S, M>(constants, time, &further, multipliers) > S::constant(PASSING) * now
}

/// To which part of what they are one by one the loads of multipliers cancel, on the body where they do so least. A body that is loaded
/// by no more than a hundredth of the load on another, one by one, counts as if it were loaded by that.
///
/// Such multipliers exist where equations depend on each other, nearly or exactly: the loads of independent equations do not
/// cancel. Moments count as forces at the radius of gyration, so that neither units nor masses weigh: a light
/// body between heavy ones is not a dependence.
fn cancellation<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> S {
    let jacobian = M::jacobian(constants, time, state);
    let leverages = leverages::<S, M>(constants);
    // Squares would leave the range of numbers.
    let largest = multipliers.as_slice().iter();
    let largest = largest.fold(S::zero(), |largest, lambda| largest.max(lambda.abs()));
    // Element by element: the sum of the loads, and the sum of their squares.
    let mut together = M::Velocities::<S>::zeros();
    let mut one_by_one = M::Velocities::<S>::zeros();
    for block in M::REPORT.blocks {
        let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
        let rows = values.chunks(block.columns.max(1)).take(block.rows);
        let multipliers = multipliers.as_slice().iter().skip(block.row);
        for (row, &multiplier) in rows.zip(multipliers) {
            let sums = together.as_mut_slice().iter_mut();
            let places = sums.zip(one_by_one.as_mut_slice()).skip(block.column);
            for ((sum, squares), &value) in places.zip(row) {
                let load = value * multiplier.quotient(largest);
                *sum = *sum + load;
                *squares = load.fused(load, *squares);
            }
        }
    }
    for sum in together.as_mut_slice() {
        *sum = *sum * *sum;
    }
    let on = |squares: &M::Velocities<S>, first: usize, elements: usize| {
        let places = squares.as_slice().iter().zip(leverages.as_slice());
        let own = places.skip(first).take(elements);
        own.fold(S::zero(), |sum, (&square, &leverage)| {
            square.fused(leverage, sum)
        })
    };
    let bodies = || {
        M::REPORT.bodies.iter().map(|body| {
            let (first, elements) = (body.velocity, elements(body.kind));
            (
                on(&together, first, elements),
                on(&one_by_one, first, elements),
            )
        })
    };
    let most = bodies().fold(S::zero(), |most, (_, single)| most.max(single));
    let least = S::constant(CANCELLED * CANCELLED) * most;
    let worst = bodies().fold(S::zero(), |worst, (left, single)| {
        let single = single.max(least);
        if single > S::zero() {
            worst.max(left.quotient(single))
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
    let mut leverages = M::mass(constants);
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
