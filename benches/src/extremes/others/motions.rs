//! Their motions in closed form.

use std::f64::consts::{FRAC_PI_2, PI};

use holonom::nalgebra::{Unit, UnitQuaternion, Vector3};
use holonom::{Mechanism as _, Real, View};
use holonom_study::pendulum::{RigidPendulum, from_vertical};

use super::models::{Block, Bob, Top, Turned, TwoPoints};
use crate::extremes::case::{ClosedForm, hanging};
use crate::extremes::rod::GRAVITY;

impl Bob {
    fn pendulum(&self) -> RigidPendulum {
        let mass = 1.0 + self.ratio;
        RigidPendulum {
            mass,
            inertia: 1.0 / 3.0 + 1.01 * self.ratio,
            distance: (0.5 + self.ratio) / mass,
            gravity: GRAVITY,
            amplitude: FRAC_PI_2,
        }
    }

    /// Its period (s).
    #[must_use]
    pub fn period(&self) -> f64 {
        self.pendulum().period()
    }
}

impl ClosedForm for Bob {
    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        let h = Self::HANDLES;
        let position = view.pose(h.bob).position;
        vec![
            from_vertical(view.angle(h.pivot).to_f64(), FRAC_PI_2),
            hanging(position.y, position.z),
        ]
    }

    fn exact(&self, time: f64) -> Vec<f64> {
        vec![self.pendulum().at(time).angle; 2]
    }
}

impl ClosedForm for TwoPoints {
    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        let position = view.pose(Self::HANDLES.rod).position;
        vec![hanging(position.y, position.z), position.x.to_f64()]
    }

    fn exact(&self, time: f64) -> Vec<f64> {
        let rod = RigidPendulum {
            mass: 1.0,
            inertia: 1.0 / 3.0,
            distance: 0.5,
            gravity: GRAVITY,
            amplitude: FRAC_PI_2,
        };
        vec![rod.at(time).angle, 0.0]
    }
}

impl Top {
    /// Angular momentum (kg m^2/s, global), of which the axis goes round by its size over
    /// [`Top::ACROSS`].
    fn momentum(&self) -> Vector3<f64> {
        Vector3::new(
            Self::ACROSS * 0.01 * self.spin,
            0.0,
            Self::ALONG * self.spin,
        )
    }

    /// The rate (rad/s) at which the axis goes round, the fastest of its motion.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.momentum().norm() / Self::ACROSS
    }
}

impl ClosedForm for Top {
    const ARE_ANGLES: bool = false;

    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        let along = view.point(
            Self::HANDLES.top,
            Vector3::new(S::one(), S::zero(), S::zero()),
        );
        along.iter().map(|x| x.to_f64()).collect()
    }

    /// `R = rot(L, |L| t / A) rot(e3, -(C - A) / A w3 t)`: Goldstein, *Classical Mechanics*, 5.6.
    fn exact(&self, time: f64) -> Vec<f64> {
        let own = -(Self::ALONG - Self::ACROSS) / Self::ACROSS * self.spin;
        let round = UnitQuaternion::from_axis_angle(
            &Unit::new_normalize(self.momentum()),
            self.rate() * time,
        );
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), own * time);
        let point: Vector3<f64> = round * turned * Vector3::x();
        point.iter().copied().collect()
    }
}

impl ClosedForm for Block {
    const ARE_ANGLES: bool = false;

    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        vec![view.pose(Self::HANDLES.block).position.x.to_f64()]
    }

    fn exact(&self, time: f64) -> Vec<f64> {
        vec![0.1 * (self.stiffness.sqrt() * time).cos()]
    }
}

impl ClosedForm for Turned {
    const ARE_ANGLES: bool = false;

    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        vec![view.angle_rate(Self::HANDLES.pivot).to_f64()]
    }

    fn exact(&self, time: f64) -> Vec<f64> {
        vec![3.0 * self.moment * time]
    }
}

/// A whole turn over a rate (rad/s).
pub(super) fn period(rate: f64) -> f64 {
    2.0 * PI / rate
}
