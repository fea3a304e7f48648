//! Every plan of a tree and of a loop, at states that violate the constraints: masses that joints
//! hand on, and rows in whatever order.

use holonom_engine::plan::candidates::all;
use holonom_engine::plan::kernels::{Kernels, solver};
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::Input;
use holonom_engine::symbolic::evaluate::evaluate;

use crate::common::{delivered, tokens};
use crate::dense::{Dice, SYMBOL, State, dense, deviation};
use crate::library;

/// A base with two branches, of which one has a body more; axes along principal axes and not,
/// masses that the macro cannot see.
const TREE: &str = "#[mechanism(gravity = [0.3, 0.0, -9.81])] struct Tree {
    #[body(mass = 3.0, inertia = [0.5, 0.3, 0.4], position = [0.1, 0.4, 0.0])] base: Body,
    #[body(mass = 1.5, inertia = [0.2, 0.1, 0.2], position = [0.1, 1.2, 0.1])] arm: Body,
    #[body(mass = LOAD, inertia = [0.1, 0.2, 0.3], position = [0.5, 0.8, -0.4])] ball: Body,
    #[body(mass = 0.7, inertia = [0.02, 0.05, 0.04], position = [0.1, 1.9, 0.3])] hand: Body,
    #[joint(between = [ground, base], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])] shoulder: Revolute,
    #[joint(between = [base, arm], point = [0.1, 0.8, 0.0], axis = [0.0, 0.6, 0.8])] elbow: Revolute,
    #[joint(between = [base, ball], point = [0.3, 0.8, -0.1])] socket: Spherical,
    #[joint(between = [arm, hand], point = [0.1, 1.6, 0.2], axis = [1.0, 0.0, 0.0])] wrist: Revolute,
    CLOSING
}";

const ROD: &str = "#[joint(between = [hand, ball], head = [0.1, 1.9, 0.3], tail = [0.5, 0.9, -0.4])] rod: Distance,";

fn judge(text: &str) {
    let model = delivered(&tokens(text), library::definition);
    let kernels = Kernels::new(&model);
    let described = State::described(&model, &kernels);
    let mut dice = Dice::new(11);
    let plans = all(&model, Terms::Plain);
    assert!(
        plans
            .iter()
            .any(|plan| plan.points.iter().all(Option::is_some))
    );
    for _ in 0..4 {
        let state = described.near(&model, 0.2, &mut dice);
        let (wanted, smallest) = dense(&model, &kernels, &state, 0.0);
        assert!(smallest > 1e-3, "the system is regular: {smallest:e}");
        let (upper, lower) = (state.of(&kernels.forces), state.of(&kernels.gamma));
        for plan in &plans {
            let fused = state.by_plan(&model, plan).solution;
            let difference = deviation(&fused, &wanted);
            assert!(difference < 1e-11, "fused: {difference:e}, {plan:?}");
            let solver = solver(&model, plan, Terms::Plain);
            let given = evaluate(&solver.arena, &solver.solution, |input| match input {
                Input::Coordinate(place) => state.coordinates.get(place as usize).copied(),
                Input::Velocity(place) => state.velocities.get(place as usize).copied(),
                Input::Upper(place) => upper.get(place as usize).copied(),
                Input::Lower(place) => lower.get(place as usize).copied(),
                Input::Symbol(_) | Input::Varying(_) => Some(SYMBOL),
                _ => None,
            });
            let given: Vec<f64> = given
                .into_iter()
                .map(|x| x.expect("a known input"))
                .collect();
            let difference = deviation(&given, &wanted);
            assert!(difference < 1e-11, "given: {difference:e}, {plan:?}");
        }
    }
}

#[test]
fn every_plan_of_a_tree() {
    judge(&TREE.replace("CLOSING", ""));
}

#[test]
fn every_plan_of_a_loop() {
    judge(&TREE.replace("CLOSING", ROD));
}
