//! What ends a step early: numbers that pass zero within it.

use crate::dynamics::evaluate::Evaluate;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// A number that is read along a motion, with the side of zero on which it was.
///
/// It ends a step where it passes zero: the reading of an event, the effort or the gap of an
/// interaction, the expression by which a law switches.
pub(crate) trait Guard<S: Real, M: Mechanism> {
    /// The number in a state of the bodies.
    ///
    /// # Errors
    /// One that is not a number; the fault of an evaluation.
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault>;

    /// Whether it has passed where it is this.
    fn is_passed(&self, value: S) -> bool;

    /// The number so that it is negative before it passes.
    fn beyond(&self, value: S) -> S;

    /// Keeps a number, and where it has passed up to there, until the step is ended or goes on.
    /// One that keeps nothing is a condition of the time and the motion alone.
    fn keep(&mut self, _equations: &mut dyn Evaluate<S, M>, _value: S, _root: Option<S>) {}

    /// Goes on with the number that was kept.
    fn go_on(&mut self, _equations: &mut dyn Evaluate<S, M>) {}

    /// Takes the number where a step ends early (s), be it by this one or by another.
    ///
    /// # Errors
    /// One that ends steps without end.
    fn take(
        &mut self,
        _equations: &mut dyn Evaluate<S, M>,
        _time: S,
        _value: S,
    ) -> Result<(), Fault> {
        Ok(())
    }
}

/// What is done with each guard.
pub(crate) type Visit<'v, S, M> = dyn FnMut(&mut dyn Guard<S, M>) -> Result<(), Fault> + 'v;

/// All guards of a step, in an order that stays.
pub(crate) trait Guards<S: Real, M: Mechanism> {
    /// Visits them.
    ///
    /// # Errors
    /// The first of the visit.
    fn each(&mut self, visit: &mut Visit<'_, S, M>) -> Result<(), Fault>;
}
