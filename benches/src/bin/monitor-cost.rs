//! What the monitor of a run costs: the time of a monitored run over that of an unmonitored one.
//! Both run in turn in one process; the medians of the ratios are shown.
//!
//! ```text
//! cargo run --release -p holonom-benches --features monitor-cost --bin monitor-cost
//! ```
//!
//! An argument selects the rows whose names contain it, such as `"UR5 relative"`. Rotors turn at
//! 300 rad/s, beside a pendulum and on it. The program ends with an error where a ratio is above
//! its bound: 1.3, and 1.6 for pendulums. One run has a dozen steps, so that what the monitor does
//! at the start counts.

#![forbid(unsafe_code)]

use std::process::ExitCode;
use std::time::Instant;

use comfy_table::Table;
use holonom::joints::Revolute;
use holonom::mechanism::{Absolute, Relative};
use holonom::prelude::*;
use holonom::{JointCoordinates, Runs};
use holonom_models::{FourBar, RodPendulum, SqueezingMechanism, Ur5};

/// A rod on a hinge, and a rotor that has nothing to do with it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Beside {
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[body(
        mass = 1.0,
        inertia = [0.01, 0.01, 0.02],
        position = [2.0, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, 300.0]
    )]
    rotor: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rotor], point = [2.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
}

/// A rod on a hinge with a rotor at its end.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Aboard {
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[body(
        mass = 0.1,
        inertia = [0.00002, 0.00001, 0.00001],
        position = [0.0, 1.0, 0.0],
        angular_velocity = [300.0, 0.0, 0.0]
    )]
    rotor: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [rod, rotor], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
}

/// A parallelogram of links of 1 m that hangs from two pins, drawn aside by 0.6 rad.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
struct Swing {
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [0.5 * sin(0.6), -0.5 * cos(0.6), 0.0]
    )]
    left: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [0.5 + sin(0.6), -cos(0.6), 0.0]
    )]
    coupler: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [1.0 + 0.5 * sin(0.6), -0.5 * cos(0.6), 0.0]
    )]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_pin: Revolute,
    #[joint(
        between = [left, coupler],
        point = [sin(0.6), -cos(0.6), 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    left_end: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_pin: Revolute,
    #[joint(
        between = [coupler, right],
        point = [1.0 + sin(0.6), -cos(0.6), 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    right_end: Revolute,
}

/// Of how many pairs of runs a median is taken.
const PAIRS: usize = 201;

/// The time (s) that a measured run takes at least: shorter ones are repeated. Others seldom take
/// the processor within it.
const LEAST: f64 = 5e-4;

/// A scene with the bound of its ratios.
struct Scene<M> {
    name: &'static str,
    mechanism: M,
    /// How long it moves (s).
    end: f64,
    bound: f64,
}

/// The median ratio, the time of an unmonitored step (s), and the number of steps.
fn cost<M, I>(scene: &Scene<M>, integrator: I, is_relative: bool) -> (f64, f64, usize)
where
    M: JointCoordinates,
    I: Runs<Problem<M, StandardLagrange, f64, Absolute>>
        + Runs<Problem<M, StandardLagrange, f64, Relative>>,
{
    let simulation = |is_monitored| {
        let simulation = Simulation::new(&scene.mechanism, StandardLagrange, integrator);
        if is_monitored {
            simulation
        } else {
            simulation.unmonitored()
        }
    };
    let nothing = |_: &Sample<'_, f64, M>| ControlFlow::Continue(());
    let (span, reports) = (|| 0.0..=scene.end, || every(scene.end));
    let run = |is_monitored| {
        let began = Instant::now();
        let report = if is_relative {
            let simulation = simulation(is_monitored).joint_coordinates();
            simulation.run(span(), reports(), nothing)
        } else {
            let simulation = simulation(is_monitored).absolute_coordinates();
            simulation.run(span(), reports(), nothing)
        };
        let report = report.unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        (began.elapsed().as_secs_f64(), report.accepted)
    };
    let (_, steps) = run(false);
    let (once, _) = run(false);
    let times = (LEAST / once).ceil() as usize;
    let several = |is_monitored| (0..times).map(|_| run(is_monitored).0).sum::<f64>();
    let mut ratios = Vec::with_capacity(PAIRS);
    let mut bare = Vec::with_capacity(PAIRS);
    for _ in 0..PAIRS {
        let (monitored, unmonitored) = (several(true), several(false));
        ratios.push(monitored / unmonitored);
        bare.push(unmonitored / (times * steps) as f64);
    }
    (median(ratios), median(bare), steps)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Adds the rows of a scene; tells whether all of its ratios are within its bound.
fn rows<M: JointCoordinates>(table: &mut Table, scene: &Scene<M>, step: f64) -> bool {
    let chosen = std::env::args().nth(1).unwrap_or_default();
    let mut is_within = true;
    for (coordinates, is_relative) in [("absolute", false), ("relative", true)] {
        for method in [None, Some(step)] {
            let name = method.map_or("ode45 1e-6".to_owned(), |step| format!("Rk4 {step:e}"));
            if !format!("{} {coordinates} {name}", scene.name).contains(&chosen) {
                continue;
            }
            let (ratio, bare, steps) = match method {
                None => cost(scene, DormandPrince::default(), is_relative),
                Some(step) => cost(scene, Rk4::every(step), is_relative),
            };
            is_within &= ratio <= scene.bound;
            table.add_row([
                scene.name.to_owned(),
                coordinates.to_owned(),
                name,
                steps.to_string(),
                format!("{:.2}", bare * 1e6),
                format!("{ratio:.2}"),
                format!("{:.1}", scene.bound),
            ]);
        }
    }
    is_within
}

fn main() -> ExitCode {
    let mut table = Table::new();
    table.set_header([
        "scene",
        "coordinates",
        "method",
        "steps",
        "us a step",
        "ratio",
        "bound",
    ]);
    macro_rules! scenes {
        ($($name:literal: $mechanism:ty, $end:literal s, step $step:literal, bound $bound:literal;)*) => {
            [$({
                let scene = Scene {
                    name: $name,
                    mechanism: <$mechanism>::default(),
                    end: $end,
                    bound: $bound,
                };
                rows(&mut table, &scene, $step)
            }),*]
        };
    }
    let are_within = scenes! {
        "pendulum": RodPendulum, 10.0 s, step 1e-2, bound 1.6;
        "four-bar": Swing, 5.0 s, step 1e-3, bound 1.3;
        "four-bar up to where it is singular": FourBar, 0.65 s, step 1e-3, bound 2.6;
        "UR5": Ur5, 1.0 s, step 1e-3, bound 1.3;
        "squeezing mechanism": SqueezingMechanism, 0.03 s, step 1e-5, bound 1.3;
        "pendulum beside a rotor": Beside, 10.0 s, step 1e-3, bound 1.6;
        "rotor on a pendulum": Aboard, 10.0 s, step 1e-3, bound 1.6;
    };
    println!("{table}");
    if are_within.iter().all(|&is_within| is_within) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
