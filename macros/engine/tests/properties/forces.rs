//! Generalised forces, energy and power of random forces.

use holonom_engine::model::ElementKind;
use holonom_engine::symbolic::arena::Expr;
use holonom_engine::symbolic::scene::Scene;
use holonom_engine::symbolic::vector::Frame;
use num_dual::Dual2_64;

use crate::language::{Acting, Interpreter};
use crate::pose::{Pose, constant, dot};
use crate::random::{Dice, Joint};
use crate::{STATES, State, TOLERANCE, deviation, model, pose, values};

const FORCES: usize = 40;

/// The generalised forces on the six velocities of every body, then energy and power, and the scale
/// of numbers; `None` near a singularity.
fn judged(force: &Joint, state: &State) -> Option<(Vec<f64>, f64)> {
    let still = [0.0; 3];
    let mut scale = 1.0_f64;
    let (element, starts) = force.read();
    let mut read = |poses: Vec<Pose>, rate: f64| {
        let time = Dual2_64::new(state.time, rate, 0.0);
        let interpreter = Interpreter::new(&element, [&poses, &starts], &[], time, &state.turns);
        let actions = interpreter.actions();
        scale = scale.max(interpreter.scale.get());
        (!interpreter.singular.get()).then_some(actions)
    };
    let standing = || state.poses.iter().map(|at| pose(at, still, still));
    let bodies = state.poses.iter().zip(&state.rates);
    let moving = read(bodies.map(|(at, (v, w))| pose(at, *v, *w)).collect(), 1.0)?;
    // What every action does along a curve, whose angular velocities are given in the axes of the
    // bodies.
    let along = |now: &Acting, curve: &Acting, turn: &dyn Fn(usize) -> [f64; 3]| match (now, curve)
    {
        (Acting::Potential(_), Acting::Potential(energy)) => -energy.v1,
        (Acting::Along(effort, _), Acting::Along(_, coordinate)) => effort.re * coordinate.v1,
        (Acting::Force(vector, _), Acting::Force(_, point)) => {
            (0..3).map(|k| vector[k].re * point[k].v1).sum()
        }
        (Acting::Moment(moment, body), _) => force.between[*body].map_or(0.0, |place| {
            let (r, p) = state.poses[place];
            let spin = Pose::still(r, p).outwards(turn(place).map(constant));
            dot(*moment, spin).re
        }),
        _ => unreachable!("one text gives one list of actions"),
    };
    let mut forces = Vec::new();
    for body in 0..state.poses.len() {
        for column in 0..6 {
            let mut unit = [0.0; 6];
            unit[column] = 1.0;
            let [a, b, c, d, e, f] = unit;
            let mut poses: Vec<Pose> = standing().collect();
            poses[body] = pose(&state.poses[body], [a, b, c], [d, e, f]);
            let curve = read(poses, 0.0)?;
            let turn = |place: usize| if place == body { [d, e, f] } else { still };
            let pairs = moving.iter().zip(&curve);
            forces.push(pairs.map(|(now, curve)| along(now, curve, &turn)).sum());
        }
    }
    let energy = moving.iter().map(|action| match action {
        Acting::Potential(energy) => energy.re,
        _ => 0.0,
    });
    forces.push(energy.sum());
    let spin = |place: usize| state.rates[place].1;
    let power = moving.iter().map(|action| match action {
        Acting::Potential(_) => 0.0,
        action => along(action, action, &spin),
    });
    forces.push(power.sum());
    Some((forces, scale))
}

/// The same of the engine.
fn derived(scene: &mut Scene, bodies: usize) -> Vec<Expr> {
    let gradient = scene.applied();
    let mut outputs = Vec::new();
    for body in 0..bodies {
        let space = &mut scene.space;
        let force = gradient.force(space, body);
        outputs.extend(space.components(force, Frame::Global));
        let moment = gradient.moment(space, body);
        outputs.extend(space.components(moment, Frame::Body(body)));
    }
    outputs.extend(scene.energy_and_power(0));
    outputs
}

#[test]
fn random_forces_against_dual_numbers() {
    let mut dice = Dice::new(2);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for _ in 0..FORCES {
        let force = Joint::random(ElementKind::Force, &mut dice);
        let model = model(&force);
        let angles = force.turns(&model);
        let bodies = model.bodies.len();
        let scenes = [
            ("exact", Scene::new(&model)),
            ("homogeneous", Scene::for_solution(&model)),
            ("normalised", Scene::normalised(&model)),
        ];
        let scenes = scenes.map(|(name, mut scene)| {
            let outputs = derived(&mut scene, bodies);
            (name, scene, outputs)
        });
        for _ in 0..STATES {
            let state = State::random(&mut dice, bodies, angles.len());
            let Some((judged, scale)) = judged(&force, &state) else {
                continue;
            };
            compared += 1;
            let counted = force.angles(&angles, &state);
            for (name, scene, outputs) in &scenes {
                let found = values(&scene.space.arena, outputs, &state, true, &counted);
                // A force times a derivative: two numbers of that scale.
                let difference = deviation(&found, &judged, scale * scale);
                assert!(
                    difference <= TOLERANCE,
                    "the forces ({name}) of\n{force}\ndiffer by {difference:e}"
                );
                worst = worst.max(difference);
            }
        }
    }
    println!("{compared} states: largest deviation {worst:.1e}");
    assert!(
        compared > FORCES * STATES / 2,
        "most states are sound: {compared}"
    );
}
