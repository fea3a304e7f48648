//! Impacts on limits, and rest on them.

use core::f64::consts::PI;

use holonom::measure::{Interacting, NoForces};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;
use holonom::{Adams, ImplicitMidpoint, RadauIIA, Runs};

use super::{Ball, GRAVITY, Rod, tight};

fn comes_to_rest<C: Coordinates<Ball>>() {
    let (ball, h) = (Ball::default(), Ball::HANDLES);
    let restitution = 0.5;
    let floor = h.rail.displacement().limits();
    let mut rests = None;
    let report = Simulation::new(&ball, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions([
            // The rail's displacement is zero at the height 1 m.
            Interaction::limits(h.rail.displacement(), [-1.0, f64::INFINITY])
                .restitution(restitution),
        ])
        .run(0.0..=3.0, every(0.01), |sample| {
            let x = sample.displacement(h.rail);
            assert!(x > -1.0 - 1e-12, "{x}");
            if sample.mode(floor) == Ok(InteractionMode::AtLower) {
                rests.get_or_insert(sample.time());
                let effort = sample.effort(floor).expect("one interaction");
                assert!((effort - GRAVITY).abs() < 1e-10, "{effort}");
                assert!((x + 1.0).abs() < 1e-14, "{x}");
            }
        })
        .expect("it bounces and rests");
    let fall = (2.0 / GRAVITY).sqrt();
    let wanted = fall * (1.0 + restitution) / (1.0 - restitution);
    let rests = rests.expect("it comes to rest");
    assert!(
        rests < wanted + 0.01 && rests > wanted - 1e-3,
        "{rests} {wanted}"
    );
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_ball_comes_to_rest_after_infinitely_many_bounces() {
    comes_to_rest::<Relative>();
    comes_to_rest::<Absolute>();
}

/// The complete elliptic integral of the modulus `k`, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

fn pendulum<F, I, C>(name: &str, formulation: F, integrator: I, bound: f64)
where
    F: Formulation<f64>,
    C: Coordinates<Rod>,
    I: Runs<Problem<Rod, F, f64, C, Interacting<f64, Rod, NoForces, 1>>>,
{
    const RESTITUTION: f64 = 0.7;
    let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    let stop = hinge.angle().limits();
    let mut times = Vec::new();
    let report = Simulation::new(&rod, formulation, integrator)
        .coordinates::<C>()
        .interactions([
            Interaction::limits(hinge.angle(), [-0.5 * PI, 3.0]).restitution(RESTITUTION)
        ])
        .run(0.0..=5.0, every(0.1), |sample| {
            let impact = sample.impact(stop).expect("one interaction");
            if let Some(impact) = impact
                && times.last() != Some(&impact.time)
            {
                times.push(impact.time);
                let [before, after] = impact.rates;
                assert!((after + RESTITUTION * before).abs() < 1e-12 * before.abs());
                // About the hinge.
                let moment = 1.0 / 6.0 + 0.5;
                let loss = 0.5 * moment * (before * before - after * after);
                assert!((impact.lost_energy - loss).abs() < 1e-5 * loss, "{name}");
            }
        })
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(
        report.warnings().is_empty(),
        "{name}: {}",
        report.warnings()
    );
    let frequency = (2.0 * GRAVITY * 0.5 / (1.0 / 6.0 + 0.5)).sqrt();
    let mut modulus = (0.25 * PI).sin();
    let mut wanted = elliptic(modulus) / frequency;
    assert!(times.len() > 4, "{name}: {times:?}");
    for time in times {
        assert!((time - wanted).abs() < bound, "{name}: {time} {wanted}");
        modulus *= RESTITUTION;
        wanted += 2.0 * elliptic(modulus) / frequency;
    }
    assert!(wanted > 5.0, "{name}: one was missed");
}

#[test]
fn a_rod_meets_its_limit_at_times_of_elliptic_integrals() {
    let rigid = StandardLagrange;
    pendulum::<_, _, Relative>("ode45", rigid, DormandPrince::new(tight()), 1e-10);
    pendulum::<_, _, Absolute>("ode45", rigid, DormandPrince::new(tight()), 1e-10);
    pendulum::<_, _, Relative>("ode113", rigid, Adams::new(tight()), 1e-10);
    pendulum::<_, _, Relative>("radau", rigid, RadauIIA::new(tight()), 1e-10);
    pendulum::<_, _, Relative>("rk4", rigid, Rk4::every(1e-3), 1e-9);
    pendulum::<_, _, Relative>("midpoint", rigid, ImplicitMidpoint::every(1e-3), 1e-4);
    pendulum::<_, _, Absolute>(
        "baumgarte",
        Baumgarte::default(),
        DormandPrince::new(tight()),
        1e-9,
    );
    let stiff = DormandPrince::new(tight());
    pendulum::<_, _, Absolute>("augmented", AugmentedLagrangian::default(), stiff, 1e-6);
    pendulum::<_, _, Absolute>("penalty", Penalty::default(), stiff, 1e-4);
}
