//! The rank of the constraints at expansion: what is found, what is dropped, what is refused.

mod common;

use std::fmt::Write;

use common::{delivery, model, tokens};
use holonom_engine::emit::documentation::documentation;
use holonom_engine::model::{Model, Rank};
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::rank::judge;

/// Name, bodies, point, axis.
type Hinge<'a> = (&'a str, [&'a str; 2], [f64; 3], [f64; 3]);

/// A mechanism of bodies (name, position) with Euler parameters of a general direction, and hinges.
fn hinged(attribute: &str, bodies: &[(&str, [f64; 3])], hinges: &[Hinge<'_>]) -> Model {
    let mut text = format!("#[mechanism({attribute})] struct Hinged {{");
    for (name, position) in bodies {
        write!(
            text,
            "#[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = {position:?}, orientation = [0.1, 0.7, -0.3, 0.4])] {name}: Body,"
        )
        .expect("a string");
    }
    for (name, [i, j], point, axis) in hinges {
        write!(
            text,
            "#[joint(between = [{i}, {j}], point = {point:?}, axis = {axis:?})] {name}: Revolute,"
        )
        .expect("a string");
    }
    model(&tokens(&(text + "}")))
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn door(attribute: &str) -> Model {
    hinged(
        attribute,
        &[("leaf", [0.4, 1.0, 0.0])],
        &[
            ("lower", ["ground", "leaf"], [0.0, 0.25, 0.0], Y),
            ("upper", ["ground", "leaf"], [0.0, 1.75, 0.0], Y),
        ],
    )
}

/// The N-four-bar of the IFToMM library with spatial hinges: links of 1 m, at an angle from
/// upright.
fn four_bars(count: usize, angle: f64, attribute: &str) -> Model {
    let names: Vec<(String, String)> = (0..=count)
        .map(|i| (format!("link{i}"), format!("bar{i}")))
        .collect();
    let (sine, cosine) = angle.sin_cos();
    let mut bodies: Vec<(&str, [f64; 3])> = Vec::new();
    for (i, (link, bar)) in names.iter().enumerate() {
        bodies.push((link, [i as f64 + 0.5 * sine, 0.5 * cosine, 0.0]));
        if i < count {
            bodies.push((bar, [i as f64 + 0.5 + sine, cosine, 0.0]));
        }
    }
    let hinge_names: Vec<[String; 3]> = (0..=count)
        .map(|i| ["a", "b", "c"].map(|letter| format!("{letter}{i}")))
        .collect();
    let mut hinges: Vec<Hinge<'_>> = Vec::new();
    for (i, [a, b, c]) in hinge_names.iter().enumerate() {
        hinges.push((a, ["ground", &names[i].0], [i as f64, 0.0, 0.0], Z));
        let top = [i as f64 + sine, cosine, 0.0];
        if i > 0 {
            hinges.push((b, [&names[i - 1].1, &names[i].0], top, Z));
        }
        if i < count {
            hinges.push((c, [&names[i].0, &names[i].1], top, Z));
        }
    }
    hinged(attribute, &bodies, &hinges)
}

fn bricard(attribute: &str) -> Model {
    const P: [[f64; 3]; 6] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, -1.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, 0.0, 1.0],
    ];
    let rods = ["r1", "r2", "r3", "r4", "r5"];
    let joints = ["j1", "j2", "j3", "j4", "j5", "j6"];
    let bodies: Vec<_> = (0..5)
        .map(|k| (rods[k], [0, 1, 2].map(|c| 0.5 * (P[k][c] + P[k + 1][c]))))
        .collect();
    let at = |k: usize| rods.get(k).copied().unwrap_or("ground");
    let hinges: Vec<_> = (0..6)
        .map(|k| {
            let before = if k == 0 { "ground" } else { at(k - 1) };
            (joints[k], [before, at(k)], P[k], [Y, Z, X, Y, Z, X][k])
        })
        .collect();
    hinged(attribute, &bodies, &hinges)
}

fn chain(links: usize) -> Model {
    let names: Vec<(String, String)> = (0..links)
        .map(|i| (format!("link{i}"), format!("hinge{i}")))
        .collect();
    let bodies: Vec<(&str, [f64; 3])> = names
        .iter()
        .enumerate()
        .map(|(i, (name, _))| (name.as_str(), [0.0, i as f64 + 0.5, 0.0]))
        .collect();
    let hinges: Vec<_> = names
        .iter()
        .enumerate()
        .map(|(i, (name, hinge))| {
            let before = if i == 0 {
                "ground"
            } else {
                names[i - 1].0.as_str()
            };
            (
                hinge.as_str(),
                [before, name.as_str()],
                [0.0, i as f64, 0.0],
                X,
            )
        })
        .collect();
    hinged("", &bodies, &hinges)
}

fn decided(rank: usize, at_start: usize) -> Rank {
    Rank::Decided { rank, at_start }
}

fn rows(model: &Model) -> Vec<(usize, usize)> {
    let redundant = &model.independence.redundant;
    redundant.iter().map(|row| (row.joint, row.row)).collect()
}

fn refusal(text: &str) -> String {
    holonom_engine::assemble(delivery(&tokens(text))).to_string()
}

#[test]
fn a_chain_has_full_rank() {
    for links in [1, 2, 8] {
        let model = chain(links);
        assert_eq!(model.independence.rank, decided(5 * links, 5 * links));
        assert_eq!(rows(&model), []);
        assert_eq!(model.independence.undetermined, []);
    }
}

#[test]
fn two_hinges_on_one_edge() {
    let kept = door("redundant = \"keep\"");
    assert_eq!(kept.independence.rank, decided(5, 5));
    assert_eq!(rows(&kept), [(1, 0), (1, 1), (1, 2), (1, 3), (1, 4)]);
    assert_eq!(kept.independence.redundant[0].follows_from, [0]);
    assert_eq!(kept.layout().rows, 10);
    let dropped = door("redundant = \"drop\"");
    assert_eq!(rows(&dropped), rows(&kept));
    // Either hinge could carry the leaf alone, or both a part of it.
    let all: Vec<(usize, usize)> = (0..10).map(|row| (row / 5, row % 5)).collect();
    assert_eq!(kept.independence.undetermined, all);
    assert_eq!(dropped.independence.undetermined, all);
    assert_eq!(dropped.layout().rows, 5);
    assert_eq!(dropped.layout().row, [0, 5]);
    assert_eq!(judge(&dropped).rank, decided(5, 5));
}

#[test]
fn planar_loops_of_spatial_hinges() {
    for count in [1, 2, 5] {
        let keep = four_bars(count, 0.0, "redundant = \"keep\"");
        let equations = 15 * count + 5;
        assert_eq!(keep.layout().rows, equations);
        let rank = equations - 3 * count;
        assert_eq!(keep.independence.rank, decided(rank, rank));
        let drop = four_bars(count, 0.0, "redundant = \"drop\"");
        assert_eq!(drop.layout().rows, rank);
        let again = judge(&drop);
        assert_eq!((again.rank, again.redundant), (decided(rank, rank), vec![]));
        // Out of the plane the hinges hold each other: along z, and about axes across.
        let hinges = 0..3 * count + 1;
        let out_of_plane: Vec<_> = hinges
            .flat_map(|joint| [2, 3, 4].map(|row| (joint, row)))
            .collect();
        assert_eq!(keep.independence.undetermined, out_of_plane);
    }
}

/// A four-bar in the plane y = 0 on a base that turns about z.
fn slewing(attribute: &str, axis: [f64; 3]) -> Model {
    hinged(
        attribute,
        &[
            ("base", [0.1, 0.0, 0.0]),
            ("crank", [0.0, 0.0, 0.15]),
            ("rod", [0.25, 0.0, 0.35]),
            ("rocker", [0.5, 0.0, 0.2]),
        ],
        &[
            ("slew", ["ground", "base"], [0.0, 0.0, 0.0], axis),
            ("a", ["base", "crank"], [0.0, 0.0, 0.0], Y),
            ("b", ["crank", "rod"], [0.0, 0.0, 0.3], Y),
            ("c", ["rod", "rocker"], [0.5, 0.0, 0.4], Y),
            ("d", ["rocker", "base"], [0.5, 0.0, 0.0], Y),
        ],
    )
}

#[test]
fn what_is_left_out_of_a_loop_that_turns_is_along_its_normal() {
    let model = slewing("redundant = \"drop\"", Z);
    assert_eq!(model.independence.rank, decided(22, 22));
    let [(0, components)] = model.joints[4].components[..] else {
        panic!("{:?}", model.joints[4].components)
    };
    let dropped = &model.joints[4].dropped;
    let points: Vec<&usize> = dropped.iter().filter(|row| **row < 3).collect();
    let [&normal] = points[..] else {
        panic!("{dropped:?}")
    };
    // In axes of the base, whose orientation is a general one.
    let base = &model.bodies[0];
    let orientation = base.orientation.map(|e| model.seen(e).expect("written"));
    let axes = holonom_engine::model::inertia::rotation(orientation);
    assert_eq!(model.joints[4].bodies[components.place], Some(0));
    for (k, along) in components.axes.iter().enumerate() {
        let y: f64 = (0..3).map(|l| axes[1][l] * along[l]).sum();
        let wanted = if k == normal { 1.0 } else { 0.0 };
        assert!((y.abs() - wanted).abs() < 1e-12, "{k}: {y}");
    }
    // Where the plane only turns about its normal, components are along global axes.
    let model = slewing("redundant = \"drop\"", Y);
    assert!(model.joints.iter().all(|joint| joint.components.is_empty()));
    // What is kept is as it is written, and what is refused is named by it.
    let model = slewing("redundant = \"keep\"", Z);
    assert!(model.joints.iter().all(|joint| joint.components.is_empty()));
}

#[test]
fn what_is_left_out_between_bodies_with_many_points_in_common_turns_with_them() {
    let points = [[0.0; 3], X, Y, Z];
    let balls = points.iter().enumerate().map(|(k, point)| {
        format!("#[joint(between = [first, second], point = {point:?})] ball_{k}: Spherical,")
    });
    let bodies = ["first", "second"].map(|name| {
        format!(
            "#[body(free, mass = 1.0, inertia = [0.1, 0.2, 0.15], position = [0.2, 0.3, 0.1])] {name}: Body,"
        )
    });
    let text = bodies.into_iter().chain(balls).collect::<String>();
    let model = model(&tokens(&format!(
        "#[mechanism(redundant = \"drop\")] struct Stack {{ {text} }}"
    )));
    assert_eq!(model.independence.rank, decided(6, 6));
    for joint in &model.joints {
        let lost = joint.dropped.len();
        assert!(
            lost == 0 || lost == 3 || joint.components.len() == 1,
            "{lost}"
        );
    }
}

#[test]
fn a_singular_start_is_no_redundancy() {
    let right = 0.5 * std::f64::consts::PI;
    for count in [1, 2] {
        let model = four_bars(count, right, "redundant = \"drop\"");
        let rank = 12 * count + 5;
        assert_eq!(model.independence.rank, decided(rank, rank - count));
        assert_eq!(rows(&model).len(), 3 * count);
    }
}

#[test]
fn a_loop_that_moves_against_the_count() {
    let model = bricard("redundant = \"drop\"");
    assert_eq!(model.independence.rank, decided(29, 29));
    assert_eq!(rows(&model).len(), 1);
    assert_eq!(model.independence.degrees_of_freedom(30, 29), 1);
    assert_eq!(judge(&model).rank, decided(29, 29));
}

#[test]
fn a_long_kernel_is_written_in_parts_and_blocks() {
    let model = bricard("redundant = \"drop\"");
    let code = holonom_engine::emit::mechanism::emit(&model, &quote::quote!(::holonom));
    let file: syn::File = syn::parse2(code).expect("items");
    let [syn::Item::Const(item)] = &file.items[..1] else {
        panic!("everything stands in a constant")
    };
    let syn::Expr::Block(block) = &*item.expr else {
        panic!("a block")
    };
    let mut lengths = Vec::new();
    for statement in &block.block.stmts {
        if let syn::Stmt::Item(syn::Item::Fn(function)) = statement {
            let is_part = function.sig.ident.to_string().contains("_part_");
            lengths.push((is_part, function.block.stmts.len()));
        }
    }
    let parts = lengths.iter().filter(|(is_part, _)| *is_part).count();
    assert!(parts > 20, "{lengths:?}");
    // Scopes within each other: the compiler walks them by recursion.
    assert!(
        lengths.iter().all(|(_, length)| *length < 2000),
        "{lengths:?}"
    );
}

#[test]
fn the_documentation_says_it() {
    let text = |model: &Model| {
        let code = documentation(model, &Kernels::new(model)).to_string();
        code.lines().take(1).collect::<String>()
    };
    let kept = text(&door("redundant = \"keep\""));
    assert!(
        kept.contains("Degrees of freedom (velocities less the rank, 5): 1."),
        "{kept}"
    );
    assert!(kept.contains(
        "Redundant equations, kept, so that the formulation needs a compliance: `upper[0]`"
    ));
    let dropped = text(&door("redundant = \"drop\""));
    assert!(dropped.contains("5 constraint equations"), "{dropped}");
    assert!(dropped.contains("Redundant equations, left out: `upper[0]`"));
    let singular = text(&four_bars(
        1,
        0.5 * std::f64::consts::PI,
        "redundant = \"drop\"",
    ));
    assert!(
        singular.contains("It starts in a singular configuration, of rank 16."),
        "{singular}"
    );
}

#[test]
fn what_cannot_be_seen_is_not_decided() {
    let text = |point: &str| {
        format!(
            "struct Swing {{
                #[body(mass = crate::MASS, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.0])] rod: Body,
                #[joint(between = [ground, rod], point = {point})] first: Spherical,
                #[joint(between = [ground, rod], point = {point})] second: Spherical,
            }}"
        )
    };
    let hidden = model(&tokens(&text("[0.0, 0.0, crate::HEIGHT]")));
    assert_eq!(hidden.independence.rank, Rank::NotDecided);
    assert_eq!(hidden.independence.degrees_of_freedom(6, 6), 0);
    // A mass does not matter.
    let seen = refusal(&text("[0.0, 0.0, 0.3]"));
    assert!(
        seen.contains("all 3 equations of `second` are redundant"),
        "{seen}"
    );
    assert!(
        seen.contains("`second[0]`, `second[1]` and `second[2]` follow from equations of `first`"),
        "{seen}"
    );
    assert!(!seen.contains("equations of `first` are"), "{seen}");
}

#[test]
fn what_cannot_be_assembled_is_not_decided() {
    let model = model(&tokens(
        "struct Torn {
            #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])] rod: Body,
            #[joint(between = [ground, rod], point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]))] first: Spherical,
            #[joint(between = [ground, rod], point = local([0.0, 0.0, 1.0], [0.0, 0.0, 1.5]))] second: Spherical,
        }",
    ));
    assert_eq!(model.independence.rank, Rank::NotAssembled);
}

#[test]
fn an_inexact_start_is_assembled_first() {
    let model = model(&tokens(
        "struct Swing {
            #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.02, 1.0, -0.03])] rod: Body,
            #[joint(between = [ground, rod], point = local([0.0, 0.0, 0.0], [0.0, -1.0, 0.0]), axis = local([0.0, 0.1, 1.0], [0.0, 0.0, 1.0]))]
            hinge: Revolute,
        }",
    ));
    assert_eq!(model.independence.rank, decided(5, 5));
}

#[test]
fn constraints_that_touch_are_not_redundant() {
    // Two rods in line with a bead between them: either one alone would let it go.
    let model = model(&tokens(
        "struct Bead {
            #[body(mass = 0.1, position = [0.0, 0.0, 0.0])] bead: Particle,
            #[joint(between = [ground, bead], head = [-1.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 1.0)] left: Rod,
            #[joint(between = [ground, bead], head = [1.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 1.0)] right: Rod,
        }",
    ));
    assert_eq!(model.independence.rank, decided(2, 1));
}

#[test]
fn the_unit_of_length_does_not_matter() {
    for scale in [1e-30, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e30] {
        let at = |point: [f64; 3]| point.map(|x| scale * x);
        let model = hinged(
            "redundant = \"keep\"",
            &[("leaf", at([0.4, 1.0, 0.0]))],
            &[
                ("lower", ["ground", "leaf"], at([0.0, 0.25, 0.0]), Y),
                ("upper", ["ground", "leaf"], at([0.0, 1.75, 0.0]), Y),
            ],
        );
        assert_eq!(model.independence.rank, decided(5, 5), "{scale}");
    }
}

#[test]
fn rows_of_every_unit_stand_side_by_side() {
    // A body turns on an axis and hangs on a rod as well: 5 + 1 equations, m, rad and m^2.
    for scale in [1e-9, 1e-6, 1.0, 1e6, 1e9] {
        let at = |point: [f64; 3]| point.map(|x| scale * x);
        let text = format!(
            "struct Hung {{
                #[body(mass = 1.0, inertia = [0.1, 0.2, 0.15], position = {:?})] leaf: Body,
                #[joint(between = [ground, leaf], point = {:?}, axis = [0.0, 1.0, 0.0])] hinge: Revolute,
                #[joint(between = [ground, leaf], head = {:?}, tail = {:?}, length = {:?})] rod: Rod,
            }}",
            at([0.4, 1.0, 0.0]),
            at([0.0, 0.25, 0.0]),
            at([0.8, 1.0, 1.0]),
            at([0.8, 1.0, 0.0]),
            scale
        );
        assert_eq!(
            model(&tokens(&text)).independence.rank,
            decided(6, 6),
            "{scale}"
        );
    }
}
