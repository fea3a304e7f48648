//! Runs that go on from a checkpoint give what the whole run gives, to the last bit.

#![forbid(unsafe_code)]

mod crossed;
mod events;
mod files;
mod interactions;
mod methods;
mod trajectories;

use std::cell::Cell;

use holonom::mechanism::Coordinates;
use holonom::prelude::*;
use holonom::run::Checkpoint;
use holonom::{Runs, run::Reporting};
use holonom_fixtures as _;
use holonom_tests::is_exhaustive;
use serde_json::{from_str, to_string};

/// A door and a flap on it that a wound spring turns, driven by laws of time as well: angles that
/// are counted, and explicit time.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Flap {
    #[param]
    stiffness: f64,
    #[input]
    torque: f64,
    #[body(
        mass = 2.0, inertia = [[0.1, 0.01, 0.0], [0.01, 0.08, 0.0], [0.0, 0.0, 0.12]],
        position = [0.3, 0.1, 0.0], angular_velocity = [0.0, 0.0, 1.0], velocity = [-0.1, 0.3, 0.0]
    )]
    door: Body,
    #[body(
        mass = 1.0, inertia = [0.02, 0.03, 0.01], position = [0.8, 0.0, -0.2],
        angular_velocity = [0.0, 0.0, 1.0], velocity = [0.0, 0.8, 0.0]
    )]
    flap: Body,
    #[joint(between = [ground, door], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [door, flap], point = [0.6, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    pin: Revolute,
    #[force(
        between = [door, flap], axis = [0.0, 1.0, 0.0], stiffness = stiffness, damping = 0.05,
        free_angle = 9.0
    )]
    spring: TorsionalSpringDamper,
    #[force(
        between = [ground, door], axis = [0.0, 0.0, 1.0],
        moment = torque + 2.0 * sin(5.0 * time) + smooth_step((time - 0.3) / 0.2)
    )]
    motor: TorsionalActuator,
}

fn flap() -> Flap {
    Flap::new(0.7).expect("acceptable")
}

/// What an observer was shown.
type Shown<M> = Vec<(f64, StateOf<M>)>;

/// The times of a run and its reports.
const END: f64 = 1.0;

/// The whole run against those that go on from some of its checkpoints. A file keeps each of these
/// as it is, and a run goes on from a file. How many checkpoints there were.
fn goes_on<M, F, I, C>(
    what: &str,
    build: &dyn Fn() -> Simulation<'static, Problem<M, F, f64, C>, I>,
    reporting: Reporting<f64>,
) -> usize
where
    M: Mechanism,
    F: Formulation<f64>,
    I: Runs<Problem<M, F, f64, C>>,
    C: Coordinates<M>,
{
    let mut whole: Shown<M> = Vec::new();
    let shown = Cell::new(0);
    let mut kept = Vec::new();
    let look = |all: &mut Shown<M>, sample: &Sample<'_, f64, M>| {
        all.push((sample.time(), *sample.state()));
        shown.set(all.len());
    };
    let report = build()
        .checkpoints(1, |checkpoint: &Checkpoint<M>| {
            kept.push((shown.get(), checkpoint.clone()));
        })
        .run(0.0..=END, reporting, |sample| look(&mut whole, sample))
        .unwrap_or_else(|fault| panic!("{what}: {fault}"));
    let plain = build().run(0.0..=END, reporting, |_| ()).expect("it runs");
    assert_eq!(plain, report, "{what}: nothing is changed by checkpoints");

    let last = kept.len() - 1;
    let places = if is_exhaustive() {
        (0..=last).collect()
    } else {
        vec![0, 2, last / 2, last]
    };
    for place in places {
        let (before, checkpoint) = &kept[place];
        let mut tail: Shown<M> = Vec::new();
        let resumed = build()
            .resume(checkpoint, |sample| look(&mut tail, sample))
            .unwrap_or_else(|fault| panic!("{what} {place}: {fault}"));
        assert_eq!(resumed, report, "{what} {place} of {last}");
        assert!(
            tail == whole[*before..],
            "{what} {place}: {} of {}",
            tail.len(),
            whole.len()
        );

        let text = to_string(checkpoint).unwrap_or_else(|fault| panic!("{what}: {fault}"));
        let read: Checkpoint<M> = from_str(&text).unwrap_or_else(|fault| panic!("{what}: {fault}"));
        assert!(read == *checkpoint, "{what} {place}: {text}");
        if !is_exhaustive() && place != last / 2 {
            continue;
        }
        let mut again: Shown<M> = Vec::new();
        let from_file = build()
            .resume(&read, |sample| look(&mut again, sample))
            .expect("it goes on");
        assert!(again == tail, "{what} {place}: from a file");
        // A monitor that begins anew evaluates at its first steps, which counts as iterations.
        let counts = |report: &RunReport<f64, M>| {
            (
                (report.evaluations, report.accepted, report.rejected),
                report.worst_violation,
                (report.time, report.state),
            )
        };
        assert_eq!(counts(&from_file), counts(&report), "{what} {place}");
    }
    kept.len()
}
