//! In which mode interactions are, and the conditions under which they leave it.

use crate::integrate::Memory;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::bearing::Bearing;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::law::{Friction, Law, Tangent};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::pace::{Haste, Pace};
use crate::nonsmooth::place::dot;
use crate::nonsmooth::reader::Reader;
use crate::nonsmooth::scene::Scene;

/// An impact or another impulse on a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Impact<S> {
    /// When (s).
    pub time: S,
    /// The impulse along the quantity (N m s, N s), positive upwards.
    pub impulse: S,
    /// The rates of the quantity before and after (rad/s, m/s).
    pub rates: [S; 2],
    /// The kinetic energy (J) that the mechanism lost by all impulses of the instant.
    pub lost_energy: S,
}

/// What may follow at an instant, once impulses are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next<S> {
    /// No effort: away from limits, or not engaged.
    Without,
    /// At rest on the lower limit (a positive sign) or the upper one.
    On(S),
    /// Friction at rest.
    Still,
    /// Friction that slides at a rate of this sign.
    Moving(S),
}

/// What an interaction exerts at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Exerted<S> {
    /// Its effort (N m, N) along its quantity, positive upwards.
    pub(crate) effort: S,
    /// The largest effort (N m, N) while it sticks; zero where there is none.
    pub(crate) capacity: S,
    /// The size (N) of the friction of a contact in both directions together.
    pub(crate) size: S,
    /// By what the slip of a contact changes.
    pub(crate) haste: Haste<S>,
    /// The determinant of the equations of all that holds, where contacts slip; zero elsewhere.
    pub(crate) determinant: S,
}

/// What is done with what all interactions exert, in their order.
pub(crate) type Show<'s, S> = dyn FnMut(&[Exerted<S>]) + 's;

/// An interaction in a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Status<S> {
    pub(crate) mode: InteractionMode,
    pub(crate) is_engaged: bool,
    /// A handler has engaged or released it.
    pub(crate) is_asked: bool,
    /// What its capacity is times, at the instant that it is asked at.
    pub(crate) factor: S,
    /// The value that is held.
    pub(crate) held: S,
    /// The direction (global) of the slip at a contact, of length 1, where its mode began or was
    /// last found to go on.
    pub(crate) slip: [S; 3],
    /// When (s) a step that begins with the mode ends at the latest, by how the slip turns.
    pub(crate) pace: Option<Pace<S>>,
    /// The same by the last reading by which the mode goes on.
    pub(crate) known_pace: Option<Pace<S>>,
    /// The direction and that time by the last reading.
    pub(crate) last_slip: [S; 3],
    pub(crate) last_pace: Option<Pace<S>>,
    /// The size (m/s) up to which slip is led by what drives it, if it is at the last reading.
    pub(crate) last_led: Option<S>,
    /// The slip has begun from rest or is led, and is so small that its acceleration tells its
    /// direction.
    pub(crate) begins: bool,
    /// It is beyond its beginning at this size (m/s); at the first look where that is not known.
    pub(super) beginning: Option<S>,
    /// The slip has turned since its mode began.
    pub(super) has_turned: bool,
    /// The slip is so little that its direction stays until it ends.
    pub(crate) ends: bool,
    /// It is tried whether that sticks.
    pub(crate) is_tried: bool,
    /// What it exerted at the last look into a step, or where its mode began.
    pub(crate) exerted: Exerted<S>,
    /// The effort with which the mode began.
    pub(crate) share: S,
    /// The determinant with which modes began, that at the start of a step, and its least part at
    /// stages: see `jam.rs`.
    pub(super) began: S,
    pub(super) determinant: S,
    pub(super) least_part: S,
    /// When (s) it began, or what it holds was last brought back.
    pub(crate) since: S,
    /// The rate that it kept from arising until then: what is held is known to its round-off.
    pub(crate) kept_from: S,
    /// Friction at its capacity that does not move, for something else bears the rest.
    pub(crate) rests: bool,
    /// The same, with its capacity at rest: it has not begun to slide.
    pub(crate) is_saturated: bool,
    /// The last reading of the condition.
    pub(crate) reading: S,
    /// It has left its zero.
    has_left: bool,
    /// Until it has, readings down to this below zero are at zero.
    band: S,
    /// Whether it is the one that was found.
    pub(crate) is_found: bool,
    /// The fastest approach to a limit so far.
    pub(crate) fastest: S,
    /// The largest sum of the sizes of the terms of its rate so far.
    pub(crate) largest: S,
    /// The farthest from both limits that it was seen so far.
    pub(crate) farthest: S,
    pub(crate) impact: Option<Impact<S>>,
    /// What may follow, and the mode before.
    pub(crate) next: Next<S>,
    pub(crate) before: InteractionMode,
}

/// An interaction with its status, which a run changes between steps.
#[derive(Debug)]
pub struct Tracked<S: Scalar, M: Mechanism> {
    pub(crate) interaction: Interaction<S, M>,
    pub(crate) status: Status<S>,
}

impl<S: Scalar, M: Mechanism> Clone for Tracked<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Tracked<S, M> {}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    pub(crate) fn new(interaction: Interaction<S, M>) -> Self {
        let mut tracked = Self {
            interaction,
            status: Status::new(),
        };
        tracked.begin();
        tracked
    }

    /// As at the start of a run.
    pub(crate) fn begin(&mut self) {
        let law = &self.interaction.law;
        self.status = Status {
            is_engaged: law.is_engaged(),
            mode: law.first_mode(),
            ..Status::new()
        };
    }

    /// What bears the load that its friction goes with.
    pub(crate) fn bearing(&self) -> Option<&Bearing<S>> {
        self.interaction.law.bearing()
    }

    /// Its friction at the instant that it is asked at.
    pub(super) fn friction(&self) -> Option<Friction<S>> {
        let friction = self.interaction.law.friction()?;
        Some(friction.scaled(self.status.factor))
    }

    /// Where it stands, as friction of a contact.
    pub(crate) fn tangent(&self) -> Option<Tangent> {
        self.interaction.law.tangent()
    }

    /// Whether it is slip that begins.
    pub(super) fn begins(&self) -> bool {
        self.slips_on_contact() && self.status.begins
    }

    /// Whether it is friction of a contact that slips.
    pub(crate) fn slips_on_contact(&self) -> bool {
        self.mode() == InteractionMode::Slipping
    }

    /// The mode.
    pub(crate) fn mode(&self) -> InteractionMode {
        self.status.mode
    }

    /// The mode as it is told: what does not move sticks, at its capacity as well.
    pub(crate) fn told_mode(&self) -> InteractionMode {
        if self.status.rests && self.mode().sliding::<S>().is_some() {
            InteractionMode::Sticking
        } else {
            self.mode()
        }
    }

    /// The reading of the condition under which the present mode ends: positive as long as it is
    /// right. Infinite of a mode that does not end by itself. By what the status has of its effort.
    pub(crate) fn reading(&self, scene: &Scene<'_, S, M>) -> S {
        let never = S::constant(f64::INFINITY);
        if self.interaction.is_dropped {
            return never;
        }
        let Interaction { quantity, law, .. } = &self.interaction;
        let Exerted {
            effort,
            capacity,
            size,
            ..
        } = self.status.exerted;
        if let Some(tangent) = law.tangent() {
            // Both directions have one mode, which the first one tells.
            return match self.mode() {
                _ if tangent.behind > 1 => never,
                InteractionMode::Sticking => capacity - size,
                InteractionMode::Slipping => match Reader::of(scene).touch(quantity) {
                    Some(touch) => dot(&self.status.slip, &touch.slip_vector(tangent.has_both)),
                    None => never,
                },
                _ => never,
            };
        }
        match (self.mode(), law) {
            (InteractionMode::Free, Law::Limits(limits)) => limits.gap(quantity.value(scene)).0,
            (InteractionMode::AtLower, _) => effort,
            (InteractionMode::AtUpper, _) => -effort,
            (InteractionMode::Sticking, Law::Friction(friction)) => {
                let [lower, upper] = if friction.at_rest().is_finite() {
                    friction.between(capacity)
                } else {
                    friction.bounds()
                };
                (effort - lower).min(upper - effort)
            }
            // It ends with the mode of what bears the rest.
            _ if self.status.is_saturated => never,
            (mode, _) => match mode.sliding::<S>() {
                Some(sign) => sign * quantity.rate(scene),
                None => never,
            },
        }
    }
}

impl<S: Real> Exerted<S> {
    pub(crate) fn nothing() -> Self {
        Self {
            effort: S::zero(),
            capacity: S::zero(),
            size: S::zero(),
            haste: Haste::none(),
            determinant: S::zero(),
        }
    }
}

impl<S: Real> Status<S> {
    fn new() -> Self {
        Self {
            mode: InteractionMode::Free,
            is_engaged: true,
            is_asked: false,
            factor: S::one(),
            held: S::zero(),
            slip: [S::zero(); 3],
            pace: None,
            known_pace: None,
            last_slip: [S::zero(); 3],
            last_pace: None,
            last_led: None,
            begins: false,
            beginning: None,
            has_turned: false,
            ends: false,
            is_tried: false,
            exerted: Exerted::nothing(),
            share: S::zero(),
            began: S::zero(),
            determinant: S::zero(),
            least_part: S::zero(),
            since: S::zero(),
            kept_from: S::zero(),
            rests: false,
            is_saturated: false,
            reading: S::zero(),
            has_left: true,
            band: S::zero(),
            is_found: false,
            fastest: S::zero(),
            largest: S::zero(),
            farthest: S::zero(),
            impact: None,
            next: Next::Without,
            before: InteractionMode::Free,
        }
    }

    /// Whether it was found at the end of what it bears without sliding.
    pub(super) fn slips(&self) -> bool {
        self.is_found && self.before == InteractionMode::Sticking
    }

    /// Engages or releases it.
    pub(crate) fn engage(&mut self, is_engaged: bool) {
        self.is_engaged = is_engaged;
        self.is_asked = true;
    }

    /// Begins a mode with the reading of its condition, which resolves no more than `floor`.
    pub(crate) fn stand(&mut self, reading: S, floor: S) {
        let two = S::constant(2.0);
        self.is_found = false;
        self.is_asked = false;
        self.has_left = reading > two * floor;
        let band = if self.has_left {
            floor
        } else {
            floor.max(two * reading.abs())
        };
        // A reading of exactly zero, of what bears nothing, is at zero.
        self.band = band.max(S::smallest());
    }

    /// What is held is brought back at a time: without the efforts of all that holds it would have
    /// got a rate by such an acceleration.
    pub(super) fn is_brought_back(&mut self, time: S, acceleration: S) {
        let span = time - self.since;
        if self.mode.holds() && span > S::zero() {
            self.kept_from = (acceleration * span).abs();
            self.since = time;
        }
    }

    /// Whether it is in a free flight that never left the limit by more than round-off: what ends
    /// that does not bounce, be it found there or together with another.
    pub(super) fn has_not_flown(&self) -> bool {
        self.mode == InteractionMode::Free && !self.has_left
    }

    /// Whether a free flight that ends at a rate and a time (s) rose by no more than round-off: of
    /// a parabola that is a quarter of their product.
    pub(super) fn is_round_off(&self, rate: S, time: S) -> bool {
        let is_flight = self.mode == InteractionMode::Free && self.is_found;
        is_flight && rate * (time - self.since) <= S::constant(8.0) * self.band
    }

    /// Whether the mode ends where the next reading is this one.
    pub(crate) fn is_met(&self, reading: S) -> bool {
        self.upwards(reading) >= S::zero()
    }

    /// A reading that is negative as long as the mode is right.
    pub(crate) fn upwards(&self, reading: S) -> S {
        if self.has_left {
            -reading
        } else {
            -(reading + self.band)
        }
    }

    /// Hands over on which side of its zero the condition is.
    pub(super) fn remember_side(&mut self, memory: &mut Memory<'_, S>) {
        memory.flag(&mut self.has_left);
        memory.number(&mut self.band);
    }

    /// Goes on with the last reading, by which the mode does not end.
    pub(crate) fn go_on(&mut self) {
        if self.mode == InteractionMode::Slipping {
            if let Some(size) = self.last_led.take() {
                (self.begins, self.beginning) = (true, Some(size));
            }
            self.begins &= self.beginning.is_some();
            self.known_pace = self.last_pace;
            self.has_turned |= self.last_pace.is_some();
            if !self.ends {
                self.slip = self.last_slip;
            }
        }
        self.has_left |= self.reading > self.band;
        if self.mode == InteractionMode::Free && self.reading.is_finite() {
            self.farthest = self.farthest.max(self.reading);
        }
    }
}

#[cfg(test)]
mod tests;
