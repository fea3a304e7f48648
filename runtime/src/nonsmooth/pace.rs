//! How far a step may go where slip turns while it ends.
//!
//! Near its zero the slip `s` of a contact has `ds/dt = d - f s/|s|`: what drives it, less
//! friction. Its direction goes over into that of `d` at the rate `|d|/|s|`, which no step across
//! the zero resolves. So steps shrink with the slip, until it is little. If what is little would
//! stick, it ends: its direction stays, up to where the slip along it is zero, and an impulse takes
//! what is left beside. That and the friction that then holds do together what friction would have
//! done. Only the way of the slip until then, of the size `|s|^2 / (f - |d|)`, is another.
//!
//! Where `|d|` is `f` slip goes on at its size, in the direction of `d`. Once it is little it is
//! led by that: its direction is that of its acceleration, as of slip that begins.

use crate::integrate::{Memory, Tolerance};
use crate::math::scalar::Real;
use crate::nonsmooth::cone_problem::length;
use crate::nonsmooth::tied::at;

/// What drives slip aside by less than this part of all that acts on it has not turned it: where
/// it shrinks, and where it grows. Shares of what motion does not determine, as of a block on four
/// corners, are known to less than the first. A step over slip that grows enlarges what is aside.
const STRAIGHT_ON: [f64; 2] = [1e-7, 1e-9];

/// Slip that changes by less than this part of all that acts on it stays nearly as it is.
const STEADY: f64 = 1e-5;

/// What drives slip has its direction if it drives it aside by less than this part of all that
/// acts.
const ALIGNED: f64 = 1e-6;

/// Slip of so many tolerances is resolved by a method that controls its error.
const OF_TOLERANCE: f64 = 1e3;

/// What makes slip faster, slower, and turns it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Haste<S> {
    /// How fast (m/s^2) it changes at the most while it turns.
    pub(super) turning: S,
    /// Whether it turns here.
    pub(super) turns: bool,
    /// Whether it does not shrink.
    pub(super) grows: bool,
    /// All that acts on it (m/s^2) where it stays nearly as it is, in the direction of what drives
    /// it; zero elsewhere.
    pub(super) steady: S,
}

impl<S: Real> Haste<S> {
    pub(crate) fn none() -> Self {
        Self {
            turning: S::zero(),
            turns: false,
            grows: false,
            steady: S::zero(),
        }
    }

    /// Of slip in a direction, by accelerations without efforts, and by those of the efforts along
    /// both directions of its contact.
    pub(super) fn of<const K: usize>(
        (matrix, offset): (&[[S; K]; K], &[S; K]),
        efforts: &[S; K],
        pair: [usize; 2],
        [x, y]: [S; 2],
    ) -> Self {
        let mut parts = [[S::zero(); 2]; 2];
        for (place, index) in pair.into_iter().enumerate() {
            let [drive, friction] = &mut parts[place];
            *drive = at(offset, index);
            for (column, (&w, &effort)) in matrix[index].iter().zip(efforts).enumerate() {
                let sum = if pair.contains(&column) {
                    &mut *friction
                } else {
                    &mut *drive
                };
                *sum = w.fused(effort, *sum);
            }
        }
        let [[drive_x, friction_x], [drive_y, friction_y]] = parts;
        let all = length([drive_x, drive_y]) + length([friction_x, friction_y]);
        let aside = (drive_x * y - drive_y * x).abs();
        let along = (drive_x + friction_x) * x + (drive_y + friction_y) * y;
        let (two, grows) = (S::constant(2.0), along >= S::zero());
        let is_steady = along.abs() <= S::constant(STEADY) * all;
        let is_aligned = aside <= S::constant(ALIGNED) * all;
        Self {
            turning: if grows || is_steady {
                (two * aside).max(all.quotient(two * two))
            } else {
                all
            },
            grows: grows || is_steady,
            turns: aside > S::constant(STRAIGHT_ON[usize::from(grows)]) * all,
            steady: if is_steady && is_aligned {
                all
            } else {
                S::zero()
            },
        }
    }

    pub(super) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        memory.number(&mut self.turning);
        memory.flag(&mut self.turns);
        memory.flag(&mut self.grows);
        memory.number(&mut self.steady);
    }
}

/// Slip at a look into a step.
pub(crate) struct SlipHere<S> {
    /// Its direction (global).
    pub(crate) direction: [S; 3],
    /// When a step from there ends at the latest.
    pub(crate) pace: Option<Pace<S>>,
    /// The size (m/s) up to which it is led, if it is.
    pub(crate) led: Option<S>,
}

/// When a step ends at the latest, by slip that turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace<S> {
    /// When (s).
    pub(super) until: S,
    /// How large (m/s) slip that grows was where this was found; zero of slip that shrinks.
    pub(super) grown: S,
    /// The sum of which it is a part.
    pub(super) largest: S,
}

impl<S: Real> Pace<S> {
    /// When (s) a step ends at the latest. A method that controls its error follows slip that grows
    /// by itself, as soon as its tolerance resolves that.
    pub(crate) fn end_of_step(&self, tolerance: Option<Tolerance<S>>) -> Option<S> {
        let is_resolved = tolerance.is_some_and(|tolerance| {
            let error = tolerance.relative.fused(self.largest, tolerance.absolute);
            self.grown > S::constant(OF_TOLERANCE) * error
        });
        (!is_resolved).then_some(self.until)
    }

    pub(super) fn remember(pace: &mut Option<Self>, memory: &mut Memory<'_, S>) {
        let mut is_there = pace.is_some();
        memory.flag(&mut is_there);
        let nothing = Self {
            until: S::zero(),
            grown: S::zero(),
            largest: S::zero(),
        };
        let mut read = pace.unwrap_or(nothing);
        if is_there {
            for number in [&mut read.until, &mut read.grown, &mut read.largest] {
                memory.number(number);
            }
        }
        *pace = is_there.then_some(read);
    }
}
