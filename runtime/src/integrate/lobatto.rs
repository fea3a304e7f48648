//! What a step of a method of low order misses.

use super::record::{LastStep, Reached};
use super::{NoStages, StepRecord, System, dense};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// Where Lobatto's rule of order 4, which is Simpson's, leads from the slopes at both ends of a
/// step and in the middle of the cubic through them.
///
/// What a method of order 2 misses is the difference of the ends, up to a power of the step that is
/// higher by one. Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, II.1.
pub(super) fn better_end<S: Real, Y: System<S>>(
    system: &mut Y,
    taken: &LastStep<S, Y::State>,
    reached: &Reached<S, Y::State>,
) -> Result<Y::State, Fault> {
    let half = S::constant(0.5);
    let last = &system.rates(reached.time, &reached.state)?;
    let record = StepRecord {
        last,
        ..taken.record(reached, &NoStages)
    };
    let middle = dense::cubic(&record, half);
    let slope = &system.rates(half.fused(taken.step, taken.start), &middle)?;
    let sixth = S::constant(1.0 / 6.0) * taken.step;
    let four = S::constant(4.0) * sixth;
    let terms = [(sixth, &taken.first), (four, slope), (sixth, last)];
    Ok(taken.from.plus(terms))
}
