//! A single step that is looked into: states within it by the interpolant of the method.

use super::{OneStep, Scheme, Slopes, StepEnds, StepRecord, StepStart, System, refused};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A step with the slopes at its ends.
pub(crate) struct StepWithin<S: Real, X: Vector<S>, K: Scheme<S>> {
    scheme: K,
    step: S,
    from: X,
    first: X,
    stages: K::Stages<X>,
    to: X,
    last: X,
}

impl<S: Real, X: Vector<S>, K: Scheme<S>> StepWithin<S, X, K> {
    /// Takes a step from a time and a state. It costs one evaluation more than the step alone, and
    /// those of [`Scheme::prepare`].
    ///
    /// # Errors
    /// A fault of the system.
    pub(crate) fn take<Y: System<S, State = X>>(
        scheme: K,
        system: &mut Y,
        (time, from): (S, &X),
        step: S,
    ) -> Result<Self, Fault>
    where
        K: OneStep<S, Y>,
    {
        let outcome = Self::attempt(scheme, system, (time, from), step);
        outcome.map_err(|fault| refused(&scheme, system, (time, from), step, fault))
    }

    fn attempt<Y: System<S, State = X>>(
        scheme: K,
        system: &mut Y,
        (time, from): (S, &X),
        step: S,
    ) -> Result<Self, Option<Fault>>
    where
        K: OneStep<S, Y>,
    {
        let mut first = from.clone();
        system.stage(time, from, &mut first)?;
        let start = StepStart {
            time,
            state: from,
            slope: &first,
        };
        let mut stages = scheme.stages(&first);
        let mut to = scheme.advanced(&mut Slopes::new(system), start, step, &mut stages)?;
        if !to.is_finite() {
            return Err(None);
        }
        system.renormalise(&mut to, None);
        system.follow(from, step, &mut to);
        let mut last = to.clone();
        system.stage(time + step, &to, &mut last)?;
        if !last.is_finite() {
            return Err(None);
        }
        let ends = StepEnds {
            step,
            from,
            first: &first,
            last: &last,
        };
        scheme.prepare(system, time, ends, &mut stages)?;
        Ok(Self {
            scheme,
            step,
            from: from.clone(),
            first,
            stages,
            to,
            last,
        })
    }

    /// The state at its end.
    pub(crate) fn end(&self) -> &X {
        &self.to
    }

    /// The state after a part of it, from 0 to 1.
    pub(crate) fn at(&self, part: S) -> X {
        let record = StepRecord {
            step: self.step,
            from: &self.from,
            first: &self.first,
            stages: &self.stages,
            to: &self.to,
            last: &self.last,
        };
        self.scheme.interpolate(record, part)
    }
}
