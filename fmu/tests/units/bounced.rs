//! Limits of joints and laws that switch: events of model exchange, and of co-simulation.

use crate::driven::ran;
use crate::unit::{Unit, attributes, elements, variable};
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::Fmu;

/// A slider between two stops, pushed by an input, and by a buffer that it meets on its way.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Stopped {
    #[param]
    bounce: f64,
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [3.0, 0.0, 0.0])]
    slider: Body,
    #[joint(
        between = [ground, slider],
        point = [0.0, 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        limits = [-1.0, 1.0],
        restitution = bounce
    )]
    rail: Prismatic,
    #[force(
        between = [ground, slider], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        force = push - 8.0 * max(0.0, length - 5.5)
    )]
    motor: Actuator,
}

fn stopped(bounce: f64, push: f64) -> Stopped {
    let mut stopped = Stopped::new(bounce).expect("finite");
    stopped.push = push;
    stopped
}

fn unit(mechanism: &Stopped, name: &str) -> Unit {
    let unit = Fmu::<_, Relative>::new(mechanism, StandardLagrange).named(name);
    Unit::of(unit.without_binary(), &format!("{name}.fmu"))
}

/// Time, displacement and rate after each step, and what was logged.
fn run(unit: &Unit, name: &str, kind: &str) -> (Vec<[f64; 3]>, String) {
    let arguments = ["100", "0.03", kind].map(str::to_owned);
    let driver = ("bouncing.c", include_str!("bouncing.c"));
    let (numbers, logged) = ran(unit, name, driver, &arguments);
    let (rows, _) = numbers.as_chunks::<3>();
    (rows.to_vec(), logged)
}

#[test]
fn a_joint_turns_back_at_its_limits() {
    let mechanism = stopped(0.95, -0.5);
    let unit = unit(&mechanism, "bounced");
    let mut stepper = mechanism.stepper(StandardLagrange, Rk4).expect("described");
    let mut state = stepper.initial_state().expect("described");
    let rail = Stopped::HANDLES.rail;
    let mut expected = Vec::new();
    for number in 1..=3000 {
        stepper.step(&mut state, 1e-3).expect("it bounces");
        if number % 30 == 0 {
            let bodies = stepper.bodies(&state);
            let view = stepper.view(&bodies);
            expected.push([view.displacement(rail), view.displacement_rate(rail)]);
        }
    }
    let turns = expected
        .windows(2)
        .filter(|pair| pair[0][1] * pair[1][1] < 0.0);
    let turns = turns.count();
    assert!(turns > 2, "{turns}");
    // The buffer is smooth in its two parts alone: steps of 30 ms that end where it begins are as
    // near as their method is, and those of co-simulation as short ones over the bend.
    for (kind, tolerance) in [("steps", 1e-6), ("exchange", 1e-5)] {
        let (rows, logged) = run(&unit, "bounced", kind);
        assert_eq!(rows.len(), expected.len(), "{kind}: {logged}");
        for ([time, found @ ..], expected) in rows.iter().zip(&expected) {
            for (found, expected) in found.iter().zip(expected) {
                let error = (found - expected).abs();
                assert!(
                    error < tolerance,
                    "{kind}, {time} s: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn a_unit_ends_where_a_joint_comes_to_rest_at_a_limit() {
    for kind in ["steps", "exchange"] {
        let rested = unit(&stopped(0.0, 20.0), "rested");
        let (rows, logged) = run(&rested, "rested", kind);
        ended(&rows, &logged, 0.36, [1e-7, 1e-3]);
        // After bounces, as long as these are longer than a step of the importer.
        let bounced = unit(&stopped(0.3, 20.0), "bounced_out");
        let (rows, logged) = run(&bounced, "bounced_out", kind);
        let is_located = kind == "steps";
        let tolerances = if is_located {
            [1e-7, 1e-3]
        } else {
            [5e-3, 0.5]
        };
        ended(&rows, &logged, 1.0, tolerances);
    }
}

#[test]
fn a_unit_ends_where_an_importer_does_not_resolve_a_bounce() {
    let bounced = unit(&stopped(0.3, 20.0), "unresolved");
    let (rows, logged) = run(&bounced, "unresolved", "idle");
    // While it leaves.
    ended(&rows, &logged, 0.36, [1e-7, 3.0]);
    let [_, _, rate] = *rows.last().expect("one");
    assert!(rate < -0.1, "{rate}");
}

/// A unit has ended at its upper limit, before a time (s), and has said so.
fn ended(rows: &[[f64; 3]], logged: &str, end: f64, [near, slow]: [f64; 2]) {
    let [time, place, rate] = *rows.last().expect("one");
    assert!(time < end && (place - 1.0).abs() < near, "{time} {place}");
    assert!(rate.abs() < slow, "{rate}");
    let is_named = logged.contains("comes to rest at a limit (rail_upper_gap is zero)");
    assert!(is_named, "{logged}");
}

#[test]
fn limits_and_switches_are_event_indicators() {
    let mechanism = stopped(0.5, 0.0);
    let unit = unit(&mechanism, "indicated");
    let document = unit.description();
    let indicators = elements(&document, "EventIndicator").into_iter();
    let references: Vec<_> = indicators.map(attributes).collect();
    let names = ["rail_lower_gap", "rail_upper_gap", "motor_switch"];
    let expected = names.map(|name| {
        let reference = variable(&document, name).attribute("valueReference");
        format!("valueReference={:?}", reference.expect("a number"))
    });
    assert_eq!(references, expected);
    // What is false unless it is said.
    let exchange = elements(&document, "ModelExchange");
    let completed = exchange[0].attribute("needsCompletedIntegratorStep");
    assert_eq!(completed, Some("true"));
    let gap = attributes(variable(&document, "rail_upper_gap"));
    assert!(
        gap.contains(r#"description="how far the displacement of rail is below its upper limit (m)" causality="local" variability="continuous" initial="calculated" unit="m""#),
        "{gap}"
    );
    let passed = Fmu::<_, Relative>::new(&mechanism, StandardLagrange).named("passed");
    let passed = Unit::of(passed.without_limits().without_binary(), "passed.fmu");
    let document = passed.description();
    assert_eq!(elements(&document, "EventIndicator").len(), 1);
}
