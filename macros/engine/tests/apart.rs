//! Refusals that say where something is: distances and directions in numbers, along global axes.

mod common;

use common::{delivery_of, tokens};
use holonom_engine::model::ElementKind;
use proc_macro2::TokenStream;

/// As in the library.
const JOINTS: [(&str, &str); 5] = [
    (
        "Revolute",
        "Revolute(i, j; point: Point, axis: Axis) { j.point - i.point; dot(i.axis.normals(), j.axis); angle about axis; }",
    ),
    (
        "Universal",
        "Universal(i, j; point: Point, axis_i: Axis, axis_j: Axis) { j.point - i.point; dot(i.axis_i, j.axis_j); }",
    ),
    (
        "Spherical",
        "Spherical(i, j; point: Point) { j.point - i.point; }",
    ),
    (
        "Distance",
        "Distance(i, j; head: Point, tail: Point, length: Length = initial(length(j.tail - i.head))) { \
         squared(j.tail - i.head) - length * length; }",
    ),
    (
        "PointOnLine",
        "PointOnLine(i, j; point: Point, axis: Axis) { dot(i.axis.normals(), j.point - i.point); }",
    ),
];

fn find(path: &str) -> Option<(ElementKind, TokenStream)> {
    let (_, text) = JOINTS.iter().find(|(name, _)| *name == path)?;
    Some((ElementKind::Joint, tokens(text)))
}

/// What is said of a mechanism.
fn refusal(fields: &str) -> String {
    let text = format!("#[mechanism(redundant = \"drop\")] struct Described {{ {fields} }}");
    holonom_engine::assemble(delivery_of(&tokens(&text), find)).to_string()
}

fn says(fields: &str, wanted: &str) {
    let found = refusal(fields);
    assert!(found.contains(wanted), "{wanted}\n{found}");
}

/// The points on the leaf are 2 m apart, those on the ground 1 m: where the lower one holds, the
/// upper one is off by 1 m.
#[test]
fn a_point_that_does_not_fit_is_so_far_off() {
    says(
        "#[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])] leaf: Body,
         #[joint(between = [ground, leaf], point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]))] lower: Spherical,
         #[joint(between = [ground, leaf], point = local([0.0, 1.0, 0.0], [0.0, 2.0, 0.0]))] upper: Spherical,",
        "`upper[1]` contradicts equations of `lower`: where those hold, it does not (`point` of `leaf` is 1 m by [0, 1, 0] from that of \
         `ground`); look for",
    );
}

/// On three balls a table stands still. Its fourth leg is 5 cm too high, and leans by atan(0.1).
#[test]
fn an_axis_that_does_not_fit_is_at_an_angle() {
    let found = refusal(
        "#[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])] table: Body,
         #[joint(between = [ground, table], point = [0.0, 0.0, 0.0])] first: Spherical,
         #[joint(between = [ground, table], point = [1.0, 0.0, 0.0])] second: Spherical,
         #[joint(between = [ground, table], point = [0.0, 1.0, 0.0])] third: Spherical,
         #[joint(
             between = [ground, table], point = local([1.0, 1.0, 0.0], [1.0, 1.0, 0.05]),
             axis = local([0.0, 0.0, 1.0], [0.0, 0.1, 1.0])
         )] fourth: Revolute,",
    );
    for wanted in [
        "`point` of `table` is 0.05 m by [0, 0, 0.05] from that of `ground`",
        "`axis` of `table` is at 5.711 deg to that of `ground`",
    ] {
        assert!(found.contains(wanted), "{wanted}\n{found}");
    }
}

#[test]
fn what_cannot_be_left_says_angles_and_distances() {
    says(
        "#[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])] shaft: Body,
         #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis_i = [1.0, 0.0, 0.0], axis_j = [1.0, 0.0, 0.0])] cross: Universal,",
        "`cross[3]` does not hold in the reference configuration (`axis_i` and `axis_j` are at 0 deg), and no",
    );
    says(
        "#[body(mass = 1.0)] bead: Particle,
         #[joint(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 1.0)] rod: Distance,",
        "`rod[0]` does not hold in the reference configuration (`head` and `tail` are 0 m apart), and no",
    );
}

#[test]
fn a_point_beside_its_particle_is_so_far_from_it() {
    says(
        "#[body(mass = 1.0, position = [0.0, 1.0, 0.0])] bead: Particle,
         #[joint(between = [ground, bead], point = [0.3, 1.0, -0.4])] pin: Spherical,",
        "at the particle's own position can be fixed on it; this is 0.5 m by [0.3, 0, -0.4] from there",
    );
}
