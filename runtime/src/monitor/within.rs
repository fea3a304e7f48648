//! What the monitor asks for of the way between two ends of steps.

use super::Monitor;
use super::limits::{self, above};
use super::singular::Approach;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// How near a state is to a singular configuration, as far as it is asked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearness<S> {
    /// The smallest relative pivot; `None` where it is not asked, or there is none.
    pivot: Option<S>,
    /// What is left of the gradients, see [`Gradients`](super::gradients::Gradients).
    gradient: Option<S>,
}

/// What is asked of a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    pub(crate) pivot: bool,
    pub(crate) gradient: bool,
}

impl<S: Real> Nearness<S> {
    /// Of equations that depend on each other.
    pub(crate) fn singular(asked: Asked) -> Self {
        Self {
            pivot: asked.pivot.then(S::zero),
            gradient: asked.gradient.then(S::one),
        }
    }

    /// Whether a way through three states shows no sign of something singular in between.
    pub(crate) fn keep_away(states: [Self; 3]) -> bool {
        keeps_away(states.map(|nearness| nearness.pivot))
            && keeps_away(states.map(|nearness| nearness.gradient))
    }
}

/// Whether what goes with a distance shows no sign of having been zero between three instants:
/// there it bends by twice the distance that it has at one of them.
fn keeps_away<S: Real>(squares: [Option<S>; 3]) -> bool {
    let [Some(a), Some(b), Some(c)] = squares else {
        return true;
    };
    let [a, b, c] = [a, b, c].map(|square| square.max(S::zero()).sqrt());
    let bend = (a - (b + b) + c).abs();
    bend < S::constant(0.25) * a.min(b).min(c)
}

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// The end of the last step.
    pub(crate) fn time(&self) -> S {
        self.travel.time
    }

    /// The power (W) of the forces at the start of the step that ends with a power, and to what
    /// precision (J) their work is to be looked for; `None` where the powers at its ends tell.
    #[inline]
    pub(crate) fn asks_for_work(&self, end: S, power: S) -> Option<(S, S)> {
        self.energy.asks(end, power)
    }

    /// How near the mechanism was at the last look, which was at the end of the last step or
    /// shortly before.
    pub(crate) fn last_nearness(&self, asked: Asked) -> Nearness<S> {
        let last = self.pivots.approach().and_then(Approach::last);
        Nearness {
            pivot: last.filter(|_| asked.pivot),
            gradient: self.gradients.approach().last().filter(|_| asked.gradient),
        }
    }

    /// What is to be asked of the end of a step of this length, with the fastest motion so far:
    /// what may have passed zero in it, whatever is at its end. Nothing is to be found where a
    /// singular configuration is known.
    #[inline]
    pub(crate) fn asks(&self, step: S) -> Asked {
        let motion = self.travel.fastest * step;
        let may_pass = |approach: &Approach<S>| {
            approach.may_come_to_pass(motion) && above(approach.fall(), limits::NEARLY_SINGULAR)
        };
        let gradients = self.gradients.approach();
        Asked {
            pivot: self.pivots.approach().is_some_and(may_pass),
            gradient: gradients.last().is_some() && may_pass(gradients),
        }
    }

    /// Whether a motion (rad) between such states may have passed a singular configuration. Nothing
    /// is to be found where one is known.
    pub(crate) fn may_pass(&self, motion: S, [from, to]: [Nearness<S>; 2]) -> bool {
        let may_pass = |approach: &Approach<S>, ends: [Option<S>; 2]| match ends {
            [Some(from), Some(to)] => {
                above(approach.fall(), limits::NEARLY_SINGULAR)
                    && approach.may_pass(motion, [from, to])
            }
            _ => false,
        };
        let by_pivots = self.pivots.approach();
        by_pivots.is_some_and(|approach| may_pass(approach, [from.pivot, to.pivot]))
            || may_pass(self.gradients.approach(), [from.gradient, to.gradient])
    }

    /// How fast the mechanism moves at the most (rad/s): at the end of the last step, or in a
    /// state.
    pub(crate) fn faster(&self, state: &M::State<S>) -> S {
        self.travel.rate.max(self.measure.of(state))
    }

    /// How near a state is, by its pivot, if there is one.
    pub(crate) fn nearness(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        pivot: Option<S>,
        asked: Asked,
    ) -> Nearness<S> {
        Nearness {
            pivot,
            gradient: asked
                .gradient
                .then(|| self.gradients.measure(constants, (time, state))),
        }
    }

    /// Looks at a time within a step; tells whether its pivot was smaller than ever.
    pub(crate) fn look(&mut self, time: S, nearness: Nearness<S>) -> bool {
        if let Some(gradient) = nearness.gradient {
            self.gradients.look_within(time, gradient);
        }
        let pivot = nearness.pivot;
        pivot.is_some_and(|pivot| self.pivots.look_within(time, pivot))
    }

    /// Keeps the state of the smallest pivot.
    pub(crate) fn keep(&mut self, time: S, state: &M::State<S>) {
        self.pivots.keep(time, state);
    }

    /// Takes that so much motion (rad) since the last step was looked into, and nothing that was
    /// asked was passed unseen.
    pub(crate) fn is_known_for(&mut self, motion: S, asked: Asked) {
        let travel = self.travel.radians + motion;
        if asked.pivot {
            self.pivots.are_known_until(travel);
        }
        if asked.gradient {
            self.gradients.is_known_until(travel);
        }
    }
}
