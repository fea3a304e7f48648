//! What a step of a method of low order misses.

use super::{NoStages, Stride, System, dense};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A step that was taken.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a, S, X> {
    /// The times of its ends.
    pub(super) start: S,
    pub(super) end: S,
    pub(super) step: S,
    /// State and slope at its start.
    pub(super) from: &'a X,
    pub(super) first: &'a X,
    /// The state at its end.
    pub(super) to: &'a X,
}

impl<S: Real, X: Vector<S>> Taken<'_, S, X> {
    /// Where Lobatto's rule of order 4, which is Simpson's, leads from the slopes at both ends and
    /// in the middle of the cubic through them.
    ///
    /// What a method of order 2 misses stands in the difference of the ends, up to a power of the
    /// step that is higher by one. Hairer, Norsett and Wanner, *Solving Ordinary Differential
    /// Equations I*, II.1.
    pub(super) fn better_end<Y: System<S, State = X>>(&self, system: &mut Y) -> Result<X, Fault> {
        let half = S::constant(0.5);
        let last = &system.rates(self.end, self.to)?;
        let stride = Stride {
            step: self.step,
            from: self.from,
            first: self.first,
            stages: &NoStages,
            to: self.to,
            last,
        };
        let middle = dense::cubic(&stride, half);
        let slope = &system.rates(half.fused(self.step, self.start), &middle)?;
        let sixth = S::constant(1.0 / 6.0) * self.step;
        let four = S::constant(4.0) * sixth;
        let terms = [(sixth, self.first), (four, slope), (sixth, last)];
        Ok(self.from.plus(terms))
    }
}
