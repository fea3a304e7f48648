//! The worst violation of every joint.
//!
//! A look costs `Phi` and `Phi'`, in every sixteenth step, or as often as a violation may decay.
//! Only it finds a joint that opens slowly while the energy is right: `tests/tests/alarms.rs`, an
//! upright rod in relative coordinates. The sides of joints are looked at once, at the end:
//! `tests/tests/branches/sides.rs`.

use super::limits::{self, exceeds};
use super::record::{Look, RunFacts};
use super::warning::Warning;
use crate::constraints::row_units::RowUnits;
use crate::constraints::rows::Rows;
use crate::constraints::side::wrong;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::JointInfo;
use crate::state::vector::Array;

/// A violation of a velocity, over the velocities of the joint's own bodies: what slips at this
/// rate for the time of one radian of motion opens the joint by [`limits::OPEN`] ten times over.
const SLIPPING: f64 = 1e-2;

/// The largest violation of a joint's equations over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Violation<S> {
    /// Of equations between lengths (m; of their rates m/s): the distance by which the joint is
    /// open.
    pub length: S,
    /// Of equations between directions (rad; of their rates rad/s).
    pub angle: S,
    /// When it was largest (s), against lengths of the mechanism or radians.
    pub time: S,
}

/// The violations of a run, and its joints that are on a side that is not meant.
pub(super) struct Violations<S: Scalar, M: Mechanism> {
    rows: RowUnits<S, M>,
    start: S,
    position: Worst<S, M>,
    velocity: Worst<S, M>,
    /// A joint that was upside down at the end, and when.
    wrong: Option<(usize, S)>,
}

/// The largest size of every row, as a length or an angle, and when.
struct Worst<S: Scalar, M: Mechanism> {
    size: M::Multipliers<S>,
    time: M::Multipliers<S>,
}

copied! {
    [S: Scalar, M: Mechanism] Violations<S, M>;
    [S: Scalar, M: Mechanism] Worst<S, M>;
}

impl<S: Real, M: Mechanism> Violations<S, M> {
    pub(super) fn none(start: S, rows: &Rows<S, M>) -> Self {
        Self {
            rows: RowUnits::of(rows),
            start,
            position: Worst::none(start),
            velocity: Worst::none(start),
            wrong: None,
        }
    }

    /// The units of the rows.
    pub(super) fn rows(&self) -> &RowUnits<S, M> {
        &self.rows
    }

    /// Takes a look at a time.
    pub(super) fn look(&mut self, time: S, look: &Look<S, M>) {
        let factors = self.rows.factors();
        self.position.take(look.phi.as_slice(), factors, time);
        self.velocity.take(look.phi_rate.as_slice(), factors, time);
    }

    /// Looks at the end of a run, on which side of its equations every joint is: none gets to
    /// another one without being wide open on the way.
    pub(super) fn end(&mut self, constants: &M::Constants<S>, time: S, state: &M::State<S>) {
        let wrong = wrong::<S, M>(constants, state, 0);
        self.wrong = wrong.map(|joint| (joint, time));
    }

    /// The worst violation of the position of a joint.
    pub(super) fn position(&self, joint: usize) -> Violation<S> {
        self.of(&self.position, joint)
    }

    /// The worst violation of the velocity of a joint.
    pub(super) fn velocity(&self, joint: usize) -> Violation<S> {
        self.of(&self.velocity, joint)
    }

    fn of(&self, worst: &Worst<S, M>, joint: usize) -> Violation<S> {
        match M::REPORT.joints.get(joint) {
            Some(info) => worst.of(&self.rows, info),
            None => Violation {
                length: S::zero(),
                angle: S::zero(),
                time: self.start,
            },
        }
    }

    /// By how much a joint was open, in such lengths (m) or radians.
    pub(super) fn largest(&self, length: S) -> S {
        let mut largest = S::zero();
        for info in M::REPORT.joints {
            let violation = self.position.of(&self.rows, info);
            let length = violation.length.quotient(length);
            largest = largest.max(length).max(violation.angle);
        }
        largest
    }

    pub(super) fn wrong_side(&self) -> Option<Warning> {
        let (joint, time) = self.wrong?;
        Some(Warning::WrongSide {
            joint: M::REPORT.joints.get(joint)?.name,
            time: time.to_f64(),
        })
    }

    pub(super) fn open(&self, run: &RunFacts<S>) -> Option<Warning> {
        let length = S::constant(limits::OPEN) * run.length;
        let bounds = (length, S::constant(limits::OPEN));
        let (joint, worst) = self.position.beyond(&self.rows, bounds)?;
        Some(Warning::Open {
            joint,
            length: worst.length.to_f64(),
            angle: worst.angle.to_f64(),
            time: worst.time.to_f64(),
        })
    }

    /// Speeds (m/s) up to one that is round-off count as none.
    pub(super) fn slipping(&self, run: &RunFacts<S>, round_off: S) -> Option<Warning> {
        if run.rests {
            return None;
        }
        let [speed, spin] = run.speeds;
        let (speed, spin) = (
            speed.max(spin * run.length),
            spin.max(speed.quotient(run.length)),
        );
        let limit = S::constant(SLIPPING);
        let bounds = (
            (limit * speed).max(round_off),
            (limit * spin).max(round_off.quotient(run.length)),
        );
        let (joint, worst) = self.velocity.beyond(&self.rows, bounds)?;
        Some(Warning::Slipping {
            joint,
            length: worst.length.to_f64(),
            angle: worst.angle.to_f64(),
            time: worst.time.to_f64(),
        })
    }
}

impl<S: Real, M: Mechanism> Worst<S, M> {
    fn none(start: S) -> Self {
        let mut time = M::Multipliers::<S>::zeros();
        time.as_mut_slice().fill(start);
        Self {
            size: M::Multipliers::<S>::zeros(),
            time,
        }
    }

    #[inline]
    fn take(&mut self, rows: &[S], factors: &[S], now: S) {
        let places = self.size.as_mut_slice().iter_mut();
        let places = places.zip(self.time.as_mut_slice());
        for ((size, time), (&row, &factor)) in places.zip(rows.iter().zip(factors)) {
            let here = row.abs() * factor;
            if exceeds(here, *size) {
                (*size, *time) = (here, now);
            }
        }
    }

    fn of(&self, rows: &RowUnits<S, M>, joint: &JointInfo) -> Violation<S> {
        let mut violation = Violation {
            length: S::zero(),
            angle: S::zero(),
            time: S::zero(),
        };
        let mut largest = -S::one();
        let sizes = self.size.as_slice().iter().zip(self.time.as_slice());
        let own = sizes.enumerate().skip(joint.row).take(joint.rows);
        for (row, (&size, &time)) in own {
            let kind = if rows.is_length(row) {
                &mut violation.length
            } else {
                &mut violation.angle
            };
            *kind = kind.max(size);
            if size > largest {
                (largest, violation.time) = (size, time);
            }
        }
        violation
    }

    /// The joint that is beyond its limits by most, with the kind of violation that is: the other
    /// is zero.
    fn beyond(
        &self,
        rows: &RowUnits<S, M>,
        (length, angle): (S, S),
    ) -> Option<(&'static str, Violation<S>)> {
        let mut found = None;
        let mut most = S::one();
        for info in M::REPORT.joints {
            let violation = self.of(rows, info);
            let none = S::zero();
            let (mut by_length, mut by_angle) = (violation, violation);
            (by_length.angle, by_angle.length) = (none, none);
            for (size, limit, one) in [
                (violation.length, length, by_length),
                (violation.angle, angle, by_angle),
            ] {
                // NaN is beyond every limit; nothing is beyond a limit of zero where nothing moves.
                let beyond = if size == none {
                    none
                } else {
                    size.quotient(limit)
                };
                if exceeds(beyond, most) {
                    most = beyond;
                    found = Some((info.name, one));
                }
            }
        }
        found
    }
}
