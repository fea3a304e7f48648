//! C03: what explicit methods do to Euler parameters at a constant angular velocity.
//!
//! `p' = 1/2 L(p)^T w` turns `p` in two planes at half the rate of the body. With `z = |w| h / 2` a
//! step of a method multiplies each of them, as a complex number, by the stability polynomial
//! `R(i z)`: `|p|^2` by `|R(i z)|^2`, and half the angle comes out too large by `arg R(i z) - z`.

use holonom::prelude::*;
use holonom::{
    Heun, Midpoint, SemiImplicitEuler, StateParts, Stepper,
    integrate::{BogackiShampine3, DormandPrince5, OneStep, SecondOrder, System},
    mechanism::{Absolute, Relative},
    run,
};

use super::difference;

/// A stability polynomial: its coefficients at `z^0`, `z^1`, .., and `|R(i z)|^2 - 1`, which has no
/// digits left where it is made of those.
struct Polynomial {
    coefficients: &'static [f64],
    gain: fn(f64) -> f64,
}

/// Of explicit Euler, which semi-implicit Euler is for positions where velocities stay.
const FIRST: Polynomial = Polynomial {
    coefficients: &[1.0, 1.0],
    gain: |z| z.powi(2),
};
/// Of two stages and order 2.
const SECOND: Polynomial = Polynomial {
    coefficients: &[1.0, 1.0, 1.0 / 2.0],
    gain: |z| z.powi(4) / 4.0,
};
/// Of three stages and order 3.
const THIRD: Polynomial = Polynomial {
    coefficients: &[1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0],
    gain: |z| -z.powi(4) / 12.0 + z.powi(6) / 36.0,
};
/// Of four stages and order 4.
const FOURTH: Polynomial = Polynomial {
    coefficients: &[1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0],
    gain: |z| -z.powi(6) / 72.0 + z.powi(8) / 576.0,
};
/// Of Dormand and Prince's six stages of order 5 (Hairer and Wanner, *Solving Ordinary Differential
/// Equations II*, IV.2).
const FIFTH: Polynomial = Polynomial {
    coefficients: &[
        1.0,
        1.0,
        1.0 / 2.0,
        1.0 / 6.0,
        1.0 / 24.0,
        1.0 / 120.0,
        1.0 / 600.0,
    ],
    gain: |z| {
        -z.powi(6) / 1800.0 + z.powi(8) / 1600.0 - z.powi(10) / 14_400.0 + z.powi(12) / 360_000.0
    },
};

impl Polynomial {
    /// `arg R(i z) - z`.
    fn ahead(&self, z: f64) -> f64 {
        let (mut real, mut imaginary) = (0.0, 0.0);
        for &coefficient in self.coefficients.iter().rev() {
            (real, imaginary) = (coefficient - z * imaginary, z * real);
        }
        f64::atan2(imaginary, real) - z
    }
}

/// `p (0, axis)`, the product of quaternions: `p'` of twice a unit of angular velocity in the axes
/// of the body.
fn along(p: [f64; 4], [x, y, z]: [f64; 3]) -> [f64; 4] {
    let [e, a, b, c] = p;
    [
        -a * x - b * y - c * z,
        e * x + b * z - c * y,
        e * y + c * x - a * z,
        e * z + a * y - b * x,
    ]
}

fn dot(p: [f64; 4], q: [f64; 4]) -> f64 {
    p.iter().zip(&q).map(|(p, q)| p * q).sum()
}

/// `|p|^2`, and how much half of the angle (rad, -pi to pi) is too large after a turn from `start`
/// by twice `half` (rad) about an axis.
fn compared(start: [f64; 4], axis: [f64; 3], half: f64, p: [f64; 4]) -> [f64; 2] {
    let (sine, cosine) = half.sin_cos();
    let ahead = along(start, axis);
    let exact: [f64; 4] = core::array::from_fn(|k| cosine * start[k] + sine * ahead[k]);
    [dot(p, p), dot(p, along(exact, axis)).atan2(dot(p, exact))]
}

const START: [f64; 4] = [0.5, 0.1, -0.7, 0.5];
const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// s.
const STEP: f64 = 1e-3;
/// Ten seconds.
const STEPS: u32 = 10_000;
/// Every step rounds, now up and now down: what that adds up to goes with the square root of their
/// number, a hundred. Ten times as much is allowed.
const ROUND_OFF: f64 = 10.0 * 100.0 * f64::EPSILON;

/// The rates of Euler parameters at a constant angular velocity (rad/s, axes of the body), which is
/// no part of the state.
struct Turning {
    axis: [f64; 3],
    speed: f64,
}

impl System<f64> for Turning {
    type State = [f64; 4];

    fn rates(&mut self, _time: f64, &p: &[f64; 4]) -> Result<[f64; 4], Fault> {
        Ok(along(p, self.axis).map(|rate| 0.5 * self.speed * rate))
    }
}

impl SecondOrder<f64> for Turning {
    /// Velocities stay.
    fn with_new_velocities(&mut self, _: f64, _: &[f64; 4], _: f64, _: &mut [f64; 4]) {}
}

/// A body on which nothing acts, turning about a principal axis.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
struct Free {
    #[body(
        free,
        mass = 1.0,
        inertia = [0.2, 0.3, 0.4],
        position = [0.3, -0.2, 0.1],
        orientation = [0.5, 0.1, -0.7, 0.5]
    )]
    body: Body,
}

fn turning(axis: [f64; 3], speed: f64) -> <Free as Mechanism>::State<f64> {
    let mut state = Free::default().described_state().expect("described");
    let velocities = state.velocities_mut().as_mut_slice();
    for (velocity, along) in velocities[3..].iter_mut().zip(axis) {
        *velocity = speed * along;
    }
    state
}

fn euler_parameters(state: &<Free as Mechanism>::State<f64>) -> [f64; 4] {
    let coordinates = state.coordinates().as_slice();
    core::array::from_fn(|k| coordinates[3 + k])
}

/// Methods that move all of these.
trait Steps:
    OneStep<f64, Turning>
    + run::Steps<Problem<Free, StandardLagrange, f64, Absolute>>
    + run::Steps<Problem<Free, StandardLagrange, f64, Relative>>
{
}

impl<K> Steps for K where
    K: OneStep<f64, Turning>
        + run::Steps<Problem<Free, StandardLagrange, f64, Absolute>>
        + run::Steps<Problem<Free, StandardLagrange, f64, Relative>>
{
}

fn of_a_system<K: OneStep<f64, Turning>>(scheme: K, axis: [f64; 3], speed: f64) -> [f64; 4] {
    let (mut p, mut system) = (START, Turning { axis, speed });
    for step in 0..STEPS {
        let time = STEP * f64::from(step);
        scheme
            .step(&mut system, time, &mut p, STEP)
            .expect("finite");
    }
    p
}

fn of_a_body<K: run::Steps<Problem<Free, StandardLagrange, f64, Absolute>>>(
    scheme: K,
    axis: [f64; 3],
    speed: f64,
) -> [f64; 4] {
    let mut stepper = Stepper::new(&Free::default(), StandardLagrange, scheme)
        .expect("acceptable")
        .absolute_coordinates();
    let mut state = turning(axis, speed);
    for _ in 0..STEPS {
        stepper.step(&mut state, STEP).expect("regular");
    }
    euler_parameters(&state)
}

fn of_a_ball<K: run::Steps<Problem<Free, StandardLagrange, f64, Relative>>>(
    scheme: K,
    axis: [f64; 3],
    speed: f64,
) -> [f64; 4] {
    let mut stepper = Stepper::<Problem<_, _>, _>::new(&Free::default(), StandardLagrange, scheme)
        .expect("acceptable")
        .joint_coordinates();
    let mut state = stepper.state_of(&turning(axis, speed)).expect("consistent");
    for _ in 0..STEPS {
        stepper.step(&mut state, STEP).expect("regular");
    }
    euler_parameters(&stepper.bodies(&state))
}

/// Ten seconds about every axis: Euler parameters alone, and of a body, where they are brought to
/// length 1 after every step, against `|p|^2 - 1` and the error of half the angle (rad) that are
/// returned.
fn drifts<K: Steps>(scheme: K, polynomial: &Polynomial, speed: f64) -> [f64; 2] {
    let steps = f64::from(STEPS);
    let z = 0.5 * speed * STEP;
    let gain = (steps * (polynomial.gain)(z).ln_1p()).exp_m1();
    let ahead = steps * polynomial.ahead(z);
    println!("{scheme:?}, {speed} rad/s: {gain:e}, {ahead:e} rad");
    // What a step turns by is known to some units in its last place.
    let asked = ROUND_OFF + 4.0 * f64::EPSILON * z * steps;
    for axis in AXES {
        for (what, square, p) in [
            ("alone", 1.0 + gain, of_a_system(scheme, axis, speed)),
            ("body", 1.0, of_a_body(scheme, axis, speed)),
            ("ball", 1.0, of_a_ball(scheme, axis, speed)),
        ] {
            let [found, angle] = compared(START, axis, z * steps, p);
            // Of a ball, `p` comes out of joint coordinates with either sign: half the angle counts
            // modulo half a turn.
            let times = if what == "ball" { 2.0 } else { 1.0 };
            let angle = difference(times * angle, times * ahead) / times;
            let off = [found / square - 1.0, angle];
            println!("{what}, {axis:?}: off by {off:?}");
            assert!(off.iter().all(|off| off.abs() <= asked), "{what}: {off:?}");
        }
    }
    [gain, ahead]
}

/// To the digits that were published.
#[test]
fn runge_kutta_of_order_4() {
    for (speed, [square, angle], digits) in [
        (10.0, [-2.170_132_1e-12, -2.604e-10], [5e-20, 5e-14]),
        (100.0, [-2.169_458_367e-6, -2.601_84e-5], [5e-16, 5e-11]),
        (1000.0, [-0.877_854_591, -2.376], [5e-10, 5e-4]),
    ] {
        let [gain, ahead] = drifts(Rk4, &FOURTH, speed);
        assert!((gain - square).abs() <= digits[0], "{gain:e}");
        assert!((ahead - angle).abs() <= digits[1], "{ahead:e}");
    }
}

#[test]
fn methods_of_other_orders() {
    for speed in [10.0, 100.0, 400.0] {
        drifts(SemiImplicitEuler, &FIRST, speed);
        drifts(Midpoint, &SECOND, speed);
        drifts(Heun, &SECOND, speed);
        drifts(BogackiShampine3, &THIRD, speed);
        drifts(DormandPrince5, &FIFTH, speed);
    }
}
