//! Where on a step of a branch something happens: a fold, a branching, the end.

use super::stability::negative;
use super::walk::{Spot, Walk};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::joint_rates::{HasInverse, HasMassMatrix, JointRates};

/// Trials of a search: bisection alone would end, too.
const TRIALS: usize = 100;

/// A point at a length along the tangent of a step.
type Place<'a, M, const N: usize, S> = (S, &'a Spot<M, N, S>);

/// A point that was found, if there is one.
type Found<M, const N: usize, S> = Result<Option<(S, Spot<M, N, S>)>, Fault>;

/// What a step passes; at most one fold or branching.
pub(super) struct Passed<M: JointRates, const N: usize, S: Real> {
    pub(super) fold: Option<Spot<M, N, S>>,
    pub(super) branching: Option<Spot<M, N, S>>,
    /// The point with the value of the end.
    pub(super) last: Option<Spot<M, N, S>>,
}

impl<M, const N: usize, S> Passed<M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    pub(super) fn between(
        walk: &Walk<N, S>,
        from: &Spot<M, N, S>,
        end: Place<'_, M, N, S>,
    ) -> Result<Self, Fault> {
        let begin = (S::zero(), from);
        let part = |ends| Segment { from, ends };
        let fold = part([begin, end]).fold(walk)?;
        // The value comes to its end at most once on either side of a fold.
        let turn = fold.as_ref().map_or(end, |(at, spot)| (*at, spot));
        let mut last = part([begin, turn]).end(walk)?;
        let limit = last.as_ref().map_or(end.0, |(at, _)| *at);
        let is_passed = |(at, spot): (S, Spot<M, N, S>)| (at <= limit).then_some(spot);
        let branching = match fold {
            Some(_) => None,
            None => part([begin, end]).branching(walk)?.and_then(is_passed),
        };
        if fold.is_some() && last.is_none() {
            last = part([turn, end]).end(walk)?;
        }
        Ok(Self {
            fold: fold.and_then(is_passed),
            branching,
            last: last.map(|(_, spot)| walk.at_end(&spot).unwrap_or(spot)),
        })
    }
}

/// A part of a step.
struct Segment<'a, M: JointRates, const N: usize, S: Real> {
    /// Where the step begins.
    from: &'a Spot<M, N, S>,
    ends: [Place<'a, M, N, S>; 2],
}

impl<M, const N: usize, S> Segment<'_, M, N, S>
where
    M: HasInverse + HasMassMatrix,
    S: Real,
{
    /// Where the value turns back.
    fn fold(&self, walk: &Walk<N, S>) -> Found<M, N, S> {
        self.zero(walk, |spot| {
            Some(spot.tangent.value.quotient(walk.interval))
        })
    }

    /// Where an eigenvalue of the stiffness becomes zero.
    fn branching(&self, walk: &Walk<N, S>) -> Found<M, N, S> {
        let [before, after] = self.ends.map(|(_, spot)| walk.eigenvalues(spot));
        let (Some(before), Some(after)) = (before, after) else {
            return Ok(None);
        };
        let (before, after) = (negative(&before), negative(&after));
        if before == after {
            return Ok(None);
        }
        let critical = before.min(after);
        self.zero(walk, |spot| walk.eigenvalues(spot)?.get(critical).copied())
    }

    /// Where the value is that of the end.
    fn end(&self, walk: &Walk<N, S>) -> Found<M, N, S> {
        self.zero(walk, |spot| {
            Some((spot.value - walk.end).quotient(walk.interval))
        })
    }

    /// Where a quantity that changes its sign is zero, by the Illinois method (Dowell and Jarratt
    /// 1971), with halves of the way where that is slow.
    fn zero(&self, walk: &Walk<N, S>, of: impl Fn(&Spot<M, N, S>) -> Option<S>) -> Found<M, N, S> {
        let [(mut a, begin), (mut b, end)] = self.ends;
        let (Some(mut at_a), Some(mut at_b)) = (of(begin), of(end)) else {
            return Ok(None);
        };
        if at_a == S::zero() || at_a * at_b > S::zero() {
            return Ok(None);
        }
        let mut best = if at_a.abs() < at_b.abs() {
            (at_a.abs(), a, *begin)
        } else {
            (at_b.abs(), b, *end)
        };
        for trial in 0..TRIALS {
            let share = at_a.quotient(at_a - at_b);
            let share = if trial % 8 == 7 {
                S::constant(0.5)
            } else {
                share
            };
            let length = (b - a).fused(share, a);
            if best.0 <= S::zero() || length == a || length == b {
                break;
            }
            let spot = match walk.ahead(self.from, length) {
                Ok(spot) => spot,
                // Next to a branching no direction is better than another.
                Err(_) if (b - a).abs() <= S::EPSILON.sqrt() * (a.abs() + b.abs()) => break,
                Err(fault) => return Err(fault),
            };
            let Some(value) = of(&spot) else { break };
            // A single eigenvalue tells its sign alone, which is nearest where it was last.
            if value.abs() <= best.0 {
                best = (value.abs(), length, spot);
            }
            // A side that stays counts half.
            if value * at_b < S::zero() {
                (a, at_a) = (b, at_b);
            } else {
                at_a = at_a * S::constant(0.5);
            }
            (b, at_b) = (length, value);
        }
        let (_, length, spot) = best;
        Ok(Some((length, spot)))
    }
}
