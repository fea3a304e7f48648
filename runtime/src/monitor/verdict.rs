//! From what the monitor saw to warnings.

use super::limits;
use super::warning::{Warning, Warnings};
use super::{Monitor, Violation, Worst, exceeds};
use crate::integrate::ErrorModel;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::JointInfo;

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// Warnings.
    #[must_use]
    pub(crate) fn warnings(&self) -> Warnings {
        Warnings::new([
            self.wrong_side(),
            self.energy(),
            self.open(),
            self.slipping(),
            self.nearly_singular(),
            self.vanishing(),
            self.unconverged_warning(),
            self.phase(),
            self.long_run(),
            self.compliance(),
            self.many_steps(),
            self.coarse(),
            self.orientation(),
            self.resolution(),
            self.coarse_steps(),
            self.long_steps(),
        ])
    }

    fn wrong_side(&self) -> Option<Warning> {
        let (joint, time) = self.wrong?;
        Some(Warning::WrongSide {
            joint: M::REPORT.joints.get(joint)?.name,
            time: time.to_f64(),
        })
    }

    fn energy(&self) -> Option<Warning> {
        if self.rests() {
            return None;
        }
        let (change, time) = self.balance.worst();
        let change = change.quotient(self.lives());
        above(change.abs(), limits::ENERGY).then(|| Warning::Energy {
            change: change.to_f64(),
            time: time.to_f64(),
        })
    }

    /// How often the motion has forgotten what it was: an error counts that has come about since.
    fn lives(&self) -> S {
        self.memory.lives(&self.measure)
    }

    fn phase(&self) -> Option<Warning> {
        let change = self.balance.drift().quotient(self.lives());
        let shift = S::constant(0.5) * change.abs() * self.travel;
        let shift = shift.quotient(self.lives()) * self.memory.part_of_vibrations(&self.measure);
        (above(shift, limits::PHASE) && self.energy().is_none()).then(|| Warning::Phase {
            change: change.to_f64(),
            travel: self.travel.to_f64(),
            shift: shift.to_f64(),
        })
    }

    /// Round-off of velocities changes the energy like a random walk, whose end tells little of its
    /// way. Only where nothing works on the mechanism: forces and drivers set a phase of their own.
    fn long_run(&self) -> Option<Warning> {
        if !self.balance.is_of_a_closed_system() || self.phase().is_some() {
            return None;
        }
        let change = S::constant(limits::ROUND_OFF) * S::EPSILON;
        let change = change * S::constant(self.steps as f64).sqrt();
        let shift = S::constant(0.5) * change * self.travel;
        above(shift, limits::PHASE).then(|| Warning::LongRun {
            steps: self.steps,
            travel: self.travel.to_f64(),
            shift: shift.to_f64(),
        })
    }

    fn open(&self) -> Option<Warning> {
        let length = S::constant(limits::OPEN) * self.length;
        let (
            info,
            Violation {
                length,
                angle,
                time,
            },
        ) = self.worst(&self.position, (length, S::constant(limits::OPEN)))?;
        Some(Warning::Open {
            joint: info.name,
            length: length.to_f64(),
            angle: angle.to_f64(),
            time: time.to_f64(),
        })
    }

    fn slipping(&self) -> Option<Warning> {
        if self.rests() {
            return None;
        }
        let least = self.speed_of_round_off();
        let [speed, spin] = self.speeds();
        let (speed, spin) = (
            speed.max(spin * self.length),
            spin.max(speed.quotient(self.length)),
        );
        let limit = S::constant(limits::SLIPPING);
        let (
            info,
            Violation {
                length,
                angle,
                time,
            },
        ) = self.worst(
            &self.velocity,
            (
                (limit * speed).max(least),
                (limit * spin).max(least.quotient(self.length)),
            ),
        )?;
        Some(Warning::Slipping {
            joint: info.name,
            length: length.to_f64(),
            angle: angle.to_f64(),
            time: time.to_f64(),
        })
    }

    /// The joint that is beyond its limits by most, with the kind of violation that is: the other
    /// is zero.
    fn worst(
        &self,
        worst: &Worst<S, M>,
        (length, angle): (S, S),
    ) -> Option<(&'static JointInfo, Violation<S>)> {
        let mut found = None;
        let mut most = S::one();
        for info in M::REPORT.joints {
            let violation = worst.of(&self.rows, info);
            let none = S::zero();
            for (size, limit, one) in [
                (
                    violation.length,
                    length,
                    Violation {
                        angle: none,
                        ..violation
                    },
                ),
                (
                    violation.angle,
                    angle,
                    Violation {
                        length: none,
                        ..violation
                    },
                ),
            ] {
                // NaN is beyond every limit; nothing is beyond a limit of zero where nothing moves.
                let beyond = if size == none {
                    none
                } else {
                    size.quotient(limit)
                };
                if exceeds(beyond, most) {
                    most = beyond;
                    found = Some((info, one));
                }
            }
        }
        found
    }

    fn nearly_singular(&self) -> Option<Warning> {
        let approach = self.approach.as_ref()?;
        let fall = approach.fall();
        let nearest = self.smallest_pivot()?;
        let is_near = self.is_near(fall) || approach.may_have_passed();
        is_near.then(|| Warning::NearlySingular {
            joint: nearest.joint,
            fall: fall.to_f64(),
            time: nearest.time.to_f64(),
        })
    }

    /// Whether pivots, or squares of gradients, that fell so far tell of a singular configuration.
    /// A mechanism that is open by a little passes one at a distance whose square goes with that;
    /// of one that is open by more all is reported.
    fn is_near(&self, fall: S) -> bool {
        let open = self.largest_violation();
        let passed = !above(open, limits::OPEN) && fall < S::constant(limits::PASSED_OPEN) * open;
        !above(fall, limits::NEARLY_SINGULAR) || passed
    }

    /// By how much a joint was open, in lengths of the mechanism or radians.
    pub(super) fn largest_violation(&self) -> S {
        let mut largest = S::zero();
        for info in M::REPORT.joints {
            let violation = self.position.of(&self.rows, info);
            let length = violation.length.quotient(self.length);
            largest = largest.max(length).max(violation.angle);
        }
        largest
    }

    /// Gradients count by their squares, as pivots do.
    fn vanishing(&self) -> Option<Warning> {
        let shortest = self.shortest_gradient()?;
        let fall = shortest.relative * shortest.relative;
        let may_have_passed = self.gradients.approach().may_have_passed();
        let is_near = self.is_near(fall) || may_have_passed;
        (is_near && self.nearly_singular().is_none()).then(|| Warning::Vanishing {
            joint: shortest.joint,
            length: shortest.relative.to_f64(),
            time: shortest.time.to_f64(),
        })
    }

    fn unconverged_warning(&self) -> Option<Warning> {
        let time = self.unconverged.since?;
        Some(Warning::Unconverged {
            corrections: self.unconverged.corrections,
            evaluations: self.unconverged.evaluations,
            time: time.to_f64(),
        })
    }

    /// Only where there is no balance of energy that tells more.
    fn many_steps(&self) -> Option<Warning> {
        if self.rests() || self.balance.tells(limits::ENERGY) {
            return None;
        }
        self.tolerance?;
        let steps = S::constant(self.steps as f64);
        let ErrorModel {
            estimate_power,
            estimate_share,
            ..
        } = self.model;
        let mean = self.estimated.quotient(steps).powf(estimate_power);
        let sum = S::constant(estimate_share) * mean * steps;
        let sum = sum.quotient(self.lives());
        above(sum, limits::ADDED_UP).then(|| Warning::ManySteps {
            steps: self.steps,
            error: sum.to_f64(),
        })
    }

    /// Only where nothing controls the steps.
    fn coarse_steps(&self) -> Option<Warning> {
        let share = self.balance.warning_of_work();
        // The work of a first step is not known, that of the next ones depends on it.
        let begun = self.steps > 8 && !self.rests();
        let warned = begun && self.tolerance.is_none() && above(share, limits::FOLLOWED);
        warned.then(|| Warning::CoarseSteps {
            share: share.to_f64(),
        })
    }

    /// Of methods whose energy does not tell.
    fn long_steps(&self) -> Option<Warning> {
        if self.rests() {
            return None;
        }
        let mut shift = self.phase_error.worst();
        if !above(shift, limits::PHASE) {
            shift = shift.max(
                self.silent_shift()
                    .min(self.phase_error.missed(self.fastest)),
            );
        }
        // What is off at the worst is known as it dies out.
        let lives = self.lives() * self.memory.fed(self.balance.gained());
        let shift = shift.quotient(lives.max(S::one())).max(self.led_shift());
        let shift = shift * self.memory.part_of_vibrations(&self.measure);
        above(shift, limits::PHASE).then(|| Warning::LongSteps {
            shift: shift.to_f64(),
        })
    }

    /// A rate that changes by a part `x` of the largest in a step is that of an oscillation of `x`
    /// radians a step.
    fn silent_shift(&self) -> S {
        let [turned, changed] = self.cubes;
        let fastest = self.fastest * self.fastest * self.fastest;
        let phase_error = S::constant(self.model.phase_error);
        if phase_error > S::zero() && fastest > S::zero() {
            phase_error * turned.max(changed.quotient(fastest))
        } else {
            S::zero()
        }
    }

    /// Where velocities are ahead of coordinates by a part of a step, coordinates are off by what a
    /// rate changes by over so much time.
    fn led_shift(&self) -> S {
        S::constant(self.model.stagger) * self.longest * self.changed
    }

    fn coarse(&self) -> Option<Warning> {
        let (_, absolute) = self.tolerance?;
        let moved = self.travel > S::zero() && !self.rests();
        let moved = moved && !M::REPORT.bodies.is_empty();
        let coarse = absolute > S::constant(limits::COARSE) * self.length;
        (coarse && moved).then(|| Warning::CoarseTolerance {
            absolute: absolute.to_f64(),
            size: self.length.to_f64(),
        })
    }

    fn resolution(&self) -> Option<Warning> {
        let coarse = self.resolution > S::constant(limits::COARSE) * self.length;
        coarse.then(|| Warning::CoarseNumbers {
            resolution: self.resolution.to_f64(),
            size: self.length.to_f64(),
        })
    }

    fn orientation(&self) -> Option<Warning> {
        // On average over the steps; those that turn further drift more, and are off by less of
        // it.
        let half = S::constant(0.5) * self.travel.quotient(S::constant(self.steps as f64));
        let error = S::constant(self.model.angle_error);
        let of_short = S::constant(self.model.angle_error_of_short_steps).quotient(half);
        let error = if half > S::zero() {
            error.max(of_short)
        } else {
            error
        };
        let shift = self.norm_drift.sum() * error;
        let warned = above(self.largest_drift, limits::LENGTH) || above(shift, limits::PHASE);
        warned.then(|| Warning::Orientation {
            drift: self.largest_drift.to_f64(),
            shift: shift.to_f64(),
        })
    }

    fn compliance(&self) -> Option<Warning> {
        let bias = self.compliance.bias();
        if bias == S::zero() || self.rests() {
            return None;
        }
        above(bias * self.travel, limits::BIAS).then(|| Warning::Compliance {
            bias: bias.to_f64(),
            travel: self.travel.to_f64(),
        })
    }
}

pub(super) fn above<S: Real>(value: S, limit: f64) -> bool {
    exceeds(value, S::constant(limit))
}
