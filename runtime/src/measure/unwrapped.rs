//! The angle of a joint over many turns, followed from one reading to the next.

use crate::math::scalar::Scalar;
use crate::measure::view::View;
use crate::mechanism::handle::{HasAngle, JointHandle};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::readout::AngleParts;
use crate::mechanism::turns::nearest;

/// Follows the angle of a joint over turns, from reading to reading, in states of which nothing was
/// counted: those that a program of your own moves. In runs and steppers [`View::angle`] goes on by
/// itself.
///
/// The whole turns are those that bring the angle nearest to the last one plus the mean of both
/// rates times the time between. So a joint may turn many times between two readings, as long as
/// that mean is right within half a turn. The first reading is [`View::angle`] itself. A joint
/// whose definition counts turns is read as it is.
///
/// ```
/// # use holonom::prelude::*;
/// use holonom::measure::UnwrappedAngle;
///
/// /// A wheel at 10 rad/s.
/// #[derive(Mechanism)]
/// struct Shop {
///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2], angular_velocity = [0.0, 0.0, 10.0])]
///     wheel: Body,
///     #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
///     axle: Revolute,
/// }
///
/// let shop = Shop::default();
/// let mut axle = UnwrappedAngle::default();
/// Simulation::new(&shop, StandardLagrange, DormandPrince::default())
///     .run(0.0_f64..=3.0, every(0.5), |sample| {
///         let angle = axle.read(sample, Shop::HANDLES.axle);
///         assert!((angle - 10.0 * sample.time()).abs() < 1e-4);
///     })?;
/// # Ok::<(), SimulationError<StateOf<Shop>>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnwrappedAngle<S> {
    last: Option<Reading<S>>,
}

/// A reading of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reading<S> {
    /// When (s).
    time: S,
    /// With its whole turns (rad).
    angle: S,
    /// Its rate (rad/s).
    rate: S,
}

/// Before the first reading.
impl<S> Default for UnwrappedAngle<S> {
    fn default() -> Self {
        Self { last: None }
    }
}

impl<S: Scalar> UnwrappedAngle<S> {
    /// The angle of a joint (rad), with the zero and the sign of [`View::angle`] and without
    /// bounds. Readings come in the order of their times, either way.
    pub fn read<M: Mechanism, J: HasAngle>(
        &mut self,
        view: &View<'_, S, M>,
        joint: JointHandle<M, J>,
    ) -> S {
        let parts = view.angle_parts(joint.index());
        self.follow(view.time(), view.angle(joint), &parts)
    }

    /// The same from the parts of an angle at a time (s), and the angle that a state has counted.
    pub(crate) fn follow(&mut self, time: S, counted: S, parts: &AngleParts<S>) -> S {
        let (within, rate) = (parts.angle(), parts.rate);
        let angle = match (self.last, parts.turns) {
            (Some(last), None) => {
                let mean = S::constant(0.5) * (last.rate + rate);
                nearest(within, mean.fused(time - last.time, last.angle))
            }
            (None, None) => nearest(within, counted),
            (_, Some(_)) => within,
        };
        self.last = Some(Reading { time, angle, rate });
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::{AngleParts, UnwrappedAngle};

    fn parts(angle: f64, rate: f64, turns: Option<f64>) -> AngleParts<f64> {
        AngleParts {
            cosine: angle.cos(),
            sine: angle.sin(),
            rate,
            turns,
        }
    }

    /// Swings over the top, stops, and turns back.
    #[test]
    fn an_angle_goes_on_over_turns_both_ways() {
        for interval in [0.01, 0.1, 0.37] {
            let mut followed = UnwrappedAngle::default();
            for step in 0..200 {
                let time = interval * f64::from(step);
                let (angle, rate) = (40.0 * (0.5 * time).sin(), 20.0 * (0.5 * time).cos());
                let found = followed.follow(time, angle, &parts(angle, rate, None));
                assert!((found - angle).abs() < 1e-12, "{found} for {angle}");
            }
        }
    }

    #[test]
    fn several_turns_between_readings_are_counted_by_their_rate() {
        let mut followed = UnwrappedAngle::default();
        for step in 0..20 {
            let time = f64::from(step);
            let found = followed.follow(time, 0.0, &parts(100.0 * time, 100.0, None));
            assert!((found - 100.0 * time).abs() < 1e-10);
        }
    }

    #[test]
    fn a_counted_angle_is_as_it_is_and_one_of_nan_stays_one() {
        let mut followed = UnwrappedAngle::default();
        assert_eq!(followed.follow(0.0, 0.5, &parts(0.5, 0.0, None)), 0.5);
        let counted = parts(0.5, 0.0, Some(100.0));
        assert_eq!(followed.follow(1.0, 0.5, &counted), counted.angle());
        assert!(
            followed
                .follow(2.0, 0.0, &parts(f64::NAN, 0.0, None))
                .is_nan()
        );
        assert!(followed.follow(3.0, 0.0, &parts(0.1, 0.0, None)).is_nan());
    }
}
