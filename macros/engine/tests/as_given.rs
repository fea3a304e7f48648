//! Masses and inertias that no body has, taken as they are given.

mod common;

use common::{checked, definition, tokens};
use holonom_engine::model::Model;

/// A frame that a hinge turns, and a body that turns on it, all about one point.
fn crossed(settings: &str, frame: &str, axis: &str) -> Result<Model, String> {
    let fields = format!(
        "#[param(like = 1.0)] heavy: f64,
         #[body({frame})] frame: Body,
         #[joint(between = [ground, frame], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
         first: Revolute,
         #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.5, 0.5])] block: Body,
         #[joint(between = [frame, block], point = [0.0, 0.0, 0.0], axis = {axis})]
         second: Revolute,"
    );
    checked(
        &tokens(&format!(
            "#[mechanism({settings})] struct Crossed {{ {fields} }}"
        )),
        definition,
    )
}

const JOINTS: &str = "coordinates = \"joints\"";
const ACROSS: &str = "[1.0, 0.0, 0.0]";

fn refusal(settings: &str, frame: &str, axis: &str) -> String {
    crossed(settings, frame, axis).expect_err("refused")
}

#[test]
fn a_link_without_mass_is_taken_where_the_mechanism_has_inertia() {
    let frame = "mass = 0.0, inertia = [0.0, 0.0, 0.0], as_given";
    let model = crossed(JOINTS, frame, ACROSS).expect("the block resists both hinges");
    assert!(model.is_of_joints_alone());
    let metric = model.with_metric().into_owned();
    assert!(!metric.is_of_joints_alone());
    let frame_of = |model: &Model| model.bodies[0].mass.literal();
    assert_eq!(
        (frame_of(&model), frame_of(&metric)),
        (Some(0.0), Some(2.0))
    );

    let found = refusal(
        JOINTS,
        "mass = 1.0, inertia = [1.0, 1.0, -30.0], as_given",
        ACROSS,
    );
    assert!(
        found.contains(
            "with `frame` `as_given`, the mass matrix of the mechanism is not positive definite"
        ),
        "{found}"
    );
    // Both about one line: the frame may be anywhere.
    let found = refusal(JOINTS, frame, "[0.0, 0.0, 1.0]");
    assert!(found.contains("is not positive definite"), "{found}");
    let found = refusal("coordinates = \"both\"", frame, ACROSS);
    assert!(
        found.contains("such a body has no equations of its own"),
        "{found}"
    );
}

#[test]
fn moments_of_no_body_are_taken_in_any_coordinates() {
    let frame = "mass = 1.0, inertia = [1.0, 1.0, 3.0]";
    let found = refusal("", frame, ACROSS);
    assert!(
        found.contains("no body has the moments of inertia of `frame`"),
        "{found}"
    );
    let model = crossed("", &format!("{frame}, as_given"), ACROSS).expect("taken");
    assert!(!model.is_of_joints_alone());
}

#[test]
fn what_is_as_given_is_written_out() {
    for frame in [
        "mass = heavy, inertia = [1.0, 1.0, 1.0], as_given",
        "mass = 1.0, inertia = [heavy, 1.0, 1.0], as_given",
    ] {
        let found = refusal(JOINTS, frame, ACROSS);
        assert!(
            found.contains("`frame` is `as_given`: its mass and inertia must be numbers"),
            "{found}"
        );
    }
    let found = refusal(
        JOINTS,
        "mass = 1.0, shape = ball(radius = 1.0), as_given",
        ACROSS,
    );
    assert!(found.contains("has no `as_given`"), "{found}");
}
