//! How near a run came to a singular configuration.

use super::seen::Nearest;
use crate::mechanism::Pivot;
use crate::scalar::Real;

/// The course of the relative pivot over the steps of a run.
///
/// A pivot goes with the square of the distance from the configuration in which it vanishes, and steps may pass over that: so a parabola through
/// three steps in which the middle one is least tells how small it was in between.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach<S> {
    /// The largest relative pivot at the end of a step.
    largest: S,
    /// The smallest, met or found between steps.
    least: Nearest<S>,
    /// The last two steps: time and pivot.
    before: [Option<(S, S)>; 2],
}

impl<S: Real> Approach<S> {
    pub(super) fn new() -> Self {
        Self {
            largest: S::zero(),
            least: Nearest::none(),
            before: [None; 2],
        }
    }

    /// Takes the end of a step: the pivot there, and the least of all evaluations on the way.
    #[inline]
    pub(super) fn step(&mut self, time: S, pivot: Pivot<S>, on_the_way: Nearest<S>) {
        self.largest = self.largest.max(pivot.relative);
        if on_the_way.pivot.relative < self.least.pivot.relative {
            self.least = on_the_way;
        }
        let [first, second] = self.before;
        if let (Some(first), Some(second)) = (first, second)
            && second.1 < first.1
            && second.1 <= pivot.relative
        {
            self.between([first, second, (time, pivot.relative)], pivot.joint);
        }
        self.before = [second, Some((time, pivot.relative))];
    }

    /// The lowest point of the parabola through three points of which the second is lowest, at most that; zero where it lies below.
    fn between(&mut self, [a, b, c]: [(S, S); 3], joint: S) {
        let slopes = [
            (b.1 - a.1).quotient(b.0 - a.0),
            (c.1 - b.1).quotient(c.0 - b.0),
        ];
        let curvature = (slopes[1] - slopes[0]).quotient(c.0 - a.0);
        let slope = slopes[0] + curvature * (b.0 - a.0);
        let four = S::constant(4.0);
        let lowest = b.1 - (slope * slope).quotient(four * curvature);
        if lowest.is_finite() && lowest < self.least.pivot.relative {
            let relative = lowest.max(S::zero());
            let half = S::constant(-0.5);
            self.least = Nearest {
                pivot: Pivot { relative, joint },
                time: b.0 + half * slope.quotient(curvature),
            };
        }
    }

    /// The smallest relative pivot, with its time.
    pub(super) fn least(&self) -> Option<Nearest<S>> {
        self.least.pivot.relative.is_finite().then_some(self.least)
    }

    /// The smallest over the largest.
    pub(super) fn fall(&self) -> S {
        if self.largest > S::zero() {
            self.least.pivot.relative.quotient(self.largest)
        } else {
            S::one()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Approach;
    use crate::mechanism::Pivot;
    use crate::watch::seen::Nearest;

    /// Steps over `c ((t - t0)^2 + d^2)`, and the fall that is found.
    fn fall(step: f64, distance: f64) -> f64 {
        let mut approach = Approach::new();
        for k in 0..40 {
            let time = step * (f64::from(k) - 19.7);
            let pivot = Pivot {
                relative: 0.5 * (time.sin().powi(2) + distance * distance),
                joint: 2.0,
            };
            approach.step(time, pivot, Nearest::none());
        }
        assert_eq!(approach.least().unwrap().pivot.joint, 2.0);
        assert!(approach.least().unwrap().time.abs() < step);
        approach.fall()
    }

    #[test]
    fn what_is_passed_between_two_steps_is_found() {
        for step in [0.01, 0.03, 0.07] {
            assert!(fall(step, 0.0) < 1e-4, "{step}: {}", fall(step, 0.0));
            assert!(fall(step, 0.2) > 1e-2, "{step}: {}", fall(step, 0.2));
        }
    }
}
