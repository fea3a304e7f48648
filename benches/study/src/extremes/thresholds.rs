//! What a run promises, stated before anything is run, and where that ends: every number with its
//! reason.
//!
//! Errors are relative to the scale of the motion: radians for an angle, parts of the largest value
//! for others.

use holonom::Real as _;

use crate::compare::Precision;
use crate::trade::{FLOOR, Family, Formulated, Setting};

/// A run holds what it promises within this: the constants below are of linear oscillations,
/// motions are not.
pub const HOLDS: f64 = 10.0;

/// An error above this of the motion's scale is wrong where nothing tells of it.
pub const WRONG: f64 = 1e-2;

/// The error of a step of `x` radians of an oscillation, for every radian of motion: leading terms
/// of the phase, or of the amplitude where that is larger.
///
/// Semi-implicit Euler: half a step, `x / 2`, which does not grow with the motion; its phase
/// `x^2 / 24`. Midpoint and Heun: `x^2 / 6`; implicit midpoint: `x^2 / 12`. Generalized-alpha:
/// `(1/12 + 3/8 d^2) x^2`, and an amplitude of `d^3 x^3 / 2`, with `d = (1 - rho) / (1 + rho)`.
/// Kutta of order 3: an amplitude of `x^3 / 24`, and a phase of `x^4 / 30`. Runge-Kutta of order 4:
/// `x^4 / 120`; Adams, Bashforth and Moulton: `19 x^4 / 720`, and an amplitude of
/// about `x^5 / 8`. Dormand-Prince of order 5: its amplitude of a linear oscillation goes with
/// `x^6 / 3600`; a motion that is not linear has terms of order 5, for which `x^5 / 360` stands. Of
/// order 8: `x^8 / 360`, likewise.
fn of_step(family: Family, x: f64) -> [f64; 2] {
    match family {
        Family::SemiImplicitEuler => [x / 2.0, x * x / 24.0],
        Family::Midpoint | Family::Heun => [0.0, x.powi(2) / 6.0],
        Family::Kutta3 => [0.0, x.powi(3) / 24.0 + x.powi(4) / 30.0],
        Family::ImplicitMidpoint => [0.0, x.powi(2) / 12.0],
        // With a spectral radius of 0.8: (1 - 0.8) / (1 + 0.8) = 1/9.
        Family::GeneralizedAlpha => [
            0.0,
            (1.0 / 12.0 + 3.0 / 8.0 / 81.0) * x.powi(2) + x.powi(3) / 729.0 / 2.0,
        ],
        Family::AdamsBashforthMoulton4 => [0.0, 19.0 / 720.0 * x.powi(4) + x.powi(5) / 8.0],
        Family::Rk4 => [0.0, x.powi(4) / 120.0],
        Family::DormandPrinceFixed => [0.0, x.powi(5) / 360.0],
        Family::DormandPrince853Fixed => [0.0, x.powi(8) / 360.0],
        // Of step control: the tolerance in every step, steps of about a third of a radian at usual
        // tolerances.
        Family::BogackiShampine
        | Family::DormandPrince
        | Family::DormandPrince853
        | Family::Adams
        | Family::RadauIIA => [0.0, 3.0],
        // Of backward differentiation some ten times as many steps, whose errors are to one side.
        Family::Bdf => [0.0, 30.0],
    }
}

/// What is known of a motion before it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The frequency (rad/s) of the fastest motion that is followed.
    pub frequency: f64,
    /// How long it runs (s).
    pub duration: f64,
    /// The largest number in the state over the scale of the motion, in the same unit, at least 1:
    /// far from the origin, digits are lost.
    pub reach: f64,
    /// The scale of the motion in the units of the state, for the absolute tolerance: an element
    /// below it is as good as that, not better.
    pub size: f64,
    /// The mass (kg) that the constraints carry: a penalty yields by its part of `alpha`.
    pub mass: f64,
    /// The violation that the run starts with, over the size of the mechanism: it moves as one of
    /// other lengths.
    pub violation: f64,
}

/// The relative error that a setting promises for a motion: discretisation, bias of the
/// formulation, round-off of every step to one side, and what the start is off by.
///
/// Round-off: `EPSILON` of the number type, times the reach, in every step, where nothing evens
/// out.
///
/// The bias of a penalty: `m / alpha` of the accelerations, for every radian (what chapter 15's rod
/// shows: 3.4e-5 rad after 32 rad with `m / alpha = 7e-7`). An augmented Lagrangian has it iterated
/// away, down to `1e-10` (f64) of the accelerations, or what single precision leaves.
#[must_use]
pub fn promised(setting: &Setting, motion: &Motion) -> f64 {
    let Motion {
        frequency,
        duration,
        reach,
        size,
        mass,
        violation,
    } = *motion;
    let travel = frequency * duration;
    let value = setting.integration.step_or_tolerance;
    let family = setting.integration.family;
    let (fixed, each, steps) = if family.is_adaptive() {
        // Where an element is small, its floor counts.
        let tolerance = value * (FLOOR / size).max(1.0);
        (0.0, of_step(family, 0.0)[1] * tolerance, 3.0 * travel)
    } else {
        let [fixed, each] = of_step(family, value * frequency);
        (fixed, each, duration / value)
    };
    let epsilon = match setting.scalar {
        Precision::Double => f64::EPSILON,
        Precision::Single => f32::EPSILON.to_f64(),
    };
    let bias = match setting.formulation {
        Formulated::Standard | Formulated::Baumgarte(_) => 0.0,
        Formulated::Penalty(penalty) => mass / penalty.alpha,
        Formulated::AugmentedLagrangian(_) => 1e-10_f64.max(64.0 * epsilon),
    };
    let round_off = epsilon * reach * steps.max(1.0);
    fixed + travel * (each + bias + violation) + round_off
}
