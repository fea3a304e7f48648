//! States of the user's own that steps, or a tolerance, do not follow.

use holonom::forces::Actuator;
use holonom::joints::Prismatic;
use holonom::prelude::*;
use holonom::{Runs, SemiImplicitEuler, Warning, mechanism::Relative};

/// A block that an oscillator of two states pushes to and fro: `x = size (1 - cos t)`. Beside it a
/// filter that follows the clock.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Pushed {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: Prismatic,
    #[state(rate = frequency * b, start = 1.0)]
    a: f64,
    #[state(rate = -frequency * a, start = 0.0)]
    b: f64,
    #[state(rate = 0.5 * (cos(0.1 * time) - slow), start = 0.0)]
    slow: f64,
    #[force(
        between = [ground, block],
        head = [-10.0, 0.0, 0.0],
        tail = [0.0, 0.0, 0.0],
        force = size * a
    )]
    push: Actuator,
    #[param]
    frequency: f64,
    #[param]
    size: f64,
}

/// What the block is off by, over its way, and whether a state has a warning.
fn run<I>(integrator: I, end: f64) -> (f64, bool)
where
    I: Runs<Problem<Pushed, StandardLagrange, f64, Relative>>,
{
    let pushed = Pushed::new(1.0, 1.0).expect("acceptable");
    let mut off = 0.0_f64;
    let report = Simulation::new(&pushed, StandardLagrange, integrator)
        .run(0.0..=end, every(0.01 * end), |sample| {
            let x: f64 = sample.displacement(Pushed::HANDLES.track);
            off = off.max(0.5 * (x - (1.0 - sample.time().cos())).abs());
        })
        .expect("it runs");
    let mut warnings = report.warnings().into_iter();
    let is_told = warnings.any(|warning| matches!(warning, Warning::CoarseState { .. }));
    (off, is_told)
}

#[test]
fn states_that_steps_do_not_follow_are_told() {
    let told = [
        run(SemiImplicitEuler::every(0.02), 1000.0),
        run(SemiImplicitEuler::every(0.001), 100.0),
        run(Rk4::every(0.5), 1000.0),
        run(Rk4::every(0.5), 100.0),
        run(holonom::Kutta3::every(0.2), 100.0),
        // The absolute tolerance is as large as the states.
        run(
            DormandPrince::new(Tolerance {
                relative: 1e-3,
                absolute: 1.0,
            }),
            100.0,
        ),
    ];
    for (place, (off, is_told)) in told.into_iter().enumerate() {
        assert!(off > 1e-2 && is_told, "{place}: {off}, {is_told}");
    }
    let right = [
        run(SemiImplicitEuler::every(0.0001), 12.0),
        run(Rk4::every(0.1), 1000.0),
        run(holonom::Kutta3::every(0.05), 100.0),
        run(DormandPrince::default(), 100.0),
    ];
    for (place, (off, is_told)) in right.into_iter().enumerate() {
        assert!(off < 5e-3 && !is_told, "{place}: {off}, {is_told}");
    }
}
