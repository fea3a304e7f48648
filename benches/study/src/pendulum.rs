//! The closed form of a rigid pendulum: what every integration of it is judged by.

use crate::elliptic::{jacobi, quarter_period};

/// A rigid body on a hinge, released at rest: `I phi'' = -m g d sin(phi)`.
///
/// The angle `phi` (rad) is counted from the downward vertical about the hinge axis; the body
/// starts at `amplitude`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidPendulum {
    /// Mass (kg).
    pub mass: f64,
    /// Moment of inertia about the hinge axis (kg m^2), not about the centre of mass.
    pub inertia: f64,
    /// From the hinge to the centre of mass (m).
    pub distance: f64,
    /// Acceleration of gravity (m/s^2), downwards.
    pub gravity: f64,
    /// The angle at time zero (rad), between `-pi` and `pi`.
    pub amplitude: f64,
}

/// Motion and reaction at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// `phi` (rad), from the downward vertical.
    pub angle: f64,
    /// `phi'` (rad/s).
    pub rate: f64,
    /// `phi''` (rad/s^2).
    pub acceleration: f64,
    /// The force of the hinge on the body along the line from the centre of mass to the hinge (N).
    pub radial: f64,
    /// The force of the hinge on the body across that line, in the direction of growing `phi` (N).
    pub transverse: f64,
}

impl RigidPendulum {
    /// The rod of chapter 15 of Flores (2015), released at rest from the horizontal: 1 m long,
    /// hinged at one end.
    pub const CHAPTER_15: Self = Self {
        mass: 7.02,
        inertia: 0.585_526_5 + 7.02 * 0.5 * 0.5,
        distance: 0.5,
        gravity: 9.81,
        amplitude: std::f64::consts::FRAC_PI_2,
    };

    /// The frequency of small oscillations, `sqrt(m g d / I)` (rad/s).
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.mass * self.gravity * self.distance / self.inertia).sqrt()
    }

    /// The time of one full swing there and back (s).
    #[must_use]
    pub fn period(&self) -> f64 {
        4.0 * quarter_period((0.5 * self.amplitude).sin().powi(2)) / self.frequency()
    }

    /// Motion and reaction at a time (s).
    ///
    /// `sin(phi / 2) = k cd(w t | k^2)` with `k = sin(amplitude / 2)` and `w` the
    /// [frequency](Self::frequency); from it `phi' = -2 w k k' sn / dn` with `k'^2 = 1 - k^2`,
    /// because `cos(phi / 2) = k' / dn`.
    #[must_use]
    pub fn at(&self, time: f64) -> Swing {
        let (modulus, complement) = (0.5 * self.amplitude).sin_cos();
        let frequency = self.frequency();
        let j = jacobi(frequency * time, modulus * modulus);
        let (sine, cosine) = (modulus * j.cn / j.dn, complement / j.dn);
        let angle = 2.0 * sine.atan2(cosine);
        let rate = -2.0 * frequency * modulus * complement * j.sn / j.dn;
        let acceleration = -frequency.powi(2) * angle.sin();
        Swing {
            angle,
            rate,
            acceleration,
            radial: self.mass * (self.gravity * angle.cos() + self.distance * rate.powi(2)),
            transverse: self.mass * (self.distance * acceleration + self.gravity * angle.sin()),
        }
    }
}

/// The angle `phi` from the downward vertical (rad) at a joint angle `theta` (rad) that is zero
/// where the pendulum was released, `amplitude` from the vertical.
///
/// For the rod of chapter 15 the joint angle turns about global x and is zero with the rod along
/// +y, gravity along -z: a positive turn lifts the rod, `theta = -pi/2` points it down, and
/// `phi = theta + pi/2`.
#[must_use]
pub fn from_vertical(theta: f64, amplitude: f64) -> f64 {
    wrapped(theta + amplitude)
}

/// The same angle in the range `-pi..=pi` (rad).
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    // The range of most angles needs no detour through the functions, which would cost a digit.
    if angle.abs() <= std::f64::consts::PI {
        angle
    } else {
        sine.atan2(cosine)
    }
}

/// Radial and transverse part (N) of a force of the hinge on a pendulum that swings about global x
/// with gravity along -z, as [`Swing`] defines them.
///
/// The rod points along `(0, sin phi, -cos phi)`, growing `phi` moves it along
/// `(0, cos phi, sin phi)`.
#[must_use]
pub fn polar_parts(force: [f64; 3], angle: f64) -> (f64, f64) {
    let (sine, cosine) = angle.sin_cos();
    (
        -(force[1] * sine - force[2] * cosine),
        force[1] * cosine + force[2] * sine,
    )
}

#[cfg(test)]
mod tests {
    use super::{RigidPendulum, from_vertical, polar_parts, wrapped};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Time, angle, rate, radial and transverse reaction, calculated with 18 digits.
    const REFERENCE: [[f64; 5]; 5] = [
        [
            1.0,
            -1.562_676_795_263_082_5,
            0.488_775_443_886_885_43,
            1.397_699_173_704_197,
            -17.227_600_661_249_58,
        ],
        [
            5.0,
            -1.368_085_820_598_437_2,
            2.433_857_865_939_373_7,
            34.656_553_861_985_28,
            -16.875_412_913_594_163,
        ],
        [
            10.0,
            0.776_118_948_971_797_9,
            -4.582_317_240_185_013,
            122.847_198_297_600_27,
            12.068_591_148_374_754,
        ],
        [
            100.0,
            -0.329_650_912_160_502_63,
            5.276_276_128_543_78,
            162.873_332_520_921_14,
            -5.576_977_937_872_249,
        ],
        [
            1000.0,
            0.676_733_509_664_628_2,
            -4.789_481_105_145_914_5,
            134.205_983_602_369_49,
            10.789_136_082_464_424,
        ],
    ];

    #[test]
    fn motion_and_reactions_are_those_of_the_reference() {
        for [time, angle, rate, radial, transverse] in REFERENCE {
            // The phase is known no better than `frequency * time` times the machine epsilon.
            let tolerance = 1e-12_f64.max(2e-15 * time);
            let swing = RigidPendulum::CHAPTER_15.at(time);
            assert!((swing.angle - angle).abs() < tolerance, "angle at {time} s");
            assert!(
                (swing.rate - rate).abs() < 5.0 * tolerance,
                "rate at {time} s"
            );
            assert!(
                (swing.radial / radial - 1.0).abs() < 20.0 * tolerance,
                "radial at {time} s"
            );
            assert!(
                (swing.transverse / transverse - 1.0).abs() < 10.0 * tolerance,
                "{time} s"
            );
        }
    }

    #[test]
    fn period_and_extremes_are_those_of_the_reference() {
        let pendulum = RigidPendulum::CHAPTER_15;
        assert!((pendulum.period() - 1.933_552_342_311_354_3).abs() < 1e-15);
        let lowest = pendulum.at(0.25 * pendulum.period());
        assert!((lowest.rate + 5.424_332_192_957_82).abs() < 1e-13);
        assert!((lowest.radial - 172.142_262_885_851).abs() < 1e-11);
        assert!((pendulum.at(0.0).angle - FRAC_PI_2).abs() < 1e-15);
    }

    #[test]
    fn energy_stays() {
        let pendulum = RigidPendulum::CHAPTER_15;
        let energy = |time: f64| {
            let swing = pendulum.at(time);
            0.5 * pendulum.inertia * swing.rate.powi(2)
                - pendulum.mass * pendulum.gravity * pendulum.distance * swing.angle.cos()
        };
        for step in 0..500 {
            assert!((energy(0.02 * f64::from(step)) - energy(0.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_joint_angle_is_zero_at_the_start_and_minus_a_quarter_turn_below() {
        assert_eq!(from_vertical(0.0, FRAC_PI_2), FRAC_PI_2);
        assert_eq!(from_vertical(-FRAC_PI_2, FRAC_PI_2), 0.0);
        // Beyond the far horizontal the joint angle comes back as +pi: the same direction.
        assert!((from_vertical(PI - 1e-9, FRAC_PI_2) + FRAC_PI_2 + 1e-9).abs() < 1e-15);
        assert!((wrapped(-3.0 * PI) + PI).abs() < 1e-14 || (wrapped(-3.0 * PI) - PI).abs() < 1e-14);
    }

    #[test]
    fn a_resting_pendulum_hangs_on_its_hinge() {
        // Straight down, the hinge carries the weight; sideways, an upward force is transverse.
        assert_eq!(polar_parts([0.0, 0.0, 70.0], 0.0), (70.0, 0.0));
        let (radial, transverse) = polar_parts([0.0, 0.0, 70.0], FRAC_PI_2);
        assert!(radial.abs() < 1e-14 && (transverse - 70.0).abs() < 1e-14);
        // The signs of the closed form, from Newton's law at the start: m (g - d w^2) upwards on a
        // horizontal rod.
        let start = RigidPendulum::CHAPTER_15.at(0.0);
        let upward = 7.02 * (9.81 - 0.5 * RigidPendulum::CHAPTER_15.frequency().powi(2));
        let (radial, transverse) = polar_parts([0.0, 0.0, upward], start.angle);
        assert!((radial - start.radial).abs() < 1e-13);
        assert!((transverse - start.transverse).abs() < 1e-13);
    }
}
