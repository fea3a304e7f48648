//! What parameters are said to be like: what is decided by it, and what is asked of it later.

mod common;

use common::{PENDULUM, delivery, model, tokens};
use holonom_engine::model::{Model, Rank};
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::rank::judge;
use holonom_engine::symbolic::arena::Input;
use holonom_engine::symbolic::evaluate::evaluate;
use holonom_engine::symbolic::left_out::left_out;

/// A planar four-bar of four hinges with crank, coupler, rocker and base, and what stands above
/// them.
fn four_bar(attribute: &str, fields: &str, [a, b, c, d]: [&str; 4]) -> String {
    let hinge = |name: &str, between: &str, point: &str| {
        format!(
            "#[joint(between = [{between}], point = {point}, axis = [0.0, 0.0, 1.0])] {name}: Revolute,"
        )
    };
    let body = |name: &str, position: &str| {
        format!(
            "#[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = {position})] {name}: Body,"
        )
    };
    [
        format!("#[mechanism({attribute})] struct FourBar {{ {fields}"),
        body("crank_body", &format!("[0.0, 0.5 * {a}, 0.0]")),
        body("coupler_body", &format!("[0.5 * {b}, {a}, 0.0]")),
        body("rocker_body", &format!("[{d}, 0.5 * {c}, 0.0]")),
        hinge("o", "ground, crank_body", "[0.0, 0.0, 0.0]"),
        hinge("a", "crank_body, coupler_body", &format!("[0.0, {a}, 0.0]")),
        hinge(
            "b",
            "coupler_body, rocker_body",
            &format!("local([0.5 * {b}, 0.0, 0.0], [0.0, 0.5 * {c}, 0.0])"),
        ),
        hinge("c", "ground, rocker_body", &format!("[{d}, 0.0, 0.0]")),
        "}".into(),
    ]
    .concat()
}

const LIKES: [f64; 4] = [0.25, 0.9, 0.6, 0.9];

/// The four lengths as parameters, of which some say what they are like.
fn given(attribute: &str, says: [bool; 4]) -> Model {
    let names = ["crank", "coupler", "rocker", "base"];
    let fields = names.iter().zip(LIKES).zip(says);
    let fields: String = fields
        .map(|((name, like), says)| {
            let list = if says {
                format!("(like = {like:?})")
            } else {
                String::new()
            };
            format!("#[param{list}] {name}: f64,")
        })
        .collect();
    model(&tokens(&four_bar(attribute, &fields, names)))
}

fn written(attribute: &str) -> Model {
    let lengths = LIKES.map(|length| format!("{length:?}"));
    let lengths = lengths.each_ref().map(String::as_str);
    model(&tokens(&four_bar(attribute, "", lengths)))
}

#[test]
fn what_is_found_is_what_is_found_of_literals() {
    let attribute = "redundant = \"drop\"";
    let (given, written) = (given(attribute, [true; 4]), written(attribute));
    let mut found = given.independence.clone();
    assert_eq!(found.likes, [0, 1, 2, 3]);
    assert_eq!(written.independence.likes, []);
    assert_eq!(
        found.rank,
        Rank::Decided {
            rank: 17,
            at_start: 17
        }
    );
    found.likes.clear();
    assert_eq!(found.redundant, written.independence.redundant);
    assert_eq!(found.undetermined, written.independence.undetermined);
    for (joint, other) in given.joints.iter().zip(&written.joints) {
        assert_eq!(joint.dropped, other.dropped);
    }
}

#[test]
fn nothing_is_decided_where_one_length_does_not_say() {
    for place in 0..4 {
        let mut says = [true; 4];
        says[place] = false;
        let found = judge(&given("redundant = \"keep\"", says));
        assert_eq!(found.rank, Rank::NotDecided);
        assert_eq!(found.likes, []);
    }
}

#[test]
fn only_what_constraints_depend_on_is_asked_later() {
    let text = "struct Rod { #[param(like = 2.0)] mass: f64, #[param(like = 0.5)] arm: f64, \
                #[body(mass = mass, inertia = [0.1, 0.2, 0.15], position = [0.0, arm, 0.0])] rod: Body, \
                #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])] pivot: Revolute, }";
    assert_eq!(model(&tokens(text)).independence.likes, [1]);
    let code = |text: &str| holonom_engine::assemble(delivery(&tokens(text))).to_string();
    assert!(code(text).contains("check_likes"));
    // Nothing of the pendulum is a parameter.
    assert!(!code(PENDULUM).contains("check_likes"));
    let of_mass = text.replace("[0.0, arm, 0.0]", "[0.0, 0.5, 0.0]");
    assert!(!code(&of_mass).contains("check_likes"));
    assert!(code(&of_mass).contains("Default for Rod"));
    let unsaid = of_mass.replace("(like = 0.5)", "");
    assert!(!code(&unsaid).contains("Default for Rod"));
}

/// Values and gradients of what was left out are those of the same equations where they are kept.
#[test]
fn what_was_left_out_is_what_it_would_be() {
    let (dropped, kept) = (
        given("redundant = \"drop\"", [true; 4]),
        given("redundant = \"keep\"", [true; 4]),
    );
    let layout = kept.layout();
    let known = |input: Input| match input {
        Input::Symbol(place) => kept.like(place),
        Input::Coordinate(place) => Some((1.3 * f64::from(place) + 0.4).sin()),
        Input::Time => Some(0.0),
        _ => None,
    };
    let kernel = left_out(&dropped);
    let found = evaluate(&kernel.arena, &kernel.outputs, known);
    let kernels = Kernels::new(&kept);
    let values = |kernel: &holonom_engine::symbolic::equations::Kernel| {
        evaluate(&kernel.arena, &kernel.outputs, known)
    };
    let (phi, jacobian) = (values(&kernels.constraints), values(&kernels.jacobian));
    let width = 1 + layout.velocities;
    assert_eq!(found.len(), 3 * width);
    for (row, place) in found.chunks(width).zip(&dropped.independence.redundant) {
        let number = layout.row[place.joint] + place.row;
        let mut expected = vec![0.0; width];
        expected[0] = phi[number].expect("it is known");
        for block in kernels.blocks.iter().filter(|b| b.joint == place.joint) {
            let first = 1 + layout.velocity[block.body];
            for k in 0..6 {
                let value = jacobian[block.offset + 6 * place.row + k];
                expected[first + k] = value.expect("it is known");
            }
        }
        for (found, expected) in row.iter().zip(expected) {
            let found = found.expect("it is known");
            assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
        }
    }
}
