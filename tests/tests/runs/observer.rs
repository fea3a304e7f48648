//! When a run reports, and how it is stopped.

use holonom::prelude::*;
use holonom::run::Reporting;
use holonom_models::RodPendulum;

use crate::flat::flat;

fn times(interval: core::ops::RangeInclusive<f64>, reporting: Reporting<f64>) -> Vec<f64> {
    let mut times = Vec::new();
    Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(0.03))
        .run(interval, reporting, |sample| {
            times.push(sample.time());
            ControlFlow::Continue(())
        })
        .expect("solvable");
    times
}

#[test]
fn reports_come_at_the_start_at_every_time_and_at_the_end() {
    assert_eq!(times(0.0..=0.25, every(0.1)), [0.0, 0.1, 0.2, 0.25]);
    assert_eq!(times(1.0..=1.5, every(0.25)), [1.0, 1.25, 1.5]);
    assert_eq!(times(0.0..=0.07, every_step()), [0.0, 0.03, 0.06, 0.07]);
    assert_eq!(times(2.0..=2.0, every(0.1)), [2.0]);
}

#[test]
fn an_observer_stops_a_run() {
    let rod = RodPendulum::default();
    let mut last = (f64::NAN, Vec::new());
    let report = Simulation::new(&rod, Baumgarte::default(), DormandPrince::default())
        .run(0.0..=10.0, every(0.02), |sample| {
            last = (sample.time(), flat::<f64, RodPendulum>(sample.state()));
            // The rod passes the vertical.
            if sample.pose(RodPendulum::HANDLES.rod).position.y < 0.0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .expect("solvable");
    assert!(report.stopped);
    assert_eq!(report.time, last.0);
    assert_eq!(flat::<f64, RodPendulum>(&report.state), last.1);
    // A quarter of the period of 1.93355 s, to the next report.
    assert!((0.483..0.504).contains(&report.time), "{}", report.time);
}

#[test]
fn an_observer_may_stop_at_the_start() {
    let mut seen = 0;
    let report = Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(0.1))
        .run(0.0..=1.0, every_step(), |_| {
            seen += 1;
            ControlFlow::Break(())
        })
        .expect("nothing can fail");
    assert_eq!(
        (seen, report.stopped, report.time, report.accepted),
        (1, true, 0.0, 0)
    );
}

#[test]
fn what_is_observed_does_not_change_the_run() {
    let rod = RodPendulum::default();
    let run = |look: bool| {
        Simulation::new(&rod, StandardLagrange, DormandPrince::default())
            .run(0.0..=1.0, every(0.02), |sample| {
                if look {
                    let handles = RodPendulum::HANDLES;
                    sample
                        .reaction(handles.pivot, handles.rod)
                        .expect("solvable");
                    // The constraints hold by the accelerations, too.
                    assert!(sample.acceleration_violation().expect("solvable") <= 1e-24);
                }
                ControlFlow::Continue(())
            })
            .expect("solvable")
    };
    assert_eq!(run(false), run(true));
}
