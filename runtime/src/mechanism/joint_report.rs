//! What the elements of a joint state are, for readers: in words, and as coordinates and rates of
//! the joints.

use core::f64::consts::TAU;
use core::fmt;
use core::ops::Range;

use crate::error::readable::Given;
use crate::math::names::is_same;
use crate::math::scalar::Scalar;
use crate::mechanism::joint_kernels::{Freedom, JointMotion, JointParts, JointReport};
use crate::mechanism::report::Report;
use crate::state::vector::MovingState;

impl JointMotion {
    /// The unit of its coordinate; of its velocity, the same a second. Euler parameters of a ball
    /// have none, its velocity is in rad/s.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        match self.freedom {
            Freedom::Turn { .. } | Freedom::Screw { .. } => "rad",
            Freedom::Slide => "m",
            Freedom::Ball => "1",
        }
    }

    /// Whether its angle counts against that of the joint.
    #[must_use]
    pub const fn is_reversed(&self) -> bool {
        matches!(
            self.freedom,
            Freedom::Turn { is_reversed: true }
                | Freedom::Screw {
                    is_reversed: true,
                    ..
                }
        )
    }

    /// The places of its velocities.
    pub(crate) const fn rates(&self) -> Range<usize> {
        let rates = match self.freedom {
            Freedom::Ball => 3,
            Freedom::Turn { .. } | Freedom::Slide | Freedom::Screw { .. } => 1,
        };
        self.velocity..self.velocity + rates
    }

    /// The field of the joint, or of the body if none carries it.
    pub(crate) const fn mover(&self) -> &'static str {
        if self.joint.is_empty() {
            self.body
        } else {
            self.joint
        }
    }

    fn signed<S: Scalar>(&self, value: S) -> S {
        if self.is_reversed() { -value } else { value }
    }
}

impl JointReport {
    /// The coordinate of the joint itself, zero in the reference configuration: an angle (rad) or a
    /// displacement (m). A turn is from `-pi` to `pi`, a screw counts all turns. `None` for a ball,
    /// and where there is no such motion.
    ///
    /// ```text
    /// angle of the joint = +-((angle - zero) - (angle - zero of the motion that it is against))
    /// ```
    #[must_use]
    pub fn coordinate<S: Scalar, X: JointParts<S>>(&self, motion: usize, state: &X) -> Option<S> {
        let motion = self.motions.get(motion)?;
        match motion.freedom {
            Freedom::Slide => state.rest_slice().get(motion.coordinate).copied(),
            Freedom::Screw { counter, .. } => state.rest_slice().get(counter).copied(),
            Freedom::Ball => None,
            Freedom::Turn { .. } => {
                let [mut c, mut s] = since_reference(motion, state)?;
                if let Some(against) = motion.against {
                    let [a, b] = since_reference(self.motions.get(against)?, state)?;
                    (c, s) = (c * a + s * b, s * a - c * b);
                }
                Some(motion.signed(s.atan2(c)))
            }
        }
    }

    /// The rate of the joint itself (rad/s, m/s). `None` as of [`JointReport::coordinate`]. It is
    /// linear in the rates of a state, so that it reads accelerations of a slope as well.
    #[must_use]
    pub fn rate<S: Scalar, X: JointParts<S>>(&self, motion: usize, state: &X) -> Option<S> {
        let motion = self.motions.get(motion)?;
        if motion.freedom == Freedom::Ball {
            return None;
        }
        let of = |motion: &JointMotion| state.rates_slice().get(motion.velocity).copied();
        let own = of(motion)?;
        let rate = match motion.against {
            Some(against) => own - of(self.motions.get(against)?)?,
            None => own,
        };
        Some(motion.signed(rate))
    }

    /// The motions of a joint, by their places among [`JointReport::motions`].
    pub fn motions_of<'a>(&'a self, joint: &'a str) -> impl Iterator<Item = usize> + 'a {
        let motions = self.motions.iter().enumerate();
        motions.filter_map(move |(place, motion)| (motion.joint == joint).then_some(place))
    }

    /// The motion that a rate belongs to, with its number.
    pub(crate) fn motion_of_rate(&self, rate: usize) -> Option<(usize, &'static JointMotion)> {
        let mut motions = self.motions.iter().enumerate();
        motions.find(|(_, motion)| motion.rates().contains(&rate))
    }

    /// The field of the joint, or of the body that moves freely, that a rate belongs to.
    pub(crate) fn mover_of_rate(&self, rate: usize) -> &'static str {
        let motion = self.motion_of_rate(rate);
        motion.map_or("", |(_, motion)| motion.mover())
    }

    /// Whether a body moves by a screw.
    pub(crate) const fn has_screws(&self) -> bool {
        let mut motions = self.motions;
        while let [first, rest @ ..] = motions {
            if matches!(first.freedom, Freedom::Screw { .. }) {
                return true;
            }
            motions = rest;
        }
        false
    }

    /// Whether every body is carried by a joint of its own with one motion, and there are no other
    /// joints: then the angle of none turns faster than that motion.
    pub(crate) const fn moves_one_by_one(&self, report: &Report) -> bool {
        let bodies = report.bodies.len();
        if !self.closing.is_empty() || self.motions.len() != bodies || report.joints.len() != bodies
        {
            return false;
        }
        let mut motions = self.motions;
        // Motions of one body stand one after the other.
        let mut before = "";
        while let [first, rest @ ..] = motions {
            let is_ball = matches!(first.freedom, Freedom::Ball);
            if is_ball || first.joint.is_empty() || is_same(first.body, before) {
                return false;
            }
            (motions, before) = (rest, first.body);
        }
        true
    }

    /// The sum of the speeds (rad/s, m/s) of a joint in two states, where it is greatest: two by
    /// two, so that comparisons wait less for each other.
    #[inline(always)]
    pub(crate) fn fastest<S: Scalar, X: MovingState<S>>(&self, from: &X, to: &X) -> S {
        let speed = |motion: &JointMotion, rates: &[S]| {
            let of = |place: usize| rates.get(place).copied().unwrap_or(S::zero());
            match motion.against.and_then(|other| self.motions.get(other)) {
                Some(other) => (of(motion.velocity) - of(other.velocity)).abs(),
                None => of(motion.velocity).abs(),
            }
        };
        let mut lanes = [S::zero(); 2];
        for two in self.motions.chunks(2) {
            for (lane, motion) in lanes.iter_mut().zip(two) {
                let sum = speed(motion, from.rates_slice()) + speed(motion, to.rates_slice());
                *lane = sum.select(*lane, *lane, sum);
            }
        }
        let [a, b] = lanes;
        a.select(b, b, a)
    }

    /// Puts the unwrapped angles of screws right, which rounding takes away from their pairs.
    pub(crate) fn rewrap_screws<S: Scalar, X: JointParts<S>>(&self, state: &mut X) {
        for motion in self.motions {
            let Freedom::Screw { counter, .. } = motion.freedom else {
                continue;
            };
            let Some([c, s]) = since_reference(motion, state) else {
                continue;
            };
            let within = motion.signed(s.atan2(c));
            if let Some(counted) = state.rest_slice_mut().get_mut(counter) {
                let turns = ((*counted - within) * S::constant(TAU.recip())).round();
                *counted = turns.fused(S::constant(TAU), within);
            }
        }
    }

    fn name(&self, motion: usize) -> &'static str {
        self.motions.get(motion).map_or("", |motion| motion.joint)
    }
}

/// Cosine and sine of an angle since the reference configuration.
fn since_reference<S: Scalar, X: JointParts<S>>(motion: &JointMotion, state: &X) -> Option<[S; 2]> {
    let [c, s] = *state.pairs_slice().get(motion.coordinate)?;
    let zero = S::constant(motion.zero);
    let (a, b) = (zero.cos(), zero.sin());
    Some([c * a + s * b, s * a - c * b])
}

/// A line for every element of a state.
impl fmt::Display for JointReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for motion in self.motions {
            let JointMotion {
                joint,
                body,
                coordinate,
                velocity,
                ..
            } = *motion;
            let of = Of(joint, body);
            match motion.freedom {
                Freedom::Turn { is_reversed } | Freedom::Screw { is_reversed, .. } => {
                    writeln!(
                        f,
                        "pairs()[{coordinate}]: cosine and sine of the angle {of} (rad)"
                    )?;
                    write!(f, "rates()[{velocity}]: its rate (rad/s)")?;
                    if let Some(against) = motion.against {
                        let name = self.name(against);
                        write!(f, "; both with those of `{name}`, of which they are a sum")?;
                    }
                    if is_reversed {
                        f.write_str("; both count the other way round")?;
                    }
                    if motion.zero != 0.0 {
                        let zero = Given(motion.zero);
                        write!(
                            f,
                            "; the angle is {zero} rad in the reference configuration"
                        )?;
                    }
                    if let Freedom::Screw { counter, .. } = motion.freedom {
                        write!(f, "; it moves along its axis with rest()[{counter}]")?;
                    }
                    writeln!(f)?;
                }
                Freedom::Slide => {
                    writeln!(f, "rest()[{coordinate}]: the displacement {of} (m)")?;
                    writeln!(f, "rates()[{velocity}]: its rate (m/s)")?;
                }
                Freedom::Ball => {
                    let [last, end] = [coordinate + 3, velocity + 2];
                    writeln!(
                        f,
                        "rest()[{coordinate}..={last}]: Euler parameters of `{body}`, {of}, from principal to global axes"
                    )?;
                    writeln!(
                        f,
                        "rates()[{velocity}..={end}]: its angular velocity (rad/s, principal axes)"
                    )?;
                }
            }
        }
        for counter in self.counters {
            let (element, coordinate) = (counter.element, counter.coordinate);
            writeln!(
                f,
                "rest()[{coordinate}]: an auxiliary variable, the angle that `{element}` counts turns of (rad)"
            )?;
        }
        for state in self.states {
            let (name, coordinate) = (state.name, state.coordinate);
            writeln!(f, "rest()[{coordinate}]: the state `{name}`")?;
        }
        Ok(())
    }
}

/// Of a joint, or of a body that none carries.
struct Of(&'static str, &'static str);

impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(joint, body) = self;
        if joint.is_empty() {
            write!(f, "of `{body}`, which moves freely")
        } else {
            write!(f, "of `{joint}`")
        }
    }
}
