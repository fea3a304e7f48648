//! Limits that several indicators share, each with its reason. One that a single indicator has is
//! in its file.
//!
//! A result is taken to be trusted where it is right to about a hundredth.

use crate::math::scalar::Real;

/// A violation of a position, over the length of the joint or in radians, above which a joint
/// counts as open: what a joint lets slip shows in the motion by about as much, and more where it
/// adds up.
pub(super) const OPEN: f64 = 1e-3;

/// The least relative pivot, over the largest of the run, that counts as near to a singular
/// configuration.
///
/// A pivot goes with the square of the distance, in radians or lengths, from the configuration in
/// which it vanishes: a distance of about 0.03. Pivots that are small all along, by masses that
/// differ, are no sign of one, so it is the fall that counts.
pub(super) const NEARLY_SINGULAR: f64 = 1e-3;

/// A shift of phase (rad) that follows from a change of energy: half the relative change for every
/// radian of motion, for the period of an oscillation goes with its energy to first order.
pub(super) const PHASE: f64 = 1e-2;

/// The absolute tolerance, or what the digits of positions resolve, over the length of the
/// mechanism: below it elements of the state are right to that tolerance only.
pub(super) const COARSE: f64 = 1e-4;

/// What round-off comes to, in last digits of what a number is made of.
pub(super) const DIGITS: f64 = 64.0;

/// How far the errors of steps may add up at rest, over the tolerance of one and over what joints
/// are open by: a damped or oscillating error stays within a few.
pub(super) const ALLOWED: f64 = 4.0;

/// Whether a value is above a bound; NaN is above every bound.
pub(super) fn exceeds<S: Real>(value: S, bound: S) -> bool {
    let within = value <= bound;
    !within
}

/// Whether a value is above a limit; NaN is above every limit.
pub(super) fn above<S: Real>(value: S, limit: f64) -> bool {
    exceeds(value, S::constant(limit))
}
