//! Shapes of bodies whose mass and inertia are given.

mod common;

use common::{checked, definition, tokens};
use holonom_engine::model::inertia::rotation;
use holonom_engine::model::number::literals;
use holonom_engine::model::{Body, Model, Shape};

/// A body with a parameter `far` beside it.
fn described(attribute: &str) -> Result<Model, String> {
    let fields = format!("#[param(like = 1.0)] far: f64, #[body({attribute}, free)] body: Body,");
    checked(
        &tokens(&format!("struct Shaped {{ {fields} }}")),
        definition,
    )
}

fn body(attribute: &str) -> Body {
    described(attribute).expect("sound").bodies.remove(0)
}

/// Beside a mass and an inertia a shape changes no number: it is placed on the body, and drawn.
#[test]
fn a_shape_beside_mass_and_inertia_is_only_drawn() {
    let measured = "mass = 3.0, inertia = [[1.0, 0.1, 0.2], [0.1, 2.0, -0.3], [0.2, -0.3, 2.5]], \
         position = [0.1, 0.2, 0.3], orientation = rpy(0.3, -0.8, 1.9)";
    let plain = body(measured);
    let mut drawn = body(&format!(
        "{measured}, shapes = [cylinder(radius = 0.1, from = [1.0, 0.0, 0.0], to = [1.0, 2.0, 0.0]), \
         block(size = [0.3, 0.2, 0.1], at = [0.0, 0.0, 0.5])]"
    ));
    let shapes = std::mem::take(&mut drawn.shapes);
    // Of another place in the text.
    drawn.name = plain.name.clone();
    assert_eq!(format!("{drawn:?}"), format!("{plain:?}"));
    let [tube, block] = &shapes[..] else {
        panic!("{shapes:?}");
    };
    let a = rotation(literals(&plain.orientation).expect("numbers"));
    let turned = |v: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|l| a[k][l] * v[l]).sum::<f64>());
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        let same = (0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-15);
        assert!(same, "{found:?} {wanted:?}");
    };
    let place = |shape: &Shape| {
        let s = turned(shape.centre);
        [0, 1, 2].map(|k| [0.1, 0.2, 0.3][k] + s[k])
    };
    near(place(tube), [1.0, 1.0, 0.0]);
    near(place(block), [0.0, 0.0, 0.5]);
    // The length of the cylinder is along y; a block has the axes of its body.
    let own = rotation(tube.axes);
    near(turned([0, 1, 2].map(|k| own[k][0])), [0.0, 1.0, 0.0]);
    let own = rotation(block.axes);
    near([own[0][0], own[1][1], own[2][2]], [1.0, 1.0, 1.0]);
}

#[test]
fn a_shape_that_is_drawn_needs_a_place() {
    let measured = "mass = 1.0, inertia = [1.0, 1.0, 1.0]";
    let ball = |radius: &str, at: &str, more: &str| {
        let ball = format!("ball(radius = {radius}, at = [{at}, 0.0, 0.0]{more})");
        described(&format!("{measured}, shapes = [{ball}]"))
    };
    let said = ball("0.1", "far", "").expect_err("no place");
    assert!(said.contains("is only drawn; its points"), "{said}");
    let said = described(&format!(
        "{measured}, position = [far, 0.0, 0.0], shape = ball(radius = 0.1, at = [1.0, 0.0, 0.0])"
    ));
    assert!(said.expect_err("no place").contains("is only drawn"));
    // Its sizes may be parameters.
    assert!(ball("far", "1.0", "").is_ok());
    let said = ball("0.1", "1.0", ", density = 5.0").expect_err("a density");
    assert!(said.contains("has no `density`"), "{said}");
}
