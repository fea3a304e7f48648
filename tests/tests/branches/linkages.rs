//! Planar four-bars of given proportions, and where their rocker stands in closed form.

use std::f64::consts::TAU;

use holonom::joints::{AngleDriver, Cylindrical, Revolute, Spherical};
use holonom::prelude::*;

/// A four-bar: crank on the origin, rocker on `(ground, 0)`, their pin described at `(x, y)`.
#[derive(Clone, Copy, Mechanism)]
pub(crate) struct FourBar {
    #[param]
    crank_length: f64,
    #[param]
    x: f64,
    #[param]
    y: f64,
    #[param]
    base: f64,
    /// Of the crank.
    #[param]
    pub(crate) mass: f64,
    #[body(
        mass = mass, inertia = [0.02 * mass, 0.02 * mass, 0.02 * mass],
        position = [crank_length / 2.0, 0.0, 0.0]
    )]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [crank_length, 0.0, 0.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.05, 0.05, 0.05], position = [base, 0.0, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [crank_length, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [x, y, 0.0])]
    c: Spherical,
    #[joint(between = [ground, rocker], point = [base, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Cylindrical,
}

/// The same, driven at the crank: one radian a second.
#[derive(Clone, Copy, Mechanism)]
pub(crate) struct DrivenFourBar {
    #[param]
    crank_length: f64,
    #[param]
    x: f64,
    #[param]
    y: f64,
    #[param]
    base: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [crank_length / 2.0, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [crank_length, 0.0, 0.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.05, 0.05, 0.05], position = [base, 0.0, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [crank_length, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [x, y, 0.0])]
    c: Spherical,
    #[joint(between = [ground, rocker], point = [base, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Cylindrical,
    #[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = time)]
    motor: AngleDriver,
}

/// Lengths (m) of crank, coupler, rocker and ground, and on which side of the line from crank pin
/// to rocker pivot their pin is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lengths {
    pub(crate) links: [f64; 4],
    pub(crate) sign: f64,
}

/// 0.5, 1.2, 0.8 and 1.0.
pub(crate) const CRANK_ROCKER: Lengths = Lengths {
    links: [0.5, 1.2, 0.8, 1.0],
    sign: 1.0,
};

impl Lengths {
    /// The angle of the rocker (rad) against x at an angle of the crank.
    pub(crate) fn rocker(self, angle: f64) -> f64 {
        let [crank, coupler, rocker, base] = self.links;
        let (sine, cosine) = angle.sin_cos();
        let (px, py) = (crank * cosine, crank * sine);
        let (dx, dy) = (base - px, -py);
        let l = dx.hypot(dy);
        let along = (coupler * coupler - rocker * rocker + l * l) / (2.0 * l);
        let across = self.sign * (coupler * coupler - along * along).sqrt();
        let x = px + (along * dx - across * dy) / l;
        let y = py + (along * dy + across * dx) / l;
        y.atan2(x - base)
    }

    /// The pin of coupler and rocker with the crank on x.
    fn pin(self) -> [f64; 2] {
        let [_, _, rocker, base] = self.links;
        let (sine, cosine) = self.rocker(0.0).sin_cos();
        [base + rocker * cosine, rocker * sine]
    }

    pub(crate) fn four_bar(self) -> FourBar {
        let [x, y] = self.pin();
        FourBar::new(self.links[0], x, y, self.links[3], 1.0).expect("lengths")
    }

    pub(crate) fn driven(self) -> DrivenFourBar {
        let [x, y] = self.pin();
        DrivenFourBar::new(self.links[0], x, y, self.links[3]).expect("lengths")
    }

    /// What the angle of the rocker's joint is off by at an angle of the crank, on this branch.
    pub(crate) fn error(self, crank: f64, rocker: f64) -> f64 {
        wrapped(rocker - (self.rocker(crank) - self.rocker(0.0))).abs()
    }
}

/// An angle within half a turn.
pub(crate) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Numbers from 0 to 1, the same in every run (Knuth's multiplier).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn within(&mut self, from: f64, to: f64) -> f64 {
        let Self(state) = self;
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((*state >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A crank-rocker by Grashof's rule, not nearer than 0.02 m to a change point.
    pub(crate) fn crank_rocker(&mut self) -> Lengths {
        loop {
            let links = [0.1, 0.3, 0.3, 0.3].map(|least| self.within(least, 2.0));
            let mut sorted = links;
            sorted.sort_by(f64::total_cmp);
            let [shortest, a, b, longest] = sorted;
            if shortest == links[0] && shortest + longest + 0.02 < a + b {
                let sign = if self.within(0.0, 1.0) < 0.5 {
                    1.0
                } else {
                    -1.0
                };
                return Lengths { links, sign };
            }
        }
    }
}
