//! Inverse dynamics: the moment that drives the slider-crank against its closed form.

use holonom::prelude::*;
use holonom_models::DrivenSliderCrank;

use super::{at_times, difference, simpson, tight};

/// Angle (rad) of the crank, its first and its second derivative.
fn law(time: f64) -> [f64; 3] {
    let (sine, cosine) = (75.0 * time).sin_cos();
    [
        150.0 * time + 0.2 * (1.0 - cosine),
        150.0 + 15.0 * sine,
        1125.0 * cosine,
    ]
}

/// The moment of the motor (N m): with lengths `r` and `l` of crank and rod, and `beta` the angle
/// of the rod, `r sin(theta) + l sin(beta) = 0`, all velocities are `theta'` times functions of
/// `theta`. The power of the moment is that of the inertia and of gravity.
fn moment(time: f64) -> f64 {
    const R: f64 = 0.153;
    const L: f64 = 0.306;
    const GRAVITY: f64 = 9.81;
    const CRANK: [f64; 2] = [0.038, 7.4e-5];
    const ROD: [f64; 2] = [0.038, 5.9e-4];
    const SLIDER: f64 = 0.076;
    let [theta, rate, acceleration] = law(time);
    let (sine, cosine) = theta.sin_cos();
    let sine_of_rod = -R / L * sine;
    let cosine_of_rod = (1.0 - sine_of_rod * sine_of_rod).sqrt();
    // beta' = b theta', and db = db/dtheta.
    let b = -R / L * cosine / cosine_of_rod;
    let db = (R / L * sine + b * b * sine_of_rod) / cosine_of_rod;
    // The centre of the rod: x = r cos(theta) + l/2 cos(beta), y = r sin(theta) + l/2 sin(beta);
    // first and second derivatives by theta.
    let x = -R * sine - L / 2.0 * sine_of_rod * b;
    let dx = -R * cosine - L / 2.0 * (cosine_of_rod * b * b + sine_of_rod * db);
    let y = R * cosine + L / 2.0 * cosine_of_rod * b;
    let dy = -R * sine - L / 2.0 * (sine_of_rod * b * b - cosine_of_rod * db);
    // The slider: x = r cos(theta) + l cos(beta).
    let s = -R * sine - L * sine_of_rod * b;
    let ds = -R * cosine - L * (cosine_of_rod * b * b + sine_of_rod * db);
    let inertia = CRANK[1]
        + CRANK[0] * R * R / 4.0
        + ROD[1] * b * b
        + ROD[0] * (x * x + y * y)
        + SLIDER * s * s;
    let half_of_its_derivative = ROD[1] * b * db + ROD[0] * (x * dx + y * dy) + SLIDER * s * ds;
    let weight = GRAVITY * (CRANK[0] * R / 2.0 * cosine + ROD[0] * y);
    inertia * acceleration + half_of_its_derivative * rate * rate + weight
}

/// rad; 165 rad/s and 50 N m to as many digits.
const ASKED: f64 = 1e-9;

/// What the angle and the rate of the crank and the moment of the motor are off by.
fn errors(sample: &Sample<'_, f64, DrivenSliderCrank>) -> [f64; 3] {
    let handles = DrivenSliderCrank::HANDLES;
    let [angle, rate, _] = law(sample.time());
    let effort = sample.driving_effort(handles.motor).expect("solvable");
    // The same as what the motor exerts on the crank.
    let wrench = sample
        .reaction(handles.motor, handles.crank)
        .expect("solvable");
    assert!((wrench.moment.z - effort).abs() <= 50.0 * ASKED);
    [
        difference(sample.angle(handles.bearing), angle).abs(),
        (sample.angle_rate(handles.bearing) - rate).abs(),
        (effort - moment(sample.time())).abs(),
    ]
}

fn judge([angle, rate, moment]: [f64; 3]) {
    println!("{angle:e} rad, {rate:e} rad/s, {moment:e} N m");
    assert!(angle <= ASKED && rate <= 165.0 * ASKED && moment <= 50.0 * ASKED);
}

/// By integration of the motion that the driver prescribes.
fn drives<F: Formulation<f64>>(method: F) {
    let times: Vec<f64> = (1..=20).map(|k| 0.01 * f64::from(k)).collect();
    let model = DrivenSliderCrank::default();
    let mut worst = [0.0_f64; 3];
    at_times(&model, method, 0.01, &times, |_, sample| {
        for (worst, error) in worst.iter_mut().zip(errors(sample)) {
            *worst = worst.max(error);
        }
    });
    judge(worst);
}

#[test]
fn the_moment_of_the_motor_is_that_of_the_closed_form() {
    drives(StandardLagrange);
    drives(Baumgarte::default());
    drives(AugmentedLagrangian::default());
}

#[test]
fn so_it_is_by_kinematics_without_integration() {
    let mut worst = [0.0_f64; 3];
    // The crank turns by 0.3 rad from time to time.
    let report = KinematicAnalysis::new(&DrivenSliderCrank::default(), StandardLagrange)
        .run(0.0..=0.2, every(2e-3), |sample| {
            for (worst, error) in worst.iter_mut().zip(errors(sample)) {
                *worst = worst.max(error);
            }
            ControlFlow::Continue(())
        })
        .expect("driven");
    println!("{} poses, {} steps", report.poses, report.iterations);
    assert!(report.poses > 100);
    judge(worst);
}

#[test]
fn the_work_of_the_motor_is_what_the_energy_gains() {
    const STEP: f64 = 2.5e-5;
    /// J, of 4.6 J.
    const ASKED: f64 = 1e-8;
    let handles = DrivenSliderCrank::HANDLES;
    let (mut power, mut energy) = (Vec::new(), Vec::new());
    Simulation::new(&DrivenSliderCrank::default(), StandardLagrange, tight())
        .run(0.0..=0.1, every(STEP), |sample| {
            let effort = sample.driving_effort(handles.motor).expect("solvable");
            power.push(effort * sample.angle_rate(handles.bearing));
            energy.push(sample.energy());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    let gained = energy[energy.len() - 1] - energy[0];
    let work = simpson(STEP, &power);
    println!("gained {gained} J, work {work} J");
    assert!((gained - work).abs() <= ASKED);
    assert!(gained > 1.0, "nothing is gained");
}
