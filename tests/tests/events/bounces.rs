//! Times of impacts against closed forms, of every method and in both coordinates.

use core::f64::consts::PI;

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, Bdf, BogackiShampine, DormandPrince853, GeneralizedAlpha, Heun,
    ImplicitMidpoint, Kutta3, Midpoint, RadauIIA, Runs,
};

use super::{Ball, GRAVITY, height, tight};

const RESTITUTION: f64 = 0.7;

/// The times of the impacts of a ball up to a time, as a run finds them.
fn impacts<I, C>(integrator: I, end: f64) -> Vec<f64>
where
    C: Coordinates<Ball>,
    I: Runs<Problem<Ball, StandardLagrange, f64, C>>,
{
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let mut times = Vec::new();
    let mut energy = 0.0;
    let report = Simulation::new(&ball, StandardLagrange, integrator)
        .coordinates::<C>()
        .on("floor", Crossing::Falling, height, |event| {
            times.push(event.time());
            event.set_displacement_rate(rail, -RESTITUTION * event.displacement_rate(rail))
        })
        .run(0.0..=end, every(0.05), |sample| {
            // Between impacts it is kept.
            if sample.displacement_rate(rail) > 0.0 && height(sample).abs() < 1e-12 {
                energy = sample.energy();
            } else if energy > 0.0 {
                assert!((sample.energy() - energy).abs() < 1e-9, "{}", sample.time());
            }
        })
        .expect("it bounces");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    assert_eq!(report.time, end);
    times
}

fn exact(end: f64) -> Vec<f64> {
    let mut speed = (2.0 * GRAVITY).sqrt();
    let mut time = speed / GRAVITY;
    let mut times = Vec::new();
    while time <= end {
        times.push(time);
        speed *= RESTITUTION;
        time += 2.0 * speed / GRAVITY;
    }
    times
}

fn agrees<I>(name: &str, integrator: I)
where
    I: Runs<Problem<Ball, StandardLagrange, f64, Absolute>>
        + Runs<Problem<Ball, StandardLagrange, f64, Relative>>,
{
    agrees_with(name, impacts::<I, Absolute>(integrator, 2.4));
    agrees_with(name, impacts::<I, Relative>(integrator, 2.4));
}

fn agrees_with(name: &str, found: Vec<f64>) {
    let wanted = exact(2.4);
    assert_eq!(found.len(), wanted.len(), "{name}: {found:?}");
    assert!(wanted.len() > 6);
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((found - wanted).abs() < 1e-10, "{name}: {found} {wanted}");
    }
}

#[test]
fn a_ball_bounces_at_exact_times_by_every_method() {
    agrees("ode45", DormandPrince::new(tight()));
    agrees("ode23", BogackiShampine::new(tight()));
    agrees("dop853", DormandPrince853::new(tight()));
    agrees("ode113", Adams::new(tight()));
    agrees("radau", RadauIIA::new(tight()));
    agrees("bdf", Bdf::new(tight()));
    agrees("rk4", Rk4::every(0.013));
    agrees("dp5", DormandPrince::every(0.13));
    agrees("dp8", DormandPrince853::every(0.13));
    agrees("rk3", Kutta3::every(0.013));
    agrees("heun", Heun::every(0.013));
    agrees("midpoint", Midpoint::every(0.013));
    agrees("implicit midpoint", ImplicitMidpoint::every(0.013));
    agrees("abm4", AdamsBashforthMoulton4::every(0.013));
    let alpha = GeneralizedAlpha::every(0.013);
    agrees_with("alpha", impacts::<_, Absolute>(alpha, 2.4));
}

/// A rod of 1 m on a hinge about x, released from the horizontal; its stop is below the hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Rod {
    #[body(mass = 2.0, inertia = [1.0 / 6.0, 0.001, 1.0 / 6.0], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

/// The complete elliptic integral of the modulus `k`, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

fn pendulum<I, C>(name: &str, integrator: I, bound: f64)
where
    C: Coordinates<Rod>,
    I: Runs<Problem<Rod, StandardLagrange, f64, C>>,
{
    let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    let mut times = Vec::new();
    let report = Simulation::new(&rod, StandardLagrange, integrator)
        .coordinates::<C>()
        .projection(Projection::default())
        .on(
            "stop",
            Crossing::Falling,
            |sample| sample.angle(hinge) + 0.5 * PI,
            |event| {
                times.push(event.time());
                event.set_angle_rate(hinge, -RESTITUTION * event.angle_rate(hinge))
            },
        )
        .run(0.0..=5.0, every(0.1), |_| ())
        .expect("it swings");
    assert!(
        report.warnings().is_empty(),
        "{name}: {}",
        report.warnings()
    );
    // Energy goes with the square of the sine of half the amplitude.
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
fn a_pendulum_meets_its_stop_at_times_of_elliptic_integrals() {
    pendulum::<_, Relative>("ode45", DormandPrince::new(tight()), 1e-10);
    pendulum::<_, Absolute>("ode45", DormandPrince::new(tight()), 1e-10);
    pendulum::<_, Relative>("dop853", DormandPrince853::new(tight()), 1e-10);
    pendulum::<_, Relative>("ode113", Adams::new(tight()), 1e-10);
    pendulum::<_, Absolute>("ode113", Adams::new(tight()), 1e-10);
    pendulum::<_, Relative>("radau", RadauIIA::new(tight()), 1e-10);
    pendulum::<_, Relative>("rk4", Rk4::every(1e-3), 1e-10);
    pendulum::<_, Relative>("bdf", Bdf::new(tight()), 1e-8);
}

#[test]
fn times_converge_with_the_order_of_the_method() {
    let error = |step: f64| {
        let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
        let report = rod
            .simulation(StandardLagrange, Rk4::every(step))
            .run_until(0.0..=2.0, Crossing::Falling, |sample| {
                sample.angle(hinge) + 0.5 * PI
            })
            .expect("it swings");
        assert!(report.stopped);
        let frequency = (2.0 * GRAVITY * 0.5 / (1.0 / 6.0 + 0.5)).sqrt();
        (report.time - elliptic((0.25 * PI).sin()) / frequency).abs()
    };
    let (coarse, fine) = (error(0.04), error(0.02));
    assert!(coarse / fine > 12.0, "{coarse:e} {fine:e}");
}
