//! Orientations turn at the angular velocity, however long a run lasts and whatever the length of
//! the Euler parameters is.

use std::f64::consts::{PI, TAU};

use holonom::forces::TorsionalSpringDamper;
use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{Runs, state::Array};

/// A body that nothing holds, at 20 rad/s about a principal axis.
#[derive(Mechanism)]
pub(crate) struct Spinning {
    #[body(mass = 1.0, inertia = [0.2, 0.3, 0.4], angular_velocity = [0.0, 0.0, 20.0], free)]
    body: Body,
}

/// A wheel on a shaft.
#[derive(Mechanism)]
struct Wheel {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.3], angular_velocity = [0.0, 0.0, 1000.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
}

/// A wheel on a soft torsion spring, of which a quarter period takes many turns.
#[derive(Mechanism)]
struct Sprung {
    #[body(mass = 1.0, inertia = [0.3, 0.3, 0.5], angular_velocity = [0.0, 0.0, 300.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, wheel], axis = [0.0, 0.0, 1.0], stiffness = 1e-3)]
    spring: TorsionalSpringDamper,
}

/// The angle about z by which Euler parameters are off, from -pi to pi.
fn off(p: &[f64], turned: f64) -> f64 {
    let angle = 2.0 * p[3].atan2(p[0]) - turned;
    angle - TAU * (angle / TAU).round()
}

/// The largest error of the angle and of `|p|` at the reports of a run.
fn errors<M, I>(mechanism: &M, rate: f64, integrator: I, duration: f64) -> [f64; 2]
where
    M: Mechanism,
    I: Runs<Problem<M, StandardLagrange>>,
{
    let mut worst = [0.0_f64; 2];
    Simulation::new(mechanism, StandardLagrange, integrator)
        .run(0.0..=duration, every(0.01 * duration), |sample| {
            let p = &sample.state().coordinates().as_slice()[3..7];
            let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
            let errors = [off(p, rate * sample.time()).abs(), (length - 1.0).abs()];
            worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    println!(
        "{duration} s: off by {:e} rad, |p| by {:e}",
        worst[0], worst[1]
    );
    worst
}

#[test]
fn a_free_body_under_step_control_is_right_after_a_thousand_seconds() {
    let [angle, length] = errors(&Spinning::default(), 20.0, DormandPrince::default(), 1000.0);
    assert!(angle <= 1e-3, "{angle}");
    assert!(length <= 1e-6, "{length}");
}

#[test]
fn a_free_body_at_a_fixed_step_is_as_right_as_the_method() {
    let [angle, length] = errors(&Spinning::default(), 20.0, Rk4::every(0.01), 100.0);
    assert!(angle <= 2e-3, "{angle}");
    assert!(length <= 1e-6, "{length}");
}

#[test]
fn a_wheel_at_a_thousand_radians_a_second() {
    let [angle, length] = errors(&Wheel::default(), 1000.0, DormandPrince::default(), 10.0);
    assert!(angle <= 1e-2, "{angle}");
    assert!(length <= 1e-6, "{length}");
}

/// `theta = w0 / n sin(n t)`, `n^2 = k / J`: over a thousand turns in a quarter of the period.
#[test]
fn a_torsion_spring_counts_a_thousand_turns() {
    let (rate, frequency) = (300.0, (1e-3_f64 / 0.5).sqrt());
    let quarter = 0.5 * PI / frequency;
    let sprung = Sprung::default();
    let handles = Sprung::HANDLES;
    let mut reached = [0.0; 2];
    Simulation::new(&sprung, StandardLagrange, DormandPrince::default())
        .run(0.0..=quarter, every(quarter), |sample| {
            let counted = sample.state().coordinates().as_slice().last().copied();
            reached = [
                counted.expect("it counts"),
                sample.force_parts(handles.spring).potential,
            ];
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    let turned = rate / frequency;
    println!("{reached:?} for {turned} rad");
    assert!(turned > 1000.0 * TAU);
    assert!((reached[0] - turned).abs() < 0.1, "{}", reached[0] - turned);
    let energy = 0.5 * 1e-3 * turned * turned;
    assert!((reached[1] / energy - 1.0).abs() < 1e-4, "{reached:?}");
}
