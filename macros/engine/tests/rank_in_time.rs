//! Equations that follow from others in position, velocity and time, and such as contradict each
//! other.

mod common;

use common::{delivered, delivery_of, tokens};
use holonom_engine::model::{ElementKind, Model, Rank};
use proc_macro2::TokenStream;

/// As in the library, but for `Turning`, a plane that turns away from the first, and `Alined`,
/// which asks both normals of an axis to have one direction as soon as the time begins, and `Far`,
/// which nothing satisfies from then on.
const JOINTS: [(&str, &str); 11] = [
    (
        "Revolute",
        "Revolute(i, j; point: Point, axis: Axis) { j.point - i.point; dot(i.axis.normals(), j.axis); angle about axis; }",
    ),
    (
        "Prismatic",
        "Prismatic(i, j; point: Point, axis: Axis) { dot(i.axis.normals(), j.axis); dot(j.axis.normals()[0], i.axis.normals()[1]); \
         let d = j.point - i.point; dot(i.axis.normals(), d); displacement dot(i.axis, d); }",
    ),
    (
        "Screw",
        "Screw(i, j; point: Point, axis: Axis, pitch: Length) { dot(i.axis.normals(), j.axis); let d = j.point - i.point; \
         dot(i.axis.normals(), d); dot(i.axis, d) - pitch / TAU * angle(i, j, axis); angle about axis; displacement dot(i.axis, d); }",
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
        "AngleDriver",
        "AngleDriver(i, j; axis: Axis, motion: Law) { drive angle(i, j, axis) to motion(); angle about axis; }",
    ),
    (
        "DisplacementDriver",
        "DisplacementDriver(i, j; point: Point, axis: Axis, motion: Law) { \
         drive dot(i.axis, j.point - i.point) to motion(); displacement dot(i.axis, j.point - i.point); }",
    ),
    (
        "PointOnPlane",
        "PointOnPlane(i, j; point: Point, normal: Axis) { dot(i.normal, j.point - i.point); }",
    ),
    (
        "Turning",
        "Turning(i, j; point: Point, motion: Law) { dot([1.0, motion(), 0.0], j.point - i.point); }",
    ),
    (
        "Far",
        "Far(i, j; point: Point) { (2.0 + squared(j.origin - i.point)) * time; }",
    ),
    (
        "Alined",
        "Alined(i, j; axis: Axis, direction: Vector) { cross(j.axis.normals(), i.direction) * time; }",
    ),
];

fn find(path: &str) -> Option<(ElementKind, TokenStream)> {
    let (_, text) = JOINTS.iter().find(|(name, _)| *name == path)?;
    Some((ElementKind::Joint, tokens(text)))
}

fn model(text: &str) -> Model {
    delivered(&tokens(text), find)
}

fn refusal(text: &str) -> String {
    holonom_engine::assemble(delivery_of(&tokens(text), find)).to_string()
}

/// The rows that are left out.
fn dropped(model: &Model) -> Vec<(String, Vec<usize>)> {
    let joints = model.joints.iter();
    joints
        .filter(|joint| !joint.dropped.is_empty())
        .map(|joint| (joint.name.to_string(), joint.dropped.clone()))
        .collect()
}

/// A wheel on a hinge about z with a motor for each law.
fn wheel(wish: &str, laws: &[&str]) -> String {
    let motors: Vec<String> = laws
        .iter()
        .enumerate()
        .map(|(k, law)| {
            format!("#[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = {law})] motor{k}: AngleDriver,")
        })
        .collect();
    format!(
        "#[mechanism({wish})] struct Driven {{
            #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.1, 0.0, 0.0], orientation = [0.1, 0.7, -0.3, 0.4])] wheel: Body,
            #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])] hinge: Revolute,
            {}
        }}",
        motors.join(" ")
    )
}

const WISHES: [&str; 3] = ["", "redundant = \"drop\"", "redundant = \"keep\""];

/// Refused as a contradiction of the last motor with the first, whatever is wished, and for nothing
/// else.
fn contradicts(laws: &[&str], what: &str) {
    for wish in WISHES {
        let text = refusal(&wheel(wish, laws));
        assert!(
            text.contains("`motor1[0]` contradicts equations of `motor0`"),
            "{laws:?}, {wish}: {text}"
        );
        assert!(text.contains(what), "{laws:?}, {wish}: {text}");
        assert!(!text.contains("redundant:"), "{laws:?}, {wish}: {text}");
    }
}

#[test]
fn motors_of_one_law_are_redundant() {
    for law in [
        "time",
        "1000.0 * time",
        "1e-3 * time",
        "smooth_step((time - 2.0) / 0.01)",
        "10.0 * smooth_step((time - 7200.0) / 3600.0)",
        "3.0 * sin(50.0 * time)",
        "7.0 * time * time",
    ] {
        let model = model(&wheel("redundant = \"drop\"", &[law, law]));
        assert_eq!(dropped(&model), [("motor1".into(), vec![0])], "{law}");
        let rank = Rank::Decided {
            rank: 6,
            at_start: 6,
        };
        assert_eq!(model.independence.rank, rank, "{law}");
        let text = refusal(&wheel("", &[law, law]));
        assert!(
            text.contains("the equation of `motor1` is redundant"),
            "{text}"
        );
    }
}

#[test]
fn laws_that_say_the_same_are_redundant() {
    for laws in [
        ["2.0 * time", "time + time"],
        ["sin(2.0 * time)", "2.0 * sin(time) * cos(time)"],
        ["time * time", "0.25 * (2.0 * time) * (2.0 * time)"],
    ] {
        let model = model(&wheel("redundant = \"drop\"", &laws));
        assert_eq!(dropped(&model), [("motor1".into(), vec![0])], "{laws:?}");
    }
}

#[test]
fn motors_of_two_speeds_contradict() {
    contradicts(&["time", "2.0 * time"], "speed");
    contradicts(&["time", "-time"], "speed");
    contradicts(&["time", "1.001 * time"], "speed");
    contradicts(&["0.0", "1e-6 * time"], "speed");
    contradicts(&["0.0", "1e6 * time"], "speed");
    contradicts(&["time", "sin(time)"], "time = ");
}

#[test]
fn motors_that_start_apart_contradict() {
    contradicts(&["time", "time + 0.1"], "time = 0 s");
    // Without the time in it a start that cannot be assembled shows by itself: what cannot be left
    // out is told.
    let text = refusal(&wheel("redundant = \"drop\"", &["0.5", "0.0"]));
    assert!(
        text.contains("`motor1[0]` contradicts equations of `motor0`")
            && text.contains("where those hold, it does not;"),
        "{text}"
    );
}

#[test]
fn motors_that_part_later_contradict() {
    contradicts(&["0.0", "smooth_step((time - 200.0) / 1.0)"], "time = 200");
    contradicts(
        &["time", "time + 0.001 * smooth_step((time - 0.003) / 0.001)"],
        "time = 0.00",
    );
    contradicts(
        &["0.0", "smooth_step((time - 20000.0) / 3600.0)"],
        "time = 2",
    );
    // There and back within a tenth of a second.
    contradicts(
        &[
            "100.0 * time",
            "100.0 * time + smooth_step((time - 40.0) / 0.1) - smooth_step((time - 40.2) / 0.1)",
        ],
        "time = 40",
    );
    contradicts(&["time * time", "time * time * time"], "time = ");
    contradicts(&["0.0", "1.0 - cos(0.001 * time)"], "time = ");
}

#[test]
fn a_row_that_depends_on_others_at_the_start_only_stays() {
    let text = |wish: &str, motion: &str| {
        format!(
            "#[mechanism({wish})] struct Bead {{
                #[body(mass = 1.0, position = [0.0, 0.0, 0.3])] bead: Particle,
                #[joint(between = [ground, bead], point = [0.0, 0.0, 0.3], normal = [1.0, 0.0, 0.0])] plane: PointOnPlane,
                #[joint(between = [ground, bead], point = [0.0, 0.0, 0.3], motion = {motion})] turning: Turning,
            }}"
        )
    };
    for wish in WISHES {
        for motion in ["time", "smooth_step((time - 10.0) / 0.5)", "1e-2 * time"] {
            let model = model(&text(wish, motion));
            let rank = Rank::Decided {
                rank: 2,
                at_start: 1,
            };
            assert_eq!(model.independence.rank, rank, "{motion}");
            assert_eq!(dropped(&model), [], "{motion}");
        }
    }
}

#[test]
fn rows_that_vanish_at_the_start_and_contradict_each_other_from_then_on_are_refused() {
    for wish in WISHES {
        let text = format!(
            "#[mechanism({wish})] struct Torn {{
                #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15])] body: Body,
                #[joint(between = [ground, body], axis = [-0.13, 0.54, 0.83], direction = [0.83, -1.23, 0.86])] torn: Alined,
            }}"
        );
        let text = refusal(&text);
        assert!(
            text.contains("contradicts equations of `torn`"),
            "{wish}: {text}"
        );
    }
}

#[test]
fn rows_that_begin_where_nothing_satisfies_them_are_not_left_out() {
    let text = |wish: &str| {
        format!(
            "#[mechanism({wish})] struct Far {{
                #[body(mass = 1.0, position = [0.1, 0.0, 0.0])] bead: Particle,
                #[joint(between = [ground, bead], point = [0.3, 0.2, 0.0])] far: Far,
            }}"
        )
    };
    for wish in ["", "redundant = \"drop\""] {
        let refused = refusal(&text(wish));
        assert!(
            refused.contains("the gradient of `far[0]` vanishes wherever"),
            "{refused:.300}"
        );
    }
    assert_eq!(
        model(&text("redundant = \"keep\"")).independence.dormant,
        [(0, 0)]
    );
}

/// A crank of 1 and a rod of 2 (or less) in the plane z = 0 from the origin along x, and a slider;
/// `more` joints.
fn slider_crank(wish: &str, angle: f64, rod: f64, more: &str) -> String {
    let (sine, cosine) = angle.sin_cos();
    let reach = cosine + (rod * rod - sine * sine).sqrt();
    format!(
        "#[mechanism({wish})] struct SliderCrank {{
            #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [{}, {}, 0.0])] crank: Body,
            #[body(mass = 1.0, position = [{reach}, 0.0, 0.0])] slider: Particle,
            #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])] hinge: Revolute,
            #[joint(between = [ground, slider], point = [{reach}, 0.0, 0.0], normal = [0.0, 0.0, 1.0])] plane: PointOnPlane,
            #[joint(between = [ground, slider], point = [{reach}, 0.0, 0.0], normal = [0.0, 1.0, 0.0])] guide: PointOnPlane,
            #[joint(between = [crank, slider], head = [{cosine}, {sine}, 0.0], tail = [{reach}, 0.0, 0.0], length = {rod:?})] rod: Distance,
            {more}
        }}",
        0.5 * cosine,
        0.5 * sine
    )
}

fn turn(law: &str) -> String {
    format!(
        "#[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = {law})] turn: AngleDriver,"
    )
}

/// Drives the slider to a place along x.
fn push(law: &str) -> String {
    format!(
        "#[joint(between = [ground, slider], point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]), axis = [1.0, 0.0, 0.0], motion = {law})] \
         push: DisplacementDriver,"
    )
}

#[test]
fn two_drivers_of_one_freedom_agree_or_contradict() {
    let right = "cos(time) + sqrt(4.0 - sin(time) * sin(time))";
    let both = |law: &str| format!("{} {}", turn("time"), push(law));
    let agreed = model(&slider_crank(
        "redundant = \"drop\"",
        0.0,
        2.0,
        &both(right),
    ));
    assert_eq!(dropped(&agreed), [("push".into(), vec![0])]);
    for (wrong, at) in [
        // The same place and speed at the start, a dead point.
        ("3.0", "time = "),
        ("3.0 - 0.5 * time * time", "time = "),
        ("3.0 - time", "time = 0 s"),
        ("2.5", "time = 0 s"),
    ] {
        for wish in WISHES {
            let text = refusal(&slider_crank(wish, 0.0, 2.0, &both(wrong)));
            assert!(
                text.contains("`push[0]` contradicts equations of") && text.contains(at),
                "{wrong}, {wish}: {text}"
            );
        }
    }
}

#[test]
fn an_arm_drawn_beyond_its_reach_contradicts_nothing() {
    // At 2 s the crank and the rod are in line.
    for law in [
        "3.0 - 0.25 * (2.0 - time) * (2.0 - time)",
        "2.0 + 0.5 * time",
        "2.0 + 0.5 * sin(time)",
    ] {
        let start = if law.starts_with('3') {
            "1.3181160716528182"
        } else {
            // cos of the angle between crank and guide: (1 + 4 - 4) / (2 * 1 * 2)
            "1.318116071652818"
        };
        let angle: f64 = start.parse().expect("a number");
        for wish in WISHES {
            let model = model(&slider_crank(wish, angle, 2.0, &push(law)));
            assert_eq!(dropped(&model), [], "{law}");
        }
    }
    // At the dead point from the start: pushed outwards, it cannot go; inwards, on either branch.
    for law in [
        "3.0 + 0.1 * time",
        "3.0 - 0.1 * time",
        "3.0 - 0.1 * time * time",
    ] {
        for wish in WISHES {
            let model = model(&slider_crank(wish, 0.0, 2.0, &push(law)));
            assert_eq!(dropped(&model), [], "{law}");
            let rank = Rank::Decided {
                rank: 9,
                at_start: 8,
            };
            assert_eq!(model.independence.rank, rank, "{law}");
        }
    }
}

/// Cranks side by side on one bar, the first of them driven.
fn parallelogram(wish: &str, cranks: usize) -> String {
    let mut text = format!("#[mechanism({wish})] struct Driven {{");
    for k in 0..cranks {
        text += &format!(
            "#[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [{k}.0, 0.5, 0.0])] crank{k}: Body,
             #[joint(between = [ground, crank{k}], point = [{k}.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])] foot{k}: Revolute,"
        );
    }
    text +=
        "#[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [1.0, 1.0, 0.0])] bar: Body,";
    for k in 0..cranks {
        text += &format!(
            "#[joint(between = [crank{k}, bar], point = [{k}.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])] head{k}: Revolute,"
        );
    }
    text + "#[joint(between = [ground, crank0], axis = [0.0, 0.0, 1.0], motion = 2.0 * time)] motor: AngleDriver, }"
}

#[test]
fn a_parallelogram_is_driven_over_its_flat_position() {
    // The third crank's equations follow from the others', and the drive leads through both dead
    // points.
    let model = model(&parallelogram("redundant = \"drop\"", 3));
    let rank = Rank::Decided {
        rank: 24,
        at_start: 24,
    };
    assert_eq!(model.independence.rank, rank);
    assert_eq!(model.independence.redundant.len(), 7);
    let motor = model.joints.last().expect("joints");
    assert_eq!(motor.dropped, [0; 0]);
}

#[test]
fn turns_are_counted_along_the_way() {
    // A nut on a screw: turn and displacement are driven, and agree by its pitch.
    let nut = |turn: &str, feed: &str| {
        format!(
            "#[mechanism(redundant = \"drop\")] struct Feed {{
                #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.0, 0.0, 0.0])] nut: Body,
                #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)] screw: Screw,
                #[joint(between = [ground, nut], axis = [0.0, 0.0, 1.0], motion = {turn})] turn: AngleDriver,
                #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], motion = {feed})] feed: DisplacementDriver,
            }}"
        )
    };
    for (turn, feed) in [
        ("TAU * time", "0.01 * time"),
        ("TAU * 100.0 * time", "time"),
        (
            "TAU * 20.0 * smooth_step(time / 5.0)",
            "0.2 * smooth_step(time / 5.0)",
        ),
        ("TAU * 3.0 * sin(10.0 * time)", "0.03 * sin(10.0 * time)"),
    ] {
        let model = model(&nut(turn, feed));
        assert_eq!(dropped(&model), [("feed".into(), vec![0])], "{turn}");
    }
    let text = refusal(&nut("TAU * time", "0.011 * time"));
    assert!(
        text.contains("`feed[0]` contradicts equations of `screw` and `turn`"),
        "{text}"
    );
}

#[test]
fn a_nut_goes_on_over_many_turns() {
    // Two nuts of one plate and one screw each: the sweep leads over turns, and the angles are
    // counted on.
    let model = model(
        "#[mechanism(redundant = \"drop\")] struct Nuts {
            #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.0, 0.0, 0.0])] nut: Body,
            #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.3)] first: Screw,
            #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.3)] second: Screw,
        }",
    );
    assert_eq!(dropped(&model), [("second".into(), vec![0, 1, 2, 3, 4])]);
}

/// A four-bar of spatial hinges in the plane z = 0 with links of given lengths, its crank at an
/// angle, and a motor of it.
fn four_bar([ground, crank, coupler, rocker]: [f64; 4], angle: f64, law: &str) -> Option<String> {
    let near = [crank * angle.cos(), crank * angle.sin()];
    let across = [ground - near[0], -near[1]];
    let distance = across[0].hypot(across[1]);
    let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
    let height = (coupler * coupler - along * along).sqrt();
    if height.is_nan() || height < 0.05 {
        return None;
    }
    let unit = across.map(|x| x / distance);
    let far = [
        near[0] + along * unit[0] - height * unit[1],
        near[1] + along * unit[1] + height * unit[0],
    ];
    let body = |name: &str, a: [f64; 2], b: [f64; 2]| {
        format!(
            "#[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [{:?}, {:?}, 0.0])] {name}: Body, ",
            0.5 * (a[0] + b[0]),
            0.5 * (a[1] + b[1])
        )
    };
    let hinge = |name: &str, between: &str, [x, y]: [f64; 2]| {
        format!(
            "#[joint(between = [{between}], point = [{x:?}, {y:?}, 0.0], axis = [0.0, 0.0, 1.0])] {name}: Revolute, "
        )
    };
    Some(
        String::from("#[mechanism(redundant = \"drop\")] struct FourBar { ")
            + &body("crank", [0.0, 0.0], near)
            + &body("coupler", near, far)
            + &body("rocker", far, [ground, 0.0])
            + &hinge("a", "ground, crank", [0.0, 0.0])
            + &hinge("b", "crank, coupler", near)
            + &hinge("c", "coupler, rocker", far)
            + &hinge("d", "rocker, ground", [ground, 0.0])
            + &format!(
                "#[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = {law})] motor: AngleDriver, }}"
            ),
    )
}

#[test]
fn driven_loops_contradict_nothing() {
    const LAWS: [&str; 6] = [
        "time",
        "-300.0 * time",
        "TAU * smooth_step((time - 1.0) / 2.0)",
        "2.0 * sin(3.0 * time)",
        "0.5 * time * time",
        "1e-3 * time",
    ];
    let mut state = 1_u32;
    let mut number = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let mut seen = 0;
    while seen < 30 {
        let law = LAWS[seen % LAWS.len()];
        // Some cranks turn all the way round, some are drawn beyond their reach, some loops fold
        // flat.
        let lengths = match seen % 5 {
            0 => [1.0, 1.0, 1.0, 1.0],
            1 => [1.0, 0.5, 1.0, 0.5],
            _ => [1.0, 0.2, 0.3, 0.3].map(|least| least + number()),
        };
        let angle = 0.1 + 3.0 * number();
        let Some(text) = four_bar(lengths, angle, law) else {
            continue;
        };
        seen += 1;
        let model = model(&text);
        let rank = Rank::Decided {
            rank: 18,
            at_start: 18,
        };
        assert_eq!(model.independence.rank, rank, "{lengths:?}, {angle}, {law}");
        assert_eq!(model.independence.redundant.len(), 3);
    }
}
