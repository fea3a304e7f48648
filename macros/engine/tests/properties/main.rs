//! Random joints and forces: what the engine derives from their text equals what dual numbers say
//! of the same text.
//!
//! `D`, `Phi'`, `gamma` and `Phi_t` of the symbols are evaluated by numbers at random states. The
//! text is read a second time by an interpreter of its own ([`language`]), which knows no
//! derivative: it runs over num-dual's dual numbers of second order, along curves `q(h)`:
//!
//! * a column of `D`: `r + h`, or `p + h/2 L(p)^T d` with `d` a unit vector of the body;
//! * `Phi'` and `-gamma`: `q + q' h + 1/2 q'' h^2` without accelerations, at the time `t + h`;
//! * `Phi_t`: the time `t + h` alone;
//! * the generalised forces of a force: the curves of the columns of `D`.

#[path = "../common/mod.rs"]
mod common;
mod forces;
#[path = "../common/language.rs"]
mod language;
#[path = "../common/pose.rs"]
mod pose;
mod random;
#[path = "../common/reading.rs"]
mod reading;
#[path = "../common/writing.rs"]
mod writing;

use common::{checked, tokens};
use holonom_engine::model::{ElementKind, Model};
use holonom_engine::symbolic::arena::{Arena, Expr, Input};
use holonom_engine::symbolic::evaluate::evaluate;
use holonom_engine::symbolic::scene::Scene;
use holonom_engine::symbolic::vector::Frame;
use language::Interpreter;
use num_dual::Dual2_64;
use pose::Pose;
use random::{Dice, Joint};

/// Of the largest number that the interpreter met on the way.
const TOLERANCE: f64 = 1e-12;
const JOINTS: usize = 40;
const STATES: usize = 3;

/// The state of a mechanism at one instant.
struct State {
    time: f64,
    /// Of each body: position, Euler parameters.
    poses: Vec<([f64; 3], [f64; 4])>,
    /// Of each body: velocity, angular velocity in its axes.
    rates: Vec<([f64; 3], [f64; 3])>,
    /// Whole turns of every unwrapped angle.
    turns: Vec<f64>,
}

impl State {
    fn random(dice: &mut Dice, bodies: usize, angles: usize) -> Self {
        Self {
            time: 0.3 + 0.2 * dice.number(),
            poses: (0..bodies)
                .map(|_| (dice.vector(1.0), dice.unit_quaternion()))
                .collect(),
            rates: (0..bodies)
                .map(|_| (dice.vector(1.0), dice.vector(1.0)))
                .collect(),
            turns: (0..angles).map(|_| dice.below(7) as f64 - 3.0).collect(),
        }
    }
}

/// `1/2 L(p)^T w`: the rates of Euler parameters, `w` in body axes.
fn euler_rates(p: [f64; 4], w: [f64; 3]) -> [f64; 4] {
    let [e0, x, y, z] = p;
    let [a, b, c] = w;
    [
        -0.5 * (x * a + y * b + z * c),
        0.5 * (e0 * a + y * c - z * b),
        0.5 * (e0 * b + z * a - x * c),
        0.5 * (e0 * c + x * b - y * a),
    ]
}

/// A curve of poses: values, first and second derivatives.
fn pose(at: &([f64; 3], [f64; 4]), rate: [f64; 3], turn: [f64; 3]) -> Pose {
    let (r, p) = at;
    let first = euler_rates(*p, turn);
    let second = euler_rates(first, turn);
    Pose {
        position: [0, 1, 2].map(|k| Dual2_64::new(r[k], rate[k], 0.0)),
        euler: [0, 1, 2, 3].map(|k| Dual2_64::new(p[k], first[k], second[k])),
    }
}

/// What dual numbers say.
struct Judged {
    phi: Vec<f64>,
    rate: Vec<f64>,
    quadratic: Vec<f64>,
    by_time: Vec<f64>,
    /// By rows, then by bodies and their six velocities.
    gradients: Vec<Vec<f64>>,
    scale: f64,
}

/// `None` where something is near a point at which it has no derivative.
fn judged(joint: &Joint, state: &State) -> Option<Judged> {
    let still = [0.0; 3];
    let mut scale = 1.0_f64;
    let (element, starts) = joint.read();
    let mut rows = |poses: Vec<Pose>, time: Dual2_64| {
        let interpreter = Interpreter::new(&element, [&poses, &starts], &[], time, &state.turns);
        let rows = interpreter.rows();
        scale = scale.max(interpreter.scale.get());
        (!interpreter.singular.get()).then_some(rows)
    };
    let now = Dual2_64::new(state.time, 0.0, 0.0);
    let later = Dual2_64::new(state.time, 1.0, 0.0);
    let bodies = state.poses.iter().zip(&state.rates);
    let along = rows(bodies.map(|(at, (v, w))| pose(at, *v, *w)).collect(), later)?;
    let standing = || state.poses.iter().map(|at| pose(at, still, still));
    let by_time = rows(standing().collect(), later)?;
    let mut gradients = vec![Vec::new(); along.len()];
    for body in 0..state.poses.len() {
        for column in 0..6 {
            let mut unit = [0.0; 6];
            unit[column] = 1.0;
            let [a, b, c, d, e, f] = unit;
            let mut poses: Vec<Pose> = standing().collect();
            poses[body] = pose(&state.poses[body], [a, b, c], [d, e, f]);
            for (row, value) in gradients.iter_mut().zip(rows(poses, now)?) {
                row.push(value.v1);
            }
        }
    }
    Some(Judged {
        phi: along.iter().map(|row| row.re).collect(),
        rate: along.iter().map(|row| row.v1).collect(),
        quadratic: along.iter().map(|row| row.v2).collect(),
        by_time: by_time.iter().map(|row| row.v1).collect(),
        gradients,
        scale,
    })
}

/// What the engine derives, ready to be evaluated.
struct Derived {
    scene: Scene,
    /// `Phi`, then `Phi'`, then `Phi''` without accelerations.
    rows: [Vec<Expr>; 3],
    gradients: Vec<Vec<Expr>>,
}

impl Derived {
    fn new(mut scene: Scene, bodies: usize) -> Self {
        let mut rows = [Vec::new(), Vec::new(), Vec::new()];
        let mut gradients = Vec::new();
        for constraint in 0..scene.constraints.len() {
            for (order, rows) in rows.iter_mut().enumerate() {
                let mut factors = [Arena::ZERO; 3];
                factors[order] = Arena::ONE;
                rows.extend(scene.combination(constraint, Frame::Global, factors));
            }
            for gradient in scene.gradients(constraint, Frame::Global) {
                let space = &mut scene.space;
                let mut row = Vec::new();
                for body in 0..bodies {
                    let force = gradient.force(space, body);
                    row.extend(space.components(force, Frame::Global));
                    let moment = gradient.moment(space, body);
                    row.extend(space.components(moment, Frame::Body(body)));
                }
                gradients.push(row);
            }
        }
        Self {
            scene,
            rows,
            gradients,
        }
    }
}

/// The values of expressions at a state, at rest if not `moving`; `angles` are those that are
/// counted.
fn values(
    arena: &Arena,
    outputs: &[Expr],
    state: &State,
    moving: bool,
    angles: &[f64],
) -> Vec<f64> {
    let mut coordinates = Vec::new();
    for (r, p) in &state.poses {
        coordinates.extend(r);
        coordinates.extend(p);
    }
    // What was integrated is not quite the angle: it picks the turn, and the turn only.
    coordinates.extend(angles.iter().map(|angle| angle + 0.5));
    let mut velocities = Vec::new();
    for (v, w) in &state.rates {
        velocities.extend(v);
        velocities.extend(w);
    }
    let values = evaluate(arena, outputs, |input| match input {
        Input::Time => Some(state.time),
        Input::Coordinate(place) => coordinates.get(place as usize).copied(),
        Input::Velocity(_) if !moving => Some(0.0),
        Input::Velocity(place) => velocities.get(place as usize).copied(),
        _ => None,
    });
    values
        .into_iter()
        .map(|value| value.expect("a known input"))
        .collect()
}

/// The largest difference, over the scale.
fn deviation(derived: &[f64], judged: &[f64], scale: f64) -> f64 {
    assert_eq!(derived.len(), judged.len(), "numbers of equations");
    derived.iter().zip(judged).fold(0.0, |worst, (a, b)| {
        // Not a number is a deviation.
        let difference = (a - b).abs() / scale;
        if difference <= worst {
            worst
        } else {
            difference
        }
    })
}

fn model(joint: &Joint) -> Model {
    sound_model(joint).unwrap_or_else(|faults| panic!("faults: {faults}\n{joint}"))
}

/// The model, or why the engine refuses it.
fn sound_model(joint: &Joint) -> Result<Model, String> {
    let text = joint.definition();
    let find = |name: &str| (name == "Any").then(|| (joint.kind, tokens(&text)));
    checked(&tokens(&joint.mechanism()), find)
}

/// Whether an equation asks both normals of an axis to have one direction.
fn crosses_normals(joint: &Joint) -> bool {
    let text = joint.definition();
    text.lines().any(|line| {
        let equation = line.trim_start();
        equation.starts_with("cross(") && equation.contains(".normals()")
    })
}

#[test]
fn random_joints_against_dual_numbers() {
    let mut dice = Dice::new(1);
    let (mut compared, mut equations, mut worst) = (0, 0, 0.0_f64);
    let mut refused = 0;
    for _ in 0..JOINTS {
        let joint = Joint::random(ElementKind::Joint, &mut dice);
        let model = match sound_model(&joint) {
            Ok(model) => model,
            // As `cross(axis.normals(), v)`, which asks both normals to have one direction.
            Err(faults)
                if faults.contains("contradicts")
                    || faults.contains("brings it nearer") && crosses_normals(&joint) =>
            {
                refused += 1;
                continue;
            }
            Err(faults) => panic!("faults: {faults}\n{joint}"),
        };
        let angles = joint.turns(&model);
        let bodies = model.bodies.len();
        let scenes = [
            ("exact", Scene::new(&model)),
            ("homogeneous", Scene::for_solution(&model)),
            ("normalised", Scene::normalised(&model)),
        ];
        let scenes = scenes.map(|(name, scene)| (name, Derived::new(scene, bodies)));
        for _ in 0..STATES {
            let state = State::random(&mut dice, bodies, angles.len());
            let Some(judged) = judged(&joint, &state) else {
                continue;
            };
            compared += 1;
            equations += judged.phi.len();
            let counted = joint.angles(&angles, &state);
            for (name, derived) in &scenes {
                let of = |outputs: &[Expr], moving| {
                    values(
                        &derived.scene.space.arena,
                        outputs,
                        &state,
                        moving,
                        &counted,
                    )
                };
                let [phi, rate, quadratic] = &derived.rows;
                let mut found = [
                    ("Phi", of(phi, true), &judged.phi),
                    ("Phi'", of(rate, true), &judged.rate),
                    ("-gamma", of(quadratic, true), &judged.quadratic),
                    ("Phi_t", of(rate, false), &judged.by_time),
                ]
                .map(|(what, derived, judged_values)| {
                    (
                        what.to_string(),
                        deviation(&derived, judged_values, judged.scale),
                    )
                })
                .to_vec();
                for (row, (derived, judged_row)) in
                    derived.gradients.iter().zip(&judged.gradients).enumerate()
                {
                    let difference = deviation(&of(derived, true), judged_row, judged.scale);
                    found.push((format!("row {row} of D"), difference));
                }
                for (what, difference) in found {
                    assert!(
                        difference <= TOLERANCE,
                        "{what} ({name}) of\n{joint}\ndiffers by {difference:e}"
                    );
                    worst = worst.max(difference);
                }
            }
        }
    }
    println!("{compared} states, {equations} equations: largest deviation {worst:.1e}");
    assert!(
        compared > JOINTS * STATES / 2 && refused * 10 < JOINTS,
        "most states are sound: {compared}, {refused} joints refused"
    );
}
