//! Motion and reactions against closed forms and published references, problem by problem; what a
//! model gains and loses in energy.

#![forbid(unsafe_code)]

mod arms;
mod bricard;
mod cart_pole;
mod door;
mod driven_slider_crank;
mod euler_parameters;
mod flyball_governor;
mod four_bar;
mod heavy_chain;
mod heavy_top;
#[path = "../methods/pendulum.rs"]
mod pendulum;
mod rod_pendulum;
mod row_of_four_bars;
mod simple_pendulum;
mod slider_crank;
mod squeezing_mechanism;
mod variable_length_pendulum;

use core::f64::consts::{PI, TAU};

use holonom::prelude::*;
use holonom::{BodyHandle, DormandPrince853, JointCoordinates, StateParts, View, state::Array};
use holonom_fixtures as _;

/// Steps so small that the integration does not count.
fn tight() -> DormandPrince853<f64> {
    DormandPrince853::new(Tolerance {
        relative: 1e-11,
        absolute: 1e-13,
    })
}

/// Runs with [`tight`] steps to the last of these times (s, growing, multiples of `step`), shows
/// the samples at them with their place, and holds the violation of the constraints at every
/// multiple of `step` under `violation` (`Phi^T Phi`).
///
/// In both descriptions, but where a formulation iterates, which `descriptions` has by joints and
/// which takes long to compile; the report is that of the bodies.
fn at_times<M: JointCoordinates, F: Formulation<f64>>(
    model: &M,
    method: F,
    step: f64,
    times: &[f64],
    mut look: impl FnMut(usize, &Sample<'_, f64, M>),
) -> RunReport<f64, M> {
    let end = times.last().copied().expect("a time");
    // An angle has no size: a tolerance that is relative to positions of some centimetres asks for
    // more than the same one in radians.
    let tighter = DormandPrince853::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-13,
    });
    let mut looked = |seen: &mut usize, sample: &Sample<'_, f64, M>| {
        let here = |time: &f64| (time - sample.time()).abs() < 0.5 * step;
        if let Some(place) = times.iter().position(here) {
            *seen += 1;
            look(place, sample);
        }
        ControlFlow::Continue(())
    };
    let mut seen = [0; 2];
    let report = Simulation::new(model, method, tight())
        .run(0.0..=end, every(step), |sample| {
            looked(&mut seen[0], sample)
        })
        .expect("solvable");
    println!(
        "{method:?}: {} evaluations, violation {:e}",
        report.evaluations, report.worst_violation
    );
    assert_eq!(seen[0], times.len());
    if !F::ITERATED {
        let by_joints = Simulation::new(model, method, tighter)
            .joint_coordinates()
            .run(0.0..=end, every(step), |sample| {
                looked(&mut seen[1], sample)
            })
            .expect("solvable");
        println!(
            "{method:?}, joint coordinates: {} evaluations, violation {:e}",
            by_joints.evaluations, by_joints.worst_violation
        );
        assert_eq!(seen[1], times.len());
    }
    report
}

/// The largest deviation of the energy (J) from its reference over a run with [`tight`] steps.
fn change_of_energy<M: Mechanism, F: Formulation<f64>>(
    model: &M,
    method: F,
    end: f64,
    reference: f64,
) -> f64 {
    let mut worst = 0.0_f64;
    Simulation::new(model, method, tight())
        .run(0.0..=end, every(end / 100.0), |sample| {
            worst = worst.max((sample.energy() - reference).abs());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    println!("{method:?}: energy changes by {worst:e} J");
    worst
}

/// The largest difference of coordinates and velocities from those of the start, after a run with
/// [`tight`] steps.
fn difference_after<M: Mechanism>(model: &M, period: f64) -> f64 {
    let first = model.described_state().expect("described");
    let report = Simulation::new(model, Baumgarte::default(), tight())
        .run(0.0..=period, every(period), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let flat = |state: &M::State<f64>| {
        [
            state.coordinates().as_slice(),
            state.velocities().as_slice(),
        ]
        .concat()
    };
    let (first, last) = (flat(&first), flat(&report.state));
    let pairs = first.iter().zip(&last);
    let difference = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{}: {difference:e} after a period", M::REPORT.name);
    difference
}

/// The angle (rad, `-pi..=pi`) that an angle is above another, turns not counted.
fn difference(angle: f64, reference: f64) -> f64 {
    let turns = ((angle - reference) / TAU).round();
    angle - reference - turns * TAU
}

/// The angle (rad, `-pi..=pi`) by which a body that moves in the xy plane is turned about z.
fn angle_about_z<M: Mechanism>(view: &View<'_, f64, M>, body: BodyHandle<M>) -> f64 {
    let p = view.pose(body).orientation;
    let angle = 2.0 * p.k.atan2(p.w);
    if angle > PI {
        angle - TAU
    } else if angle < -PI {
        angle + TAU
    } else {
        angle
    }
}

/// The integral of samples at equal steps, by Simpson's rule; an even number of steps.
fn simpson(step: f64, samples: &[f64]) -> f64 {
    let weight = |place: usize| match place {
        0 => 1.0,
        place if place + 1 == samples.len() => 1.0,
        place if place % 2 == 1 => 4.0,
        _ => 2.0,
    };
    assert_eq!(samples.len() % 2, 1, "an even number of steps");
    let sum: f64 = samples
        .iter()
        .enumerate()
        .map(|(place, sample)| weight(place) * sample)
        .sum();
    step / 3.0 * sum
}
