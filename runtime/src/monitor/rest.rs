//! Whether a mechanism is at rest, as far as its numbers tell.
//!
//! It costs two evaluations at the start, and distances a step while rest lasts. Without it what
//! stands still has warnings: `tests/tests/quiet.rs`.
//!
//! Relative measures compare with what the motion itself is. Where nothing moves but round-off, or
//! what a tolerance or a compliance lets move, they compare an error with itself.

use super::beginning::{Beginning, largest};
use super::limits::{self, exceeds};
use super::record::MonitoredStep;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{minus, read, square};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// A violation, in lengths of the mechanism, up to which a mechanism that sags by as much is at
/// rest: what penalties of the usual size leave. A motion that is larger is judged.
const SAGS: f64 = 1e-6;

/// What is known of rest at a time.
pub(super) struct Rest<S: Scalar, M: Mechanism> {
    /// The state at the start.
    first: M::State<S>,
    /// Whether the run began at rest and has stayed there.
    lasts: bool,
}

copied!([S: Scalar, M: Mechanism] Rest<S, M>);

impl<S: Real, M: Mechanism> Rest<S, M> {
    pub(super) fn unknown(state: &M::State<S>) -> Self {
        Self {
            first: *state,
            lasts: false,
        }
    }

    /// Whether the run began at rest and has stayed there, as far as its numbers tell: what moved
    /// since says of nothing.
    #[inline]
    pub(super) fn lasts(&self) -> bool {
        self.lasts
    }

    /// Takes what acts at the start of a run, of a mechanism of such a length (m), and what a
    /// compliance leaves of the accelerations.
    pub(super) fn begin(&mut self, beginning: &Beginning<'_, S, M>, length: S, left: S) {
        let [here, _] = beginning.accelerations;
        let free = beginning.free(length);
        let round_off = S::constant(limits::DIGITS) * S::EPSILON;
        let slow = round_off * (free * length).sqrt();
        let yields = S::constant(limits::ALLOWED) * left + beginning.bias * free;
        let still = S::constant(limits::DIGITS).fused(beginning.noise(length), yields);
        self.lasts = !exceeds(largest::<S, M>(here, length), still)
            && !exceeds(largest::<S, M>(self.first.velocities(), length), slow);
    }

    /// Looks whether a step has led away from rest: farther than so much (m).
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>, length: S, hardly: S) {
        let (now, first) = (step.state.coordinates(), self.first.coordinates());
        let (now, first) = (now.as_slice(), first.as_slice());
        let mut way = S::constant(0.25) * step.motion.turned * length;
        for body in M::REPORT.bodies {
            let place = body.coordinate;
            let [r, r0]: [[S; 3]; 2] = [read(now, place), read(first, place)];
            way = way.max(square(&minus(&r, &r0)).sqrt());
            if body.kind == BodyKind::Rigid {
                let [p, p0]: [[S; 4]; 2] = [read(now, place + 3), read(first, place + 3)];
                let [a, b, c, d] = p;
                let [x, y, z, w] = p0;
                let turn = square(&[a - x, b - y, c - z, d - w]).sqrt();
                way = way.max((turn + turn) * length);
            }
        }
        self.lasts = !exceeds(way, hardly);
    }
}

/// A way (m) that says of no motion: what round-off, the step control, and a violation so far
/// account for, as long as that is little. Violation and mechanism have lengths.
pub(super) fn hardly<S: Real>(round_off: S, allowed: S, open: S, length: S) -> S {
    let open = open.min(S::constant(SAGS)) * length;
    let way = S::constant(limits::ALLOWED).fused(allowed + open, round_off);
    way.min(S::constant(limits::COARSE) * length)
}
