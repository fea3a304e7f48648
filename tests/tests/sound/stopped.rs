//! What an observer stops has been looked at up to its end.

use holonom::monitor::{Violation, Warning};
use holonom::prelude::*;
use holonom_models::RodPendulum;

/// In steps that are too long for it.
const STEP: f64 = 0.1;

/// What a run found that is stopped at its second report, where that is after so many steps.
fn stopped(reports_after: f64) -> (Vec<Violation<f64>>, Option<f64>, Vec<Warning>) {
    let mut reports = 0;
    let report = Simulation::new(&RodPendulum::default(), StandardLagrange, Rk4::every(STEP))
        .absolute_coordinates()
        .run(0.0..=10.0, every(reports_after * STEP), |_| {
            reports += 1;
            if reports > 1 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .expect("nothing else stops it");
    assert!(report.stopped);
    let monitor = report.monitor.expect("it is monitored");
    let pivot = RodPendulum::HANDLES.pivot;
    let violations = vec![monitor.violation(pivot), monitor.velocity_violation(pivot)];
    let warnings = report.warnings().into_iter().collect();
    (violations, monitor.energy_drift(), warnings)
}

/// Violations and energies are looked at in every sixteenth step, and at the end.
#[test]
fn a_run_that_is_stopped_within_a_step_was_looked_at_up_to_the_step_before() {
    for steps in [3.0, 9.0, 15.0, 16.0, 22.0, 31.0] {
        let at_its_end = stopped(steps);
        for part in [0.3, 0.5, 0.9] {
            assert_eq!(
                stopped(steps + part),
                at_its_end,
                "{steps} steps and {part}"
            );
        }
    }
    // Which tells more than what was looked at before.
    let (few, many) = (stopped(3.5).0, stopped(15.5).0);
    assert!(few[0].length < 0.5 * many[0].length, "{few:?}, {many:?}");
}
