//! Lengths that pass through zero, where forces along them turn round.
//!
//! The direction of such a force flips where its two points meet, and turns fast where they pass
//! close by. A step over that is of first order, by every method. So a step in which a direction
//! turns with its points close is not taken. The run goes on in shorter ones. Each covers a part of
//! the distance, as large a part as the way is straight. Where the points meet to round-off, the
//! velocities lead across in [`ACROSS`] times the least step. A straight passage takes some ten
//! steps, another one some fifty. `passages.rs` is what a run does of this.
//!
//! The separations are those of the bodies at both ends of a step. Where nothing turns round, none
//! of this is compiled.

use crate::integrate::{Memory, Method};
use crate::math::scalar::Real;
use crate::math::vec3::{minus, plus, times};
use crate::mechanism::kernels::Mechanism;

/// A length that ends far from where it was led to does so by this part, squared.
pub(super) const CLOSE: f64 = 0.25;

/// A step that turns a direction is not taken where its points come closer than this part, squared,
/// of their larger distance at its ends. Those of a line that turns at its length come no closer.
const CLOSER: f64 = 0.9;

/// Or where it turns by more than the angle of this cosine, squared, and they come closer than this
/// part, squared. A line of constant length that turns by a radian comes no closer.
const STRONG: [f64; 2] = [0.25, 0.5];

/// What is allowed in a step besides a straight way.
#[derive(Debug)]
pub(super) struct Bends {
    /// The square of the cosine of a turn in a step that is taken however close the points come.
    slight: f64,
    /// A step that turns more is not taken where the points would pass each other on a straight way
    /// at so many ways of the step, squared. What passes farther off turns slowly all along.
    beside: f64,
    /// Part of the distance of the points that is covered, the least and the most: the less, the
    /// wider the passage is against the longest step.
    covered: [f64; 2],
    /// Turn (rad) of the direction behind the passage.
    turned: f64,
}

/// Where points pass each other so closely that what is missed of the turn is little.
const CLOSEST: Bends = Bends {
    slight: 0.97,
    beside: 0.25,
    covered: [0.1, 0.5],
    turned: 0.1,
};

/// These do so at this part, squared, of the longest way in a step.
const CLOSELY: f64 = 1e-7;

/// Of a method of order 4 without control of the error.
const FIXED: Bends = Bends {
    slight: 0.99,
    beside: 1.0,
    covered: [0.03, 0.15],
    turned: 0.03,
};

/// Of one of order 2: what is missed of a turn goes with the square of the part in a step.
const LOW: Bends = Bends {
    slight: 0.9984,
    beside: 1.0,
    covered: [0.02, 0.1],
    turned: 0.02,
};

/// Of one that controls it.
const CONTROLLED: Bends = Bends {
    slight: 0.81,
    beside: 0.25,
    covered: [1.0, 1.0],
    turned: 0.5,
};

impl Bends {
    /// The same where points would pass each other at a distance on a straight way, of which the
    /// longest step would cover so much; both are squared.
    fn of_passage<S: Real>(&'static self, [distance, way]: [S; 2]) -> &'static Self {
        if self.turned < CLOSEST.turned && distance < S::constant(CLOSELY) * way {
            &CLOSEST
        } else {
            self
        }
    }
}

/// A step covers no more than so many distances. What is stiff across them, as forces are by the
/// reciprocal of the length, differs by that much at the ends of a step of an implicit method.
const GROWN: f64 = 1e3;

/// This one on a straight way towards each other: it must not lead across.
const STRAIGHT: f64 = 0.98;

/// A way is straight where the square of the angle to it, times the step, is below this part of the
/// longest step of the run.
const BENT: f64 = 1e-7;

/// The step across, in units in the last place of the longest one of the run.
const LEAST: f64 = 4096.0;

/// How many of them lead across at once.
const ACROSS: f64 = 4.0;

/// The same in units in the last place of the time, and of places on the way.
const LEAST_DIGITS: f64 = 64.0;

/// Where points pass each other again and again, a step is this part of the last swing at the most.
const OF_SWING: f64 = 0.125;

/// The square of the distance, in ways of the longest step, from which on some steps are not looked
/// at.
const FAR_SQUARED: f64 = 1024.0;

/// How many: even from rest on, the way of these is shorter.
const SKIPPED: usize = 3;

/// How often points may pass each other at once.
const AT_ONCE: usize = 8;

/// How many steps may be refused at once: a passage takes a few.
const REFUSED: usize = 64;

/// How often steps may be halved until one is as long as before: up to the digits of the time, and
/// some more.
const HALVED: usize = 256;

/// At once: within this part of the longest step of the run.
const MOMENT: f64 = 1e-3;

/// What a run remembers of lengths that pass through zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passing<S> {
    /// What a step may turn by.
    bends: &'static Bends,
    /// Whether steps that turn more are taken all the same.
    pub(super) takes_all: bool,
    /// How long (s) the segment under way may be, and the next one.
    pub(super) limit: Option<S>,
    pub(super) next: Option<S>,
    /// How long (s) it goes on by its velocities before that, and the place of the length.
    pub(super) across: Option<S>,
    pub(super) place: usize,
    /// The longest step so far (s).
    pub(super) longest: S,
    /// Steps that need not be looked at.
    pub(super) skipped: usize,
    /// When points passed each other last (s), and how often at once.
    pub(super) last: Option<S>,
    at_once: usize,
    /// How long (s) it was before the last time; zero if that was the first.
    swing: S,
    /// When a step was refused first of those at once (s), and how many.
    refused_from: S,
    refused: usize,
    /// How long (s) the last segment was that failed and was halved, or one behind it.
    halved: Option<S>,
    halvings: usize,
    /// Whether the last step was not taken.
    refuses: bool,
    /// Whether the segment under way ends only because its steps are limited.
    is_cut: bool,
    /// When (s) a segment last ended so: nothing jumps there.
    seam: Option<S>,
}

/// What a step has done to the lengths.
pub(super) struct Judged<S> {
    /// The place of one whose direction turns with its points close.
    pub(super) turns: Option<usize>,
    /// How many times the step the next one may be: from its start by those that turn, and from its
    /// end by all.
    pub(super) from_start: S,
    from_end: S,
    /// Whether all points are far from each other.
    pub(super) is_far: bool,
    /// Whether some pass each other within the way of the longest step.
    pub(super) passes: bool,
    /// The square of the shortest way (m) of those that are not.
    way: S,
}

impl<S: Real> Passing<S> {
    /// Nothing yet, of a run with this method.
    pub(crate) fn by<I: Method<S>>(integrator: &I) -> Self {
        let model = integrator.error_model();
        let is_low = model.phase_error > 0.0;
        Self {
            // In shorter ones velocities would be ahead by less, and the energy another.
            takes_all: model.stagger > 0.0,
            bends: match integrator.tolerance() {
                Some(_) => &CONTROLLED,
                None if is_low => &LOW,
                None => &FIXED,
            },
            limit: None,
            next: None,
            across: None,
            place: 0,
            longest: S::zero(),
            skipped: 0,
            last: None,
            at_once: 0,
            swing: S::zero(),
            refused_from: S::zero(),
            refused: 0,
            halved: None,
            halvings: 0,
            refuses: false,
            is_cut: false,
            seam: None,
        }
    }

    /// Whether the segment has ended before a step that must be shorter, at a time (s).
    pub(crate) fn has_refused(&mut self, time: S) -> bool {
        let has_refused = core::mem::take(&mut self.refuses);
        if has_refused || self.is_cut {
            self.seam = Some(time);
        }
        has_refused
    }

    /// Forces may jump where the segment ends.
    pub(crate) fn ends_with_a_jump(&mut self) {
        self.is_cut = false;
        self.halvings = 0;
    }

    /// Forgets what was planned from the end of a segment on that has not reached it.
    pub(crate) fn forget_plan(&mut self) {
        (self.limit, self.next, self.across) = (None, None, None);
        self.halved = None;
        self.ends_with_a_jump();
    }

    /// Whether a segment goes on from a time (s) as the one before it ended.
    pub(crate) fn goes_on(&mut self, from: S) -> bool {
        self.seam.take() == Some(from)
    }

    /// Hands over what it remembers between two steps.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        memory.optional(&mut self.limit);
        memory.optional(&mut self.next);
        memory.optional(&mut self.across);
        memory.optional(&mut self.halved);
        memory.count(&mut self.halvings);
        memory.count(&mut self.place);
        memory.number(&mut self.longest);
        memory.count(&mut self.skipped);
        memory.optional(&mut self.last);
        memory.count(&mut self.at_once);
        memory.number(&mut self.swing);
        memory.number(&mut self.refused_from);
        memory.count(&mut self.refused);
        memory.optional(&mut self.seam);
    }

    /// Begins a segment.
    pub(crate) fn begin(&mut self) {
        let two = S::constant(2.0);
        let grown = self.halved.map(|halved| two * halved);
        let grown = grown.filter(|&grown| grown < self.longest);
        self.limit = self.next.take().or(grown);
        self.halved = self.halved.and(self.limit);
        if self.halved.is_none() {
            self.halvings = 0;
        }
        self.skipped = 0;
    }

    /// Where (s) the segment ends that begins at a time and may end at another.
    pub(crate) fn end(&mut self, from: S, until: S) -> S {
        let end = self.limit.map_or(until, |limit| from + limit);
        // What would be left is no step.
        self.is_cut = end + self.least(end) < until;
        if self.is_cut { end } else { until }
    }

    /// The step (s) across.
    fn least(&self, time: S) -> S {
        let digits = S::constant(LEAST_DIGITS) * time.ulp();
        (S::constant(LEAST) * S::EPSILON * self.longest).max(digits)
    }

    /// The same where places are up to a size (m), and change in a step as was judged.
    pub(super) fn least_of(&self, judged: &Judged<S>, (start, end): (S, S), size: S) -> S {
        let digits = S::constant(LEAST_DIGITS) * S::EPSILON * size;
        let way = judged.way.max(S::smallest()).sqrt();
        self.least(end).max((digits * (end - start)).quotient(way))
    }

    /// Whether a step between two times (s) is taken; the next segment is limited accordingly.
    pub(super) fn takes(
        &mut self,
        judged: &Judged<S>,
        (start, end): (S, S),
        size: S,
    ) -> Result<bool, usize> {
        let step = end - start;
        let least = self.least_of(judged, (start, end), size);
        self.longest = self.longest.max(step);
        if let Some(place) = judged.turns {
            let next = (judged.from_start * step).min(S::constant(0.5) * step);
            self.plan(next, least, place);
            return self.refuse(start).then_some(false).ok_or(place);
        }
        let swings = self.swings(end);
        let mut left = judged.from_end * step;
        if swings {
            left = left.min(S::constant(OF_SWING) * self.swing);
        }
        if (self.limit.is_some() || swings) && left < self.longest {
            self.plan(left, least, self.place);
        }
        self.skipped = if judged.is_far && !swings { SKIPPED } else { 0 };
        Ok(true)
    }

    /// Whether a step (s) from a time (s) on that has failed is tried again, of half its length.
    pub(super) fn halve(&mut self, time: S, step: S) -> bool {
        self.longest = self.longest.max(step);
        let half = S::constant(0.5) * step;
        (self.next, self.across, self.halved) = (Some(half), None, Some(half));
        self.halvings += 1;
        self.refuses = half > self.least(time) && self.halvings < HALVED;
        self.refuses
    }

    /// Plans the next segment (s): across, if it is below the least step.
    pub(super) fn plan(&mut self, next: S, least: S, place: usize) {
        (self.next, self.across, self.place) = (Some(next), None, place);
        if next < least {
            let across = S::constant(ACROSS) * least;
            let behind = S::constant(0.5 * GROWN) * across;
            (self.next, self.across) = (Some(behind), Some(across));
        }
    }

    /// Whether the points may pass each other soon, as they did before.
    fn swings(&self, time: S) -> bool {
        let is_short = self.swing < self.longest + self.longest;
        let last = self.last.filter(|_| is_short && self.swing > S::zero());
        last.is_some_and(|last| time - last <= self.swing + self.swing)
    }

    /// Refuses a step from a time (s) on; whether that is not too often.
    pub(super) fn refuse(&mut self, time: S) -> bool {
        let moment = S::constant(MOMENT) * self.longest;
        if self.refused == 0 || time - self.refused_from > moment {
            (self.refused_from, self.refused) = (time, 0);
        }
        self.refused += 1;
        self.refuses = true;
        self.refused <= REFUSED
    }

    /// Counts that points have passed each other.
    pub(super) fn count(&mut self, time: S, place: usize) -> Result<(), usize> {
        let moment = S::constant(MOMENT) * self.longest;
        let is_at_once = self.last.is_some_and(|last| time - last <= moment);
        self.at_once = if is_at_once { self.at_once + 1 } else { 0 };
        self.swing = self.last.map_or(S::zero(), |last| time - last);
        self.last = Some(time);
        if self.at_once >= AT_ONCE {
            return Err(place);
        }
        Ok(())
    }
}

/// How many times a way may be gone on, from a separation on, by the longest step in such ways.
fn allowed<S: Real>(from: &[S; 3], way: &[S; 3], (longest, bends): (S, &Bends)) -> S {
    let never = S::constant(f64::from(f32::MAX));
    let (at, squared) = (dot(from, from), dot(way, way));
    if at <= S::zero() || squared <= S::zero() {
        return never;
    }
    let (distance, length) = (at.sqrt(), squared.sqrt());
    let distances = distance.quotient(length);
    let towards = -dot(from, way).quotient(distance);
    let sine = (squared - towards * towards).max(S::smallest() * squared);
    let sine = sine.quotient(squared).sqrt();
    let budget = S::constant(BENT) * longest;
    let straight = if towards <= S::zero() {
        let bent = budget.quotient(sine * sine);
        let turned = (S::constant(bends.turned) * distances).quotient(sine);
        bent.max(turned).min(S::constant(GROWN) * distances)
    } else {
        // Up to the closest approach, less what is left where the direction has turned too much.
        let closest = (distance * towards).quotient(squared);
        let left = sine * closest.quotient(budget).sqrt();
        closest * (S::one() - left.max(S::constant(1.0 - STRAIGHT)))
    };
    let [least, most] = bends.covered.map(S::constant);
    // The closest approach in the longest step.
    let offset = (sine * distances).quotient(longest).max(S::smallest());
    let covered = least.quotient(offset.sqrt()).max(least).min(most);
    straight.max(covered * distances).min(never)
}

pub(super) fn dot<S: Real>(a: &[S; 3], b: &[S; 3]) -> S {
    let ([a1, a2, a3], [b1, b2, b3]) = (*a, *b);
    a1 * b1 + a2 * b2 + a3 * b3
}

/// The square of the distance at which points pass each other on a straight way.
fn beside<S: Real>(from: &[S; 3], way: &[S; 3]) -> S {
    let towards = dot(from, way);
    let squared = dot(way, way).max(S::smallest());
    (dot(from, from) - (towards * towards).quotient(squared)).max(S::zero())
}

/// Whether a direction turns in a step with its points close to each other.
fn turns<S: Real>([before, after]: [&[S; 3]; 2], way: &[S; 3], bends: &Bends) -> bool {
    let (at_start, at_end) = (dot(before, before), dot(after, after));
    let squared = dot(way, way);
    // From zero on it has no direction to turn from.
    if at_start <= S::zero() || squared <= S::zero() {
        return false;
    }
    let nearest = (-dot(before, way)).quotient(squared);
    let nearest = nearest.max(S::zero()).min(S::one());
    let closest = plus(before, &times(way, nearest));
    let closest = dot(&closest, &closest);
    let cosine = dot(before, after);
    let turns = |slight: f64| {
        cosine <= S::zero() || cosine * cosine < S::constant(slight) * at_start * at_end
    };
    let comes = |close: f64| closest < S::constant(close) * at_start.max(at_end);
    let [strong, close] = STRONG;
    let passes = beside(before, way) < S::constant(bends.beside) * squared;
    turns(bends.slight) && passes && comes(CLOSER) || turns(strong) && comes(close)
}

/// Looks at the separations at the start and at the end of a step.
pub(super) fn judged<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    ends: [(S, &M::State<S>); 2],
    passing: &Passing<S>,
) -> Judged<S> {
    let Passing { longest, bends, .. } = *passing;
    let never = S::constant(f64::from(f32::MAX));
    let mut judged = Judged {
        turns: None,
        from_start: never,
        from_end: never,
        is_far: true,
        passes: false,
        way: never,
    };
    let [(start, _), (end, _)] = ends;
    let longest = longest.max(end - start).quotient(end - start);
    M::separations(constants, ends, &mut |place, [before, after]| {
        let way = minus(&after, &before);
        let longest_way = times(&way, longest);
        let longest_way = dot(&longest_way, &longest_way);
        if dot(&before, &before) > S::constant(FAR_SQUARED) * longest_way {
            return;
        }
        let passes_at = beside(&before, &way);
        let bends = bends.of_passage([passes_at, longest_way]);
        let by = (longest, bends);
        judged.is_far = false;
        judged.way = judged.way.min(dot(&way, &way));
        judged.from_end = judged.from_end.min(allowed(&after, &way, by));
        let is_nearest_within = dot(&before, &way) <= S::zero() && dot(&after, &way) >= S::zero();
        judged.passes |= is_nearest_within && passes_at < longest_way;
        if turns([&before, &after], &way, bends) {
            judged.turns = Some(place);
            judged.from_start = judged.from_start.min(allowed(&before, &way, by));
        }
    });
    judged
}
