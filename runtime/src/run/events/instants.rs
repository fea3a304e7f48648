//! When a switch of the time alone passes its zero: found ahead, and never missed.
//!
//! The kernel over intervals encloses the expression and its slope on a whole stretch of time.
//! Where the expression has no zero there, it passes none. Where the slope has none, there is at
//! most one, which the signs at the ends tell. Else the stretch is halved.

use crate::error::Fault;
use crate::forward::Forward;
use crate::forward::interval::Interval;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::switch::Switch;
use crate::run::events::switching::undecided;
use crate::state::vector::{Array, StateParts};
use crate::stepping::locate::{MOST, locate};

/// Enclosures of a value and of its slope.
type Enclosed = Forward<Interval, 1>;

/// Stretches shorter than so many units in the last place of the times of a search are not halved.
const SHORTEST: f64 = 8.0;

/// Twice what a root is off at the most, in units in the last place of the end of its stretch.
const ROUGH: f64 = 16.0;

/// More stretches than any law should need.
const STRETCHES: usize = 100_000;

/// How often a stretch is halved towards its start, to see which way an expression leaves zero.
const HALVINGS: usize = 48;

/// The expressions of the time alone, over numbers and over intervals.
pub(crate) struct Instants<M: Mechanism> {
    numbers: M::Constants<f64>,
    intervals: M::Constants<Enclosed>,
}

impl<M: Mechanism> Instants<M> {
    /// By parameters, inputs and sides that are held.
    pub(crate) fn new<S: Real>(parameters: &M::Parameters<S>) -> Self {
        Self {
            numbers: M::prepare(&converted::<S, f64, M>(parameters, |x| x)),
            intervals: M::prepare(&converted::<S, Enclosed, M>(parameters, |x| {
                Enclosed::constant(x)
            })),
        }
    }

    /// The expression at a time (s).
    pub(crate) fn at(&self, switch: &Switch, time: f64) -> f64 {
        reading::<f64, M>(&self.numbers, switch, time)
    }

    /// What an expression changes by at a time (s) within the digits of roots.
    pub(crate) fn digits(&self, switch: &Switch, time: f64) -> f64 {
        let near = 4.0 * ROUGH * f64::EPSILON * time.abs();
        let [before, after] = [time - near, time + near].map(|time| self.at(switch, time));
        (after - before).abs()
    }

    /// The expression and its slope on a stretch of time (s).
    fn on(&self, switch: &Switch, from: f64, to: f64) -> [Interval; 2] {
        let time = Forward::new(Interval::new(from, to), [Interval::constant(1.0)]);
        let enclosed = reading::<Enclosed, M>(&self.intervals, switch, time);
        let [slope] = enclosed.derivatives();
        [enclosed.value(), slope]
    }

    /// The side that an expression takes where it has left another.
    pub(crate) fn side_after(&self, switch: &Switch, side: f64, from: f64, until: f64) -> f64 {
        if side == 0.0 || self.at(switch, from) == 0.0 {
            self.side_behind(switch, from, until)
        } else {
            -side
        }
    }

    /// The side that an expression takes behind a time (s), as far as it is seen up to another:
    /// 1, -1, or 0 where it stays at zero.
    pub(crate) fn side_behind(&self, switch: &Switch, from: f64, until: f64) -> f64 {
        let here = self.at(switch, from);
        if here != 0.0 {
            return here.signum();
        }
        let [value, _] = self.on(switch, from, from + shortest(from, until));
        if value.is_zero() {
            return 0.0;
        }
        let halvings = (0..=HALVINGS).rev();
        let parts = halvings.map(|k| (until - from) / (1_u64 << k) as f64);
        let mut seen = parts.map(|part| self.at(switch, from + part));
        seen.find(|reading| *reading != 0.0)
            .map_or(0.0, f64::signum)
    }

    /// The first time (s) in `(from, until]` at which an expression leaves the side of its zero
    /// that is held, be it to rest at zero.
    pub(crate) fn first(
        &self,
        switch: &Switch,
        side: f64,
        (from, until): (f64, f64),
    ) -> Result<Option<f64>, Fault> {
        let (mut at, mut width) = (from, until - from);
        let shortest = shortest(from, until);
        for _ in 0..STRETCHES {
            if at >= until {
                return Ok(None);
            }
            let mut end = at + width;
            if end > until || until - end < width * f64::EPSILON {
                end = until;
            }
            let [value, slope] = self.on(switch, at, end);
            let stays = if side == 0.0 {
                value.is_zero()
            } else {
                value.is_beside_zero(side)
            };
            if side != 0.0 && value.is_zero() {
                return Ok(Some(at));
            }
            let is_shortest = end - at <= shortest;
            if !stays && (is_shortest || side != 0.0 && slope.excludes_zero()) {
                let upwards = |time: f64| -side * self.at(switch, time);
                let reading = self.at(switch, end);
                if reading.is_nan() {
                    return Err(undecided(switch, end));
                }
                if side == 0.0 {
                    if reading != 0.0 {
                        return Ok(Some(at));
                    }
                } else if -side * reading > 0.0 {
                    let read = |time| Ok::<f64, Fault>(upwards(time));
                    let root = locate((at, end), upwards(end), read, MOST)?;
                    // Once more, to the digits of the root instead of those of the end.
                    let near = at.max(root - ROUGH * f64::EPSILON * end.abs());
                    return locate((near, root), upwards(root), read, MOST).map(Some);
                }
            } else if !stays {
                width = 0.5 * (end - at);
                continue;
            }
            at = end;
            width *= 2.0;
        }
        Err(undecided(switch, at))
    }
}

/// The length (s) of a stretch that is not halved.
fn shortest(from: f64, until: f64) -> f64 {
    SHORTEST * f64::EPSILON * from.abs().max(until.abs())
}

/// The expression of a switch over any numbers.
fn reading<T: Scalar, M: Mechanism>(constants: &M::Constants<T>, switch: &Switch, time: T) -> T {
    let mut readings = M::Parameters::<T>::zeros();
    // Nothing is read of it.
    let state = M::State::<T>::from_parts(Array::zeros(), Array::zeros());
    M::switches_of_time_into(constants, time, &state, &mut readings);
    let found = readings.as_slice().get(switch.place).copied();
    found.unwrap_or(T::zero())
}

fn converted<S: Real, T: Scalar, M: Mechanism>(
    parameters: &M::Parameters<S>,
    number: impl Fn(f64) -> T,
) -> M::Parameters<T> {
    let mut converted = M::Parameters::<T>::zeros();
    let both = converted.as_mut_slice().iter_mut();
    for (place, parameter) in both.zip(parameters.as_slice()) {
        *place = number(parameter.to_f64());
    }
    converted
}
