//! E04: the door on two hinges against its closed form.

use core::f64::consts::FRAC_PI_2;

use holonom::prelude::*;
use holonom_models::Door;
use nalgebra::Vector3;

use super::{at_times, change_of_energy, difference, difference_after};

/// `phi'' = -w0^2 sin(phi)` from `pi/2` at rest, `w0^2 = 3.19204613912414751` 1/s^2, in elliptic
/// functions: `phi` (rad) and `phi'` (rad/s) at 10 s.
const PHI: f64 = -1.343_747_101_212_868;
const RATE: f64 = -1.198_783_255_920_019;

fn swings<F: Formulation<f64>>(method: F) {
    /// rad; a rate of 2.5 rad/s to as many digits.
    const ASKED: f64 = 1e-9;
    let handles = Door::HANDLES;
    at_times(&Door::default(), method, 1.0, &[10.0], |_, sample| {
        for hinge in [handles.lower_hinge, handles.upper_hinge] {
            let error = difference(sample.angle(hinge) + FRAC_PI_2, PHI).abs();
            let rate = (sample.angle_rate(hinge) - RATE).abs();
            println!("{error:e} rad, {rate:e} rad/s");
            assert!(error <= ASKED && rate <= 2.5 * ASKED);
        }
    });
}

#[test]
fn it_swings_as_its_closed_form() {
    swings(StandardLagrange);
    swings(Baumgarte::default());
    swings(AugmentedLagrangian::default());
}

#[test]
fn it_returns_after_a_period() {
    // m, rad, m/s, rad/s; at rest, the acceleration is 3.2 rad/s^2.
    assert!(difference_after(&Door::default(), Door::PERIOD) <= 1e-9);
}

#[test]
fn the_energy_stays() {
    /// J, of 14 J that go to and fro.
    const ASKED: f64 = 1e-8;
    // The centre of mass is 1 m up the edge.
    let first = 20.0 * 9.81 * 10.0_f64.to_radians().cos();
    let model = Door::default();
    assert!(change_of_energy(&model, StandardLagrange, 10.0, first) <= ASKED);
    assert!(change_of_energy(&model, Baumgarte::default(), 10.0, first) <= ASKED);
}

#[test]
fn the_hinges_together_carry_the_leaf() {
    /// N, N m: round-off of 200 N.
    const ROUND_OFF: f64 = 1e-10;
    let handles = Door::HANDLES;
    Simulation::new(&Door::default(), StandardLagrange, Rk4::every(1e-3))
        .run(0.0..=0.0, every(1.0), |sample| {
            let on = |hinge| sample.reaction(hinge, handles.leaf).expect("solvable");
            let (lower, upper) = (on(handles.lower_hinge), on(handles.upper_hinge));
            let evaluation = sample.evaluation().expect("solvable");
            let acceleration = Door::velocity(&evaluation.rates, handles.leaf);
            let weight = Vector3::new(0.0, 0.0, -9.81 * 20.0);
            let rest: Vector3<f64> = lower.force + upper.force + weight - 20.0 * acceleration;
            assert!(rest.amax() <= ROUND_OFF, "{rest}");
            assert!(acceleration.norm() > 1.0, "it falls");
            ControlFlow::Continue(())
        })
        .expect("solvable");
}
