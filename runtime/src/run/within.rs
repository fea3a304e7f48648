//! What the ends of a step do not tell: singular configurations between them, and what a method of
//! low order misses.

use crate::dynamics::equations::Equations;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::monitor::{Asked, Monitor, Nearness};
use crate::stepping::marching::Marching;

/// How often a step is divided at the most.
const FINEST: usize = 8;

/// How often a step is divided before the sequence of its pivots may say that nothing was passed.
const COARSEST: usize = 2;

/// The part of an interval at which it is divided: not its middle, for a motion may repeat itself
/// in half a step.
const DIVISION: f64 = 0.44;

/// Shows the monitor where a step has led to, and where a rule of higher order would have led.
pub(crate) fn judge<S: Real, M: Mechanism>(
    monitor: &mut Monitor<S, M>,
    equations: &dyn Equations<S, M>,
    (time, state): (S, &M::State<S>),
    better: &M::State<S>,
) {
    monitor.judge((equations.constants(), time), [state, better]);
}

/// Evaluations of an integration so far, and those of them that looked into the last step; zero
/// where nothing did.
#[derive(Clone, Copy)]
pub(crate) struct Looks {
    pub(crate) evaluations: usize,
    pub(crate) looks: usize,
}

impl Looks {
    pub(crate) const NONE: Self = Self {
        evaluations: 0,
        looks: 0,
    };
}

/// Looks into the last step of an integration, or into what comes before an event within it, before
/// its end is corrected or shown to the monitor: as far as pivots at the ends of its parts do not
/// tell that the mechanism kept away from where one vanishes. The bodies stood near by a moment
/// ago.
///
/// By joints a step may be a fifth of a turn.
pub(crate) fn look_within<S: Real, M: Mechanism>(
    monitor: &mut Monitor<S, M>,
    march: &mut dyn Marching<S, M>,
    near: &M::State<S>,
    step_end: S,
    event: Option<&StateAt<S, M>>,
) -> Looks {
    let start = monitor.time();
    let end = event.map_or(step_end, |event| event.time);
    let asked = monitor.asks(end - start);
    if !(asked.pivot || asked.gradient) {
        return Looks::NONE;
    }
    let last = event.map_or_else(|| march.bodies_near(near), |event| event.bodies);
    let rate = monitor.faster(&last);
    let first = monitor.last_nearness(asked);
    let known = march.equations().pivot_seen().filter(|_| event.is_none());
    let last = nearness(monitor, march.equations(), (end, &last), asked, known);
    if !monitor.may_pass(rate * (end - start), [first, last]) {
        return Looks::NONE;
    }
    let before = march.counts().evaluations;
    let seen = march.equations().seen();
    let mut step = Within {
        monitor,
        march,
        near,
        rate,
        asked,
    };
    let is_known = step.between((start, first), (end, last), 0);
    if is_known {
        monitor.is_known_for(rate * (end - start), asked);
    }
    march.equations_mut().recall(seen);
    let evaluations = march.counts().evaluations;
    Looks {
        evaluations,
        looks: evaluations.saturating_sub(before),
    }
}

/// How near a state is to a singular configuration, with its pivot where that is known.
fn nearness<S: Real, M: Mechanism>(
    monitor: &mut Monitor<S, M>,
    equations: &dyn Equations<S, M>,
    (time, bodies): (S, &M::State<S>),
    asked: Asked,
    known: Option<S>,
) -> Nearness<S> {
    let pivot = if asked.pivot {
        known.or_else(|| equations.pivot_within(time, bodies))
    } else {
        None
    };
    monitor.nearness(equations.constants(), (time, bodies), pivot, asked)
}

/// A step that is looked into.
struct Within<'w, S: Real, M: Mechanism> {
    monitor: &'w mut Monitor<S, M>,
    march: &'w mut (dyn Marching<S, M> + 'w),
    near: &'w M::State<S>,
    /// The largest rate of motion (rad/s) at its ends.
    rate: S,
    asked: Asked,
}

impl<S: Real, M: Mechanism> Within<'_, S, M> {
    fn bodies(&mut self, time: S) -> Result<M::State<S>, Fault> {
        // An interpolant between two orientations passes within the sphere of Euler parameters.
        let bodies = self.march.at(time, self.near)?;
        Ok(with_unit_orientations::<S, M>(&bodies))
    }

    /// How near the mechanism was at a time; `None` where there is no telling.
    #[inline(never)]
    fn nearness(&mut self, time: S) -> Option<Nearness<S>> {
        match self.bodies(time) {
            Ok(state) => {
                let equations = self.march.equations();
                let at = (time, &state);
                Some(nearness(self.monitor, equations, at, self.asked, None))
            }
            Err(Fault::Step(StepFault::Singular { .. })) => Some(Nearness::singular(self.asked)),
            Err(_) => None,
        }
    }

    // States stay out of the frames of the recursion, and of those that were least there are few.
    #[inline(never)]
    fn look(&mut self, time: S, nearness: Nearness<S>) {
        if self.monitor.look(time, nearness)
            && let Ok(state) = self.bodies(time)
        {
            self.monitor.keep(time, &state);
        }
    }

    /// Looks at what lies between two times, in order; whether nothing can have been passed unseen.
    fn between(&mut self, from: (S, Nearness<S>), to: (S, Nearness<S>), depth: usize) -> bool {
        let motion = self.rate * (to.0 - from.0);
        if !self.monitor.may_pass(motion, [from.1, to.1]) {
            return true;
        }
        if depth == FINEST {
            return false;
        }
        let time = from.0 + S::constant(DIVISION) * (to.0 - from.0);
        let Some(nearness) = self.nearness(time) else {
            return false;
        };
        if depth >= COARSEST && Nearness::keep_away([from.1, nearness, to.1]) {
            self.look(time, nearness);
            return true;
        }
        let middle = (time, nearness);
        let before = self.between(from, middle, depth + 1);
        self.look(time, nearness);
        let after = self.between(middle, to, depth + 1);
        before && after
    }
}
