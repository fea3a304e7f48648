//! How a joint moves: what a definition says of it, and what is made of that.

mod common;

use common::tokens;
use holonom_engine::diag::Faults;
use holonom_engine::model::{Direction, ElementKind, JointDef, Motion};
use holonom_engine::{check, syntax};
use quote::quote;

/// What stands behind the word `joint`: as it is carried from crate to crate.
fn definition(body: &str) -> Result<JointDef, String> {
    let mut faults = Faults::new();
    let syntax = syntax::joint::parse_transported(tokens(body), ElementKind::Joint, &mut faults);
    let joint = syntax.and_then(|syntax| check::joint::check(&syntax, &mut faults));
    let errors = faults.into_tokens().to_string();
    joint.ok_or(errors)
}

/// A joint with a point and two axes, by what it says behind its equation.
fn motions(statement: &str) -> Option<Vec<Motion>> {
    let body = format!("J(i, j; p: Point, a: Axis, b: Axis) {{ dot(i.a, j.b); {statement} }}");
    definition(&body).expect("no fault").motions
}

fn axis(parameter: usize) -> Direction {
    Direction {
        parameter,
        normal: None,
    }
}

#[test]
fn motions_stand_in_the_model_in_order() {
    assert_eq!(motions(""), None);
    assert_eq!(motions("motion none;"), Some(Vec::new()));
    let normal = |which| Direction {
        parameter: 2,
        normal: Some(which),
    };
    assert_eq!(
        motions("motion turn a at p, slide b.normal(), slide b.binormal(), ball at p;"),
        Some(vec![
            Motion::Turn {
                axis: axis(1),
                point: 0
            },
            Motion::Slide { along: normal(0) },
            Motion::Slide { along: normal(1) },
            Motion::Ball { point: 0 },
        ])
    );
}

#[test]
fn motions_may_come_through_another_macro() {
    // A fragment of `macro_rules` comes in an invisible group.
    let group = |tokens| {
        proc_macro2::TokenTree::from(proc_macro2::Group::new(
            proc_macro2::Delimiter::None,
            tokens,
        ))
    };
    let (direction, point) = (group(quote!(a.normal())), group(quote!(p)));
    let body = quote!(J(i, j; p: Point, a: Axis) { j.p - i.p; motion turn #direction at #point; });
    let mut faults = Faults::new();
    let syntax = syntax::joint::parse_transported(body, ElementKind::Joint, &mut faults);
    let joint = syntax.and_then(|syntax| check::joint::check(&syntax, &mut faults));
    assert_eq!(faults.into_tokens().to_string(), "");
    let turn = Motion::Turn {
        axis: Direction {
            parameter: 1,
            normal: Some(0),
        },
        point: 0,
    };
    assert_eq!(joint.expect("sound").motions, Some(vec![turn]));
}

#[test]
fn a_carrier_hands_the_statement_on() {
    let written = tokens(
        "[::holonom] pub joint Hinge(i, j; point: Point, axis: Axis) { \
         j.point - i.point; dot(i.axis.normals(), j.axis); motion turn axis at point; }",
    );
    let carrier = holonom_engine::joint(written).to_string();
    assert!(carrier.contains("motion turn axis at point ;"), "{carrier}");
    assert!(!carrier.contains("[faulty]"), "{carrier}");
}

#[test]
fn every_fault_is_said_at_once() {
    let errors = definition(
        "J(i, j; p: Point, a: Axis, n: Number) { j.p - i.p; \
         motion turn p at a, slide i.a, ball at i.p, slide a.normals(), turn c at q, slide n, ball at j, slide a.size(), \
         slide -a; \
         motion none; }",
    )
    .expect_err("faults");
    for words in [
        "found `- a`",
        "`p` is a `Point`",
        "`a` is an `Axis`",
        "one `a`; write `a`",
        "one `p`; write `p`",
        "`normals()` are two",
        "no axis `c`",
        "no point `q`",
        "`n` is a `Number`",
        "`j` is a body",
        "no `size` here",
        "the second time",
    ] {
        assert!(errors.contains(words), "{words} is not in {errors}");
    }
    assert_eq!(errors.matches("compile_error").count(), 12);
}
