//! The files in C, with every warning, driven by a program that was linked with them.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::unit::{Unit, path, variable};
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_fmu::Fmu;
use holonom_models::{CartPole, FourBar};

/// Warnings that the files must not have.
const STRICT: &[&str] = &[
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wdouble-promotion",
    "-pedantic",
    "-Werror",
    "-ffp-contract=off",
    "-fsanitize=undefined",
    "-fno-sanitize-recover",
    "-O1",
];

/// Compiles the files of a unit with a driver.
fn driver(unit: &Unit, name: &str, (file, text): (&str, &str)) -> PathBuf {
    let folder = path(name);
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join(file), text).expect("a file is written");
    let mut sources = vec![file.to_owned()];
    for (file, bytes) in &unit.files {
        if let Some(file) = file.strip_prefix("sources/") {
            fs::write(folder.join(file), bytes).expect("a file is written");
            if file.ends_with(".c") {
                sources.push(file.to_owned());
            }
        }
    }
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let mut command = Command::new(&compiler);
    command.current_dir(&folder).args(STRICT).args(sources);
    let done = command.args(["-o", "driver", "-lm"]).output();
    let done = done.expect("there is a compiler of C");
    let message = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{compiler}: {message}");
    folder.join("driver")
}

/// What a driver writes that is given the token of a unit and further arguments, and what is
/// logged.
pub(crate) fn ran(
    unit: &Unit,
    name: &str,
    of: (&str, &str),
    arguments: &[String],
) -> (Vec<f64>, String) {
    let document = unit.description();
    let token = document.root_element().attribute("instantiationToken");
    let mut command = Command::new(driver(unit, name, of));
    command.arg(token.expect("a token"));
    let output = command.args(arguments).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {message}");
    let (numbers, _) = output.stdout.as_chunks::<8>();
    let numbers = numbers.iter().map(|bytes| f64::from_ne_bytes(*bytes));
    (numbers.collect(), message.into_owned())
}

/// The numbers that a unit has after some steps: states, then their derivatives.
fn driven(unit: &Unit, name: &str, steps: u32, step: f64) -> Vec<f64> {
    let driver = ("driver.c", include_str!("driver.c"));
    let (numbers, _) = ran(
        unit,
        name,
        driver,
        &[steps.to_string(), format!("{step:?}")],
    );
    numbers
}

fn near(found: f64, expected: f64, what: &str) {
    let is_near = (found - expected).abs() < 1e-12 * (1.0 + expected.abs());
    assert!(is_near, "{what}: {found} for {expected}");
}

#[test]
fn co_simulation_takes_the_steps_of_a_stepper() {
    let mut cart = CartPole::default();
    cart.push = 3.0;
    let unit = Fmu::<CartPole, Relative>::new(&cart, StandardLagrange);
    let unit = Unit::of(
        unit.named("cart_of_steps").internal_step(0.004),
        "cart_of_steps.fmu",
    );
    // Communication steps of 10 ms are three internal ones.
    let numbers = driven(&unit, "cart_of_steps", 600, 0.01);
    let stepper = cart.stepper(StandardLagrange, Rk4).expect("described");
    let mut stepper = stepper.joint_coordinates();
    let mut state = stepper.initial_state().expect("described");
    let report = &CartPole::JOINT_REPORT;
    let of = |joint: &str| report.motions_of(joint).next().expect("a motion");
    let (rail, hinge) = (of("rail"), of("hinge"));
    let mut angle = 0.0;
    for _ in 0..1800 {
        stepper.step(&mut state, 0.01 / 3.0).expect("a step");
        let wrapped: f64 = report.coordinate(hinge, &state).expect("a turn");
        angle = wrapped + TAU * ((angle - wrapped) / TAU).round();
    }
    // The pole goes through where its angle jumps, if it is not counted over all turns.
    assert!(angle.abs() > PI, "{angle}");
    let hinge_rate = report.rate(hinge, &state).expect("a turn");
    let expected = [
        ("hinge_angle", angle),
        (
            "rail_position",
            report.coordinate(rail, &state).expect("a slide"),
        ),
        ("rail_rate", report.rate(rail, &state).expect("a slide")),
        ("hinge_rate", hinge_rate),
    ];
    let document = unit.description();
    let place = |name: &str| -> usize {
        let reference = variable(&document, name).attribute("valueReference");
        reference
            .and_then(|text| text.parse().ok())
            .expect("a number")
    };
    for (name, expected) in expected {
        near(numbers[place(name) - 1], expected, name);
    }
    let derivative = numbers[place("der(hinge_angle)") - 1];
    near(derivative, hinge_rate, "derivative of the angle");
}

#[test]
fn a_closed_loop_is_driven_too() {
    let bars = FourBar::default();
    let unit = Fmu::<FourBar, Relative>::new(&bars, Baumgarte::default());
    let unit = Unit::of(unit.named("driven_bars"), "driven_bars.fmu");
    let numbers = driven(&unit, "driven_bars", 50, 0.01);
    let (states, derivatives) = numbers.split_at(numbers.len() / 2);
    // Angles first, and as many rates, each of which is the derivative of its angle.
    let (angles, rates) = states.split_at(states.len() / 2);
    assert_eq!(derivatives[..angles.len()], *rates);
}
