//! Laws that switch, by `sign`, `abs`, `min`, `max` and `if`, against closed forms.

#![forbid(unsafe_code)]

mod instants;
mod linear;
mod oscillators;
mod passages;
mod resting;
mod runs;
mod second_road;

use holonom::mechanism::Coordinates;
use holonom::prelude::*;
use holonom::{RunReport, Runs, run::Reporting};
use holonom_fixtures as _;

fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    }
}

/// A run in coordinates by their type, which must succeed without a warning.
fn run<M, I, C>(
    mechanism: &M,
    integrator: I,
    end: f64,
    reporting: Reporting<f64>,
    mut see: impl FnMut(&Sample<'_, f64, M>),
) -> RunReport<f64, M>
where
    M: Mechanism,
    C: Coordinates<M>,
    I: Runs<Problem<M, StandardLagrange, f64, C>>,
{
    let report = Simulation::new(mechanism, StandardLagrange, integrator)
        .coordinates::<C>()
        .run(0.0..=end, reporting, |sample| see(sample))
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    report
}

/// A run of steps so long that the monitor cannot follow the work of forces.
fn unwatched<M, I, C>(mechanism: &M, integrator: I, end: f64) -> RunReport<f64, M>
where
    M: Mechanism,
    C: Coordinates<M>,
    I: Runs<Problem<M, StandardLagrange, f64, C>>,
{
    Simulation::new(mechanism, StandardLagrange, integrator)
        .coordinates::<C>()
        .unmonitored()
        .run(0.0..=end, every(end), |_| ())
        .unwrap_or_else(|error| panic!("{error}"))
}
