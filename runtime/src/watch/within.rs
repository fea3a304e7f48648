//! What the watch wants to know of the way between two ends of steps.

use super::verdict::above;
use super::{Watch, limits};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// How near a state is to a singular configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearness<S> {
    /// The smallest relative pivot; 1 where there is none to look at.
    pivot: S,
    /// What is left of the gradients, see [`Gradients`](super::gradients::Gradients).
    gradient: S,
}

impl<S: Real> Nearness<S> {
    /// Of equations that depend on each other.
    pub(crate) fn singular() -> Self {
        Self {
            pivot: S::zero(),
            gradient: S::one(),
        }
    }

    /// As near as can be.
    fn nearest() -> Self {
        Self {
            pivot: S::zero(),
            gradient: S::zero(),
        }
    }

    /// Whether a course through three states shows no sign of something singular in between.
    pub(crate) fn keep_away(course: [Self; 3]) -> bool {
        keeps_away(course.map(|nearness| nearness.pivot))
            && keeps_away(course.map(|nearness| nearness.gradient))
    }
}

/// Whether what goes with a distance shows no sign of having been zero between three instants:
/// there it bends by twice the distance that it has at one of them.
fn keeps_away<S: Real>(squares: [S; 3]) -> bool {
    let [a, b, c] = squares.map(|square| square.max(S::zero()).sqrt());
    let bend = (a - (b + b) + c).abs();
    bend < S::constant(0.25) * a.min(b).min(c)
}

impl<S: Real, M: Mechanism> Watch<S, M> {
    /// The end of the last step.
    pub(crate) fn time(&self) -> S {
        self.time
    }

    /// How near the mechanism was at the last look, which was at the end of the last step or
    /// shortly before.
    pub(crate) fn last_nearness(&self) -> Nearness<S> {
        let last = self.approach.as_ref().and_then(|approach| approach.last());
        Nearness {
            pivot: last.unwrap_or(S::one()),
            gradient: self.gradients.approach().last().unwrap_or(S::one()),
        }
    }

    /// Whether a step of this length may have passed a singular configuration, whatever was at its
    /// end, with the fastest motion so far.
    pub(crate) fn may_have_passed(&self, step: S) -> bool {
        self.may_pass(
            self.fastest * step,
            [self.last_nearness(), Nearness::nearest()],
        )
    }

    /// Whether a motion (rad) between such states may have passed a singular configuration. Nothing
    /// is to be found where one is known.
    pub(crate) fn may_pass(&self, motion: S, [from, to]: [Nearness<S>; 2]) -> bool {
        let by_pivots = self.approach.as_ref().is_some_and(|approach| {
            above(approach.fall(), limits::NEARLY_SINGULAR)
                && approach.may_pass(motion, [from.pivot, to.pivot])
        });
        let approach = self.gradients.approach();
        by_pivots
            || above(approach.fall(), limits::NEARLY_SINGULAR)
                && approach.may_pass(motion, [from.gradient, to.gradient])
    }

    /// How fast the mechanism moves at the most (rad/s): at the end of the last step, or in a
    /// state.
    pub(crate) fn faster(&self, state: &M::State<S>) -> S {
        self.rate.max(self.pace.of(state))
    }

    /// How near a state is, by its pivot, if there is one.
    pub(crate) fn nearness(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        pivot: Option<S>,
    ) -> Nearness<S> {
        Nearness {
            pivot: pivot.unwrap_or(S::one()),
            gradient: self.gradients.measure(constants, (time, state)),
        }
    }

    /// Looks at a time within a step; tells whether its pivot was smaller than ever.
    pub(crate) fn look(&mut self, time: S, nearness: Nearness<S>) -> bool {
        self.gradients.look_within(time, nearness.gradient);
        let approach = self.approach.as_mut();
        approach.is_some_and(|approach| approach.step(time, nearness.pivot, S::zero()))
    }

    /// Keeps the state of the smallest pivot.
    pub(crate) fn keep(&mut self, time: S, state: &M::State<S>) {
        self.nearest = (time, *state);
    }

    /// Takes that so much motion (rad) since the last step was looked into, and nothing was passed
    /// unseen.
    pub(crate) fn is_known_for(&mut self, motion: S) {
        let travel = self.travel + motion;
        self.looked = travel;
        self.gradients.is_known_until(travel);
    }
}
