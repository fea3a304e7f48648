//! From where on a run has a warning: every limit with its reason.
//!
//! A result is taken to be trusted where it is right to about a hundredth.

/// A violation of a position, over the length of the joint or in radians, above which a joint
/// counts as open: what a joint lets slip shows in the motion by about as much, and more where it
/// adds up.
pub(super) const OPEN: f64 = 1e-3;

/// A violation of a velocity, over the velocities of the joint's own bodies: what slips at this
/// rate for the time of one radian of motion opens the joint by [`OPEN`] ten times over.
pub(super) const SLIPPING: f64 = 1e-2;

/// The least relative pivot, over the largest of the run, that counts as near to a singular
/// configuration.
///
/// A pivot goes with the square of the distance, in radians or lengths, from the configuration in
/// which it vanishes: a distance of about 0.03. Pivots that are small all along, by masses that
/// differ, are no sign of one, so it is the fall that counts.
pub(super) const NEARLY_SINGULAR: f64 = 1e-3;

/// The same over the largest violation, in lengths of the mechanism or radians: near to a
/// configuration in which an equation is a product of two distances, up to the scales of these, an
/// equation that is off by `d` keeps a pivot of `2 d`. A rhombus that goes on along the wrong
/// branch keeps several times the largest violation of the run.
pub(super) const PASSED_OPEN: f64 = 15.0;

/// A change of energy that no force accounts for, over the energy that the mechanism exchanges.
pub(super) const ENERGY: f64 = 1e-2;

/// A shift of phase (rad) that follows from a change of energy: half the relative change for every
/// radian of motion, for the period of an oscillation goes with its energy to first order.
pub(super) const PHASE: f64 = 1e-2;

/// What round-off changes of the energy in a step, over it and the epsilon of the number type, as
/// one of a random walk's steps: velocities are rounded once or twice by up to half an epsilon,
/// evenly, and the energy goes with their square.
pub(super) const ROUND_OFF: f64 = 0.5;

/// Errors of single steps, as the step control estimates them, added up over a run of which no
/// balance of energy tells more. Errors of an undamped, forced oscillation are a half to a fourth
/// of that.
pub(super) const ADDED_UP: f64 = 4e-2;

/// How much of the work of forces over a step may be unknown, where two rules for it disagree, with
/// steps that nothing controls: at about two radians of an oscillation a step.
pub(super) const FOLLOWED: f64 = 0.3;

/// The absolute tolerance, or what the digits of positions resolve, over the length of the
/// mechanism: below it elements of the state are right to that tolerance only.
pub(super) const COARSE: f64 = 1e-4;

/// `| |p| - 1 |` in a step: twice that is what a rotation matrix is off by where `p` is read as it
/// is, and about what an angle is off by in one step elsewhere.
pub(super) const LENGTH: f64 = 1e-3;

/// What a compliance leaves of the accelerations, over the accelerations themselves, times the
/// radians of motion over which it adds up.
pub(super) const BIAS: f64 = 1e-2;

/// What round-off comes to, in last digits of what a number is made of.
pub(super) const DIGITS: f64 = 64.0;

/// How far the errors of steps may add up at rest, over the tolerance of one and over what joints
/// are open by: a damped or oscillating error stays within a few.
pub(super) const ALLOWED: f64 = 4.0;

/// A violation, in lengths of the mechanism, up to which a mechanism that sags by as much is at
/// rest: what penalties of the usual size leave. A motion that is larger is judged.
pub(super) const SAGS: f64 = 1e-6;
