//! What a run asks of an integration: in time and in states of the bodies.

#[cfg(feature = "std")]
use core::fmt::Debug;

use crate::dynamics::equations::Equations;
use crate::error::Fault;
use crate::integrate::{Counts, Memory, TimeSpan, Tolerance};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// What is known of a method and of what it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings<S> {
    /// The step (s) of a method that does not choose it.
    pub(crate) fixed_step: Option<S>,
    /// The tolerance of a method that controls its error.
    pub(crate) tolerance: Option<Tolerance<S>>,
    /// How many evaluations a run may take.
    pub(crate) budget: usize,
    /// Whether interactions act.
    pub(crate) interacts: bool,
    /// Whether the end of a step need not be known in bodies, where nobody looks.
    pub(crate) may_defer: bool,
    /// Whether steps may end near to a singular configuration that the motion passes.
    pub(crate) may_branch: bool,
}

/// A step that was taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advanced<S> {
    /// When it ends (s).
    pub(crate) end: S,
    /// Whether the integration has counted turns through it, and knows them.
    pub(crate) knows_turns: bool,
}

/// The equations of motion with a method that integrates them, from one instant to the next.
pub(crate) trait Marching<S: Real, M: Mechanism> {
    /// The equations.
    fn equations(&self) -> &dyn Equations<S, M>;

    /// The same, to be changed between two integrations.
    fn equations_mut(&mut self) -> &mut dyn Equations<S, M>;

    /// What is known of the method.
    fn settings(&self) -> Settings<S>;

    /// The method, with its settings.
    #[cfg(feature = "std")]
    fn method(&self) -> &dyn Debug;

    /// Begins an integration, which may be a part of one of so many seconds, with the bodies at its
    /// start.
    ///
    /// # Errors
    /// Those of the method.
    fn start(&mut self, span: TimeSpan<S>, whole: S, bodies: &M::State<S>) -> Result<(), Fault>;

    /// Begins an integration again from the elements of the state in which it had begun. False of
    /// elements that are no state.
    ///
    /// # Errors
    /// Those of the method.
    fn start_again(&mut self, span: TimeSpan<S>, whole: S, elements: &[S]) -> Result<bool, Fault>;

    /// Hands over what the next steps depend on, or replaces it; whether the method does so.
    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool;

    /// Visits the elements of the state in which the integration has begun.
    #[cfg(feature = "std")]
    fn visit_start(&self, visit: &mut dyn FnMut(S));

    /// The time that was reached (s).
    fn time(&self) -> S;

    /// What the integration has cost so far.
    fn counts(&self) -> Counts;

    /// The error of the last step as its control estimates it.
    fn estimate(&self) -> Option<S>;

    /// Takes a step.
    ///
    /// # Errors
    /// Why it cannot be taken.
    fn advance(&mut self) -> Result<Advanced<S>, Fault>;

    /// Counts the turns of a step that the integration does not know, from bodies at its start (s).
    ///
    /// # Errors
    /// Those of an interpolant.
    fn recount(&mut self, start: (S, &M::State<S>)) -> Result<(), Fault>;

    /// The bodies at the end of the last step, with the turns that were counted through it.
    fn bodies(&self, near: &M::State<S>) -> M::State<S>;

    /// The same with the turns of bodies near by.
    fn bodies_near(&self, near: &M::State<S>) -> M::State<S>;

    /// The bodies at a time (s) within the last step, with the turns of those near by.
    ///
    /// # Errors
    /// Those of an interpolant.
    fn at(&mut self, time: S, near: &M::State<S>) -> Result<M::State<S>, Fault>;

    /// The bodies at a time (s) within the last step, with turns counted from another time on.
    ///
    /// # Errors
    /// Those of an interpolant.
    fn within(&mut self, from: (S, &M::State<S>), time: S) -> Result<M::State<S>, Fault>;

    /// Puts corrected bodies in the place of the end of the last step.
    fn replace(&mut self, bodies: &M::State<S>);

    /// Brings what interactions hold back to where it is held, at the end of the last step.
    ///
    /// # Errors
    /// Where there is no way back.
    fn hold_modes(&mut self, bodies: &mut M::State<S>) -> Result<(), Fault>;

    /// Lets the conversion of the last step's end to bodies wait. False where it must not.
    fn defers(&mut self, step: S) -> bool;

    /// How long ago (s) bodies are known of, where later ones wait.
    fn deferred_since(&self) -> S;

    /// Converts the state that waits, if there is one.
    fn convert(&mut self, bodies: &mut M::State<S>);

    /// Forgets it: bodies of a later one are known.
    fn forget_deferred(&mut self);

    /// Where a rule of higher order would have led in the last step.
    fn better_end(&mut self, near: &M::State<S>) -> Option<M::State<S>>;

    /// The power (W) of forces and drivers at the end of the last step, of which the bodies are
    /// known, see [`Dynamics::power_with`](crate::dynamics::Dynamics).
    fn power_at_end(&self, lead: Option<S>, bodies: &M::State<S>) -> Option<S>;

    /// The same at an event within it (s).
    fn power_at_event(&self, lead: Option<S>, event: (S, &M::State<S>)) -> Option<S>;

    /// The same at a time (s) within the last step; `None` as well where there is no telling.
    fn power_within(&mut self, time: S, near: &M::State<S>) -> Option<S>;

    /// Looks whether the last step has ended near to a singular configuration that the motion
    /// passes.
    fn look_for_branches(&mut self);

    /// Whether it has.
    fn is_near_to_branches(&self) -> bool;

    /// Hands over what is remembered of it.
    fn remember_branches(&mut self, memory: &mut Memory<'_, S>);

    /// Visits the elements of the rates at the end of the last step, or of bodies between two
    /// integrations (s). Nothing is counted.
    ///
    /// # Errors
    /// Where there are no rates.
    #[cfg(feature = "std")]
    fn visit_rates(
        &mut self,
        between: Option<(S, &M::State<S>)>,
        visit: &mut dyn FnMut(S),
    ) -> Result<(), Fault>;

    /// By how much these rates differ from others, relative to their size; `None` of elements that
    /// are no rates.
    ///
    /// # Errors
    /// Where there are no rates.
    fn differs(
        &mut self,
        between: Option<(S, &M::State<S>)>,
        elements: &[S],
    ) -> Result<Option<S>, Fault>;
}
