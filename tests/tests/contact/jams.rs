//! Blocks whose friction jams: the normal efforts of corners that slip go to infinity.

use holonom::error::{ModeFault, SimulationError};
use holonom::nalgebra::{DMatrix, Matrix3, UnitQuaternion, Vector3};
use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::blocks::Block;

/// How a block is thrown along its floor: the coefficient of friction, its velocity along the floor
/// and its spin.
struct Throw {
    friction: f64,
    velocity: [f64; 2],
    spin: f64,
}

/// The steps of a run.
#[derive(Clone, Copy, Debug)]
enum Steps {
    Fixed(f64),
    Controlled(f64),
}

/// What a run has shown, or why it ended before.
struct Thrown {
    ended: Result<StateOf<Block>, SimulationError<StateOf<Block>>>,
    /// The largest energy that was gained between two instants, and the most that a corner pulled.
    gained: f64,
    pulled: f64,
    /// The corners that were closed last.
    closed: Vec<usize>,
}

/// When (s) runs end that do not jam.
const END: f64 = 0.03;

fn start(throw: &Throw) -> StateOf<Block> {
    let (block, h) = (Block::default(), Block::HANDLES);
    let mut start = block.described_state().expect("it is described");
    let [x, y] = throw.velocity;
    Block::set_velocity(&mut start, h.block, [x, y, 0.0].into());
    Block::set_angular_velocity(&mut start, h.block, [0.0, 0.0, throw.spin].into());
    start
}

fn contacts(throw: &Throw) -> [Interaction<f64, Block>; 12] {
    let h = Block::HANDLES;
    let floor = Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0]).along([1.0, 0.0, 0.0]);
    let [[a, b, c], [d, e, f], [g, i, j], [k, l, m]] = [h.first, h.second, h.third, h.fourth]
        .map(|corner| Interaction::contact(corner, floor).with_friction(throw.friction));
    [a, b, c, d, e, f, g, i, j, k, l, m]
}

fn thrown(throw: &Throw, steps: Steps) -> Thrown {
    let block = Block::default();
    let contacts = contacts(throw);
    let handles = Interaction::handles(&contacts);
    let (mut gained, mut pulled, mut energy) = (0.0_f64, 0.0_f64, f64::INFINITY);
    let mut closed = Vec::new();
    let observe = |sample: &Sample<'_, f64, Block>| {
        gained = gained.max(sample.energy() - energy);
        energy = sample.energy();
        closed.clear();
        for (corner, normal) in handles.iter().step_by(3).enumerate() {
            let effort = sample.effort(*normal).expect("it is evaluated");
            pulled = pulled.max(-effort);
            if sample.mode(*normal) == Ok(InteractionMode::AtLower) {
                closed.push(corner);
            }
        }
    };
    let ended = match steps {
        Steps::Fixed(step) => block
            .simulation(StandardLagrange, Rk4::every(step))
            .initial_state(start(throw))
            .interactions(contacts)
            .run(0.0..=END, every_step(), observe),
        Steps::Controlled(tolerance) => block
            .simulation(
                StandardLagrange,
                DormandPrince::new(Tolerance {
                    relative: tolerance,
                    absolute: tolerance,
                }),
            )
            .initial_state(start(throw))
            .interactions(contacts)
            .run(0.0..=END, every_step(), observe),
    };
    Thrown {
        ended: ended.map(|report| report.state),
        gained,
        pulled,
        closed,
    }
}

/// The determinant of the accelerations of corners by each other's efforts, over the product of
/// those by their own without friction. By the equations of Newton and Euler: an effort `N` at a
/// corner is a force `N (n - mu s)` there, with the direction `s` of its slip.
fn determinant(state: &StateOf<Block>, closed: &[usize], friction: f64) -> f64 {
    let (block, h) = (Block::default(), Block::HANDLES);
    let view = block.view(0.0, state).expect("a view");
    let orientation = UnitQuaternion::from_quaternion(view.pose(h.block).orientation);
    let rotation = orientation.to_rotation_matrix().into_inner();
    let inertia = Matrix3::from_diagonal(&[1.25, 1.25, 0.5].into());
    let compliance = (rotation * inertia * rotation.transpose()).try_inverse();
    let compliance = compliance.expect("it has a mass in all directions");
    let corners = [h.first, h.second, h.third, h.fourth];
    let arm = |corner: usize| view.position(corners[corner]) - view.position(h.block);
    let accelerates = |[at, by]: [usize; 2], friction: f64| {
        let slip = view.velocity(corners[by]);
        let slip = Vector3::new(slip.x, slip.y, 0.0).normalize();
        let force = Vector3::z() - friction * slip;
        let turns = compliance * arm(by).cross(&force);
        (force / 3.0 + turns.cross(&arm(at))).z
    };
    let matrix = DMatrix::from_fn(closed.len(), closed.len(), |row, column| {
        accelerates([closed[row], closed[column]], friction)
    });
    let alone = closed.iter().map(|&corner| accelerates([corner; 2], 0.0));
    matrix.determinant() / alone.product::<f64>()
}

/// It is refused by its name, by methods that control their error and by fixed steps, which else
/// lead across. Until then no corner has pulled, and no energy is gained.
#[test]
fn friction_that_jams_is_refused_whatever_the_steps_are() {
    let throws = [
        (1.308, [1.4615, 0.4249], -0.25),
        (2.184, [0.7793, -0.8311], -2.501),
        (1.427, [-0.1733, 1.2301], 2.2466),
    ];
    let all = [
        Steps::Controlled(1e-9),
        Steps::Controlled(1e-12),
        Steps::Fixed(3e-3),
        Steps::Fixed(1e-2),
    ];
    for (friction, velocity, spin) in throws {
        let throw = Throw {
            friction,
            velocity,
            spin,
        };
        let mut instant = None;
        for steps in all {
            let run = thrown(&throw, steps);
            let error = run.ended.expect_err("it jams");
            let fault = error.fault;
            assert!(is_jam(fault), "{friction} {steps:?}: {error}");
            let off = error.time - *instant.get_or_insert(error.time);
            assert!(off.abs() < 1e-5, "{friction} {steps:?}: {off:e}");
            let left = determinant(&error.state, &run.closed, friction);
            assert!(left.abs() < 1e-3, "{friction} {steps:?}: {left:e}");
            let (gained, pulled) = (run.gained, run.pulled);
            assert!(
                gained < 1e-8 && pulled < 1e-8,
                "{steps:?}: {gained:e} {pulled:e}"
            );
        }
        for step in [1e-3, 3e-3] {
            let time = match stepped(&throw, step) {
                Err(Fault::Mode(ModeFault::NoUniqueFriction { time, .. })) => time,
                ended => panic!("{friction} {step}: {ended:?}"),
            };
            let off = time - instant.expect("it jams");
            assert!(off.abs() < 1e-5, "{friction} {step}: {off:e}");
        }
    }
}

fn is_jam(fault: Fault) -> bool {
    matches!(fault, Fault::Mode(ModeFault::NoUniqueFriction { .. }))
}

/// Where the block is at the end, by steps in a loop of one's own.
fn stepped(throw: &Throw, step: f64) -> Result<Vector3<f64>, Fault> {
    let block = Block::default();
    let mut stepper = block
        .stepper(StandardLagrange, Rk4)?
        .interactions(contacts(throw));
    let mut state = stepper.state_of(&start(throw))?;
    while END - stepper.time() > 1e-9 {
        let left = END - stepper.time();
        stepper.step(&mut state, step.min(left))?;
    }
    let bodies = stepper.bodies(&state);
    Ok(stepper.view(&bodies).position(Block::HANDLES.block))
}

/// Stages of long steps look beyond where a corner lifts off, and find a jam there that is none.
#[test]
fn a_corner_that_lifts_off_before_a_jam_goes_on() {
    let throws = [
        (1.154, [0.4665, -1.1684], -1.9733),
        (1.262, [-0.4826, -1.0326], -2.0136),
        (1.0723, [-1.0775, 0.3111], 2.5685),
    ];
    for (friction, velocity, spin) in throws {
        let throw = Throw {
            friction,
            velocity,
            spin,
        };
        let place = |steps| {
            let ended = thrown(&throw, steps).ended;
            let state = ended.unwrap_or_else(|error| panic!("{friction} {steps:?}: {error}"));
            let view = Block::default().view(END, &state).expect("a view");
            view.position(Block::HANDLES.block)
        };
        let exact = place(Steps::Controlled(1e-9));
        for step in [3e-3, 1e-2] {
            let stepped = stepped(&throw, step);
            let stepped = stepped.unwrap_or_else(|fault| panic!("{friction} {step}: {fault}"));
            for place in [place(Steps::Fixed(step)), stepped] {
                let off = (place - exact).norm();
                assert!(off < 2e-5, "{friction} {step}: {off:e}");
            }
        }
    }
}
