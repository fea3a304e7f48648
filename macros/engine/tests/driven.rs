//! Chains whose hinges and slides are driven, in joint coordinates: what the kernels record of
//! their pivots must not depend on which numbers the macro can see.

mod common;
#[allow(dead_code, reason = "other tests need all of it")]
#[path = "mechanisms/library.rs"]
mod library;

use common::{delivered, tokens};
use holonom_engine::coordinates::kernels::JointKernels;
use holonom_engine::model::Model;
use holonom_engine::symbolic::arena::{Input, Stage};
use holonom_engine::symbolic::count::count;
use holonom_engine::symbolic::evaluate::evaluate;

fn model(item: &str) -> Model {
    delivered(&tokens(item), |name| {
        library::definition(name).map(|(kind, text)| (kind, tokens(&text)))
    })
}

/// A chain of hinges about coordinate axes, each `length` behind the last, driven by `law`.
fn chain(axes: &str, driven: &[usize], fields: &str, length: &str, law: &str) -> String {
    let mut text = format!("#[mechanism(gravity = [0.0, 0.0, -9.81])] struct Chain {{ {fields}");
    let mut carrier = String::from("ground");
    for (place, axis) in axes.chars().enumerate() {
        let axis = match axis {
            'X' => "[1.0, 0.0, 0.0]",
            'Y' => "[0.0, 1.0, 0.0]",
            'S' => "[0.48, 0.6, 0.64]",
            _ => "[0.0, 0.0, 1.0]",
        };
        text += &format!(
            "#[body(mass = 1.5, inertia = [0.2, 0.3, 0.25], position = [0.1, {place}.5 * {length}, 0.2])] b{place}: Body,
            #[joint(between = [{carrier}, b{place}], point = [0.0, {place}.0 * {length}, 0.0], axis = {axis})] h{place}: Revolute,"
        );
        if driven.contains(&place) {
            text += &format!(
                "#[joint(between = [{carrier}, b{place}], axis = {axis}, motion = {law})] d{place}: AngleDriver,"
            );
        }
        carrier = format!("b{place}");
    }
    text + "}"
}

/// The smallest relative pivot that the evaluation without stabilisation records, at some states.
fn smallest_pivot(model: &Model) -> f64 {
    let kernels = JointKernels::new(model);
    let kernel = &kernels.evaluations[0].kernel;
    let first = kernels.turns + kernels.rest + kernels.velocities + kernels.rows.len();
    let number =
        |place: u32, seed: usize| (f64::from(place + 1) * 0.618 + 0.37 * seed as f64).fract();
    let mut smallest = 1.0_f64;
    for seed in 0..4 {
        let values = evaluate(&kernel.arena, &kernel.outputs, |input| match input {
            Input::Coordinate(place) if (place as usize) < 2 * kernels.turns => {
                let (sine, cosine) = (6.0 * number(place / 2, seed)).sin_cos();
                Some(if place % 2 == 0 { cosine } else { sine })
            }
            Input::Coordinate(place) | Input::Velocity(place) => Some(number(place, seed)),
            Input::Symbol(place) | Input::Varying(place) => Some(0.5 + number(place, seed)),
            Input::Time => Some(0.3),
            _ => None,
        });
        for value in &values[first..] {
            let value = value.expect("all inputs are known").abs();
            smallest = if value < smallest || value.is_nan() {
                value
            } else {
                smallest
            };
        }
    }
    smallest
}

#[test]
fn driven_hinges_have_pivots_that_stand_out() {
    let numbers = [
        ("", "1.0", "1.0 * time"),
        ("#[param] rate: f64,", "1.0", "rate * time"),
        ("#[param] size: f64,", "size", "1.0 * time"),
        ("", "1.0", "RATE * time"),
        ("", "SIZES[1]", "RATES[2] * time"),
        ("#[input] rate: f64,", "1.0", "0.3 * time"),
    ];
    let mut wrong = Vec::new();
    for axes in ["X", "XX", "XZ", "XXX", "XZX", "ZXX", "XZXZ", "SXS"] {
        let all: Vec<usize> = (0..axes.len()).collect();
        for driven in [&all[..], &[0], &[axes.len() - 1]] {
            for (fields, length, law) in numbers {
                let text = chain(axes, driven, fields, length, law);
                let smallest = smallest_pivot(&model(&text));
                if smallest.is_nan() || smallest <= 1e-4 {
                    wrong.push(format!(
                        "{axes} {driven:?} {fields} {length} {law}: {smallest:e}"
                    ));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} pivots that vanish: {wrong:#?}",
        wrong.len()
    );
}

/// What the literals of a text take, and how many pivots are recorded.
fn cost(text: &str) -> (usize, usize) {
    let kernels = JointKernels::new(&model(text));
    let evaluation = &kernels.evaluations[0];
    let kernel = &evaluation.kernel;
    let operations = count(&kernel.arena, &kernel.outputs, Stage::State).total();
    (operations, evaluation.checks.len())
}

#[test]
fn laws_of_parameters_take_what_laws_of_numbers_take() {
    for axes in ["X", "XX", "XZ", "XZX", "XXX", "XZXZ"] {
        let all: Vec<usize> = (0..axes.len()).collect();
        for driven in [&all[..], &[0]] {
            let (literal, parameter) = (
                cost(&chain(axes, driven, "", "1.0", "1.5 * time")),
                cost(&chain(
                    axes,
                    driven,
                    "#[param] rate: f64,",
                    "1.0",
                    "rate * time",
                )),
            );
            assert!(
                parameter.0 <= literal.0 && parameter.1 == 0,
                "{axes} {driven:?}: {parameter:?}, by numbers {literal:?}"
            );
        }
    }
}
