//! Operations of the accelerations in joint coordinates, by the way that takes the fewest. The
//! slope of a pair is the rate of its angle and costs nothing; those of Euler parameters are not
//! among them.

mod common;
#[allow(dead_code, reason = "other tests need all of it")]
#[path = "mechanisms/library.rs"]
mod library;

use common::{chain, delivered, tokens};
use holonom_engine::coordinates::candidates::{Method, Strategy, choose};
use holonom_engine::coordinates::system::Reduced;
use holonom_engine::model::Model;
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::Stage;
use holonom_engine::symbolic::count::{Count, count};

/// Four-bars side by side: a row of rods on the ground, each joined to the next at the top.
fn windows(count: usize) -> String {
    let mut text = String::from(
        "#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = \"drop\")] struct Windows {",
    );
    let axis = "axis = [0.0, 0.0, 1.0]";
    for rod in 0..=count {
        let x = rod as f64;
        text += &format!(
            "#[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [{x:?}, 0.5, 0.0])] rod_{rod}: Body,
            #[joint(between = [ground, rod_{rod}], point = [{x:?}, 0.0, 0.0], {axis})] foot_{rod}: Revolute,"
        );
    }
    for rod in 0..count {
        let (x, next) = (rod as f64, rod + 1);
        let (centre, end) = (x + 0.5, x + 1.0);
        text += &format!(
            "#[body(mass = 1.0, inertia = [0.001, 0.0833, 0.0833], position = [{centre:?}, 1.0, 0.0])] top_{rod}: Body,
            #[joint(between = [rod_{rod}, top_{rod}], point = [{x:?}, 1.0, 0.0], {axis})] left_{rod}: Revolute,
            #[joint(between = [top_{rod}, rod_{next}], point = [{end:?}, 1.0, 0.0], {axis})] right_{rod}: Revolute,"
        );
    }
    text + "}"
}

/// A cart of 1 kg and a point mass of 1 kg at 1 m, and nothing that pushes: what the model of the
/// catalogue is without its numbers and its motor.
const UNIT_CART_POLE: &str = "#[mechanism(gravity = [0.0, -9.81, 0.0])] struct UnitCartPole {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])] cart: Body,
    #[body(mass = 1.0, inertia = [1e-20, 1e-20, 1e-20], position = [0.0, 1.0, 0.0])] pole: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])] rail: Prismatic,
    #[joint(between = [cart, pole], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, -1.0])] hinge: Revolute,
}";

/// A boom that a screw jack lifts; `cut` keeps the screw among the equations.
fn jack(cut: &str) -> String {
    format!(
        "#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = \"joints\", redundant = \"drop\")] struct Jack {{
            #[body(mass = 20.0, inertia = [6.0, 6.0, 0.2], position = [0.9, 0.0, 0.5])] boom: Body,
            #[body(mass = 3.0, inertia = [0.1, 0.1, 0.02], position = [0.65, 0.0, 0.1])] tube: Body,
            #[body(mass = 2.0, inertia = [0.08, 0.08, 0.01], position = [0.8, 0.0, 0.3])] spindle: Body,
            #[joint(between = [ground, boom], point = [0.0, 0.0, 0.5], axis = [0.0, 1.0, 0.0])] shoulder: Revolute,
            #[joint(between = [ground, tube], point = [0.6, 0.0, 0.0], axis = [0.0, 1.0, 0.0])] foot: Revolute,
            #[joint({cut} between = [tube, spindle], point = [0.6, 0.0, 0.0], axis = [0.3, 0.0, 0.4], pitch = 0.02)]
            thread: Screw,
            #[joint(between = [spindle, boom], point = [0.9, 0.0, 0.4])] head: Spherical,
        }}"
    )
}

/// A struct of the crate with the models.
fn of_library(name: &str) -> String {
    let text = std::fs::read_to_string(format!(
        "{}/../../models/src/{name}.rs",
        env!("CARGO_MANIFEST_DIR")
    ))
    .expect("a file");
    let file = syn::parse_file(&text).expect("Rust");
    let item = file
        .items
        .into_iter()
        .filter_map(|item| match item {
            syn::Item::Struct(s) => Some(s),
            _ => None,
        })
        .next()
        .expect("a struct");
    quote::quote!(#item).to_string()
}

/// The cheapest way for some terms.
fn cheapest(model: &Model, terms: Terms) -> (Strategy, Count, usize) {
    let counts = Strategy::all(model).into_iter().map(|strategy| {
        let mut reduced = Reduced::of(model, strategy);
        let solution = reduced.solve(terms);
        let arena = &reduced.scene.space.arena;
        let count = count(arena, &solution.accelerations, Stage::State);
        (strategy, count, solution.checks.len())
    });
    let cheapest = counts.min_by_key(|(_, count, _)| count.weighted());
    cheapest.expect("there is a way")
}

#[test]
fn accelerations_in_joint_coordinates() {
    let mut scenes: Vec<(String, String)> = Vec::new();
    for rods in [1, 2, 4, 8, 32] {
        scenes.push((
            format!("{rods} parallel hinges"),
            chain("Revolute", rods, false),
        ));
    }
    for rods in [2, 4, 8] {
        scenes.push((
            format!("{rods} hinges in turn"),
            chain("Revolute", rods, true),
        ));
    }
    for rods in [2, 8] {
        scenes.push((format!("{rods} balls"), chain("Spherical", rods, false)));
    }
    for count in [1, 10, 40] {
        scenes.push((format!("{count} windows"), windows(count)));
    }
    scenes.push(("unit cart and pole".into(), UNIT_CART_POLE.into()));
    for name in ["slider_crank", "heavy_top", "cart_pole", "ur5", "panda"] {
        scenes.push((name.into(), of_library(name)));
    }
    scenes.push(("screw jack".into(), jack("")));
    scenes.push(("screw jack, the screw cut".into(), jack("cut,")));
    let mut text = String::new();
    for (name, item) in scenes {
        let model = delivered(&tokens(&item), |name| {
            library::definition(name).map(|(kind, text)| (kind, tokens(&text)))
        });
        text += &format!("{name}\n");
        let has_rows = !Reduced::of(&model, Strategy::ALL[0])
            .scene
            .constraints
            .is_empty();
        let terms: &[Terms] = if has_rows {
            &Terms::ALL
        } else {
            &[Terms::Plain]
        };
        for &terms in terms {
            let (Strategy { runs, method }, count, checks) = cheapest(&model, terms);
            text += &format!(
                "  {terms:?}: {} operations, {} of them reciprocals, depth {}, {checks} checks ({runs:?}, {method:?})\n",
                count.total(),
                count.divisions,
                count.depth
            );
        }
    }
    insta::assert_snapshot!("reduced", text);
}

/// A four-bar on a free body, of a base of 1 m, an upright rod, a coupler and a rocker.
fn on_a_free_base([rod, coupler, rocker]: [f64; 3]) -> String {
    let diagonal = 1.0_f64.hypot(rod);
    let along = (coupler.powi(2) - rocker.powi(2) + diagonal.powi(2)) / (2.0 * diagonal);
    let up = (coupler.powi(2) - along.powi(2)).sqrt();
    let (c, s) = (1.0 / diagonal, rod / diagonal);
    let (x, y) = (along * c + up * s, rod - along * s + up * c);
    let mut text = String::from(
        "#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = \"joints\", redundant = \"drop\")] struct OnABase {
            #[body(free, mass = 0.5, inertia = [0.2, 0.3, 0.4], position = [0.3, 0.2, 0.1])] base: Body,",
    );
    for (name, x, y) in [
        ("rod", 0.0, 0.5 * rod),
        ("coupler", 0.5 * x, 0.5 * (rod + y)),
        ("rocker", 0.5 * (1.0 + x), 0.5 * y),
    ] {
        text += &format!(
            "#[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [{x:?}, {y:?}, 0.0])] {name}: Body,"
        );
    }
    for (name, bodies, x, y) in [
        ("a", "base, rod", 0.0, 0.0),
        ("b", "rod, coupler", 0.0, rod),
        ("c", "coupler, rocker", x, y),
        ("d", "rocker, base", 1.0, 0.0),
    ] {
        text += &format!(
            "#[joint(between = [{bodies}], point = [{x:?}, {y:?}, 0.0], axis = [0.0, 0.0, 1.0])] {name}: Revolute,"
        );
    }
    text + "}"
}

/// Of three rods that can only rock, no two angles follow from the third everywhere. The base can
/// move in six more ways, and a sweep hardly turns the loop.
#[test]
fn velocities_follow_from_others_wherever_motion_leads() {
    for (lengths, method) in [
        ([0.8, 0.7, 0.75], Method::MassMatrix),
        ([0.3, 0.9, 0.7], Method::Dependent),
    ] {
        let model = delivered(&tokens(&on_a_free_base(lengths)), |name| {
            library::definition(name).map(|(kind, text)| (kind, tokens(&text)))
        });
        assert_eq!(choose(&model).0.method, method, "{lengths:?}");
    }
}
