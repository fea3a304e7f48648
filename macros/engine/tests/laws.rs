//! What is seen of laws of forces: where they jump, and which turn round with their direction.

mod common;

use common::{model, tokens};
use holonom_engine::model::Model;
use holonom_engine::symbolic::scene::Scene;
use holonom_engine::symbolic::separation::Separations;

/// A body on a spring of free length zero with a damper, and a law beside them.
fn with_law(law: &str) -> Model {
    model(&tokens(&format!(
        "struct One {{
            #[param] play: f64,
            #[body(free, mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [1.0, 0.0, 0.0])]
            body: Body,
            #[force(
                between = [ground, body], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0],
                stiffness = 3.0, damping = 0.5, force = {law}
            )]
            spring: Damper,
        }}"
    )))
}

#[test]
fn a_force_turns_round_whose_size_does_not_vanish_with_the_length() {
    for (law, turns) in [
        ("0.0", false),
        ("-5.0", true),
        ("-play", true),
        ("-5.0 - 2.0 * rate", true),
        ("-2.0 * rate", false),
        ("-5.0 * rate * rate", true),
        ("-3.0 * length", false),
        ("-3.0 * length * length - 2.0 * rate", false),
        ("-3.0 * (length - 1e-9)", true),
        ("-5.0 * length / (0.001 + length)", false),
        // A pole.
        ("-1.0 / (length * length)", false),
        ("5.0 * max(0.0, 0.2 - length)", true),
        ("-5.0 * max(0.0, length - 0.2)", false),
        ("if time < 1.0 { -5.0 } else { 0.0 }", true),
        ("-5.0 * cos(length)", true),
        ("-5.0 * sin(length)", false),
    ] {
        let found = Separations::new(&Scene::new(&with_law(law)));
        let wanted: &[usize] = if turns { &[0] } else { &[] };
        assert_eq!(found.forces, wanted, "{law}");
        assert_eq!(found.kernel.outputs.len(), 3 * wanted.len(), "{law}");
    }
}

#[test]
fn a_law_is_continuous_where_its_sides_agree() {
    for (law, is_continuous) in [
        ("max(0.0, 0.2 - length)", true),
        ("min(length, play) * rate", true),
        ("abs(length - play)", true),
        ("sign(length - play) * rate * (length - play)", true),
        ("sign(length - play)", false),
        ("abs(length - play) / (length - play)", false),
        (
            "if length < play { 3.0 * (play - length) } else { 0.0 }",
            true,
        ),
        (
            "if length < play { 3.0 * (play - length) - rate } else { 0.0 }",
            false,
        ),
        ("if length < play { rate } else { rate }", true),
        ("exp(max(length, play))", true),
        ("sign(max(0.0, length - play))", false),
        // One expression, and a jump at it in another place.
        ("max(0.0, length - play) + sign(length - play)", false),
    ] {
        let switches = with_law(law).switches;
        assert!(!switches.is_empty(), "{law}");
        let found = switches.iter().all(|switch| switch.is_continuous);
        assert_eq!(found, is_continuous, "{law}");
    }
}
