//! Equations that are kept although they depend on others: a motion that passes a singular
//! configuration has a warning as everywhere.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{Formulation, Warning};

/// A parallelogram of hinges with links of 1 m, all equations kept, which turns all around: it
/// passes the line twice a turn.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", redundant = "keep")]
struct Parallelogram {
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.0, 0.5])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.0833, 0.0833, 0.001], position = [0.0, 0.5, 1.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 1.0, 0.5])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 1.0, 1.0], axis = [1.0, 0.0, 0.0])]
    c: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Revolute,
}

/// What a run of so long says, and how far the coupler is from where a parallelogram has it.
fn run<F: Formulation<f64>>(
    formulation: F,
    joints: bool,
    rate: f64,
    end: f64,
) -> Option<(Warnings, f64)> {
    let mechanism = Parallelogram::default();
    let h = Parallelogram::HANDLES;
    let mut start = mechanism.described_state().expect("parameters");
    for (body, speeds) in [
        (h.crank, [0.5, 1.0]),
        (h.coupler, [1.0, 0.0]),
        (h.rocker, [0.5, 1.0]),
    ] {
        let [speed, spin] = speeds.map(|x| x * rate);
        Parallelogram::set_velocity(&mut start, body, [0.0, -speed, 0.0].into());
        Parallelogram::set_angular_velocity(&mut start, body, [spin, 0.0, 0.0].into());
    }
    let tolerance = Tolerance {
        relative: 1e-6,
        absolute: 1e-6,
    };
    let mut off = 0.0_f64;
    let see = |sample: &Sample<'_, f64, Parallelogram>| {
        let [crank, coupler] = [h.crank, h.coupler].map(|body| sample.pose(body).position);
        let [y, z] = [2.0 * crank.y + 0.5, 2.0 * crank.z];
        off = off.max((coupler.y - y).hypot(coupler.z - z));
        ControlFlow::Continue(())
    };
    let simulation = Simulation::new(&mechanism, formulation, DormandPrince::new(tolerance));
    let simulation = simulation.initial_state(start);
    let run = if joints {
        simulation
            .joint_coordinates()
            .run(0.0..=end, every(0.02), see)
    } else {
        simulation
            .absolute_coordinates()
            .run(0.0..=end, every(0.02), see)
    };
    run.ok().map(|report| (report.warnings(), off))
}

type Warnings = holonom::Warnings;

fn is_near(warnings: &Warnings) -> bool {
    let mut warnings = (*warnings).into_iter();
    warnings.any(|warning| matches!(warning, Warning::NearlySingular { .. }))
}

#[test]
fn what_passes_a_singular_configuration_is_warned_of() {
    let mechanism = Parallelogram::default();
    let augmented = AugmentedLagrangian::of(&mechanism).expect("coefficients");
    let penalty = Penalty::default();
    let mut runs = 0;
    for joints in [true, false] {
        let both = [
            run(augmented, joints, 8.0, 4.0),
            run(penalty, joints, 8.0, 4.0),
        ];
        for (warnings, off) in both.into_iter().flatten() {
            assert!(is_near(&warnings), "{joints}, off by {off} m: {warnings}");
            runs += 1;
        }
    }
    // By bodies the augmented Lagrangian may end in an error there.
    assert!(runs >= 3);
}

/// What swings and stays away from the line is not.
#[test]
fn what_stays_away_is_not() {
    let mechanism = Parallelogram::default();
    let augmented = AugmentedLagrangian::of(&mechanism).expect("coefficients");
    for joints in [true, false] {
        let (warnings, off) = run(augmented, joints, 0.5, 0.6).expect("it runs");
        assert!(off < 1e-3, "{off}");
        assert!(!is_near(&warnings), "{warnings}");
    }
}

/// A crank that turns all around, and a rocker that does not: never in line. All equations are
/// kept.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", redundant = "keep")]
struct CrankRocker {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.25])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.6, 0.8])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.35, 0.55])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 0.5], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 1.2, 1.1], axis = [1.0, 0.0, 0.0])]
    c: Revolute,
    #[joint(between = [ground, rocker], point = [0.0, 1.5, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Revolute,
}

/// A loop that turns all around and is never singular has no warning, however its steps fall.
#[test]
fn a_loop_that_is_never_singular_is_not() {
    let mechanism = CrankRocker::default();
    let h = CrankRocker::HANDLES;
    let mut start = mechanism.described_state().expect("parameters");
    mechanism
        .set_angle_rate(&mut start, h.a, 15.0)
        .expect("it carries the crank");
    let augmented = AugmentedLagrangian::of(&mechanism).expect("coefficients");
    let warnings = |joints: bool, tolerance: f64| {
        let tolerance = Tolerance {
            relative: tolerance,
            absolute: tolerance,
        };
        let simulation = Simulation::new(&mechanism, augmented, DormandPrince::new(tolerance))
            .initial_state(start)
            .assembled()
            .projection(Projection::default());
        let nothing = |_: &Sample<'_, f64, CrankRocker>| ControlFlow::Continue(());
        let run = if joints {
            simulation
                .joint_coordinates()
                .run(0.0..=3.0, every(1.0), nothing)
        } else {
            simulation
                .absolute_coordinates()
                .run(0.0..=3.0, every(1.0), nothing)
        };
        run.expect("it runs").warnings()
    };
    for tolerance in [1e-4, 1e-6] {
        for joints in [true, false] {
            let warnings = warnings(joints, tolerance);
            assert!(!is_near(&warnings), "{tolerance} {joints}: {warnings}");
        }
    }
}
