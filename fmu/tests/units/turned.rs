//! Start values of angles over a turn, and what counts turns along with them.

use std::f64::consts::TAU;

use crate::driven::ran;
use crate::unit::{Unit, variable};
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::Fmu;
use holonom_models::VariableLengthPendulum;

/// The angle of the pin 0.1 s after a start at rest from another one.
fn after(start: f64) -> f64 {
    let pendulum = VariableLengthPendulum::default();
    let pin = VariableLengthPendulum::HANDLES.pin;
    let stepper = pendulum.stepper(StandardLagrange, Rk4).expect("described");
    let mut stepper = stepper.joint_coordinates();
    let mut bodies = pendulum.described_state::<f64>().expect("described");
    pendulum
        .set_angle(&mut bodies, pin, start)
        .expect("it turns");
    let mut state = stepper.state_of(&bodies).expect("a state");
    for _ in 0..100 {
        stepper.step(&mut state, 1e-3).expect("a step");
    }
    let angle = stepper.view(&stepper.bodies(&state)).angle(pin);
    angle + TAU * ((start - angle) / TAU).round()
}

#[test]
fn what_counts_turns_follows_the_start_value_of_an_angle() {
    let pendulum = VariableLengthPendulum::default();
    let unit = Fmu::<_, Relative>::new(&pendulum, StandardLagrange).named("turned_pendulum");
    let unit = Unit::of(unit.without_binary(), "turned_pendulum.fmu");
    let document = unit.description();
    let reference = |name: &str| {
        let reference = variable(&document, name).attribute("valueReference");
        reference.expect("a number").to_owned()
    };
    let start: f64 = 7.0;
    let arguments = [
        reference("pin_angle"),
        reference("torsion_turned"),
        format!("{start:?}"),
        format!("{:?}", start - TAU),
    ];
    let driver = ("turned.c", include_str!("turned.c"));
    let (numbers, _) = ran(&unit, "turned_pendulum", driver, &arguments);
    // A count that is set a turn lower leaves the spring less wound.
    let (followed, set) = (after(start), after(start - TAU));
    assert!((followed - set - TAU).abs() > 0.1, "{followed} {set}");
    let expected = [start, followed, followed, start - TAU, set + TAU, set];
    assert_eq!(numbers.len(), expected.len());
    for (found, expected) in numbers.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-11, "{found} for {expected}");
    }
}
