//! What a step costs in accuracy: pairs that are turned by the increments of their angles are as
//! good as the angles.

use std::f64::consts::FRAC_PI_2;

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{
    JointCoordinates,
    integrate::{OneStep, System},
    state::JointState,
};
use holonom_models::RodPendulum;

/// Two rods of 1 m and 1 kg on parallel hinges, stretched out at rest.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Two {
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 0.001, 1.0 / 12.0], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 0.001, 1.0 / 12.0], position = [0.0, 1.5, 0.0])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// The rod of chapter 15 by its angle from the downward vertical, and its rate.
struct Angle;

impl System<f64> for Angle {
    type State = [f64; 2];

    fn rates(&mut self, _time: f64, &[angle, rate]: &[f64; 2]) -> Result<[f64; 2], Fault> {
        let stiffness = 7.02 * 9.81 * 0.5 / (0.585_526_5 + 7.02 * 0.25);
        Ok([rate, -stiffness * angle.sin()])
    }
}

/// The two rods by their angles from the downward vertical, and their rates.
struct Angles;

impl System<f64> for Angles {
    type State = [f64; 4];

    fn rates(&mut self, _time: f64, &[a, b, u, v]: &[f64; 4]) -> Result<[f64; 4], Fault> {
        let (sine, cosine) = (a - b).sin_cos();
        let [m11, m12, m22] = [4.0 / 3.0, 0.5 * cosine, 1.0 / 3.0];
        let right = [
            -0.5 * sine * v * v - 1.5 * 9.81 * a.sin(),
            0.5 * sine * u * u - 0.5 * 9.81 * b.sin(),
        ];
        let determinant = m11 * m22 - m12 * m12;
        Ok([
            u,
            v,
            (m22 * right[0] - m12 * right[1]) / determinant,
            (m11 * right[1] - m12 * right[0]) / determinant,
        ])
    }
}

/// A state after 10 s by steps of Runge-Kutta.
fn reached<Y: System<f64>>(system: &mut Y, mut state: Y::State, steps: u32) -> Y::State {
    let step = 10.0 / f64::from(steps);
    for number in 0..steps {
        let time = step * f64::from(number);
        Rk4.step(system, time, &mut state, step).expect("regular");
    }
    state
}

/// The same in joint coordinates.
fn by_joints<M: JointCoordinates>(
    mechanism: &M,
    steps: u32,
) -> (M::JointState<f64>, M::State<f64>) {
    let mut stepper = Stepper::new(mechanism, StandardLagrange, Rk4)
        .expect("sound")
        .joint_coordinates();
    let mut state = stepper.initial_state().expect("closed");
    for _ in 0..steps {
        stepper
            .step(&mut state, 10.0 / f64::from(steps))
            .expect("regular");
    }
    (state, stepper.bodies(&state))
}

fn on_circle<const TURNS: usize, const REST: usize, const RATES: usize, const A: usize>(
    state: &JointState<f64, TURNS, REST, RATES, A>,
) {
    for [cosine, sine] in state.pairs() {
        assert!((cosine.hypot(*sine) - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_pendulum_is_as_accurate_as_its_angle() {
    let exact = reached(&mut Angle, [FRAC_PI_2, 0.0], 100_000)[0];
    let angle = (reached(&mut Angle, [FRAC_PI_2, 0.0], 1000)[0] - exact).abs();
    let rod = RodPendulum::default();
    let (state, bodies) = by_joints(&rod, 1000);
    on_circle(&state);
    let constants = rod.constants().expect("literal");
    let view = holonom::View::<f64, RodPendulum>::new(&constants, 10.0, &bodies);
    let joints = (view.angle(RodPendulum::HANDLES.pivot) + FRAC_PI_2 - exact).abs();
    println!("angle {angle:e}, joints {joints:e}");
    assert!(joints < 3e-7);
}

#[test]
fn a_double_pendulum_is_as_accurate_as_its_angles() {
    let start = [FRAC_PI_2, FRAC_PI_2, 0.0, 0.0];
    let exact = reached(&mut Angles, start, 100_000)[0];
    let rods = Two::default();
    let constants = rods.constants().expect("literal");
    for steps in [1000, 4000] {
        let angle = (reached(&mut Angles, start, steps)[0] - exact).abs();
        let (state, bodies) = by_joints(&rods, steps);
        on_circle(&state);
        let view = holonom::View::<f64, Two>::new(&constants, 10.0, &bodies);
        let joints = (view.angle(Two::HANDLES.shoulder) + FRAC_PI_2 - exact)
            .sin()
            .abs();
        println!("{steps} steps: angle {angle:e}, joints {joints:e}");
        assert!(joints < 1.2 * angle);
    }
}
