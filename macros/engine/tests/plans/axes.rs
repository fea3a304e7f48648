//! The normals of an axis that is given by body are right-handed with that body's own axis.

use holonom_engine::model::ElementKind;
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::symbolic::arena::Arena;
use holonom_engine::symbolic::fixed::copies;
use proc_macro2::TokenStream;

use crate::common::{delivered, tokens};
use crate::dense::{Dice, State};
use crate::library;

fn find(name: &str) -> Option<(ElementKind, TokenStream)> {
    let text = match name {
        "Back" => "Back(i, j; axis: Axis) { dot(j.axis.normals(), i.axis); angle about axis; }",
        other => return library::definition(other),
    };
    Some((ElementKind::Joint, tokens(text)))
}

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| a[k] * b[l] - a[l] * b[k])
}

/// Two bodies in the axes of the ground, and a joint with a local axis on either.
fn scene(joint: &str, [a, b]: [Vector; 2]) -> String {
    format!(
        "#[mechanism(redundant = \"keep\")] struct Case {{
            #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15])] one: Body,
            #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15])] two: Body,
            #[joint(between = [one, two], axis = local({a:?}, {b:?}))] joint: {joint},
        }}"
    )
}

fn unit(dice: &mut Dice) -> Vector {
    let v = [0; 3].map(|_| dice.number());
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

#[test]
fn every_body_has_a_right_handed_frame_with_its_own_axis() {
    let mut dice = Dice::new(2);
    let mut pairs: Vec<[Vector; 2]> = (0..40)
        .map(|_| [unit(&mut dice), unit(&mut dice)])
        .collect();
    let x = [1.0, 0.0, 0.0];
    pairs.extend([
        [x, x],
        [x, [-1.0, 0.0, 0.0]],
        [x, [-1.0, 1e-9, 0.0]],
        [x, [0.0, 0.0, 2.0]],
    ]);
    for axes in pairs {
        let model = delivered(&tokens(&scene("Back", axes)), find);
        let mut arena = Arena::new();
        let copies = copies(&mut arena, &model, &model.joints[0], 0);
        for (axis, normals) in copies.vector.iter().zip(&copies.normals) {
            let number = |x| arena.literal(x).expect("folds");
            let [a, n, b] = [*axis, normals[0], normals[1]].map(|v| v.map(number));
            let third = cross(a, n);
            let errors = [
                dot(n, n) - 1.0,
                dot(a, n),
                third[0] - b[0],
                third[1] - b[1],
                third[2] - b[2],
            ];
            assert!(
                errors.iter().all(|x| x.abs() < 4e-15),
                "{axes:?}: {errors:?}"
            );
        }
    }
}

#[test]
fn equations_see_the_axis_of_the_second_body() {
    let axes = [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8]];
    let model = delivered(&tokens(&scene("Back", axes)), find);
    let kernels = Kernels::new(&model);
    let state = State::described(&model, &kernels);
    let violation = state.of(&kernels.constraints);
    let sine = violation.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((sine - 0.6).abs() < 1e-15, "{violation:?}");
}

#[test]
fn an_angle_is_zero_where_the_least_rotation_makes_the_axes_parallel() {
    // The second axis is tilted about x by -0.3 rad: turned back by the least rotation, the angle
    // is zero.
    let axes = [[0.0, 0.0, 1.0], [0.0, 0.3_f64.sin(), 0.3_f64.cos()]];
    let model = delivered(&tokens(&scene("Back", axes)), find);
    let kernels = Kernels::new(&model);
    let mut state = State::described(&model, &kernels);
    let (sine, cosine) = 0.15_f64.sin_cos();
    state.coordinates[10..14].copy_from_slice(&[cosine, sine, 0.0, 0.0]);
    let angle = state.of(&kernels.readouts.angles[0].1);
    assert!(
        (angle[0] - 1.0).abs() < 1e-15 && angle[1].abs() < 1e-15,
        "{angle:?}"
    );
}

#[test]
fn the_second_axis_of_a_gear_does_not_look_at_the_first_wheel() {
    let text = "struct Case {
        #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15])] one: Body,
        #[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15])] two: Body,
        #[joint(between = [one, two, ground], axis_i = [1.0, 0.0, 0.0],
            axis_j = local([0.3, 1.0, -0.5], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), ratio = 0.5)]
        gear: Gear,
    }";
    let model = delivered(&tokens(text), find);
    let kernels = Kernels::new(&model);
    let mut state = State::described(&model, &kernels);
    assert!(state.of(&kernels.constraints)[0].abs() < 1e-15);
    let (sine, cosine) = 0.2_f64.sin_cos();
    state.coordinates[10..14].copy_from_slice(&[cosine, 0.0, 0.0, sine]);
    let violation = state.of(&kernels.constraints);
    assert!((violation[0] - 0.4).abs() < 1e-15, "{violation:?}");
}

#[test]
fn small_numbers_of_a_small_mechanism_are_not_round_off() {
    // A link of 1 um whose hinges stand 2e-15 m apart along the axis: 2e-9 of its size.
    let text = "struct Case {
        #[body(mass = 1e-12, inertia = [1e-25, 1e-25, 1e-25], position = [0.0, 5e-7, 0.0])] link: Body,
        #[joint(between = [ground, link], hinge = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], ball = [2e-15, 1e-6, 0.0])]
        rod: RevoluteSpherical,
    }";
    let model = delivered(&tokens(text), find);
    let kernels = Kernels::new(&model);
    let violation = State::described(&model, &kernels).of(&kernels.constraints);
    assert!(violation[0].abs() < 1e-21, "{violation:?}");
}
