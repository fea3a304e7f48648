//! A rod on a hinge.

use std::f64::consts::FRAC_PI_2;

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{Real, View};
use holonom_study::pendulum::{RigidPendulum, from_vertical};

use super::case::{ClosedForm, hanging};

pub(super) const GRAVITY: f64 = 9.81;

/// A slender rod on a hinge at one end, at rest along +y, gravity along -z; the hinge about x
/// stands `place` (m) from the origin along all axes.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub struct Rod {
    /// m.
    #[param]
    pub length: f64,
    /// kg.
    #[param]
    pub mass: f64,
    /// m.
    #[param]
    pub place: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, mass * length * length / 1e3, mass * length * length / 12.0],
        position = [place, place + length / 2.0, place]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [place, place, place], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

impl Rod {
    fn pendulum(&self) -> RigidPendulum {
        RigidPendulum {
            mass: self.mass,
            inertia: self.mass * self.length * self.length / 3.0,
            distance: 0.5 * self.length,
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

impl ClosedForm for Rod {
    fn read<S: Real>(&self, view: &View<'_, S, Self>) -> Vec<f64> {
        let h = Self::HANDLES;
        let place = S::constant(self.place);
        let position = view.pose(h.rod).position;
        // By the Euler parameters, and by the position.
        vec![
            from_vertical(view.angle(h.pivot).to_f64(), FRAC_PI_2),
            hanging(position.y - place, position.z - place),
        ]
    }

    fn exact(&self, time: f64) -> Vec<f64> {
        vec![self.pendulum().at(time).angle; 2]
    }
}
