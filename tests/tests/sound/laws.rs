//! Laws that steps do not follow, and a motor that does nothing.

use holonom::forces::{Actuator, SpringDamper};
use holonom::joints::Prismatic;
use holonom::prelude::*;
use holonom::{GeneralizedAlpha, Heun, Midpoint, Runs, Warning, Warnings, mechanism::Absolute};

/// A block of 1 kg on a rail, with a spring, a damper and a motor. From 1 m below on, a wall yields
/// to it, by a law that switches.
#[derive(Mechanism)]
struct Block {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [0.0, 0.0, speed])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
    #[force(
        between = [ground, block],
        head = [0.0, 0.0, -10.0],
        tail = [0.0, 0.0, 0.0],
        stiffness = stiffness,
        damping = damping,
        free_length = 10.0
    )]
    spring: SpringDamper,
    #[force(
        between = [ground, block],
        head = [0.0, 0.0, -10.0],
        tail = [0.0, 0.0, 0.0],
        force = push + wall * max(0.0, 9.0 - length)
    )]
    motor: Actuator,
    #[param]
    speed: f64,
    #[param]
    stiffness: f64,
    #[param]
    damping: f64,
    #[param]
    wall: f64,
    #[input]
    push: f64,
}

/// A block that begins at 4.4 m/s, moves against the wall and comes back. Returns the largest
/// change of its energy, as a part of it, and the warnings.
fn bounce<I>(integrator: I, end: f64, reports: f64) -> (f64, Warnings)
where
    I: Runs<Problem<Block, StandardLagrange, f64, Absolute>>,
{
    let (speed, stiffness, wall) = (4.4, 4.0, 1e5);
    let block = Block::new(speed, stiffness, 0.0, wall).expect("acceptable");
    let (start, mut off) = (0.5 * speed * speed, 0.0_f64);
    let report = Simulation::new(&block, StandardLagrange, integrator)
        .run(0.0..=end, every(reports), |sample| {
            let z: f64 = sample.displacement(Block::HANDLES.rail);
            let v: f64 = sample.displacement_rate(Block::HANDLES.rail);
            let into = (-1.0 - z).max(0.0);
            let energy = 0.5 * (v * v + stiffness * z * z + wall * into * into);
            off = off.max((energy / start - 1.0).abs());
        })
        .expect("it runs");
    (off, report.warnings())
}

/// Methods of order 2 gain energy by a wall that they pass in ten steps, whatever the reports are.
#[test]
fn a_bounce_that_gains_energy_is_told() {
    for (end, reports) in [
        (2.0, 0.005),
        (2.0, 0.1),
        (6.0, 0.02),
        (6.0, 1.0),
        (20.0, 0.1),
    ] {
        let gained = [
            bounce(Midpoint::every(1e-3), end, reports),
            bounce(Heun::every(1e-3), end, reports),
        ];
        for (off, warnings) in gained {
            assert!(off > 1e-2, "{end} {reports}: {off}");
            let is_told = warnings
                .into_iter()
                .any(|warning| matches!(warning, Warning::Energy { .. }));
            assert!(is_told, "{end} {reports}: {warnings}");
        }
    }
    let right = [
        bounce(Midpoint::every(5e-5), 2.0, 0.1),
        bounce(Heun::every(5e-5), 2.0, 0.005),
        bounce(DormandPrince::default(), 6.0, 0.1),
    ];
    for (off, warnings) in right {
        assert!(off < 5e-3 && warnings.is_empty(), "{off}: {warnings}");
    }
}

/// A damper of 1e5 N s/m stops the block within 10 us, and steps of 1 ms let it go on.
#[test]
fn a_damper_that_is_not_resolved_is_told() {
    let block = Block::new(1.0, 1e3, 1e5, 0.0).expect("acceptable");
    for end in [0.1, 1.0, 10.0] {
        let mut farthest = 0.0_f64;
        let report = Simulation::new(&block, StandardLagrange, GeneralizedAlpha::every(1e-3))
            .run(0.0..=end, every(0.01), |sample| {
                let z: f64 = sample.displacement(Block::HANDLES.rail);
                farthest = farthest.max(z);
            })
            .expect("it runs");
        assert!(farthest > 2e-5, "{farthest}");
        assert!(!report.warnings().is_empty(), "to {end} s");
    }
}

/// A motor without current does no work, so that round-off alone counts.
#[test]
fn round_off_counts_beside_a_motor_that_does_nothing() {
    let block = Block::new(50.0, 100.0, 0.0, 0.0).expect("acceptable");
    let report = Simulation::new(&block, StandardLagrange, Rk4::every(1e-3_f32))
        .run(0.0..=400.0, every(10.0), |_| ())
        .expect("it runs");
    let is_told = report
        .warnings()
        .into_iter()
        .any(|warning| matches!(warning, Warning::LongRun { .. } | Warning::Phase { .. }));
    assert!(is_told, "{}", report.warnings());
}
