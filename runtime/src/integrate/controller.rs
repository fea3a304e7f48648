//! The step control of MATLAB's `ode45` and `ode23`, as pure functions.

use super::controlled::OF_DURATION;
use super::{StepLimits, TimeSpan};
use crate::constraints::scales::Scales;
use crate::error::setting::positive;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Vector;

/// What a control may be asked for relative to an element, in `EPSILON`.
const LEAST: f64 = 100.0;

/// The error to be allowed in a step: `relative * max(|y|, absolute / relative)` for every element
/// of the state.
///
/// Both are finite and positive. A relative tolerance below `100 EPSILON` of the number type counts
/// as that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<S> {
    /// Relative to the element.
    pub relative: S,
    /// In the unit of the element: what counts where the element is near zero.
    pub absolute: S,
}

impl<S: Real> Tolerance<S> {
    /// That of a companion: a sixteenth, or as little as the number type has digits for. Where that
    /// is hardly less, three times as much: both differ by twice the error of the first.
    pub(super) fn of_companion(self) -> Self {
        let least = S::constant(LEAST) * S::EPSILON;
        let relative = self.relative.max(least);
        let factor = if relative >= S::constant(4.0) * least {
            least.quotient(relative).max(S::constant(1.0 / 16.0))
        } else {
            S::constant(3.0)
        };
        Self {
            relative: relative * factor,
            absolute: self.absolute * factor,
        }
    }
}

/// `relative = 1e-6`, `absolute = 1e-9`. Of a mechanism that is smaller than a centimetre, a run
/// takes 1e-7 of its length in place of the absolute one.
impl<S: Real> Default for Tolerance<S> {
    fn default() -> Self {
        Self {
            relative: S::constant(1e-6),
            absolute: S::constant(1e-9),
        }
    }
}

/// The default of the absolute tolerance over the length of a mechanism, at the most: positions of
/// a mechanism of any size are then right to a small part of it.
const OF_LENGTH: f64 = 1e-7;

impl<S: Real> Tolerance<S> {
    /// The same for a mechanism of a length (m): the default goes with it.
    pub(super) fn for_length(self, length: S) -> Self {
        let default = Self::default();
        if self != default {
            return self;
        }
        Self {
            absolute: default.absolute.min(S::constant(OF_LENGTH) * length),
            ..default
        }
    }
}

/// The absolute tolerance of scales of one, over the relative one.
const FLOOR: f64 = 1e-3;

impl<S: Real> Tolerance<S> {
    /// A relative tolerance, with the absolute one for a mechanism as its attributes describe it:
    /// the relative one times a thousandth of the least of its scales, of lengths, angles,
    /// velocities and angular velocities, which all stand in one state: the length, 1 rad, the
    /// length over the time, 1 rad over the time, see [`Scales`].
    ///
    /// # Errors
    /// As [`Scales::of`].
    pub fn of<M: Mechanism>(mechanism: &M, relative: S) -> Result<Self, Fault> {
        Ok(Self::with_scales(&Scales::of(mechanism)?, relative))
    }

    /// The same for scales that are known otherwise.
    #[must_use]
    pub fn with_scales(scales: &Scales<S>, relative: S) -> Self {
        let length = scales.length.min(S::one());
        let least = length.min(length.quotient(scales.time));
        Self {
            relative,
            absolute: S::constant(FLOOR) * relative * least,
        }
    }
}

/// The least step that is told from none at a time: 16 units in its last place.
fn told<S: Real>(time: S) -> S {
    S::constant(16.0) * time.ulp()
}

/// The settings of the control.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller<S> {
    /// One over the power of the step that the error goes with.
    exponent: f64,
    pub(super) relative: S,
    /// `absolute / relative`: the element below which the absolute tolerance counts.
    pub(super) floor: S,
    first: Option<S>,
    least: S,
    largest: S,
    /// The end of the interval.
    end: S,
}

/// What the first step takes of the change that the tolerance allows, if a method does not say
/// otherwise.
pub(super) const FIRST_SHARE: f64 = 0.8;

impl<S: Real> Controller<S> {
    /// With the power of the step that the error goes with; of a method of many orders, that of the
    /// first step.
    pub(super) fn new(
        tolerance: Tolerance<S>,
        limits: &StepLimits<S>,
        power: f64,
        span: &TimeSpan<S>,
    ) -> Result<Self, Fault> {
        let relative = positive("relative tolerance", tolerance.relative)?;
        let absolute = positive("absolute tolerance", tolerance.absolute)?;
        let duration = span.duration()?;
        positive("time to the first output", span.first_output)?;
        let relative = relative.max(S::constant(LEAST) * S::EPSILON);
        let set = |name, step: Option<S>| step.map(|step| positive(name, step)).transpose();
        let largest = set("largest step", limits.largest)?;
        let least = set("least step", limits.least)?.unwrap_or(S::zero());
        Ok(Self {
            exponent: 1.0 / power,
            relative,
            floor: absolute.quotient(relative),
            first: set("first step", limits.first)?,
            least,
            // Steps that the time cannot tell lead nowhere.
            largest: largest
                .unwrap_or(S::constant(OF_DURATION) * duration)
                .max(least)
                .max(told(span.start.abs().max(span.end.abs()))),
            end: span.end,
        })
    }

    /// The smallest step at a time.
    pub(super) fn smallest(&self, time: S) -> S {
        self.least.max(told(time))
    }

    /// The end of an integration at a time where a step as small as it may be is not accepted.
    #[cold]
    pub(super) fn underflow(&self, step: S, time: S) -> Fault {
        Fault::Step(StepFault::SizeUnderflow {
            step: step.to_f64(),
            is_least: self.least >= self.smallest(time),
            joint: None,
            resolution: None,
        })
    }

    /// The first step from a state with its slope; `share` is what it takes of the change that the
    /// tolerance allows.
    pub(super) fn first<X: Vector<S>>(
        &self,
        span: &TimeSpan<S>,
        state: &X,
        slope: &X,
        share: f64,
    ) -> S {
        if let Some(first) = self.first {
            return self.limited(span.start, first);
        }
        let rate = state.weighted_norm(state, self.floor, [(S::one(), slope)]);
        let rate = rate.quotient(S::constant(share) * self.relative.powf(self.exponent));
        let step = self.largest.min(span.first_output);
        let step = if step * rate > S::one() {
            rate.reciprocal()
        } else {
            step
        };
        step.max(self.smallest(span.start)).plain()
    }

    /// A step within its limits.
    pub(super) fn limited(&self, time: S, step: S) -> S {
        self.largest.min(self.smallest(time).max(step))
    }

    /// The first trial of a step, and whether it is stretched to the end of the interval: if it
    /// comes within a tenth of it.
    pub(super) fn opening(&self, time: S, step: S) -> (S, bool) {
        let size = self.limited(time, step);
        let remaining = self.remaining(time);
        if S::constant(1.1) * size >= remaining {
            (remaining, true)
        } else {
            (size, false)
        }
    }

    /// What remains of the interval.
    pub(super) fn remaining(&self, time: S) -> S {
        self.end - time
    }

    /// The time that a trial from `time` leads to.
    pub(super) fn end_of(&self, time: S, size: S, stretched: bool) -> S {
        if stretched { self.end } else { time + size }
    }

    /// Whether a trial with this error is accepted; not if the error is NaN.
    pub(super) fn accepts(&self, error: S) -> bool {
        error <= self.relative
    }

    /// The step after an accepted one that had not been rejected before.
    pub(super) fn grown(&self, step: S, error: S) -> S {
        let factor = S::constant(1.25) * error.quotient(self.relative).powf(self.exponent);
        let grown = if factor > S::constant(0.2) {
            step.quotient(factor)
        } else {
            S::constant(5.0) * step
        };
        grown.plain()
    }

    /// The step after a first rejection.
    pub(super) fn shrunk(&self, step: S, error: S) -> S {
        let factor = S::constant(0.8) * self.relative.quotient(error).powf(self.exponent);
        let least = S::constant(0.1);
        // An error of NaN or infinity takes the least factor.
        let shrunk = step * if factor > least { factor } else { least };
        shrunk.plain()
    }
}
