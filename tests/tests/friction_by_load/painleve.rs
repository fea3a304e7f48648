//! Painleve's rod: its end slides on rough ground, where no effort or several would do.

use holonom::error::ModeFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;

use super::{GRAVITY, tight};

/// A slender rod of 1 kg and 1 m in the plane of y and z, upright; its lower end stays on the line
/// y.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Rod {
    #[param]
    cosine: f64,
    #[param]
    sine: f64,
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0], position = [0.0, 0.5 * cosine, 0.5 * sine])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    foot: PointOnLine,
}

/// The rod at an angle above the ground, sliding at 1 m/s in a direction.
fn rod(angle: f64, direction: f64) -> (Rod, StateOf<Rod>) {
    let rod = Rod::new(angle.cos(), angle.sin()).expect("a rod");
    let mut state = rod.described_state().expect("it is described");
    rod.set_displacement_rate(&mut state, Rod::HANDLES.foot, direction)
        .expect("it is free");
    (rod, state)
}

/// The friction at the start, or the fault.
fn effort<C: Coordinates<Rod>>(mu: f64, angle: f64, direction: f64) -> Result<f64, Fault> {
    let ((rod, state), h) = (rod(angle, direction), Rod::HANDLES);
    let frictions = [Interaction::friction_by_load(h.foot, mu)];
    let [friction] = Interaction::handles(&frictions);
    let mut effort = None;
    let run = Simulation::new(&rod, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(state)
        .interactions(frictions)
        .run(0.0..=1e-3, every(1e-3), |sample| -> Result<(), Fault> {
            if effort.is_none() {
                effort = Some(sample.effort(friction)?);
            }
            Ok(())
        });
    match (run, effort) {
        (Ok(_), Some(effort)) => Ok(effort),
        (Err(RunError::Simulation(error)), _) => Err(error.fault),
        (run, _) => panic!("{:?}", run.map(|_| ())),
    }
}

/// The same by hand: `N (1 + 3 c^2) + 3 s c T = m g` with the friction `T = -d mu |N|` along y.
fn by_hand(mu: f64, angle: f64, direction: f64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let normal = GRAVITY / (1.0 + 3.0 * cosine * cosine + direction * mu * 3.0 * sine * cosine);
    -direction * mu * normal
}

fn paradox<C: Coordinates<Rod>>() {
    // The steepest paradox: the tangent is 2, and mu 4/3.
    let worst = 2.0_f64.atan();
    for direction in [1.0, -1.0] {
        for (mu, angle) in [
            (0.3, 1.0),
            (1.2, worst),
            (1.333, worst),
            (1.4, 0.6),
            (1.4, 1.5),
            (3.0, 0.2),
        ] {
            let found = effort::<C>(mu, angle, direction).expect("one effort");
            let wanted = by_hand(mu, angle, direction);
            // Near the paradox it grows without bound.
            let bound = 1e-9 * wanted.abs();
            assert!(
                (found - wanted).abs() < bound,
                "{mu} {angle} {direction}: {found} {wanted}"
            );
        }
        for (mu, angle) in [(1.334, worst), (1.4, worst), (2.0, 0.9), (5.0, 1.3)] {
            let refused = effort::<C>(mu, angle, direction);
            let is_told = matches!(refused, Err(Fault::Mode(ModeFault::NoUniqueFriction { joint: "foot", time })) if time == 0.0);
            assert!(is_told, "{mu} {angle} {direction}: {refused:?}");
        }
    }
}

#[test]
fn a_sliding_rod_is_refused_where_its_effort_is_not_unique() {
    paradox::<Relative>();
    paradox::<Absolute>();
}

/// A rod that falls into the paradox is refused there, with the time, and a rod at rest stays in
/// what it can be held by.
#[test]
fn a_rod_that_falls_is_refused_on_its_way() {
    let ((rod, state), h) = (rod(1.45, 2.0), Rod::HANDLES);
    let mut last = 0.0;
    let run = rod
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(state)
        .interactions([Interaction::friction_by_load(h.foot, 1.6)])
        .run(0.0..=3.0, every(1e-3), |sample| last = sample.time());
    let fault = run.expect_err("it falls into it").fault;
    let Fault::Mode(ModeFault::NoUniqueFriction {
        joint: "foot",
        time,
    }) = fault
    else {
        panic!("{fault}");
    };
    assert!(time > 0.1 && time - last < 2e-2, "{time} {last}");
    let told = fault.to_string();
    assert!(
        told.contains("`foot`") && told.contains("Painleve"),
        "{told}"
    );
}
