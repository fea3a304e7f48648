//! How a joint moves: what a definition says of it, and what is made of that.

mod common;

use common::{delivered, tokens};
use holonom_engine::diag::Faults;
use holonom_engine::model::Comparison;
use holonom_engine::model::{Direction, ElementDef, ElementKind, Model, Motion};
use holonom_engine::rank::moves::compare;
use holonom_engine::{check, syntax};
use quote::quote;

/// What stands behind the word `joint`: as it is carried from crate to crate.
fn definition(body: &str) -> Result<ElementDef, String> {
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
    let screw = definition(&format!(
        "{SCREW} motion screw axis at point by pitch; angle about axis; }}"
    ));
    assert_eq!(
        screw.expect("no fault").motions,
        Some(vec![Motion::Screw {
            axis: 1,
            point: 0,
            pitch: 2
        }])
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

/// What is refused of a definition where it stands.
fn refusals(body: &str) -> Vec<String> {
    let tokens = tokens(&format!("joint {body}"));
    let output = holonom_engine::joint(quote!([::holonom] #tokens)).to_string();
    let (before, _) = output.split_once("struct").expect("a type");
    let refusals = before.split("compile_error ! {").skip(1);
    let refusals = refusals.map(|rest| rest.split('"').nth(1).expect("a sentence").to_string());
    refusals.collect()
}

#[track_caller]
fn assert_moves(body: &str) {
    assert_eq!(refusals(body), [""; 0], "{body}");
}

/// One refusal, which says this.
#[track_caller]
fn assert_refused(body: &str, words: &str) {
    match &refusals(body)[..] {
        [sentence] if sentence.contains(words) => {}
        other => panic!("{words} is not said of {body}, but {other:?}"),
    }
}

const REVOLUTE: &str =
    "J(i, j; point: Point, axis: Axis) { j.point - i.point; dot(i.axis.normals(), j.axis);";
const CYLINDRICAL: &str = "J(i, j; point: Point, axis: Axis) { \
    dot(i.axis.normals(), j.axis); dot(i.axis.normals(), j.point - i.point);";
const UNIVERSAL: &str = "J(i, j; point: Point, axis_i: Axis, axis_j: Axis) { \
    j.point - i.point; dot(i.axis_i, j.axis_j);";
const PLANAR: &str = "J(i, j; point: Point, normal: Axis) { \
    dot(i.normal.normals(), j.normal); dot(i.normal, j.point - i.point);";
const SCREW: &str = "J(i, j; point: Point, axis: Axis, pitch: Length) { \
    dot(i.axis.normals(), j.axis); dot(i.axis.normals(), j.point - i.point); \
    dot(i.axis, j.point - i.point) - pitch / TAU * angle(i, j, axis);";
const LINE: &str = "J(i, j; point: Point, axis: Axis) { dot(i.axis.normals(), j.point - i.point);";

#[test]
fn motions_that_the_equations_leave_are_accepted() {
    assert_moves(&format!("{REVOLUTE} motion turn axis at point; }}"));
    for motions in [
        "turn axis at point, slide axis",
        "slide axis, turn axis at point",
    ] {
        assert_moves(&format!("{CYLINDRICAL} motion {motions}; }}"));
    }
    assert_moves(&format!(
        "{UNIVERSAL} motion turn axis_i at point, turn axis_j at point; }}"
    ));
    assert_moves(&format!(
        "{PLANAR} motion slide normal.normal(), slide normal.binormal(), turn normal at point; }}"
    ));
    assert_moves(&format!("{LINE} motion slide axis, ball at point; }}"));
    assert_moves(&format!("{REVOLUTE} angle(i, j, axis); motion none; }}"));
    assert_moves("J(i, j; point: Point) { j.point - i.point; motion ball at point; }");
    assert_moves(&format!("{SCREW} motion screw axis at point by pitch; }}"));
    let longer = SCREW.replace(
        "pitch: Length",
        "pitch: Length = 0.3, other: Length = 2.0 * pitch",
    );
    assert_moves(&format!("{longer} motion screw axis at point by pitch; }}"));
    assert_refused(
        &format!("{longer} motion screw axis at point by other; }}"),
        "forbids this motion",
    );
}

/// The thread is right-handed for a positive pitch, and turns are counted.
#[test]
fn screws_that_the_equations_do_not_leave_are_refused() {
    let left = SCREW.replace("- pitch", "+ pitch");
    assert_refused(
        &format!("{left} motion screw axis at point by pitch; }}"),
        "the equation `J[4]` (line 1) forbids this motion",
    );
    assert_refused(
        &format!("{SCREW} motion turn axis at point; }}"),
        "the equation `J[4]` (line 1) forbids this motion",
    );
    assert_refused(
        &format!("{CYLINDRICAL} motion screw axis at point by pitch; }}")
            .replace("axis: Axis", "axis: Axis, pitch: Length"),
        "no equation counts the turns of this screw; write one with `angle(i, j, axis)`",
    );
    // In the reference configuration there is nothing to count.
    assert_refused(
        &format!("{CYLINDRICAL} initial(angle(i, j, axis)) * dot(i.axis, j.axis); motion screw axis at point by pitch; }}")
            .replace("axis: Axis", "axis: Axis, pitch: Length"),
        "no equation counts",
    );
    let backwards = SCREW.replace(
        "- pitch / TAU * angle(i, j, axis)",
        "+ pitch / TAU * angle(j, i, axis)",
    );
    assert_refused(
        &format!("{backwards} motion screw axis at point by pitch; }}"),
        "write one with `angle(i, j, axis)`",
    );
    for (motion, words) in [
        (
            "screw axis.normal() at point by pitch",
            "a screw turns about an `Axis` itself",
        ),
        ("screw point at axis by pitch", "`point` is a `Point`"),
        ("screw axis at point by axis", "`axis` is an `Axis`"),
        ("screw axis at point by i.pitch", "write `pitch`"),
        (
            "screw axis at point by 0.1",
            "the pitch of a screw is a `Length` of the joint",
        ),
    ] {
        let errors = definition(&format!("{SCREW} motion {motion}; }}")).expect_err("a fault");
        assert!(errors.contains(words), "{words} is not in {errors}");
    }
}

/// Such joints hold with points and axes of a special kind only, or with several.
#[test]
fn points_axes_and_numbers_are_found_that_equations_hold_for() {
    // A link with a hinge and a ball; with a length, the points are that far apart, beside the
    // axis.
    let link = "dot(i.axis, j.ball - i.hinge) - initial(dot(i.axis, j.ball - i.hinge));";
    let motion = "motion turn axis at hinge, ball at ball;";
    let points = "hinge: Point, axis: Axis, ball: Point";
    assert_moves(&format!(
        "J(i, j; {points}) {{ {link} squared(j.ball - i.hinge) - initial(squared(j.ball - i.hinge)); {motion} }}"
    ));
    assert_moves(&format!(
        "J(i, j; {points}, length: Length) {{ {link} squared(j.ball - i.hinge) - length * length; {motion} }}"
    ));
    // A hinge of two balls on its axis.
    let hinge =
        "J(i, j; a: Point, b: Point, axis: Axis) { j.a - i.a; dot(i.axis.normals(), j.b - i.b);";
    assert_moves(&format!("{hinge} motion turn axis at a; }}"));
    // Centres of mass.
    assert_moves("J(i, j; point: Point) { j.origin - i.point; motion ball at point; }");
    // A point beside a line.
    assert_moves(
        "J(i, j; point: Point, axis: Axis, side: Axis, offset: Length = 0.0) { \
         dot(i.axis.normals(), j.axis); dot(i.side, j.point - i.point) - offset; \
         dot(cross(i.axis, i.side), j.point - i.point); motion turn axis at point, slide axis; }",
    );
}

#[test]
fn motions_that_an_equation_forbids_are_refused() {
    assert_refused(
        &format!("{REVOLUTE} motion turn axis at point, slide axis; }}"),
        "the equations `J[0]` to `J[2]` (line 1) forbid this motion",
    );
    assert_refused(
        &format!("{REVOLUTE} motion turn axis.normal() at point; }}"),
        "(line 1) forbids this motion",
    );
    // Every one of them is refused.
    let two = refusals(&format!(
        "{PLANAR} motion slide normal, turn normal.normal() at point; }}"
    ));
    assert_eq!(two.len(), 2, "{two:?}");
    assert!(two[0].contains("`J[2]`"), "{two:?}");
    assert_refused(
        "J(i, j; point: Point, axis: Axis) { dot(i.axis.normals(), j.axis); j.point - i.point; \
         motion slide axis.normal(), turn axis at point; }",
        "the equations `J[2]` to `J[4]`",
    );
}

/// The first arm carries the second, and a line does not go with a ball on it.
#[test]
fn motions_in_the_wrong_order_are_refused() {
    assert_refused(
        &format!("{UNIVERSAL} motion turn axis_j at point, turn axis_i at point; }}"),
        "the equation `J[3]` (line 1) does not hold after these motions",
    );
    assert_refused(
        &format!("{LINE} motion ball at point, slide axis; }}"),
        "does not hold after these motions",
    );
}

#[test]
fn motions_of_another_number_are_refused() {
    assert_refused(
        &format!("{CYLINDRICAL} motion slide axis; }}"),
        "states 1 motion, and its equations leave 2",
    );
    assert_refused(
        &format!("{REVOLUTE} motion none; }}"),
        "states 0 motions, and its equations leave 1",
    );
    assert_refused(
        &format!("{CYLINDRICAL} motion slide axis, slide axis; }}"),
        "states 2 motions, of which 1 are independent",
    );
    assert_refused(
        &format!("{LINE} motion slide axis, turn axis at point, ball at point; }}"),
        "states 5 motions, of which 4 are independent",
    );
}

/// What only a mechanism can tell is accepted.
#[test]
fn nothing_is_said_of_what_cannot_be_compared() {
    // Axes at an angle of 60 degrees.
    assert_moves(
        "J(i, j; point: Point, a: Axis, b: Axis) { j.point - i.point; dot(i.a, j.b) - 0.5; motion none; }",
    );
    assert_moves(
        "J(i, j; point: Point, axis: Axis, law: Law) { dot(i.axis, j.point - i.point) - law(); motion none; }",
    );
}

/// A mechanism of two bodies, a particle and a joint, which is described by its attribute.
fn mechanism(joint: &str, attribute: &str) -> Model {
    let item = format!(
        "struct Pair {{ \
         #[body(mass = 1.0, inertia = [1.0, 2.0, 2.5], position = [0.3, -0.2, 0.1], \
                orientation = rotation([0.2, 0.5, 1.0], 0.7), free)] one: Body, \
         #[body(mass = 1.0, inertia = [[1.0, 0.1, 0.0], [0.1, 2.0, 0.0], [0.0, 0.0, 2.5]], position = [1.3, 0.4, -0.6], \
                orientation = rotation([1.0, -0.5, 0.1], 0.4), free)] other: Body, \
         #[body(mass = 1.0, position = [0.5, 0.5, 1.0], free)] bead: Particle, \
         #[param] slope: f64, \
         #[joint({attribute})] joint: J }}"
    );
    delivered(&tokens(&item), |_| {
        Some((ElementKind::Joint, tokens(joint)))
    })
}

fn compared(joint: &str, attribute: &str) -> Comparison {
    compare(&mechanism(joint, attribute), 0)
}

/// What a mechanism leaves out, because it follows from its other joints, is of the joint all the
/// same.
#[test]
fn equations_that_are_left_out_count() {
    let hinge = format!("{REVOLUTE} motion turn axis at point; }}");
    let attribute = "between = [one, other], point = [1.0, -0.5, 0.7], axis = [0.3, 2.0, 0.4]";
    let mut model = mechanism(&hinge, attribute);
    model.joints[0].dropped = vec![1, 4];
    assert_eq!(compare(&model, 0), Comparison::Agrees);
}

#[test]
fn a_joint_of_a_mechanism_is_compared() {
    let hinge = format!("{REVOLUTE} motion turn axis at point; }}");
    let at = "point = [1.0, -0.5, 0.7], axis = [0.3, 2.0, 0.4]";
    for bodies in ["one, other", "other, one", "ground, other", "one, ground"] {
        let attribute = format!("between = [{bodies}], {at}");
        assert_eq!(compared(&hinge, &attribute), Comparison::Agrees, "{bodies}");
        let slide = format!("{REVOLUTE} motion slide axis.normal(); }}");
        assert!(
            matches!(compared(&slide, &attribute), Comparison::Forbidden(found) if found[0].0 == 0),
            "{bodies}"
        );
        let nothing = format!("{REVOLUTE} motion none; }}");
        let fewer = Comparison::Fewer { stated: 0, left: 1 };
        assert_eq!(compared(&nothing, &attribute), fewer, "{bodies}");
        // The arms are perpendicular, and the first body's carries the other.
        let arms = format!(
            "between = [{bodies}], point = [1.0, -0.5, 0.7], axis_i = [0.3, 2.0, 0.4], axis_j = [2.0, -0.3, 0.0]"
        );
        let cross = |motion: &str| compared(&format!("{UNIVERSAL} motion {motion}; }}"), &arms);
        assert_eq!(
            cross("turn axis_i at point, turn axis_j at point"),
            Comparison::Agrees,
            "{bodies}"
        );
        assert_eq!(
            cross("turn axis_j at point, turn axis_i at point"),
            Comparison::Violated(3),
            "{bodies}"
        );
    }
}

/// A particle does not turn, so that a ball at its place says nothing of it; but slides count.
#[test]
fn a_particle_is_compared_without_rotations() {
    let at = "point = [0.5, 0.5, 1.0], axis = [0.3, 2.0, 0.4]";
    let guide = |motions: &str| {
        let joint = format!("{LINE} motion {motions}; }}");
        ["ground, bead", "one, bead"]
            .map(|bodies| compared(&joint, &format!("between = [{bodies}], {at}")))
    };
    assert_eq!(
        guide("slide axis, ball at point"),
        [Comparison::Agrees, Comparison::Agrees]
    );
    let fewer = Comparison::Fewer { stated: 3, left: 1 };
    assert_eq!(guide("ball at point"), [fewer.clone(), fewer]);
}

#[test]
fn nothing_is_said_where_numbers_or_places_are_not_known() {
    let line = format!("{LINE} motion slide axis, ball at point; }}");
    let undecided = |attribute: &str| {
        assert_eq!(
            compared(&line, attribute),
            Comparison::Undecided,
            "{attribute}"
        );
    };
    undecided("between = [ground, bead], point = [0.5, 0.5, 1.0], axis = [0.3, 2.0, slope]");
    // The points lie behind each other.
    undecided(
        "between = [ground, bead], point = local([0.5, 0.5, 0.0], [0.0, 0.0, 0.0]), axis = [0.0, 0.0, 1.0]",
    );
    // The equations do not hold.
    undecided(
        "between = [ground, bead], point = local([0.5, 0.5, 0.0], [0.0, 0.0, 0.0]), axis = [0.3, 2.0, 0.4]",
    );
    let silent = format!("{LINE} }}");
    let attribute = "between = [ground, bead], point = [0.5, 0.5, 1.0], axis = [0.3, 2.0, 0.4]";
    assert_eq!(compared(&silent, attribute), Comparison::Undecided);
}
