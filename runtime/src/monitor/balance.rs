//! The balance of energy: the work of forces, summed from step to step, and the change of energy.
//!
//! Work is summed by a parabola through the ends of two steps. Its difference from the trapezoid
//! counts as unknown; a smaller change of energy counts as none. Where that difference is large,
//! the ends do not tell the work, and a run is asked to look for it within the step.

use super::limits::DIGITS;
use super::record::Work;
use crate::math::scalar::Real;

/// Work over what is exchanged, whatever its sign, that sets no phase of its own.
const NEXT_TO_NOTHING: f64 = 1e-3;

/// What ends of a step leave unknown of its work, over what steps leave on average, from which on
/// a step is looked into. It is so of an eighth of the steps at the most: powers jump in one, or it
/// is the first one after many short ones.
const OUTLIER: f64 = 8.0;

/// What they leave unknown over the work itself, of a step before which nothing is known.
const FIRST: f64 = 0.1;

/// What is worth a look, over what is exchanged. A change of energy by a hundredth tells.
const WORTH: f64 = 1e-6;

/// To what part of what was unknown it is looked for.
const BETTER: f64 = 1e-2;

/// The same over what is exchanged, where points pass each other closely: a passage is of some
/// hundred steps, and the errors of many passages add up.
const KNOWN_WELL: f64 = 1e-8;

/// Change of energy against the work that was put in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance<S> {
    /// Kinetic and potential energy at the start (J).
    start: S,
    /// Work of all forces without a potential, drivers included, since the start (J).
    work: S,
    /// The potential energy at the start, and the largest difference from it.
    potential: (S, S),
    /// The largest kinetic energy, the largest work so far, and the largest size of the potential
    /// energy.
    kinetic: S,
    exchanged: S,
    height: S,
    /// What energies that cancel are made of at least (J): weights over the length of the
    /// mechanism.
    parts: S,
    /// By how much the integral of the power may be off (J): what the parabola changes of the
    /// trapezoid, step by step, as far as no look within tells more.
    unsure: S,
    /// What the ends of steps left unknown of their work (J), with the number of these steps, and
    /// what those did before which nothing was known.
    left: S,
    counted: usize,
    late: S,
    /// The work whatever its sign (J).
    turnover: S,
    /// The last power (W) and the time of it, and the divided difference before, with its step (s).
    before: Option<(S, S)>,
    slope: Option<(S, S)>,
    /// What is not known of the work of a first step (J), until the next one tells.
    first: Option<S>,
    /// What no force accounts for (J), where it was largest, and when.
    worst: (S, S),
    last: S,
    /// Where energies were taken last: the time (s) and both energies of the integrals, which are
    /// over what no force accounts for, and over the kinetic energy (J s).
    levelled: Option<(S, [S; 2])>,
    integrals: [S; 2],
    duration: S,
}

/// What no force accounts for, and the kinetic energy, on average over time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mean<S> {
    /// What no force accounts for, over the mean kinetic energy.
    pub(super) change: S,
    /// The largest kinetic energy over the mean.
    pub(super) peak: S,
}

/// What the powers at ends of steps tell of the work of one.
struct Ends<S> {
    /// How long it was, and the step before (s).
    step: S,
    former: S,
    /// The divided difference of the powers (W/s), and a sixth of that of two steps (W/s^2).
    slope: S,
    sixth: Option<S>,
    /// The work (J) by the trapezoid, and whatever its sign.
    trapezoid: S,
    turnover: S,
    /// What is not known of the work (J).
    unknown: S,
}

impl<S: Real> Balance<S> {
    pub(super) fn new(kinetic: S, potential: S) -> Self {
        let zero = S::zero();
        Self {
            start: kinetic + potential,
            work: zero,
            potential: (potential, zero),
            kinetic,
            exchanged: zero,
            height: potential.abs(),
            parts: zero,
            unsure: zero,
            late: zero,
            left: zero,
            counted: 0,
            turnover: zero,
            before: None,
            slope: None,
            first: None,
            worst: (zero, zero),
            last: zero,
            levelled: None,
            integrals: [zero; 2],
            duration: zero,
        }
    }

    /// Takes what energies are made of at least (J), of which their round-off is.
    pub(super) fn made_of(&mut self, parts: S) {
        self.parts = parts;
    }

    /// The power jumps here: what was before says nothing of what comes.
    pub(super) fn restart(&mut self) {
        self.before = None;
        self.slope = None;
        self.first = None;
    }

    /// Energy (J) that an event puts in is no work, and nothing to account for.
    pub(super) fn jump(&mut self, energy: S) {
        self.start = self.start + energy;
    }

    /// Takes the energies (J) at the end of a step whose work was added.
    #[inline]
    pub(super) fn level(&mut self, time: S, kinetic: S, potential: S) {
        self.kinetic = self.kinetic.max(kinetic);
        self.height = self.height.max(potential.abs());
        self.potential.1 = self.potential.1.max((potential - self.potential.0).abs());
        self.last = kinetic + potential - self.start - self.work;
        if self.last.abs() > self.worst.0.abs() {
            self.worst = (self.last, time);
        }
        let now = [self.last, kinetic];
        if let Some((then, before)) = self.levelled {
            let step = time - then;
            let half = S::constant(0.5) * step;
            let pairs = now.iter().zip(before);
            for (sum, (&now, before)) in self.integrals.iter_mut().zip(pairs) {
                *sum = half.fused(now + before, *sum);
            }
            self.duration = self.duration + step;
        }
        self.levelled = Some((time, now));
    }

    /// Averages over time; zero where what no force accounts for is not known.
    pub(super) fn mean(&self) -> Mean<S> {
        let [change, kinetic] = self.integrals;
        let unknown = (self.digits() + self.unsure) * self.duration;
        let sure = (change.abs() - unknown).max(S::zero());
        if kinetic > S::zero() {
            Mean {
                change: sure.quotient(kinetic),
                peak: (self.kinetic * self.duration).quotient(kinetic),
            }
        } else {
            Mean {
                change: S::zero(),
                peak: S::one(),
            }
        }
    }

    /// Round-off of the energies themselves (J), as in a mechanism far from the origin.
    fn digits(&self) -> S {
        let parts = self.parts + self.height + self.kinetic;
        S::constant(DIGITS) * S::EPSILON * parts
    }

    /// Takes the work (J) of a step that was estimated twice.
    pub(super) fn add(&mut self, work: [S; 2]) {
        let [a, b] = work;
        let half = S::constant(0.5);
        self.work = self.work + half * (a + b);
        let unknown = half * (a - b).abs();
        self.unsure = self.unsure + unknown;
        self.late = self.late + unknown;
        self.turnover = self.turnover + half * (a.abs() + b.abs());
        self.exchanged = self.exchanged.max(self.work.abs());
    }

    /// What the powers at ends of steps tell of the work of the step to a power (W).
    fn by_ends(&self, time: S, power: S) -> Option<Ends<S>> {
        let (then, last) = self.before?;
        let step = time - then;
        let half = S::constant(0.5) * step;
        let slope = (power - last).quotient(step);
        let former = self.slope.map_or(S::zero(), |(_, former)| former);
        let sixth = self.slope.map(|(before, _)| {
            let curvature = (slope - before).quotient(step + former);
            curvature * S::constant(1.0 / 6.0)
        });
        let unknown = match sixth {
            Some(sixth) => sixth * step * step * step,
            None => (power - last) * step,
        };
        Some(Ends {
            step,
            former,
            slope,
            sixth,
            trapezoid: half * (power + last),
            turnover: half * (power.abs() + last.abs()),
            unknown: unknown.abs(),
        })
    }

    /// The power (W) at the start of a step, and to what precision (J) its work is to be looked for
    /// within it; `None` where the powers at its ends tell. `is_close` where points are close that
    /// a force acts between.
    pub(super) fn asks(&self, time: S, power: S, is_close: bool) -> Option<(S, S)> {
        let ends = self.by_ends(time, power)?;
        let (_, first) = self.before?;
        let size = self.size();
        if is_close {
            return Some((first, S::constant(KNOWN_WELL).max(S::EPSILON) * size));
        }
        let stands_out = if ends.sixth.is_some() {
            let steps = S::constant(self.counted as f64);
            ends.unknown * steps > S::constant(OUTLIER) * self.left
        } else {
            ends.unknown > S::constant(FIRST) * ends.turnover
        };
        let asks = stands_out && ends.unknown > S::constant(WORTH) * size;
        asks.then(|| (first, S::constant(BETTER) * ends.unknown))
    }

    /// Takes the work of a step to a power (W): as it was looked for, or by the parabola through
    /// its ends and the end before.
    pub(super) fn add_work(&mut self, time: S, power: S, within: Option<Work<S>>) {
        if let Some(ends) = self.by_ends(time, power) {
            match within {
                Some(within) => self.add_known(&ends, &within),
                None => self.add_by_ends(&ends),
            }
            self.exchanged = self.exchanged.max(self.work.abs());
            self.slope = Some((ends.slope, ends.step));
        }
        self.before = Some((time, power));
    }

    fn add_known(&mut self, ends: &Ends<S>, within: &Work<S>) {
        self.work = self.work + within.done;
        self.unsure = self.unsure + within.unsure;
        self.turnover = self.turnover + within.turnover;
        let unknown = match ends.sixth {
            Some(_) => ends.unknown,
            None => (within.done - ends.trapezoid).abs(),
        };
        self.first = None;
        self.count(unknown);
    }

    fn add_by_ends(&mut self, ends: &Ends<S>) {
        self.work = self.work + ends.trapezoid;
        self.turnover = self.turnover + ends.turnover;
        self.unsure = self.unsure + ends.unknown;
        let Some(sixth) = ends.sixth else {
            self.first = Some(ends.unknown);
            self.late = self.late + ends.unknown;
            return;
        };
        let Ends { step, former, .. } = *ends;
        self.work = self.work - sixth * step * step * step;
        self.count(ends.unknown);
        // Of a first step no parabola was known.
        if let Some(unknown) = self.first.take() {
            let bend = sixth * former * former * former;
            self.work = self.work - bend;
            self.unsure = self.unsure - (unknown - bend.abs()).max(S::zero());
        }
    }

    /// Counts what the ends of a step left unknown (J).
    fn count(&mut self, unknown: S) {
        self.left = self.left + unknown;
        self.counted = self.counted.saturating_add(1);
    }

    /// The energy that the mechanism exchanges (J).
    pub(super) fn size(&self) -> S {
        self.kinetic.max(self.potential.1).max(self.exchanged)
    }

    /// The energy (J) that the mechanism has more than at the start.
    pub(super) fn gained(&self) -> S {
        self.last + self.work
    }

    /// What no force accounts for at the end, over what is exchanged; zero where it is below the
    /// digits of the energies.
    pub(super) fn drift(&self) -> S {
        self.relative(self.last)
    }

    /// What no force accounts for (J), where it was largest.
    pub(super) fn unaccounted(&self) -> S {
        self.worst.0
    }

    /// The same where it is largest, and its time.
    pub(super) fn worst(&self) -> (S, S) {
        (self.relative(self.worst.0), self.worst.1)
    }

    /// Whether the work is known well enough for the balance to say anything.
    pub(super) fn tells(&self, limit: f64) -> bool {
        self.unsure <= S::constant(limit) * self.size()
    }

    /// How much of the work is not known, whatever its sign: large where forces change faster than
    /// steps follow, and where they begin or end within what a few steps pass.
    pub(super) fn unknown_share(&self) -> S {
        let unknown = self.left + self.late;
        if unknown > S::zero() {
            unknown.quotient(self.turnover)
        } else {
            S::zero()
        }
    }

    /// Whether next to nothing works on the mechanism: forces without a potential, drivers, and
    /// potentials that change by the time alone.
    pub(super) fn is_of_a_closed_system(&self) -> bool {
        self.turnover <= S::constant(NEXT_TO_NOTHING) * self.size()
    }

    fn relative(&self, energy: S) -> S {
        let sure = energy.abs() - self.digits() - self.unsure;
        if sure > S::zero() {
            (if energy < S::zero() { -sure } else { sure }).quotient(self.size())
        } else if sure <= S::zero() {
            S::zero()
        } else {
            sure
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Balance;

    #[test]
    fn work_that_is_put_in_balances() {
        // A unit mass under the force cos t: v = sin t, power sin t cos t.
        let mut balance = Balance::new(0.0, 0.0);
        for step in 0..=60 {
            let t = 0.1 * f64::from(step);
            let (v, power) = (t.sin(), t.sin() * t.cos());
            balance.add_work(t, power, None);
            balance.level(t, 0.5 * v * v, 0.0);
        }
        assert!(balance.drift().abs() < 1e-3, "{}", balance.drift());
        balance.add_work(6.1, 0.0, None);
        balance.level(6.1, 5.0, 0.0);
        assert!(balance.drift() > 0.5);
        assert!(!balance.is_of_a_closed_system());
    }

    #[test]
    fn work_that_ends_of_steps_do_not_tell_is_asked_for() {
        let mut balance = Balance::new(1.0, 0.0);
        let power = |t: f64| 2.0 + t.sin();
        for step in 0..=60 {
            let t = 0.1 * f64::from(step);
            if step != 1 {
                assert_eq!(balance.asks(t, power(t), false), None);
            }
            balance.add_work(t, power(t), None);
        }
        // It jumps in a step, or points are close.
        assert!(balance.asks(6.1, power(6.1) + 1.0, false).is_some());
        let (first, precision) = balance.asks(6.1, power(6.1), true).expect("it asks");
        assert_eq!(first, power(6.0));
        assert!(precision > 0.0 && precision < 1e-6);
        balance.restart();
        assert_eq!(balance.asks(6.1, 9.0, false), None);
    }

    #[test]
    fn round_off_is_no_drift() {
        let mut balance = Balance::new(0.0, 1e9);
        balance.level(1.0, 0.0, 1e9 + 1e-7);
        assert_eq!(balance.drift(), 0.0);
        assert!(balance.is_of_a_closed_system());
    }
}
