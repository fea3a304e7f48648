//! Derivatives of runs by parameters and starts of states.

use holonom::Forward;
use holonom::prelude::*;

use crate::{Fan, L, tight};

const R: f64 = 0.5;
const END: f64 = 0.02;

#[test]
fn derivatives_by_a_parameter_are_those_of_the_closed_form() {
    let fan = Fan::of(R);
    let h = Fan::HANDLES;
    let mut found = [0.0; 2];
    fan.sensitivities([h.resistance])
        .expect("sound parameters")
        .simulation(StandardLagrange, tight())
        .run(0.0..=END, every(END), |sample| {
            let [current] = sample.state_value(h.current).derivatives();
            let [speed] = sample.angle_rate(h.bearing).derivatives();
            found = [current, speed];
        })
        .expect("it runs");
    // Richardson's extrapolation of central differences of the closed form.
    let central = |step: f64| {
        let [above, below] = [R + step, R - step].map(|r| Fan::closed_form(r, END));
        [0, 1].map(|k| (above[k] - below[k]) / (2.0 * step))
    };
    let (coarse, fine) = (central(2e-3), central(1e-3));
    for (k, found) in found.into_iter().enumerate() {
        let expected = (4.0 * fine[k] - coarse[k]) / 3.0;
        assert!(
            (found - expected).abs() < 1e-8 * expected.abs(),
            "{found} and {expected}"
        );
    }
}

#[test]
fn derivatives_by_a_start_are_those_of_the_linear_system() {
    let fan = Fan::of(R);
    let h = Fan::HANDLES;
    let mut found = [0.0; 2];
    fan.sensitivities([h.current.start()])
        .expect("sound parameters")
        .simulation(StandardLagrange, tight())
        .run(0.0..=END, every(END), |sample| {
            let [current] = sample.state_value(h.current).derivatives();
            let [speed] = sample.angle_rate(h.bearing).derivatives();
            found = [current, speed];
        })
        .expect("it runs");
    // A jump of the current by 1 A is what a pulse of L volt seconds does. That is the derivative
    // of the answer to a step of the voltage, over 12 V and times L.
    let step = 1e-5;
    let slope = |time: f64| {
        let [a, b] = [time + step, time - step].map(|time| Fan::closed_form(R, time));
        [0, 1].map(|k| (a[k] - b[k]) / (2.0 * step) * L / crate::VOLTAGE)
    };
    for (found, expected) in found.into_iter().zip(slope(END)) {
        assert!(
            (found - expected).abs() < 1e-5 * expected.abs(),
            "{found} and {expected}"
        );
    }
}

#[test]
fn a_start_in_chosen_coordinates_has_the_same_derivative() {
    let fan = Fan::of(R);
    let h = Fan::HANDLES;
    let mut ends = [[0.0_f64; 2]; 2];
    let [plain, chosen] = &mut ends;
    let read = |sample: &Sample<'_, Forward<f64, 1>, Fan>| {
        let [current] = sample.state_value(h.current).derivatives();
        let [speed] = sample.angle_rate(h.bearing).derivatives();
        [current, speed]
    };
    fan.sensitivities([h.current.start()])
        .expect("sound parameters")
        .simulation(StandardLagrange, Rk4::every(1e-4))
        .run(0.0..=END, every(END), |sample| *plain = read(sample))
        .expect("it runs");
    let space = fan.coordinates([h.bearing]).expect("one coordinate");
    let start = space.state([0.0], [0.0]).expect("it is free");
    space
        .sensitivities(&start, [h.current.start().into()])
        .expect("a direction")
        .simulation(StandardLagrange, Rk4::every(1e-4))
        .run(0.0..=END, every(END), |sample| *chosen = read(sample))
        .expect("it runs");
    let [plain, chosen] = ends;
    for (plain, chosen) in plain.into_iter().zip(chosen) {
        assert!(plain.abs() > 1e-3 && (plain - chosen).abs() < 1e-12 * plain.abs());
    }
}
