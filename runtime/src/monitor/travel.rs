//! How far a mechanism has moved, in radians.

use super::motion::{Motion, MotionMeasure};
use super::record::MonitoredStep;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// How a mechanism has moved over a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travel<S> {
    pub(super) start: S,
    /// The end of the last step (s).
    pub(super) time: S,
    pub(super) steps: usize,
    /// The longest step (s).
    pub(super) longest: S,
    /// Radians of motion: of the body that turns fastest, or moves by lengths of the mechanism.
    pub(super) radians: S,
    /// The last rate of motion (rad/s), and the largest.
    pub(super) rate: S,
    pub(super) fastest: S,
    /// The squares of the largest speed (m^2/s^2) and angular velocity (rad^2/s^2).
    speeds: [S; 2],
}

impl<S: Real> Travel<S> {
    pub(super) fn from(start: S) -> Self {
        Self {
            start,
            time: start,
            steps: 0,
            longest: S::zero(),
            radians: S::zero(),
            rate: S::zero(),
            fastest: S::zero(),
            speeds: [S::zero(); 2],
        }
    }

    /// How bodies move in a state at the end of a step.
    #[inline]
    pub(super) fn motion<M: Mechanism>(
        &self,
        measure: &MotionMeasure<S, M>,
        end: S,
        state: &M::State<S>,
    ) -> Motion<S> {
        let ([rate, speed, spin], translation) = measure.rates(state);
        let turned = rate * (end - self.time);
        Motion {
            rate,
            speed,
            spin,
            turned,
            travel: self.radians + turned,
            translation,
        }
    }

    #[inline]
    pub(super) fn step<M: Mechanism>(&mut self, step: &MonitoredStep<'_, S, M>) {
        let Motion {
            rate,
            speed,
            spin,
            travel,
            ..
        } = step.motion;
        let [fastest, widest] = self.speeds;
        self.speeds = [fastest.max(speed), widest.max(spin)];
        self.radians = travel;
        self.rate = rate;
        self.fastest = self.fastest.max(rate);
        self.longest = self.longest.max(step.end - step.start);
        self.time = step.end;
        self.steps = self.steps.saturating_add(1);
    }

    /// The largest speed (m/s) and angular velocity (rad/s).
    pub(super) fn speeds(&self) -> [S; 2] {
        self.speeds.map(S::sqrt)
    }
}
