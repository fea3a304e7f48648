//! Runs in joint coordinates that seldom report: bodies are converted when somebody looks.

#![forbid(unsafe_code)]

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom::run::Reporting;

/// A rotor on an arm, and a body on a ball joint beside them: all turn by radians between reports.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Spinning {
    #[body(mass = 2.0, inertia = [0.2, 0.3, 0.4], position = [0.5, 0.0, 0.0],
           angular_velocity = [0.0, 0.0, 3.0], velocity = [0.0, 1.5, 0.0])]
    arm: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.02], position = [1.0, 0.0, 0.0],
           angular_velocity = [0.0, 40.0, 3.0], velocity = [0.0, 3.0, 0.0])]
    rotor: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.05], position = [0.0, 0.0, 2.0],
           angular_velocity = [1.0, 0.0, 25.0])]
    top: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    column: Revolute,
    #[joint(between = [arm, rotor], point = [1.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    shaft: Revolute,
    #[joint(between = [ground, top], point = [0.0, 0.0, 2.0])]
    socket: Spherical,
}

const STEP: f64 = 1.0 / 128.0;
/// Radians of each body between reports, and a number of steps.
const SELDOM: f64 = 96.0 * STEP;
const END: f64 = 4.0 * SELDOM;

/// States at the given times, of a run that reports so.
fn states(reporting: Reporting<f64>) -> Vec<(f64, StateOf<Spinning>)> {
    let mut states = Vec::new();
    let mechanism = Spinning::default();
    let simulation = mechanism.simulation(StandardLagrange, Rk4::every(STEP));
    let report = simulation
        .unmonitored()
        .run(0.0..=END, reporting, |sample| {
            states.push((sample.time(), *sample.state()))
        })
        .expect("the motion is regular");
    assert_eq!(states.last(), Some(&(report.time, report.state)));
    states
}

/// Euler parameters too have the signs that they have where each step is shown.
#[test]
fn what_is_seen_does_not_depend_on_how_often() {
    let all = states(every_step());
    let seldom = states(every(SELDOM));
    assert_eq!((all.len(), seldom.len()), (385, 5));
    for (time, state) in &seldom {
        let shown = all.iter().find(|(shown, _)| shown == time);
        assert_eq!(shown, Some(&(*time, *state)));
    }
    // A sign by the last report alone would be another one: between two of them, some `p` goes by
    // more than a quarter of its circle.
    let turned = seldom.windows(2).filter(|pair| {
        let [before, after] = [&pair[0].1, &pair[1].1].map(|state| *state.coordinates());
        (0..3).any(|body| {
            (3..7)
                .map(|k| before[7 * body + k] * after[7 * body + k])
                .sum::<f64>()
                < 0.0
        })
    });
    assert!(turned.count() > 0);
}

/// A run that fails keeps the state of its last step, not of its last report.
#[test]
fn a_fault_comes_with_the_last_state() {
    let last = |reporting| {
        let mechanism = Spinning::default();
        let method = DormandPrince::default().budget(500);
        let simulation = mechanism.simulation(StandardLagrange, method).unmonitored();
        let failed = simulation.run(0.0..=100.0, reporting, |_| {});
        let error = failed.expect_err("the budget is too small");
        assert!(matches!(error.fault, Fault::Step(StepFault::Budget { .. })));
        (error.time, error.state)
    };
    let seldom = last(every(100.0));
    assert!(seldom.0 > 0.1);
    assert_eq!(seldom, last(every_step()));
}
