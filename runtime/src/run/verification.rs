//! The estimated errors of a run, by a second run beside it.

use crate::error::Fault;
use crate::math::quaternion::angle_between;
use crate::math::scalar::Real;
use crate::math::vec3::{norm, read};
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The least error (m, rad) that is followed.
const LEAST: f64 = 1e-15;

/// The largest error so far, and when it passed the last two powers of ten. A history would not
/// fit without a heap.
#[derive(Clone, Copy)]
struct Growth<S> {
    largest: S,
    /// The last power of ten that was passed.
    power: S,
    /// When (s).
    passed: S,
    /// When the power before was passed (s).
    passed_before: S,
}

impl<S: Real> Growth<S> {
    fn take(&mut self, time: S, error: S) {
        self.largest = self.largest.max(error);
        let ten = S::constant(10.0);
        while self.largest >= ten * self.power && self.largest.is_finite() {
            self.power = ten * self.power;
            self.passed_before = self.passed;
            self.passed = time;
        }
    }
}

/// The estimated errors of a run, by its difference from a companion at the reporting times; see
/// [`Simulation::verified`](crate::Simulation::verified).
///
/// An estimate is about the error of the run where the companion is much more accurate. It is no
/// bound: what both miss in the same way stays unseen.
pub struct Verification<S: Real, M: Mechanism> {
    /// By body: the largest distance (m) in the first place of its velocity, the largest angle
    /// (rad) in the fourth.
    largest: M::Velocities<S>,
    /// See [`Growth`], in the same places.
    power: M::Velocities<S>,
    passed: M::Velocities<S>,
    passed_before: M::Velocities<S>,
    /// Reporting times that were compared.
    pub compared: usize,
    /// Evaluations of the rates by the companion.
    pub evaluations: usize,
    /// Why the companion could not go on, and when (s): nothing is compared from then on.
    pub ended: Option<(S, Fault)>,
}

/// The estimated error of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BodyError<S> {
    /// The field of the body.
    pub body: &'static str,
    /// The largest distance (m) between the centres of mass.
    pub position: S,
    /// The largest angle (rad) between the orientations; zero for a particle.
    pub rotation: S,
    /// When it grew (s): the first reporting time at which the larger of the two, a radian counted
    /// as a metre, was beyond a power of ten that is a tenth to a hundredth of what it became.
    pub grew: S,
}

impl<S: Real, M: Mechanism> Verification<S, M> {
    pub(super) fn nothing() -> Self {
        let mut power = M::Velocities::<S>::zeros();
        power.as_mut_slice().fill(S::constant(LEAST));
        Self {
            largest: Array::zeros(),
            power,
            passed: Array::zeros(),
            passed_before: Array::zeros(),
            compared: 0,
            evaluations: 0,
            ended: None,
        }
    }

    /// The estimated error of a body, until the companion [`ended`](Self::ended).
    #[must_use]
    pub fn body(&self, body: BodyHandle<M>) -> BodyError<S> {
        self.of(body.index())
    }

    /// The body with the largest estimated error, a radian counted as a metre.
    ///
    /// `None` for a mechanism without bodies, and where the companion ended before the run.
    /// [`ended`](Self::ended) says when and why, and [`body`](Self::body) has the errors until
    /// then.
    #[must_use]
    pub fn worst(&self) -> Option<BodyError<S>> {
        if self.ended.is_some() {
            return None;
        }
        let bodies = (0..M::REPORT.bodies.len()).map(|body| self.of(body));
        let size = |error: &BodyError<S>| error.position.max(error.rotation);
        bodies.reduce(|worst, next| {
            if size(&next) > size(&worst) {
                next
            } else {
                worst
            }
        })
    }

    fn of(&self, body: usize) -> BodyError<S> {
        let Some(info) = M::REPORT.bodies.get(body) else {
            let zero = S::zero();
            return BodyError {
                body: "",
                position: zero,
                rotation: zero,
                grew: zero,
            };
        };
        let [position]: [S; 1] = read(self.largest.as_slice(), info.velocity);
        let [mut grew]: [S; 1] = read(self.passed_before.as_slice(), info.velocity);
        let mut rotation = S::zero();
        if info.kind == BodyKind::Rigid {
            [rotation] = read(self.largest.as_slice(), info.velocity + 3);
            if rotation > position {
                [grew] = read(self.passed_before.as_slice(), info.velocity + 3);
            }
        }
        BodyError {
            body: info.name,
            position,
            rotation,
            grew,
        }
    }

    /// Compares the bodies of both runs at a time.
    pub(super) fn compare(&mut self, time: S, one: &M::State<S>, other: &M::State<S>) {
        self.compared = self.compared.saturating_add(1);
        let (a, b) = (one.coordinates().as_slice(), other.coordinates().as_slice());
        for info in M::REPORT.bodies {
            let r: [S; 3] = read(a, info.coordinate);
            let s: [S; 3] = read(b, info.coordinate);
            let apart = norm(&[r[0] - s[0], r[1] - s[1], r[2] - s[2]]);
            self.take(info.velocity, time, apart);
            if info.kind == BodyKind::Rigid {
                let p = read(a, info.coordinate + 3);
                let q = read(b, info.coordinate + 3);
                self.take(info.velocity + 3, time, angle_between(&p, &q));
            }
        }
    }

    fn take(&mut self, place: usize, time: S, error: S) {
        let parts = [
            &mut self.largest,
            &mut self.power,
            &mut self.passed,
            &mut self.passed_before,
        ];
        let [
            Some(largest),
            Some(power),
            Some(passed),
            Some(passed_before),
        ] = parts.map(|part| part.as_mut_slice().get_mut(place))
        else {
            return;
        };
        let mut growth = Growth {
            largest: *largest,
            power: *power,
            passed: *passed,
            passed_before: *passed_before,
        };
        growth.take(time, error);
        (*largest, *power) = (growth.largest, growth.power);
        (*passed, *passed_before) = (growth.passed, growth.passed_before);
    }
}

impl<S: Real, M: Mechanism> Clone for Verification<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: Mechanism> Copy for Verification<S, M> {}

impl<S: Real, M: Mechanism> core::fmt::Debug for Verification<S, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Verification")
            .field("worst", &self.worst())
            .field("compared", &self.compared)
            .field("evaluations", &self.evaluations)
            .field("ended", &self.ended)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::{Growth, LEAST};

    /// When an error `factor^k` at the times `k` grew.
    fn grew(factor: f64, times: i32) -> f64 {
        let mut growth = Growth {
            largest: 0.0,
            power: LEAST,
            passed: 0.0,
            passed_before: 0.0,
        };
        for k in 0..=times {
            growth.take(f64::from(k), 1e-9 * factor.powi(k));
        }
        growth.passed_before
    }

    #[test]
    fn slow_growth_and_jumps_are_dated() {
        // 1e-9 2^30 is 1.07: beyond 0.1 from 2^27 on.
        assert_eq!(grew(2.0, 30), 27.0);
        // It stays at 1e-9, which the first report shows.
        assert_eq!(grew(1.0, 30), 0.0);
        // A jump over powers of ten passes all of them at once.
        assert_eq!(grew(1e6, 1), 1.0);
    }
}
