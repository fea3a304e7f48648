//! The history of what goes with the distance from a singular configuration: of pivots and of
//! gradients.
//!
//! A step may pass over such a configuration. So three pivots around a least one are judged by
//! their parabola and by the sign of their root. The fall of a pivot counts, because unequal masses
//! make it small all along. Where motion and two ends do not exclude a singular configuration, the
//! step is divided by its interpolant until no root can have changed its sign (`run/within.rs`).
//!
//! Branches. A mechanism that is open by `d` keeps a pivot of about `2 d` where an equation
//! becomes a product of two distances, and goes on along either branch. So the limit grows with
//! the largest violation.

use super::limits::{self, above};
use crate::math::scalar::Real;

/// The least relative pivot, over the largest of the run and over the largest violation, in lengths
/// of the mechanism or radians, that counts as near to a singular configuration: near to one in
/// which an equation is a product of two distances, up to the scales of these, an equation that is
/// off by `d` keeps a pivot of `2 d`. A rhombus that goes on along the wrong branch keeps several
/// times the largest violation of the run.
const PASSED_OPEN: f64 = 15.0;

/// A relative pivot and its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nearest<S> {
    pub(super) pivot: S,
    pub(super) time: S,
}

/// The history of the relative pivot over the steps of a run.
///
/// A pivot goes with the square of the distance from the configuration in which it vanishes, and
/// steps may pass over that. So three steps in which the middle one is least are looked at twice: a
/// parabola through them tells how small the pivot was in between, and where its root, the distance
/// with a sign, runs more smoothly through zero than back, it was zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach<S> {
    /// The largest relative pivot at the end of a step.
    largest: S,
    /// The smallest, met or found between steps.
    least: Nearest<S>,
    /// The root of the largest.
    highest: S,
    /// The last two steps: time and pivot.
    before: [Option<(S, S)>; 2],
    /// The root of the last pivot.
    last_root: S,
    /// The largest motion (rad) of a step over the roots of the pivots at its ends, which go with
    /// the distances from where they vanish.
    widest: S,
    /// The largest change of the root of a pivot over the motion (rad) on the way.
    steepest: S,
    /// The motion (rad) that was looked at.
    travelled: S,
    /// How much the root of a pivot may change in a radian beside that of the largest, as far as
    /// the motion that was looked at does not tell, and the motion after which it is less.
    margin: S,
    until: S,
}

/// How many times faster than with the distance the root of a pivot may grow to its largest: a
/// mechanism need not move by a radian from where one vanishes to where it is largest.
const MARGIN: f64 = 4.0;

/// The motion (rad) after which what was seen of the slope counts for more than the margin, in
/// proportion.
const KNOWN: f64 = core::f64::consts::FRAC_PI_2;

/// What is left of the margin after all.
const LEAST: f64 = 0.0625;

/// The sum of the roots of two pivots, over that of the largest, from where on they have fallen: it
/// is 2 where all are the same.
const VARIED: f64 = 1.5;

/// A change of a root, over the largest, that tells something: in a radian of motion or more, and
/// in proportion in less, down to what the digits of a pivot tell.
const NOTED: f64 = 1e-3;

impl<S: Real> Approach<S> {
    pub(super) fn new() -> Self {
        Self {
            largest: S::zero(),
            least: Nearest {
                pivot: S::constant(f64::INFINITY),
                time: S::zero(),
            },
            highest: S::zero(),
            before: [None; 2],
            last_root: S::zero(),
            widest: S::zero(),
            steepest: S::zero(),
            travelled: S::zero(),
            margin: S::constant(MARGIN),
            until: S::constant(KNOWN),
        }
    }

    /// Takes the pivot at the end of a step that the mechanism moved by so far (rad) in; tells
    /// whether there, or since the step before, it was smaller than ever.
    #[inline]
    pub(super) fn step(&mut self, time: S, pivot: S, motion: S) -> bool {
        let root = pivot.max(S::zero()).sqrt();
        if pivot > self.largest {
            (self.largest, self.highest) = (pivot, root);
        }
        self.travelled = self.travelled + motion;
        if self.travelled > self.until {
            let known = self.travelled * S::constant(1.0 / KNOWN);
            self.margin = S::constant(MARGIN).quotient(known).max(S::constant(LEAST));
            self.until = self.travelled * S::constant(1.0625);
        }
        if self.before[1].is_some() {
            let (roots, change) = (self.last_root + root, (root - self.last_root).abs());
            let noted = S::constant(NOTED) * motion.min(S::one());
            let noted = noted.max(S::constant(4.0) * S::EPSILON.sqrt());
            if change > noted * self.highest && motion > S::zero() {
                self.steepest = self.steepest.max(change.quotient(motion));
            }
            // Pivots that hardly vary tell of no such configuration, however long the step is. Nor
            // do those that have changed too slowly so far: no step is looked into for them.
            let is_lower = roots < S::constant(VARIED) * self.highest;
            if is_lower && motion * self.slope() > roots {
                self.widest = self.widest.max(motion.quotient(roots));
            }
        }
        let mut is_least = pivot < self.least.pivot;
        if is_least {
            self.least = Nearest { pivot, time };
        }
        let [first, second] = self.before;
        if let (Some(first), Some(second)) = (first, second)
            && second.1 < first.1
            && second.1 <= pivot
        {
            is_least |= self.between([first, second, (time, pivot)]);
        }
        self.before = [second, Some((time, pivot))];
        self.last_root = root;
        is_least
    }

    /// The lowest point between three of which the second is lowest; whether it is the smallest
    /// pivot.
    pub(super) fn between(&mut self, points: [(S, S); 3]) -> bool {
        let [a, b, c] = points;
        let (slope, curvature) = parabola(points);
        let mut lowest = b.1 - (slope * slope).quotient(S::constant(4.0) * curvature);
        if passes_zero(points) {
            lowest = S::zero();
        }
        let is_least = lowest.plain().is_finite() && lowest < self.least.pivot;
        if is_least {
            let middle = b.0 - S::constant(0.5) * slope.quotient(curvature);
            self.least = Nearest {
                pivot: lowest.max(S::zero()),
                time: middle.max(a.0).min(c.0),
            };
        }
        is_least
    }

    /// The smallest relative pivot, with its time.
    pub(super) fn least(&self) -> Option<Nearest<S>> {
        self.least.pivot.plain().is_finite().then_some(self.least)
    }

    /// Whether a step was so long that it may have passed over a singular configuration unseen: the
    /// distances from one at both its ends, a root of the pivot over the largest each, are together
    /// less than its motion.
    fn may_have_passed(&self) -> bool {
        /// The largest pivot that was met need not be the largest there is.
        const MARGIN: f64 = 1.25;
        self.widest * self.highest * S::constant(MARGIN) > S::one()
    }

    /// The same of a motion (rad) with these pivots at its ends, that can be looked into.
    pub(super) fn may_pass(&self, motion: S, ends: [S; 2]) -> bool {
        let [first, last] = ends.map(|pivot| pivot.max(S::zero()).sqrt());
        motion * self.slope() > first + last
    }

    /// The same of a motion from the last pivot on, whatever is at its end.
    #[inline]
    pub(super) fn may_come_to_pass(&self, motion: S) -> bool {
        motion * self.slope() > self.last_root
    }

    /// How much the root of a pivot may change in a radian.
    #[inline]
    fn slope(&self) -> S {
        (self.margin * self.highest).max(S::constant(2.0) * self.steepest)
    }

    /// The last pivot.
    pub(super) fn last(&self) -> Option<S> {
        self.before[1].map(|(_, pivot)| pivot)
    }

    /// Times and pivots of the last two steps and of a next one, where the middle one is least and
    /// has fallen to half of the largest.
    pub(super) fn dip(&self, next: (S, S)) -> Option<[(S, S); 3]> {
        let [Some(first), Some(second)] = self.before else {
            return None;
        };
        let is_least = second.1 < first.1 && second.1 <= next.1;
        let has_fallen = second.1 < S::constant(0.5) * self.largest;
        (is_least && has_fallen).then_some([first, second, next])
    }

    /// The last pivot over the largest.
    pub(super) fn left(&self) -> Option<S> {
        let last = self.last()?;
        (self.largest > S::zero()).then(|| last.quotient(self.largest))
    }

    /// The smallest over the largest.
    pub(super) fn fall(&self) -> S {
        if self.largest > S::zero() {
            self.least.pivot.quotient(self.largest)
        } else {
            S::one()
        }
    }

    /// Whether pivots, or squares of gradients, that fell so far tell of a singular configuration,
    /// or one may have been passed. A mechanism that is open by a little passes one at a distance
    /// whose square goes with that; of one that is open by more all is reported.
    pub(super) fn is_near(&self, fall: S, open: S) -> bool {
        let passed = !above(open, limits::OPEN) && fall < S::constant(PASSED_OPEN) * open;
        !above(fall, limits::NEARLY_SINGULAR) || passed || self.may_have_passed()
    }
}

/// Slope at the middle of three points and curvature of the parabola through them.
fn parabola<S: Real>([a, b, c]: [(S, S); 3]) -> (S, S) {
    let slopes = [
        (b.1 - a.1).quotient(b.0 - a.0),
        (c.1 - b.1).quotient(c.0 - b.0),
    ];
    let curvature = (slopes[1] - slopes[0]).quotient(c.0 - a.0);
    (slopes[0] + curvature * (b.0 - a.0), curvature)
}

/// Whether the roots of three values bend ten times less if their sign changes on the way.
fn passes_zero<S: Real>(points: [(S, S); 3]) -> bool {
    let [a, b, c] = points.map(|(time, value)| (time, value.max(S::zero()).sqrt()));
    let bend = |points: [(S, S); 3]| parabola(points).1.abs();
    let minus = |(time, root): (S, S)| (time, -root);
    let through = bend([minus(a), b, c]).min(bend([minus(a), minus(b), c]));
    S::constant(10.0) * through < bend([a, b, c])
}

#[cfg(test)]
mod tests {
    use super::Approach;

    /// Steps over `c ((t - t0)^2 + d^2)`, and the fall that is found.
    fn fall(step: f64, distance: f64) -> f64 {
        let mut approach = Approach::new();
        let mut last = f64::INFINITY;
        for k in -40..40 {
            let time = step * (f64::from(k) + 0.3);
            if time.abs() > 1.5 {
                continue;
            }
            let pivot = 0.5 * (time.sin().powi(2) + distance * distance);
            if approach.step(time, pivot, step) {
                last = time;
            }
        }
        assert!(last.abs() <= 2.0 * step);
        assert!(approach.least().unwrap().time.abs() < step);
        approach.fall()
    }

    /// Whether steps over a singular configuration, or past it at a distance, may have passed it.
    fn may_have_passed(step: f64, distance: f64, phase: f64) -> bool {
        let mut approach = Approach::new();
        for k in -400..400 {
            let time = step * (f64::from(k) + phase);
            if time.abs() < 1.5 + step {
                approach.step(time, 0.5 * (time.sin().powi(2) + distance * distance), step);
            }
        }
        approach.may_have_passed()
    }

    #[test]
    fn a_step_that_is_too_long_to_tell_is_told() {
        for step in [0.01, 0.1, 0.4, 0.8, 1.2] {
            for phase in [0.02, 0.2, 0.3, 0.5, 0.7] {
                assert!(may_have_passed(step, 0.0, phase), "{step} {phase}");
                assert!(!may_have_passed(step, 2.0 * step, phase), "{step} {phase}");
            }
        }
    }

    #[test]
    fn pivots_that_stay_tell_nothing() {
        let mut approach = Approach::new();
        for k in 0..10 {
            approach.step(f64::from(k), 1.0 - 0.02 * f64::from(k), 1e6);
        }
        assert!(!approach.may_have_passed());
    }

    /// A coach goes on by a radian a step, and what hangs in it turns by a fiftieth.
    #[test]
    fn motion_that_changes_no_pivot_passes_none() {
        let mut approach = Approach::new();
        for k in -75..=75 {
            let angle = 0.02 * f64::from(k);
            let pivot = 0.5 * (angle.sin().powi(2) + 0.05 * 0.05);
            approach.step(f64::from(k), pivot, 1.0);
        }
        assert!(approach.fall() > 2e-3 && !approach.may_have_passed());
    }

    #[test]
    fn what_is_passed_between_two_steps_is_found() {
        for step in [0.01, 0.03, 0.07, 0.3, 0.5] {
            assert!(fall(step, 0.0) < 1e-4, "{step}: {}", fall(step, 0.0));
        }
        for step in [0.01, 0.03, 0.07, 0.3] {
            assert!(fall(step, 0.2) > 1e-2, "{step}: {}", fall(step, 0.2));
        }
    }
}
