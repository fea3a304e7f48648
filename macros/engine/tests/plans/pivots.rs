//! Whatever a plan says is correct to round-off.

use holonom_engine::model::ElementKind;
use holonom_engine::plan::candidates::all;
use holonom_engine::plan::kernels::Kernels;
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::Stage;
use holonom_engine::symbolic::count::count;
use proc_macro2::TokenStream;

use crate::common::{delivered, tokens};
use crate::dense::{Dice, Evaluated, State, compliance, dense, deviation, evaluated};
use crate::library;

/// Joints of three bodies, of which some rows act on two.
const ODD: [(&str, &str); 4] = [
    (
        "Odd",
        "Odd(i, j, k; point: Point, axis: Axis) { j.point - i.point; dot(k.axis.normals(), j.axis); }",
    ),
    (
        "Both",
        "Both(i, j, k; point: Point, axis: Axis) { \
         j.point - i.point; dot(i.axis.normals(), j.axis); dot(i.axis.normals(), k.axis); }",
    ),
    (
        "Mean",
        "Mean(i, j, k; point: Point, axis: Axis) { \
         k.point + j.point - 2.0 * i.point; dot(i.axis.normal(), j.axis) - dot(k.axis.normal(), j.axis); }",
    ),
    (
        "Overfull",
        "Overfull(i, j, k; point: Point, axis: Axis) { \
         j.point - i.point; dot(i.axis.normals(), j.axis); dot(i.axis.normal(), j.axis.binormal()); \
         j.point - k.point; dot(k.axis.normals(), j.axis); }",
    ),
];

fn find(name: &str) -> Option<(ElementKind, TokenStream)> {
    let own = ODD.iter().find(|(known, _)| *known == name);
    own.map_or_else(
        || library::definition(name),
        |(_, text)| Some((ElementKind::Joint, tokens(text))),
    )
}

/// Compares all evaluations with a dense solution, at the described state and at others.
fn judge(text: &str) -> Vec<f64> {
    let model = delivered(&tokens(text), find);
    let kernels = Kernels::new(&model);
    let described = State::described(&model, &kernels);
    let mut dice = Dice::new(7);
    let mut states = vec![described.clone()];
    states.extend([0; 4].map(|_| described.near(&model, 0.1, &mut dice)));
    for state in &states {
        for (terms, compliance) in [(Terms::Plain, 0.0), (Terms::Compliant, compliance())] {
            if terms == Terms::Compliant {
                continue;
            }
            let (wanted, smallest) = dense(&model, &kernels, state, compliance);
            assert!(smallest > 1e-3, "the system is regular: {smallest:e}");
            let found = evaluated(&model, &kernels, terms, state);
            let difference = deviation(&found.solution, &wanted);
            assert!(
                difference < 1e-11,
                "{terms:?}: {difference:e}\n{found:?}\n{wanted:?}",
                found = found.solution
            );
            let least = found
                .pivots
                .iter()
                .fold(1.0_f64, |m, pivot| m.min(pivot.abs()));
            assert!(
                least > 1e-3,
                "a regular system has no small pivot: {:?}",
                found.pivots
            );
        }
    }
    let found = evaluated(&model, &kernels, Terms::Plain, &states[0]);
    found.solution
}

/// Two links, and a joint of three bodies.
const LINKS: &str = "struct Case {
    #[body(mass = 3.0, inertia = [0.3, 0.6, 0.7], position = [0.3, 0.5, 0.7])]
    upper: Body,
    #[body(mass = 2.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.5, 0.0])]
    lower: Body,
    #[body(mass = 1.0, inertia = [0.5, 0.3, 0.4], position = [0.2, 0.1, -0.4])]
    vane: Body,
    #[joint(between = [ground, upper], point = [0.3, 0.0, 0.5], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.1, 0.2, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[joint(between = [upper, vane, lower], point = [0.1, 0.2, -0.3], axis = [0.0, 1.0, 0.0])]
    odd: Odd,
}";

#[test]
fn plans_in_any_order() {
    let mut dice = Dice::new(3);
    let model = delivered(&tokens(LINKS), find);
    let kernels = Kernels::new(&model);
    // The one with the fewest pivots: of single multipliers few orders are possible.
    let plans = all(&model, Terms::Plain);
    let described = State::described(&model, &kernels);
    let mut right = 0;
    for round in 0..60 {
        let state = described.near(&model, 0.2, &mut dice);
        let mut plan = plans[0].clone();
        for k in (1..plan.pivots.len()).rev() {
            plan.pivots.swap(k, dice.below(k + 1));
        }
        let (wanted, _) = dense(&model, &kernels, &state, 0.0);
        let Evaluated { solution, pivots } = state.by_plan(&model, &plan);
        let least = pivots.iter().fold(1.0_f64, |m, pivot| m.min(pivot.abs()));
        if least > 1e-6 {
            let difference = deviation(&solution, &wanted);
            let plan = plan.pivots;
            assert!(difference < 1e-9, "round {round}: {difference:e}, {plan:?}");
            right += 1;
        }
    }
    assert!(
        right > 40,
        "an order that is not possible is rare: {right} of 60"
    );
}

#[test]
#[should_panic(expected = "a plan eliminates every unknown once")]
fn a_plan_that_forgets_an_unknown() {
    let model = delivered(&tokens(LINKS), find);
    let kernels = Kernels::new(&model);
    let mut plan = kernels
        .plans
        .as_ref()
        .expect("bodies are fused")
        .rigid
        .clone();
    plan.pivots.pop();
    State::described(&model, &kernels).by_plan(&model, &plan);
}

#[test]
fn rows_that_forbid_a_motion_against_a_body_that_is_gone_before() {
    let accelerations = judge(
        "#[mechanism(gravity = [0.0, 0.0, -9.81])] struct Case {
            #[body(mass = 2.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.5, 0.0], velocity = [0.0, 0.0, 0.5],
                angular_velocity = [1.0, 0.0, 0.0])]
            a: Body,
            #[body(mass = 3.0, inertia = [0.3, 0.6, 0.7], position = [0.3, 0.5, 0.7])]
            b: Body,
            #[joint(between = [ground, a, b], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            odd: Odd,
            #[force(between = [ground, b], point = [0.3, 0.5, 1.0], force = [1.0, 2.0, 3.0])]
            push: PointForce,
        }",
    );
    // 0.3 N m over 0.2 + 0.6 kg m^2.
    for w in [accelerations[4], accelerations[10]] {
        assert!((w - 0.375).abs() < 1e-12, "{w}");
    }
}

#[test]
fn rows_of_a_tree_joint_that_do_not_act_on_the_body_that_it_carries() {
    judge(
        "struct Case {
            #[body(mass = 3.0, inertia = [0.3, 0.6, 0.7], position = [0.3, 0.5, 0.7])]
            b: Body,
            #[body(mass = 2.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.5, 0.0])]
            a: Body,
            #[joint(between = [ground, b], point = [0.3, 0.0, 0.5])]
            ball: Spherical,
            #[joint(between = [ground, a, b], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
            both: Both,
        }",
    );
}

#[test]
fn a_point_row_of_two_bodies_against_a_third() {
    judge(
        "struct Case {
            #[body(mass = 3.0, inertia = [0.3, 0.6, 0.7], position = [0.3, 0.5, 0.7])]
            b: Body,
            #[body(mass = 2.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.5, 0.0])]
            a: Body,
            #[body(mass = 1.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.1, -0.4])]
            c: Body,
            #[joint(between = [ground, b], point = [0.3, 0.0, 0.5])]
            ball: Spherical,
            #[joint(between = [b, a, c], point = [0.1, 0.2, 0.0], axis = [1.0, 0.0, 0.0])]
            mean: Mean,
            #[joint(between = [a, c], point = [0.1, 0.2, -0.3], axis = [1.0, 0.0, 0.0])]
            hinge: Revolute,
        }",
    );
}

#[test]
fn more_rows_on_a_body_than_it_has_accelerations() {
    judge(
        "struct Case {
            #[body(mass = 3.0, inertia = [0.3, 0.6, 0.7], position = [0.3, 0.5, 0.7])]
            b: Body,
            #[body(mass = 2.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.5, 0.0])]
            a: Body,
            #[body(mass = 1.0, inertia = [0.5, 0.2, 0.4], position = [0.0, 0.1, -0.4])]
            c: Body,
            #[joint(between = [a, b, c], point = [0.1, 0.2, 0.0], axis = [1.0, 0.0, 0.0])]
            full: Overfull,
            #[joint(between = [ground, a], point = [0.3, 0.0, 0.5])]
            ball: Spherical,
            #[joint(between = [ground, c], point = [-0.3, 0.4, 0.2])]
            other: Spherical,
        }",
    );
}

/// Three rods of unequal length on four hinges.
const FOUR_BAR: &str = "#[mechanism(redundant = \"drop\")] struct FourBar {
    #[body(mass = 1.0, inertia = [0.08, 0.09, 0.02], position = [0.0, 0.0, 0.5])] left: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.02, 0.12], position = [0.0, 0.6, 1.1])] top: Body,
    #[body(mass = 1.5, inertia = [0.11, 0.1, 0.03], position = [0.0, 1.2, 0.6])] right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])] first: Revolute,
    #[joint(between = [left, top], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])] second: Revolute,
    #[joint(between = [ground, right], point = [0.0, 1.2, 0.0], axis = [1.0, 0.0, 0.0])] third: Revolute,
    #[joint(between = [right, top], point = [0.0, 1.2, 1.2], axis = [1.0, 0.0, 0.0])] fourth: Revolute,
}";

/// What the pivots of the closing rows would be without the other rows depends on orientations
/// alone and varies little: a number stands for it, which no pivot exceeds.
#[test]
fn pivots_that_are_compared_with_numbers() {
    let model = delivered(&tokens(FOUR_BAR), find);
    let kernels = Kernels::new(&model);
    let described = State::described(&model, &kernels);
    let plain = &kernels.evaluations[0];
    let reciprocals = count(&plain.kernel.arena, &plain.kernel.outputs, Stage::State).divisions;
    // Three orientations, three hinges, the motion that each of two bodies keeps within the others,
    // two closing rows.
    assert_eq!(reciprocals, 9);
    let mut dice = Dice::new(5);
    for _ in 0..200 {
        let state = described.near(&model, 3.0, &mut dice);
        let found = evaluated(&model, &kernels, Terms::Plain, &state);
        let closing = &found.pivots[found.pivots.len() - 2..];
        assert!(
            closing.iter().all(|pivot| *pivot > 0.0 && *pivot < 1.02),
            "{closing:?}"
        );
    }
}
