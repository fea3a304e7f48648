//! Kernels as calls of functions give what they give as they are.

use holonom_engine::model::Model;
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::symbolic::arena::{Arena, Expr, Input};
use holonom_engine::symbolic::equations::Kernel;
use holonom_engine::symbolic::evaluate::evaluate;
use holonom_engine::symbolic::repeated::{Leaf, Repeated};

use crate::common::{delivered, tokens};
use crate::library;

/// Numbers without a pattern, between -1 and 1: of which no two differ alike.
fn number(seed: usize) -> f64 {
    2.0 * (((seed + 1) as f64).sin() * 43_758.545).rem_euclid(1.0) - 1.0
}

/// A tree in which each body carries two others by hinges that are inclined against each other;
/// `mixed` with slides, balls and axes along coordinate axes among them.
fn tree(bodies: usize, mixed: bool) -> Model {
    let mut text = String::from(
        "#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"joints\")] struct Tree {",
    );
    for body in 0..bodies {
        let three = |k: usize| [0, 1, 2].map(|l| number(9 * body + 3 * k + l));
        let (position, point) = (three(0), three(1));
        let axis = if mixed && body % 5 == 3 {
            [0.0, 0.0, 1.0]
        } else {
            three(2)
        };
        let carrier = body.checked_sub(1).map(|body| format!("b{}", body / 2));
        let carrier = carrier.unwrap_or("ground".into());
        let joint = match body % 8 {
            2 if mixed => format!("point = {point:?}, axis = {axis:?})] j{body}: Prismatic"),
            6 if mixed => format!("point = {point:?})] j{body}: Spherical"),
            _ => format!("point = {point:?}, axis = {axis:?})] j{body}: Revolute"),
        };
        text += &format!(
            "#[body(mass = LOAD, inertia = [0.2, 0.3, 0.4], position = {position:?})] b{body}: Body,
            #[joint(between = [{carrier}, b{body}], {joint},"
        );
    }
    delivered(&tokens(&(text + "}")), library::definition)
}

fn input(input: Input) -> Option<f64> {
    Some(match input {
        Input::Coordinate(place) => number(place as usize),
        Input::Velocity(place) => number(1000 + place as usize),
        Input::Symbol(_) | Input::Varying(_) => 1.3,
        _ => 0.7,
    })
}

/// What a leaf is.
fn leaf(arena: &Arena, values: &[f64], leaf: Leaf) -> f64 {
    let signed = |value: f64, is_negative: bool| if is_negative { -value } else { value };
    let known = |expr: Expr| evaluate(arena, &[expr], input)[0].expect("a number");
    match leaf {
        Leaf::Value { place, is_negative } => signed(values[place], is_negative),
        Leaf::Input {
            input: of,
            is_negative,
        } => signed(input(of).expect("a number"), is_negative),
        Leaf::Literal(value) => value,
        Leaf::Earlier(expr) => known(expr),
    }
}

/// The results of a function.
fn called(repeated: &Repeated, shape: usize, arguments: &[f64]) -> Vec<f64> {
    let shape = &repeated.shapes[shape];
    assert_eq!(shape.arguments, arguments.len());
    let results = evaluate(&shape.arena, &shape.outputs, |input| match input {
        Input::Coordinate(place) => Some(arguments[place as usize]),
        other => panic!("{other:?} is no argument"),
    });
    results
        .into_iter()
        .map(|result| result.expect("a number"))
        .collect()
}

fn compare(name: &str, kernel: &Kernel, repeated: &Repeated) {
    let mut values = Vec::new();
    for (shape, arguments) in &repeated.calls {
        let arguments = arguments.iter();
        let arguments: Vec<f64> = { arguments }
            .map(|&argument| leaf(&kernel.arena, &values, argument))
            .collect();
        values.extend(called(repeated, *shape, &arguments));
    }
    assert_eq!(values.len(), repeated.values, "{name}");
    let wanted = evaluate(&kernel.arena, &kernel.outputs, input);
    assert_eq!(wanted.len(), repeated.outputs.len(), "{name}");
    for (k, (wanted, &output)) in wanted.into_iter().zip(&repeated.outputs).enumerate() {
        let wanted = wanted.expect("a number");
        let found = leaf(&kernel.arena, &values, output);
        assert!(
            (found - wanted).abs() <= 1e-12 * (1.0 + wanted.abs()),
            "{name}, output {k}: {found} instead of {wanted}"
        );
    }
}

#[test]
fn calls_give_what_the_kernel_does() {
    let are_repeated = [false, true].map(|mixed| by_joints(&tree(63, mixed)));
    assert_eq!(are_repeated[0], 3, "hinges are alike");
}

/// Compares kernels whose outputs come joint by joint; how many of them are worth it.
fn by_joints(model: &Model) -> usize {
    let kernels = Kernels::new(model);
    let layout = model.layout();
    let rows = model.joints.iter().zip(&layout.row);
    let rows: Vec<Vec<usize>> = rows
        .map(|(joint, &row)| (row..row + model.equations(joint)).collect())
        .collect();
    let class = |input: Input| match input {
        Input::Coordinate(place) => u64::from(place % 7),
        Input::Velocity(place) => 10 + u64::from(place % 6),
        _ => 20,
    };
    let kernels = [
        ("constraints", &kernels.constraints),
        ("constraint rates", &kernels.constraint_rates),
        ("gamma", &kernels.gamma),
    ];
    let repeated = kernels.into_iter().filter_map(|(name, kernel)| {
        let repeated = Repeated::new(kernel, rows.clone(), class)?;
        println!("{name}: {} functions", repeated.shapes.len());
        compare(name, kernel, &repeated);
        Some(())
    });
    repeated.count()
}

#[test]
fn angles_of_single_joints_are_called_one_by_one() {
    let model = tree(63, false);
    let kernels = Kernels::new(&model);
    let angles: Vec<&Kernel> = { kernels.readouts.angles.iter() }
        .map(|(_, kernel)| kernel)
        .collect();
    let class = |input: Input| match input {
        Input::Coordinate(place) => u64::from(place % 7),
        Input::Velocity(place) => 10 + u64::from(place % 6),
        _ => 20,
    };
    let repeated = Repeated::each(&angles, class).expect("it saves more than half");
    assert_eq!(repeated.calls.len(), angles.len());
    let mut outputs = repeated.outputs.iter();
    for (kernel, (shape, arguments)) in angles.iter().zip(&repeated.calls) {
        let arguments = arguments.iter();
        let arguments: Vec<f64> = { arguments }
            .map(|&argument| leaf(&kernel.arena, &[], argument))
            .collect();
        let values = called(&repeated, *shape, &arguments);
        for wanted in evaluate(&kernel.arena, &kernel.outputs, input) {
            let output = *outputs.next().expect("an output");
            let found = leaf(&kernel.arena, &values, output);
            assert!((found - wanted.expect("a number")).abs() < 1e-13);
        }
    }
}
