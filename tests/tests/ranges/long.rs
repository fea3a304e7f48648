//! Long runs: right to a hundredth, or with a warning.

use holonom::prelude::*;
use holonom::{Runs, Warning};
use holonom_models::{RodPendulum, SimplePendulum};

use holonom_tests::is_exhaustive;

/// A body that nothing holds, at 20 rad/s about a principal axis.
#[derive(Mechanism)]
struct Spinning {
    #[body(mass = 1.0, inertia = [0.2, 0.3, 0.4], angular_velocity = [0.0, 0.0, 20.0], free)]
    body: Body,
}

/// Whether a run has a warning, and the largest change of energy (of what it exchanges) that the
/// observer saw.
fn long<M: Mechanism, F: Formulation<f64>, I: Runs<Problem<M, F>>>(
    model: &M,
    (method, integrator, projected): (F, I, bool),
    duration: f64,
) -> (bool, f64) {
    let mut simulation = Simulation::new(model, method, integrator);
    if projected {
        simulation = simulation.projection(Projection::default());
    }
    let (mut first, mut worst, mut largest) = (None, 0.0_f64, 0.0_f64);
    let report = simulation
        .run(0.0..=duration, every(0.37), |sample| {
            let energy = sample.energy();
            largest = largest.max(sample.kinetic_energy());
            worst = worst.max((energy - *first.get_or_insert(energy)).abs());
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    let drift = worst / largest;
    println!(
        "{method:?}, projected: {projected}: energy {drift:.1e}, monitor {:?}",
        report.monitor.and_then(|w| w.energy_drift())
    );
    println!("{}", report.warnings());
    (!report.warnings().is_empty(), drift)
}

#[test]
fn ten_thousand_seconds_of_a_pendulum_are_warned_of() {
    let rod = RodPendulum::default();
    let ode45 = DormandPrince::<f64>::default();
    // All of them lose the phase of thirty thousand radians at 1e-6.
    if is_exhaustive() {
        for projected in [false, true] {
            assert!(long(&rod, (StandardLagrange, ode45, projected), 1e4).0);
            assert!(long(&rod, (Baumgarte::default(), ode45, projected), 1e4).0);
            assert!(long(&rod, (Penalty::default(), ode45, projected), 1e4).0);
            assert!(
                long(
                    &rod,
                    (AugmentedLagrangian::default(), ode45, projected),
                    1e4
                )
                .0
            );
        }
    }
    let bob = SimplePendulum::default();
    assert!(long(&bob, (Baumgarte::default(), ode45, false), 1e4).0);
}

#[test]
fn what_turns_evenly_is_not_warned_of() {
    let (warned, drift) = long(
        &Spinning::default(),
        (StandardLagrange, DormandPrince::default(), false),
        if is_exhaustive() { 1e4 } else { 1e3 },
    );
    assert!(!warned && drift < 1e-12);
}

/// A tolerance that suits the length of the run takes the warnings away.
#[test]
fn a_tight_run_is_trusted() {
    let rod = RodPendulum::default();
    let tight = DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-14,
    });
    let mut simulation = Simulation::new(&rod, Baumgarte::default(), tight);
    simulation = simulation.projection(Projection::default());
    let duration = if is_exhaustive() { 1e3 } else { 1e2 };
    let report = simulation
        .run(0.0..=duration, every(1.0), |_| ControlFlow::Continue(()))
        .expect("nothing stops it");
    println!(
        "{:?}",
        report.monitor.and_then(|monitor| monitor.energy_drift())
    );
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

/// Changes of energy that seven digits do not show shift the phase of a long motion: by 0.05 rad
/// after 10^4 s of a pendulum at h = 0.01.
#[test]
fn what_single_precision_cannot_tell_is_warned_of() {
    let rod = RodPendulum::default();
    let warnings = |duration: f32| {
        let report = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01_f32))
            .joint_coordinates()
            .run(0.0..=duration, every(1.0), |_| ControlFlow::Continue(()))
            .expect("nothing stops it");
        report.warnings()
    };
    let short = warnings(100.0);
    assert!(short.is_empty(), "{short}");
    let longer = warnings(600.0);
    println!("{longer}");
    let mut longer = longer.into_iter();
    assert!(longer.any(|warning| matches!(warning, Warning::LongRun { .. })));
    if !is_exhaustive() {
        return;
    }
    let long = warnings(1e4);
    println!("{long}");
    let mut long = long.into_iter();
    assert!(long.any(|warning| matches!(warning, Warning::LongRun { .. } | Warning::Phase { .. })));
}
