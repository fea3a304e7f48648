//! Settings that make no sense are refused before anything happens, by name.

use holonom::error::StartFault;
use holonom::prelude::*;
use holonom::{Fault, dynamics::Dynamics};
use holonom_models::RodPendulum;

/// Not finite and positive.
const BAD: [f64; 5] = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[track_caller]
fn names(fault: &Fault, expected: &str, bad: f64) {
    let Fault::Start(StartFault::Setting { name, value }) = *fault else {
        panic!("{fault}");
    };
    assert!(name.contains(expected), "{name}");
    assert!(
        value == bad || (value.is_nan() && bad.is_nan()),
        "{value} is not {bad}"
    );
    assert!(fault.to_string().contains(name), "{fault}");
}

fn refused<F: Formulation<f64>>(method: F) -> Fault {
    let rod = RodPendulum::default();
    let error = Simulation::new(&rod, method, Rk4::every(0.1))
        .run(0.0..=1.0, every_step(), |_| -> () {
            panic!("it must not begin")
        })
        .expect_err("a bad coefficient");
    assert_eq!(error.time, 0.0);
    let by_stepper = Stepper::new(&rod, method, Rk4).expect_err("refused");
    let by_dynamics = Dynamics::<Problem<RodPendulum, F>>::new(&rod, method).expect_err("refused");
    // NaN differs from itself.
    assert_eq!(by_stepper.to_string(), error.fault.to_string());
    assert_eq!(by_dynamics.to_string(), error.fault.to_string());
    error.fault
}

#[test]
fn a_coefficient_must_be_positive() {
    for bad in BAD {
        names(&refused(Baumgarte::new(bad, 5.0)), "alpha", bad);
        names(&refused(Baumgarte::new(5.0, bad)), "beta", bad);
        names(&refused(Penalty::new(bad, 10.0, 1.0)), "alpha", bad);
        names(&refused(Penalty::new(1e7, bad, 1.0)), "omega", bad);
        names(&refused(Penalty::new(1e7, 10.0, bad)), "mu", bad);
        names(
            &refused(AugmentedLagrangian::new(bad, 10.0, 1.0)),
            "alpha",
            bad,
        );
        names(
            &refused(AugmentedLagrangian::new(1e7, bad, 1.0)),
            "omega",
            bad,
        );
        names(
            &refused(AugmentedLagrangian::new(1e7, 10.0, bad)),
            "mu",
            bad,
        );
        let method = AugmentedLagrangian {
            tolerance: bad,
            ..AugmentedLagrangian::default()
        };
        names(&refused(method), "tolerance", bad);
    }
    let method = AugmentedLagrangian::<f64> {
        max_iterations: 1,
        ..AugmentedLagrangian::default()
    };
    names(&refused(method), "max_iterations", 0.0);
}

fn run<I: holonom::Runs<Problem<RodPendulum, StandardLagrange>>>(
    integrator: I,
    interval: core::ops::RangeInclusive<f64>,
    reporting: holonom::run::Reporting<f64>,
) -> Fault {
    let rod = RodPendulum::default();
    let described = rod.described_state().expect("described");
    let error = Simulation::new(&rod, StandardLagrange, integrator)
        .run(interval, reporting, |_| ControlFlow::Continue(()))
        .expect_err("a bad setting");
    assert_eq!(error.state, described);
    error.fault
}

#[test]
fn a_tolerance_and_a_step_must_be_positive() {
    for bad in BAD {
        let relative = Tolerance {
            relative: bad,
            absolute: 1e-9,
        };
        let fault = run(DormandPrince::new(relative), 0.0..=1.0, every(0.1));
        names(&fault, "relative tolerance", bad);
        let absolute = Tolerance {
            relative: 1e-6,
            absolute: bad,
        };
        let fault = run(DormandPrince::new(absolute), 0.0..=1.0, every(0.1));
        names(&fault, "absolute tolerance", bad);
        names(&run(Rk4::every(bad), 0.0..=1.0, every(0.1)), "step", bad);
        names(
            &run(DormandPrince::every(bad), 0.0..=1.0, every(0.1)),
            "step",
            bad,
        );
        names(
            &run(Rk4::every(0.1), 0.0..=1.0, every(bad)),
            "reporting step",
            bad,
        );
    }
}

#[test]
fn an_interval_must_have_a_length() {
    let fault = run(Rk4::every(0.1), 1.0..=0.0, every(0.1));
    assert_eq!(
        fault.to_string(),
        "the interval from 1 s to 0 s must not end before it begins"
    );
    let fault = run(Rk4::every(0.1), 0.0..=f64::NAN, every(0.1));
    assert_eq!(
        fault.to_string(),
        "the interval from 0 s to NaN s must end at a finite time"
    );
    let fault = run(Rk4::every(0.1), f64::INFINITY..=f64::INFINITY, every(0.1));
    assert_eq!(
        fault.to_string(),
        "the interval from inf s to inf s must begin at a finite time"
    );
    // Where it begins does not matter.
    let rod = RodPendulum::default();
    let report = Simulation::new(&rod, StandardLagrange, Rk4::every(0.1))
        .run(-2.0..=-1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect("before zero");
    assert_eq!(report.time, -1.0);
}

#[test]
fn a_correction_must_have_a_positive_tolerance() {
    let rod = RodPendulum::default();
    let constants = rod.constants().expect("acceptable");
    for bad in BAD {
        let mut state = rod.described_state().expect("described");
        RodPendulum::set_velocity(&mut state, RodPendulum::HANDLES.rod, [0.3, 0.1, 0.7].into());
        let before = state;
        let projection = Projection {
            tolerance: bad,
            ..Projection::default()
        };
        let fault = projection
            .correct::<RodPendulum>(&constants, 0.0, &mut state)
            .expect_err("a bad tolerance");
        names(&fault, "tolerance of the projection", bad);
        assert_eq!(state, before);
        let error = Simulation::new(&rod, StandardLagrange, Rk4::every(0.1))
            .projection(projection)
            .run(0.0..=1.0, every(0.5), |_| ControlFlow::Continue(()))
            .expect_err("a bad tolerance");
        names(&error.fault, "tolerance of the projection", bad);
    }
}
