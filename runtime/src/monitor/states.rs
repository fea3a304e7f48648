//! Whether steps, or the tolerance, suit the states of the user's own, which no energy tells of.
//!
//! It costs their rates a step, and eight times more in every second one, at fixed steps; without
//! such states nothing. Only it finds a filter or an oscillator of states that steps make grow:
//! `tests/tests/sound/states.rs`.
//!
//! Every second step is compared with Simpson's rule through the rates at three ends. What it
//! misses is carried on by the rates themselves, so that what forgets its errors is not charged
//! with all of them.

use super::limits::above;
use super::record::MonitoredStep;
use super::warning::Warning;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// What a state may be off by, over its largest value; of its absolute tolerance, which errors of
/// many steps add up to, the same.
const COARSE: f64 = 1e-2;

/// The part of an absolute tolerance below which a state is nothing but round-off.
const NOTHING: f64 = 1e-6;

/// The classical rule of order 4: how far each slope leads to the next one, and its part.
const CLASSICAL: [[f64; 2]; 4] = [
    [0.5, 1.0 / 6.0],
    [0.5, 1.0 / 3.0],
    [1.0, 1.0 / 3.0],
    [0.0, 1.0 / 6.0],
];

/// The square of the radians a step that the rule follows.
const STIFF: f64 = 4.0;

/// By what part steps may differ that count as equal.
const EQUAL: f64 = 1e-6;

/// Of each state its number in its place among the coordinates.
type Numbers<S, M> = <<M as Mechanism>::State<S> as StateParts<S>>::Coordinates;

/// What steps miss of the user's own states.
pub(super) struct States<S: Scalar, M: Mechanism> {
    /// Values and rates at the beginning of two steps, rates between them.
    values: Numbers<S, M>,
    rates: [Numbers<S, M>; 2],
    /// What values are off by, and were at the worst.
    off: Numbers<S, M>,
    worst: Numbers<S, M>,
    /// The largest values.
    largest: Numbers<S, M>,
    /// How many ends of steps are known, and how long the last step was (s).
    known: usize,
    step: S,
}

copied!([S: Scalar, M: Mechanism] States<S, M>);

impl<S: Real, M: Mechanism> States<S, M> {
    pub(super) fn none() -> Self {
        let zeros = Numbers::<S, M>::zeros;
        Self {
            values: zeros(),
            rates: [zeros(), zeros()],
            off: zeros(),
            worst: zeros(),
            largest: zeros(),
            known: 0,
            step: S::zero(),
        }
    }

    /// Rates may jump here.
    pub(super) fn restart(&mut self) {
        self.known = 0;
    }

    /// Takes the end of a step, of a method that controls its steps or does not.
    #[inline]
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>, is_controlled: bool) {
        if M::REPORT.states.is_empty() {
            return;
        }
        let values = step.state.coordinates().as_slice();
        for info in M::REPORT.states {
            let value = at(values, info.coordinate).abs();
            put(&mut self.largest, info.coordinate, |largest| {
                largest.max(value)
            });
        }
        if !is_controlled {
            self.follow(step);
        }
    }

    #[inline(never)]
    fn follow(&mut self, step: &MonitoredStep<'_, S, M>) {
        let length = step.end - step.start;
        let is_equal = (length - self.step).abs() <= S::constant(EQUAL) * length;
        self.step = length;
        let mut rates = Numbers::<S, M>::zeros();
        M::state_rates_into(step.constants, step.end, step.state, &mut rates);
        if self.known == 1 {
            self.rates[1] = rates;
            self.known = 2;
            return;
        }
        if self.known == 2 && is_equal {
            self.carry(step, &rates);
            let values = step.state.coordinates().as_slice();
            let third = length * S::constant(1.0 / 3.0);
            for info in M::REPORT.states {
                let place = info.coordinate;
                let [first, middle] = &self.rates;
                let first = at(first.as_slice(), place);
                let middle = at(middle.as_slice(), place);
                let sum = first + S::constant(4.0) * middle + at(rates.as_slice(), place);
                let gained = at(values, place) - at(self.values.as_slice(), place);
                let missed = gained - third * sum;
                put(&mut self.off, place, |off| off + missed);
                let off = at(self.off.as_slice(), place).abs();
                put(&mut self.worst, place, |worst| worst.max(off));
            }
        }
        self.values = *step.state.coordinates();
        self.rates[0] = rates;
        self.known = 1;
    }

    /// Carries what values are off by over two steps, as their rates at the end lead it.
    fn carry(&mut self, step: &MonitoredStep<'_, S, M>, rates: &Numbers<S, M>) {
        let over = step.end - step.start;
        for _ in 0..2 {
            let off = self.off;
            let [mut last, mut sum] = [off, off];
            for [to_next, of_sum] in CLASSICAL {
                let slope = slope::<S, M>(step, rates, &last);
                if self.is_stiff(over, &slope, &last) {
                    // Nothing is left of what decays within a step.
                    self.off = Numbers::<S, M>::zeros();
                    return;
                }
                last = moved::<S, M>(&off, S::constant(to_next) * over, &slope);
                sum = moved::<S, M>(&sum, S::constant(of_sum) * over, &slope);
            }
            self.off = sum;
        }
    }

    /// Whether a slope leads farther in a step than explicit rules follow.
    fn is_stiff(&self, over: S, slope: &Numbers<S, M>, off: &Numbers<S, M>) -> bool {
        let size = |numbers: &Numbers<S, M>| {
            M::REPORT.states.iter().fold(S::zero(), |sum, info| {
                let largest = at(self.largest.as_slice(), info.coordinate);
                let number = at(numbers.as_slice(), info.coordinate);
                let share = if largest > S::zero() {
                    number.quotient(largest)
                } else {
                    largest
                };
                share.fused(share, sum)
            })
        };
        over * over * size(slope) > S::constant(STIFF) * size(off)
    }

    /// With the absolute tolerance of a method that controls its steps.
    pub(super) fn verdict(&self, absolute: Option<S>) -> Option<Warning> {
        let share = |place: usize| {
            let largest = at(self.largest.as_slice(), place);
            match absolute {
                Some(absolute) if largest <= S::constant(NOTHING) * absolute => S::zero(),
                Some(absolute) => absolute.quotient(largest),
                None if largest > S::zero() => at(self.worst.as_slice(), place).quotient(largest),
                None => S::zero(),
            }
        };
        let shares = M::REPORT.states.iter();
        let shares = shares.map(|info| (info.name, share(info.coordinate)));
        let (state, error) = shares.reduce(|worst, next| {
            let is_less = next.1 <= worst.1;
            if is_less { worst } else { next }
        })?;
        above(error, COARSE).then(|| Warning::CoarseState {
            state,
            error: error.to_f64(),
        })
    }
}

/// By how much rates are off where values are.
fn slope<S: Real, M: Mechanism>(
    step: &MonitoredStep<'_, S, M>,
    rates: &Numbers<S, M>,
    off: &Numbers<S, M>,
) -> Numbers<S, M> {
    let mut right = *step.state;
    for info in M::REPORT.states {
        let off = at(off.as_slice(), info.coordinate);
        put(right.coordinates_mut(), info.coordinate, |value| {
            value - off
        });
    }
    let mut slope = Numbers::<S, M>::zeros();
    M::state_rates_into(step.constants, step.end, &right, &mut slope);
    for info in M::REPORT.states {
        let rate = at(rates.as_slice(), info.coordinate);
        put(&mut slope, info.coordinate, |right| rate - right);
    }
    slope
}

/// `from + over slope`.
fn moved<S: Real, M: Mechanism>(
    from: &Numbers<S, M>,
    over: S,
    slope: &Numbers<S, M>,
) -> Numbers<S, M> {
    let mut moved = *from;
    for info in M::REPORT.states {
        let slope = at(slope.as_slice(), info.coordinate);
        put(&mut moved, info.coordinate, |value| {
            over.fused(slope, value)
        });
    }
    moved
}

fn at<S: Real>(numbers: &[S], place: usize) -> S {
    numbers.get(place).copied().unwrap_or(S::zero())
}

fn put<S: Real>(numbers: &mut impl Array<S>, place: usize, change: impl FnOnce(S) -> S) {
    if let Some(number) = numbers.as_mut_slice().get_mut(place) {
        *number = change(*number);
    }
}
