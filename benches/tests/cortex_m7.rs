//! The estimate of `study recommend --target cortex-m7` beside what `tests/firmware/run` counts.

use holonom_benches::trade::problem;
use holonom_study::chapter15::Method;
use holonom_study::trade::{
    Coordinates, Family, Formulated, IntegratorSetting, Key, PostStabilisation, Precision,
    Processor, Row, Setting,
};

const COUNTS: &str = include_str!("../../tests/firmware/counts");

/// Instructions of a step of Runge-Kutta of the rod of chapter 15, in f64 on a Cortex-M7.
fn counted(coordinates: Coordinates, formulation: &str) -> f64 {
    let start = format!(
        "cortex-m7 | pendulum, {} | {formulation} | f64 | ",
        coordinates.key()
    );
    let row = COUNTS.lines().find_map(|line| line.strip_prefix(&start));
    let step = row.expect("a row of it").split(" | ").nth(1);
    step.expect("a step").parse().expect("a number")
}

#[test]
fn the_estimate_is_between_0_7_and_1_5_times_what_is_counted() {
    let subject = problem("pendulum").expect("the pendulum");
    for (coordinates, method, name) in [
        (Coordinates::Bodies, Method::Standard, "StandardLagrange"),
        (Coordinates::Bodies, Method::Baumgarte, "Baumgarte"),
        (Coordinates::Bodies, Method::Penalty, "Penalty"),
        (Coordinates::Joints, Method::Standard, "StandardLagrange"),
    ] {
        let setting = Setting {
            coordinates,
            formulation: Formulated::default_of(method),
            is_derived: false,
            stabilisation: PostStabilisation::None,
            integration: IntegratorSetting {
                family: Family::Rk4,
                step_or_tolerance: 1e-3,
            },
            scalar: Precision::Double,
        };
        // One step.
        let row = Row {
            setting: Key::from(&setting),
            error: 0.0,
            seconds: 0.0,
            reference_kernels: None,
            evaluations: 4,
            steps: [1, 1],
            max_violation: 0.0,
            energy_drift_joule: 0.0,
            warnings: Vec::new(),
        };
        let seconds = Processor::CortexM7.seconds(&*subject, &setting, &row);
        let estimated = 480e6 * seconds.expect("known operations");
        let ratio = estimated / counted(coordinates, name);
        println!("{name} by {}: {ratio}", coordinates.key());
        assert!(
            (0.7..1.5).contains(&ratio),
            "{name} by {}: {ratio}",
            coordinates.key()
        );
    }
}
