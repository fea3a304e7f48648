//! D01: the rod of chapter 15 against its closed form.

use holonom::prelude::*;
use holonom_models::RodPendulum;
use nalgebra::Vector3;

use super::{at_times, change_of_energy, difference, difference_after, tight};
use crate::pendulum::{SWINGS, angle, final_swing};

/// The force (N) of the hinge on the rod at these instants, along the rod towards the hinge and
/// across it in the direction of growing `phi`: closed forms as well.
const FORCES: [[f64; 2]; 3] = [
    [1.397_699_173_704_197, -17.227_600_661_249_58],
    [34.656_553_861_985_28, -16.875_412_913_594_165],
    [122.847_198_297_600_27, 12.068_591_148_374_754],
];

/// Angle, rate and reaction of the pendulum at 1, 5 and 10 s.
fn swings<F: Formulation<f64>>(method: F) {
    /// rad; a rate of 5 rad/s and forces of 170 N to as many digits.
    const ASKED: f64 = 1e-9;
    let handles = RodPendulum::HANDLES;
    let times = SWINGS.map(|swing| swing.time);
    at_times(
        &RodPendulum::default(),
        method,
        1.0,
        &times,
        |place, sample| {
            let (swing, [radial, transverse]) = (SWINGS[place], FORCES[place]);
            let error = difference(angle(sample, handles.pivot), swing.angle).abs();
            let rate = (sample.angle_rate(handles.pivot) - swing.rate).abs();
            let (sine, cosine) = swing.angle.sin_cos();
            let towards_the_hinge = Vector3::new(0.0, -sine, cosine);
            let across = Vector3::new(0.0, cosine, sine);
            let wrench = sample
                .reaction(handles.pivot, handles.rod)
                .expect("solvable");
            let radial = (wrench.force.dot(&towards_the_hinge) - radial).abs();
            let transverse = (wrench.force.dot(&across) - transverse).abs();
            println!("{error:e} rad, {rate:e} rad/s, {radial:e} N, {transverse:e} N");
            assert!(error <= ASKED && rate <= 5.0 * ASKED);
            assert!(radial <= 170.0 * ASKED && transverse <= 170.0 * ASKED);
            // The plane of the motion has no force across it, the hinge turns freely.
            assert!(wrench.force.x.abs() <= ASKED && wrench.moment.amax() <= ASKED);
        },
    );
}

#[test]
fn it_swings_as_its_closed_form() {
    swings(StandardLagrange);
    swings(Baumgarte::default());
    swings(AugmentedLagrangian::default());
}

#[test]
fn it_returns_after_a_period() {
    // m, rad, m/s, rad/s; at rest, the acceleration is 14.7 rad/s^2.
    assert!(difference_after(&RodPendulum::default(), RodPendulum::PERIOD) <= 1e-9);
}

#[test]
fn the_energy_stays() {
    /// Of 34 J that go to and fro.
    const ASKED: f64 = 3e-8;
    let model = RodPendulum::default();
    assert!(change_of_energy(&model, StandardLagrange, 10.0, 0.0) <= ASKED);
    assert!(change_of_energy(&model, Baumgarte::default(), 10.0, 0.0) <= ASKED);
}

#[test]
fn the_penalty_has_its_own_bias() {
    /// Of the angle at 10 s with the coefficients of chapter 15, and to how much of it.
    const BIAS: f64 = -3.4e-5;
    const PART: f64 = 0.02;
    let swing = SWINGS[2];
    let bias_of = |method| {
        let [reached, _] = final_swing(method, tight(), swing.time);
        reached - swing.angle
    };
    let bias = bias_of(Penalty::default());
    println!("bias {bias:e} rad");
    assert!((bias - BIAS).abs() <= PART * BIAS.abs());
    // It is of the penalty, not of the integration: it shrinks with alpha.
    let less = bias_of(Penalty::new(1e8, 10.0, 1.0));
    println!("bias {less:e} rad at ten times alpha");
    assert!((less / bias - 0.1).abs() <= PART);
}
