//! Laws of time: every function that a driver may follow, with its first two derivatives by dual
//! numbers in time, and the efforts of drivers as their multipliers.

use holonom::joints::{
    AngleDriver, DisplacementDriver, DistanceDriver, OrientationDriver, Revolute,
};
use holonom::prelude::*;
use holonom::{StateParts, View};
use num_dual::{Dual2_64, DualNum};

use crate::comparison::{ROUND_OFF, distance};

/// Nine laws on three beads, each displaced along an axis of the ground.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Beads {
    #[param]
    amplitude: f64,
    #[param]
    start: f64,
    #[body(mass = 1.0, position = [0.0, 0.0, 0.0])]
    a: Particle,
    #[body(mass = 2.0, position = [1.0, 0.0, 0.0])]
    b: Particle,
    #[body(mass = 3.0, position = [2.0, 0.0, 0.0])]
    c: Particle,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        motion = 0.3 - 0.5 * time + 0.2 * time * time - 0.07 * time * time * time)]
    polynomial: DisplacementDriver,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0],
        motion = amplitude * sin(3.0 * time + 0.4))]
    sine: DisplacementDriver,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        motion = cos(2.0 * time) / (1.5 + time * time))]
    quotient: DisplacementDriver,
    #[joint(between = [ground, b], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        motion = exp(-0.7 * time) * cos(5.0 * time))]
    decay: DisplacementDriver,
    #[joint(between = [ground, b], point = [1.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0],
        motion = sqrt(1.0 + 0.5 * sin(time)))]
    root: DisplacementDriver,
    #[joint(between = [ground, b], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        motion = amplitude * smooth_step((time - start) / 0.8))]
    step: DisplacementDriver,
    #[joint(between = [ground, c], point = [2.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        motion = sin(cos(exp(0.3 * time)) * time))]
    nested: DisplacementDriver,
    #[joint(between = [ground, c], point = [2.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0],
        motion = smooth_step(0.5 + 0.4 * sin(2.0 * time)))]
    wavy_step: DisplacementDriver,
    #[joint(between = [ground, c], point = [2.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], motion = 0.25)]
    constant: DisplacementDriver,
}

const AMPLITUDE: f64 = 0.6;
const START: f64 = 0.5;

/// The polynomial between 0 and 1; outside it is constant.
fn smooth_step(x: Dual2_64) -> Dual2_64 {
    match x.re {
        x if x <= 0.0 => Dual2_64::from(0.0),
        x if x >= 1.0 => Dual2_64::from(1.0),
        _ => x.powi(3) * (x * (x * 6.0 - 15.0) + 10.0),
    }
}

/// The laws once more, over dual numbers.
fn laws(t: Dual2_64) -> [Dual2_64; 9] {
    [
        -t * 0.5 + t * t * 0.2 - t * t * t * 0.07 + 0.3,
        (t * 3.0 + 0.4).sin() * AMPLITUDE,
        (t * 2.0).cos() / (t * t + 1.5),
        (-t * 0.7).exp() * (t * 5.0).cos(),
        (t.sin() * 0.5 + 1.0).sqrt(),
        smooth_step((t - START) / 0.8) * AMPLITUDE,
        ((t * 0.3).exp().cos() * t).sin(),
        smooth_step((t * 2.0).sin() * 0.4 + 0.5),
        Dual2_64::from(0.25),
    ]
}

/// From before the step to long after it, its two ends among them.
fn times() -> impl Iterator<Item = f64> {
    (0..=60)
        .map(|k| 0.05 * f64::from(k))
        .chain([START, START + 0.8, START + 0.4, -0.3])
}

fn beads() -> Beads {
    Beads::new(AMPLITUDE, START).expect("acceptable")
}

#[test]
fn laws_and_their_derivatives_are_those_of_duals_in_time() {
    let beads = beads();
    let constants = beads.constants().expect("acceptable");
    let state = Beads::initial_state(&constants);
    let mut worst = 0.0_f64;
    for time in times() {
        let laws = laws(Dual2_64::from(time).derivative());
        // Undisplaced and at rest: Phi = -f, Phi' = Phi_t = -f', gamma = -Phi_tt = f''.
        let found = [
            Beads::constraints(&constants, time, &state).map(|row: f64| -row),
            Beads::constraint_rates(&constants, time, &state).map(|row: f64| -row),
            Beads::gamma(&constants, time, &state),
        ];
        let expected = [laws.map(|f| f.re), laws.map(|f| f.v1), laws.map(|f| f.v2)];
        for (found, expected) in found.iter().zip(&expected) {
            let deviation = distance(found, expected, 1.0);
            assert!(
                deviation <= ROUND_OFF,
                "at {time} s: {found:?} {expected:?}"
            );
            worst = worst.max(deviation);
        }
    }
    println!("laws: {worst:e}");
}

#[test]
fn a_smooth_step_is_constant_outside_and_twice_continuous() {
    let beads = beads();
    let constants = beads.constants().expect("acceptable");
    let state = Beads::initial_state(&constants);
    let step = |time: f64| {
        [
            -Beads::constraints(&constants, time, &state)[5],
            -Beads::constraint_rates(&constants, time, &state)[5],
            Beads::gamma(&constants, time, &state)[5],
        ]
    };
    for time in [-1.0, 0.0, START] {
        assert_eq!(step(time).map(f64::abs), [0.0; 3]);
    }
    for time in [START + 0.81, 2.0, 1e6] {
        let [value, rate, curvature] = step(time);
        assert!((value - AMPLITUDE).abs() < 1e-15 && rate.abs() < 1e-13 && curvature.abs() < 1e-12);
    }
    for end in [START, START + 0.8] {
        let (before, after) = (step(end - 1e-9), step(end + 1e-9));
        for (before, after) in before.iter().zip(after) {
            // The third derivative jumps by 60 / 0.8^3.
            assert!((before - after).abs() < 1e-6);
        }
    }
}

/// A slotted arm that a motor turns, a slider driven along it, and a strut of prescribed length.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Robot {
    #[body(mass = 3.0, inertia = [0.3, 0.02, 0.31], position = [0.0, 0.6, 0.0])]
    arm: Body,
    #[body(mass = 1.5, inertia = [0.02, 0.03, 0.01], position = [0.0, 0.8, 0.1])]
    tool: Body,
    #[body(mass = 0.8, position = [0.9, 0.1, 0.4])]
    bead: Particle,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [ground, arm], axis = [1.0, 0.0, 0.0], motion = 0.4 * time + 0.3 * sin(2.0 * time))]
    motor: AngleDriver,
    #[joint(between = [arm, tool], axis = [0.0, 1.0, 0.3], motion = 1.5 * smooth_step(time))]
    wrist: OrientationDriver,
    #[joint(between = [arm, tool], point = [0.0, 0.8, 0.1], axis = [0.0, 1.0, 0.0], motion = 0.2 * sin(3.0 * time))]
    along: DisplacementDriver,
    #[joint(between = [arm, tool], point = [0.0, 0.8, 0.1], axis = [1.0, 0.0, 0.0], motion = 0.1 * time * time)]
    across: DisplacementDriver,
    #[joint(between = [arm, tool], point = [0.0, 0.8, 0.1], axis = [0.0, 0.0, 1.0], motion = 0.05 * exp(time) - 0.05)]
    up: DisplacementDriver,
    #[joint(
        between = [ground, bead],
        head = [0.0, 0.0, 0.0],
        tail = [0.9, 0.1, 0.4],
        motion = sqrt(0.98) + 0.1 * sin(time)
    )]
    strut: DistanceDriver,
}

#[test]
fn efforts_are_multipliers_and_put_in_the_power_of_the_motion() {
    let robot = Robot::default();
    let handles = Robot::HANDLES;
    // The strut alone is not determined: six motions of the arm and the tool are, two of the bead
    // are free.
    assert_eq!(Robot::REPORT.degrees_of_freedom, 2);
    let mut worst = [0.0_f64; 2];
    Simulation::new(
        &robot,
        StandardLagrange,
        DormandPrince::new(Tolerance {
            relative: 1e-10,
            absolute: 1e-12,
        }),
    )
    .assembled()
    .projection(Projection::default())
    .run(0.0..=2.0, every(0.1), |sample| {
        let multipliers = sample.multipliers().expect("regular");
        let row = |joint: usize, k: usize| -multipliers[Robot::REPORT.joints[joint].row + k];
        let (t, view): (f64, &View<'_, f64, Robot>) = (sample.time(), sample);
        let smooth = |x: f64| {
            if x < 1.0 {
                30.0 * x * x * (x - 1.0) * (x - 1.0)
            } else {
                0.0
            }
        };
        // Effort, its multiplier, the rate that is prescribed, the rate that is read.
        let drives = [
            (
                view.driving_effort(&multipliers, handles.motor),
                row(1, 0),
                0.4 + 0.6 * (2.0 * t).cos(),
                view.angle_rate(handles.motor),
            ),
            (
                view.driving_effort(&multipliers, handles.wrist),
                row(2, 2),
                1.5 * smooth(t),
                view.angle_rate(handles.wrist),
            ),
            (
                view.driving_effort(&multipliers, handles.along),
                row(3, 0),
                0.6 * (3.0 * t).cos(),
                view.displacement_rate(handles.along),
            ),
            (
                view.driving_effort(&multipliers, handles.across),
                row(4, 0),
                0.2 * t,
                view.displacement_rate(handles.across),
            ),
            (
                view.driving_effort(&multipliers, handles.up),
                row(5, 0),
                0.05 * t.exp(),
                view.displacement_rate(handles.up),
            ),
            (
                view.driving_effort(&multipliers, handles.strut),
                row(6, 0),
                0.1 * t.cos(),
                view.displacement_rate(handles.strut),
            ),
        ];
        let mut power = 0.0;
        for (effort, multiplier, prescribed, rate) in drives {
            let effort = effort.expect("nothing is left out");
            assert_eq!(effort, multiplier);
            worst[0] = worst[0].max((rate - prescribed).abs());
            power += effort * prescribed;
        }
        assert!(worst[0] < 1e-10, "{worst:?} at {t} s");
        // What the drivers put in is what kinetic and potential energy gain: u . M u' - u . weight.
        let accelerations = sample.accelerations().expect("regular");
        let constants = robot.constants::<f64>().expect("acceptable");
        let mass = Robot::mass(&constants);
        let forces = Robot::forces(&constants, t, sample.state());
        let velocities = sample.state().velocities().as_slice();
        let gain: f64 = (0..velocities.len())
            .map(|k| velocities[k] * (mass[k] * accelerations[k] - forces[k]))
            .sum();
        worst[1] = worst[1].max((gain - power).abs() / power.abs().max(1.0));
        assert!(worst[1] < 1e-10, "{gain} {power} at {t} s");
        ControlFlow::Continue(())
    })
    .expect("regular");
    println!("rates {:e}, power {:e}", worst[0], worst[1]);
}
