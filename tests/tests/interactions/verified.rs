//! Companions of runs with limits and friction have modes of their own.

use holonom::Runs;
use holonom::measure::{Interacting, NoForces};
use holonom::mechanism::Relative;
use holonom::prelude::*;

use super::{Ball, GRAVITY, Rod, tight};

/// The angle and its rate after some seconds, by a companion too.
fn swung<I>(integrator: I, seconds: f64) -> (f64, f64)
where
    I: Runs<Problem<Rod, StandardLagrange, f64, Relative, Interacting<f64, Rod, NoForces, 2>>>,
{
    let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    let mut angle = f64::NAN;
    let report = rod
        .simulation(StandardLagrange, integrator)
        .joint_coordinates()
        .interactions([
            Interaction::limits(hinge.angle(), [-1.0, 1.0]).restitution(0.7),
            Interaction::friction(hinge.angle(), 0.4),
        ])
        .verified()
        .run(0.0..=seconds, every(0.1), |sample| {
            angle = sample.angle(hinge)
        })
        .expect("it runs");
    let found = report.verification.expect("it is verified");
    assert!(found.ended.is_none(), "{found:?}");
    (angle, found.worst().expect("one body").rotation)
}

#[test]
fn what_bounces_and_rubs_is_estimated() {
    let (exact, least) = swung(DormandPrince::new(tight()), 3.0);
    assert!(least < 1e-8, "{least:e}");
    for (integrator, most) in [(Rk4::every(0.05), 1e-2), (Rk4::every(0.01), 1e-4)] {
        let (angle, estimate) = swung(integrator, 3.0);
        let wrong = (angle - exact).abs();
        // The largest over the run, of which the end may have less.
        assert!(
            wrong < 3.0 * estimate && estimate < most,
            "{wrong:e} {estimate:e}"
        );
    }
}

#[test]
fn what_comes_to_rest_is_known_to_round_off() {
    // A ball thrown up against friction: 2 N and its weight, then it stays, for its weight is less.
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let mut start = ball.described_state().expect("described");
    ball.set_displacement_rate(&mut start, rail, 3.0)
        .expect("acceptable");
    let friction = GRAVITY + 2.0;
    let mut height = f64::NAN;
    let report = ball
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .interactions([Interaction::friction(rail.displacement(), friction)])
        .verified()
        .run(0.0..=2.0, every(0.25), |sample| {
            height = sample.displacement(rail)
        })
        .expect("it runs");
    let rise = 9.0 / (2.0 * (GRAVITY + friction));
    assert!((height - rise).abs() < 1e-12, "{height} {rise}");
    let found = report.verification.expect("it is verified");
    let worst = found.worst().expect("it goes with the run to its end");
    assert!(worst.position < 1e-12, "{worst:?}");
}
