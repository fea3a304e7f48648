//! The sign of a reading over a run.

use crate::error::{Fault, StepFault};
use crate::integrate::Memory;
use crate::math::scalar::Real;

/// In which direction a reading passes zero, for a condition of [`Simulation::on`].
///
/// A reading that reaches zero has passed it.
///
/// [`Simulation::on`]: crate::Simulation::on
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From below zero upwards.
    Rising,
    /// From above zero downwards.
    Falling,
    /// Either way.
    Either,
}

/// On which side of zero a reading is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Below,
    Above,
    /// At zero and at rest there: no direction is a crossing.
    Unknown,
}

impl Side {
    fn of<S: Real>(reading: S) -> Self {
        if reading > S::zero() {
            Self::Above
        } else if reading < S::zero() {
            Self::Below
        } else {
            Self::Unknown
        }
    }
}

/// How many events of one condition may follow each other at once.
const AT_ONCE: usize = 4;

/// At once: within this part of the longest step of the run.
const MOMENT: f64 = 1e-6;

/// Times closer than so many units in the last place are the same.
const SAME: f64 = 16.0;

/// Whether two times are the same to round-off.
pub(crate) fn is_same<S: Real>(a: S, b: S) -> bool {
    (a - b).abs() <= S::constant(SAME) * a.abs().max(b.abs()).ulp()
}

/// What is read where a motion begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading<S> {
    pub(crate) here: S,
    /// A little ahead on the way of the motion.
    pub(crate) ahead: S,
    /// Down to where it is at zero.
    pub(crate) round_off: S,
}

/// A condition of a run.
#[derive(Clone, Copy, Debug)]
pub struct Watch<S> {
    name: &'static str,
    crossing: Crossing,
    side: Side,
    /// Readings up to this size are still at the zero where the motion began.
    zero: S,
    /// The last reading.
    reading: S,
    /// The size of the readings on either side of the zero that was found.
    scale: S,
    /// Where it passes zero, of an event that is to be handled.
    root: Option<S>,
    /// When it passed last (s), and how often at once.
    last: Option<S>,
    at_once: usize,
}

impl<S: Real> Watch<S> {
    pub(crate) fn new(name: &'static str, crossing: Crossing) -> Self {
        Self {
            name,
            crossing,
            side: Side::Unknown,
            zero: S::zero(),
            reading: S::zero(),
            scale: S::zero(),
            root: None,
            last: None,
            at_once: 0,
        }
    }

    pub(crate) fn name(&self) -> &'static str {
        self.name
    }

    /// Hands over what it remembers between two steps, with its name.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let mut side = match self.side {
            Side::Below => 0,
            Side::Above => 1,
            Side::Unknown => 2,
        };
        memory.label(self.name);
        memory.count(&mut side);
        self.side = match side {
            0 => Side::Below,
            1 => Side::Above,
            _ => Side::Unknown,
        };
        for number in [&mut self.zero, &mut self.reading, &mut self.scale] {
            memory.number(number);
        }
        memory.optional(&mut self.last);
        memory.count(&mut self.at_once);
    }

    /// Where it passes zero, of an event that is to be handled.
    pub(crate) fn root(&self) -> Option<S> {
        self.root
    }

    /// Begins a run with this reading.
    pub(crate) fn begin(&mut self, reading: Reading<S>) {
        *self = Self::new(self.name, self.crossing);
        self.stand([reading.here, reading.ahead], reading.round_off);
    }

    /// A reading that may be at zero: then the way of the motion says on which side it is.
    fn stand(&mut self, [reading, ahead]: [S; 2], size: S) {
        let is_at_zero = reading.abs() <= size;
        (self.side, self.zero) = (Side::Unknown, S::zero());
        self.pass(if is_at_zero { ahead - reading } else { reading });
        self.reading = reading;
        if is_at_zero {
            self.zero = size;
        }
    }

    /// A reading, or the fault of one that is not a number.
    pub(crate) fn checked(&self, time: S, reading: S) -> Result<S, Fault> {
        if reading.to_f64().is_nan() {
            return Err(Fault::Step(StepFault::EventNotANumber {
                event: self.name,
                time: time.to_f64(),
            }));
        }
        Ok(reading)
    }

    /// Whether the condition is met where the next reading is this one.
    pub(crate) fn is_met(&self, reading: S) -> bool {
        match self.side {
            _ if self.is_at_zero() && reading.abs() <= self.zero => false,
            Side::Below => reading >= S::zero() && self.crossing != Crossing::Falling,
            Side::Above => reading <= S::zero() && self.crossing != Crossing::Rising,
            Side::Unknown => false,
        }
    }

    /// A reading with its sign turned, so that it is negative before it passes zero, or leaves the
    /// zero where the motion began.
    pub(crate) fn upwards(&self, reading: S) -> S {
        let upwards = if self.side == Side::Above {
            -reading
        } else {
            reading
        };
        upwards - self.zero
    }

    /// Whether the reading has not left the zero where the motion began.
    fn is_at_zero(&self) -> bool {
        self.zero > S::zero()
    }

    /// Goes on with a reading by which the condition is not met.
    pub(crate) fn pass(&mut self, reading: S) {
        self.reading = reading;
        if reading > self.zero {
            (self.side, self.zero) = (Side::Above, S::zero());
        } else if reading < -self.zero {
            (self.side, self.zero) = (Side::Below, S::zero());
        }
    }

    /// Keeps a reading until [`Watch::go_on`].
    pub(crate) fn keep(&mut self, reading: S, root: Option<S>) {
        self.scale = self.reading.abs().max(reading.abs());
        self.reading = reading;
        self.root = root;
    }

    /// Goes on with the reading that was kept.
    pub(crate) fn go_on(&mut self) {
        self.pass(self.reading);
    }

    /// Takes where the first event of a step is, and the reading there: whether it is this one. One
    /// that is a few last digits later happens then.
    pub(crate) fn take(&mut self, time: S, reading: S, longest: S) -> Result<(), Fault> {
        let is_there = self.root.is_some_and(|root| root <= time) || self.is_met(reading);
        if !is_there {
            self.root = None;
            self.pass(reading);
            return Ok(());
        }
        let moment = (S::constant(MOMENT) * longest).max(S::constant(4.0 * SAME) * time.ulp());
        let at_once = self.last.is_some_and(|last| time - last <= moment);
        let at_once = at_once || self.is_at_zero();
        self.at_once = if at_once { self.at_once + 1 } else { 0 };
        if self.at_once >= AT_ONCE {
            return Err(Fault::Step(StepFault::Chattering {
                event: self.name,
                events: self.at_once + 1,
                time: time.to_f64(),
            }));
        }
        self.last = Some(time);
        if self.is_at_zero() {
            // It never left its round-off, of which the whole reading then is a part.
            let scale = reading.abs().quotient(S::EPSILON.sqrt());
            self.scale = self.scale.max(scale);
        }
        self.zero = S::zero();
        self.root = Some(self.root.map_or(time, |root| root.min(time)));
        self.reading = reading;
        // Where the reading comes from tells, not its last digits.
        self.side = match self.side {
            Side::Below => Side::Above,
            Side::Above => Side::Below,
            Side::Unknown => Side::of(reading),
        };
        Ok(())
    }

    /// Whether it is to be handled.
    pub(crate) fn is_found(&self) -> bool {
        self.root.is_some()
    }

    /// Takes the reading in the state that was found, after its correction.
    pub(crate) fn correct(&mut self, reading: S, round_off: S) {
        if self.is_found() {
            // Its last digits, and what the correction has changed of them, say nothing.
            let digits = self.reading.abs().min(S::EPSILON.sqrt() * self.scale);
            let size = S::constant(2.0) * (digits + (reading - self.reading).abs());
            self.zero = size.max(round_off);
        }
        self.reading = reading;
    }

    /// Takes the reading in a state that was set between two steps: the way of the motion says on
    /// which side one is that is at zero.
    pub(crate) fn move_to(&mut self, reading: Reading<S>) {
        self.root = None;
        let size = self.zero.max(reading.round_off);
        self.stand([reading.here, reading.ahead], size);
    }

    /// Takes the reading after all handlers of an instant; `moved` where a handler has set the
    /// state.
    pub(crate) fn settle(&mut self, reading: Reading<S>, moved: bool) {
        let Reading {
            here,
            ahead,
            round_off,
        } = reading;
        let is_found = self.root.take().is_some();
        if is_found && moved {
            self.stand([here, ahead], self.zero);
        } else if !is_found && here != self.reading {
            // One that is about to pass its zero, or has just done so, does not by round-off.
            let was_near = self.side != Side::Unknown && self.reading.abs() <= round_off;
            if was_near && here.abs() <= round_off {
                self.reading = here;
            } else {
                self.stand([here, ahead], round_off);
            }
        }
    }
}

/// How many numbers a watch is, besides name and direction.
pub(crate) const NUMBERS: usize = 7;

/// As a switch of a law, whose side is always known or at rest at zero.
impl<S: Real> Watch<S> {
    /// All that it remembers; NaN where there is no number.
    pub(crate) fn numbers(&self) -> [S; NUMBERS] {
        let optional = |number: Option<S>| number.unwrap_or_else(|| S::constant(f64::NAN));
        let (root, last) = (optional(self.root), optional(self.last));
        let at_once = S::constant(self.at_once as f64);
        let Self {
            zero,
            reading,
            scale,
            ..
        } = *self;
        [self.side(), zero, reading, scale, root, last, at_once]
    }

    /// What remembers these.
    pub(crate) fn of_numbers(
        name: &'static str,
        crossing: Crossing,
        [side, zero, reading, scale, root, last, at_once]: [S; NUMBERS],
    ) -> Self {
        let optional = |number: S| (!number.to_f64().is_nan()).then_some(number);
        Self {
            name,
            crossing,
            side: Side::of(side),
            zero,
            reading,
            scale,
            root: optional(root),
            last: optional(last),
            at_once: at_once.to_f64() as usize,
        }
    }

    /// The side of zero: 1, -1, or 0 at rest there.
    pub(crate) fn side(&self) -> S {
        match self.side {
            Side::Below => -S::one(),
            Side::Above => S::one(),
            Side::Unknown => S::zero(),
        }
    }

    /// Takes a side anew, at zero until a reading is beyond round-off.
    pub(crate) fn begin_at(&mut self, side: S, round_off: S) {
        (self.side, self.zero, self.root) = (Side::of(side), round_off, None);
    }

    /// The side of a reading that is not at zero.
    pub(crate) fn clear_side(&self, reading: S, round_off: S) -> Option<S> {
        let side = || {
            if reading > S::zero() {
                S::one()
            } else {
                -S::one()
            }
        };
        (reading.abs() > round_off).then(side)
    }

    /// Whether its side is that of a reading. One at zero keeps the side that it has, if it has
    /// one, unless the state was moved.
    pub(crate) fn stays(&self, reading: S, round_off: S, is_moved: bool) -> bool {
        if reading.abs() <= self.zero.max(round_off) {
            !is_moved && self.side != Side::Unknown
        } else {
            Side::of(reading) == self.side
        }
    }

    /// Takes a reading on its side, or at zero.
    pub(crate) fn read(&mut self, reading: S) {
        self.reading = reading;
        if reading.abs() > self.zero {
            self.zero = S::zero();
        }
    }

    /// Takes the reading in the state that was found, after its correction: nobody handles it.
    pub(crate) fn found_at(&mut self, reading: S, round_off: S) {
        self.correct(reading, round_off);
        self.root = None;
    }

    /// Whether a reading has left its side, or the zero where it rests.
    pub(crate) fn is_left(&self, reading: S) -> bool {
        match self.side {
            Side::Unknown => self.beyond(reading) > S::zero(),
            _ => self.is_met(reading),
        }
    }

    /// A reading so that it is negative before that.
    pub(crate) fn beyond(&self, reading: S) -> S {
        match self.side {
            Side::Unknown => reading.abs() - self.zero,
            _ => self.upwards(reading),
        }
    }
}

/// When a controller is called.
#[derive(Clone, Copy, Debug)]
pub struct Period<S> {
    pub(crate) period: S,
    start: S,
    /// How often it was called.
    calls: usize,
}

impl<S: Real> Period<S> {
    pub(crate) fn new(period: S) -> Self {
        Self {
            period,
            start: S::zero(),
            calls: 0,
        }
    }

    /// Begins a run at a time (s).
    pub(crate) fn begin(&mut self, start: S) {
        (self.start, self.calls) = (start, 0);
    }

    /// Hands over what it remembers, with its period.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        memory.same(self.period);
        memory.number(&mut self.start);
        memory.count(&mut self.calls);
    }

    /// The next instant (s).
    pub(crate) fn next(&self) -> S {
        S::constant(self.calls as f64).fused(self.period, self.start)
    }

    /// Whether it is to be called at a time, which is then counted.
    pub(crate) fn is_due(&mut self, time: S) -> bool {
        let next = self.next();
        let is_due = time >= next || is_same(time, next);
        if is_due {
            self.calls = self.calls.saturating_add(1);
        }
        is_due
    }
}

/// Into how many equal parts a step is divided, at whose ends readings are looked at.
pub(crate) const PARTS: usize = 6;

/// How often a step is looked at right after its start, where a reading may be at zero there: each
/// time 16 times later.
const NEAR: usize = 12;

/// The times at which the readings of a step are looked at; `is_fresh` where they may be at zero at
/// its start.
pub(crate) fn looks<S: Real>(start: S, end: S, is_fresh: bool) -> impl Iterator<Item = S> {
    let step = end - start;
    let near = (1..=NEAR).rev().filter(move |_| is_fresh).map(move |k| {
        let part = S::constant(1.0 / (1_u64 << (4 * k)) as f64);
        part.fused(step, start)
    });
    let parts = (1..PARTS).map(move |k| {
        let part = S::constant(k as f64 / PARTS as f64);
        part.fused(step, start)
    });
    let within = near.chain(parts);
    let within = within.filter(move |&time| !is_same(time, start) && !is_same(time, end));
    within.chain(core::iter::once(end))
}
