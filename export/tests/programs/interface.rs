//! What a program is given and gives, by name, and derivatives of what it reads.

use std::process::Command;

use crate::compiled::Program;
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::{Double, Export, Quantity};
use holonom_models::{CartPole, FourBar};

fn names(quantities: &[Quantity]) -> Vec<&str> {
    let names = quantities.iter().map(|quantity| quantity.name.as_str());
    names.collect()
}

#[test]
fn members_and_readings_have_names_and_starts() {
    let mut cart = CartPole::default();
    cart.push = 2.5;
    let export = Export::<CartPole, Double, Relative>::new(&cart, StandardLagrange);
    let export = export.reading("x", "of the pole (m)", |view| {
        view.position(CartPole::HANDLES.pole).x
    });
    let export = export.about("push", "force on the cart (N)");
    let interface = export.interface();
    let header = export.c().expect("sound").header;
    let member = "cart_pole_real push; /* force on the cart (N) */";
    assert!(header.contains(member), "{header}");
    assert_eq!(interface.name, "cart_pole");
    assert_eq!(interface.parameters, []);
    assert_eq!(names(&interface.inputs), ["push"]);
    assert_eq!(interface.inputs[0].start, [2.5]);
    assert_eq!(interface.inputs[0].about, "force on the cart (N)");
    assert_eq!(names(&interface.readings), ["x"]);
    assert_eq!(interface.readings[0].about, "of the pole (m)");
    let states = interface.states.iter().map(|state| state.quantity.clone());
    let states: Vec<Quantity> = states.collect();
    let expected = ["hinge_angle", "rail_position", "rail_rate", "hinge_rate"];
    let mut sorted = [names(&states), expected.to_vec()];
    sorted.iter_mut().for_each(|names| names.sort_unstable());
    assert_eq!(sorted[0], sorted[1]);
    // Zero in the described configuration, although the pole leans there.
    assert!(
        states.iter().all(|state| state.start == [0.0]),
        "{states:?}"
    );
    let angles = interface.states.iter().filter(|state| state.is_angle);
    assert_eq!(angles.count(), 1);
}

/// Macros of the compiler and of headers that are included beside a program, as the compiler lists
/// them. Those that begin with an underscore are no names of fields, and a function needs brackets.
fn macros() -> Vec<String> {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let mut command = Command::new(compiler);
    for header in ["math.h", "stdio.h", "stdlib.h", "stdint.h"] {
        command.args(["-include", header]);
    }
    let listed = command.args(["-std=gnu11", "-dM", "-E", "-x", "c", "/dev/null"]);
    let listed = listed.output().expect("there is a compiler of C");
    let text = String::from_utf8(listed.stdout).expect("a text");
    let names = text.lines().filter_map(|line| line.split(' ').nth(1));
    let names = names.filter(|name| !name.starts_with('_') && !name.contains('('));
    names.map(str::to_owned).collect()
}

#[test]
fn no_name_is_a_macro_or_a_word_of_c() {
    let mut taken = macros();
    let known = [
        "M_PI",
        "M_SQRT1_2",
        "FP_NAN",
        "EOF",
        "NULL",
        "NAN",
        "HUGE_VAL",
    ];
    assert!(
        known.iter().all(|name| taken.iter().any(|of| of == name)),
        "{taken:?}"
    );
    taken.extend(["typeof", "typeof_unqual", "constexpr", "nullptr"].map(str::to_owned));
    let mut export =
        Export::<CartPole, Double, Relative>::new(&CartPole::default(), StandardLagrange);
    for name in &taken {
        export = export.reading(name, "", |view| view.position(CartPole::HANDLES.pole).x);
    }
    // Fields that are like macros keep their names.
    for name in ["M_body", "M", "FP", "MAX", "INTAKE", "spring_MAX"] {
        export = export.reading(name, "", |view| view.position(CartPole::HANDLES.pole).x);
        taken.push(name.to_owned());
    }
    let readings = export.interface().readings;
    let (reserved, free) = taken.split_at(taken.len() - 6);
    for (found, name) in names(&readings).into_iter().zip(reserved) {
        assert_eq!(found, format!("{name}_"));
    }
    assert_eq!(names(&readings)[reserved.len()..], *free);
}

/// What a state has is the sum of what the joints of a run of parallel axes have.
#[test]
fn sums_are_taken_apart() {
    let bars = FourBar::default();
    let export = Export::<FourBar, Double, Relative>::new(&bars, StandardLagrange);
    let states = export.interface().states;
    let handles = FourBar::HANDLES;
    let stepper = bars.stepper(StandardLagrange, Rk4).expect("described");
    let stepper = stepper.joint_coordinates();
    let start = stepper.initial_state().expect("described");
    let bodies = stepper.bodies(&start);
    let view = stepper.view(&bodies);
    assert!(states.iter().any(|state| state.against.is_some()));
    let expected = [
        ("left_foot_rate", view.angle_rate(handles.left_foot)),
        ("left_pin_rate", view.angle_rate(handles.left_pin)),
        ("right_foot_rate", view.angle_rate(handles.right_foot)),
    ];
    let mut found = 0;
    for (name, rate) in expected {
        let state = states.iter().find(|state| state.quantity.name == name);
        let Some(state) = state else { continue };
        let difference = state.quantity.start[0] - rate;
        assert!(difference.abs() < 1e-14, "{name}: {state:?} for {rate}");
        found += 1;
    }
    assert!(found > 1, "{states:?}");
}

#[test]
fn readings_have_exact_derivatives() {
    let (cart, pole) = (CartPole::default(), CartPole::HANDLES.pole);
    let source = Export::<CartPole, Double, Relative>::new(&cart, StandardLagrange)
        .named("cart_readings")
        .reading("x", "m", |view| view.position(pole).x)
        .reading("y", "m", |view| view.position(pole).y)
        .reading_derivatives()
        .c()
        .expect("exported");
    let main = "\
#include \"cart_readings.h\"
#include <stdio.h>

int main(void)
{
    cart_readings_state state;
    cart_readings_inputs inputs;
    cart_readings_sensitivities all;
    cart_readings_init(&state);
    cart_readings_default_inputs(&inputs);
    cart_readings_reading_derivatives(&inputs, &state, &all);
    fwrite(&all, sizeof all, 1, stdout);
    return 0;
}
";
    let derivatives = Program::compiled(&source, main).run::<f64>(&[]);
    // The pole leans by 0.1 rad and has its centre of mass at 0.5 m. By angle, displacement, two
    // rates and the push; the angle may be counted against that of the joint.
    let (by_x, by_y) = derivatives.split_at(5);
    let sign = by_x[0].signum();
    let expected = [0.5 * 0.1_f64.cos(), -0.5 * 0.1_f64.sin()];
    for (found, expected) in [by_x[0], by_y[0]].into_iter().zip(expected) {
        assert!(
            (sign * found - expected).abs() < 1e-15,
            "{found} for {expected}"
        );
    }
    assert_eq!(by_x[1..], [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(by_y[1..], [0.0; 4]);
}
