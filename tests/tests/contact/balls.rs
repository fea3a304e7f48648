//! One ball on planes: it slips, rolls, and bounces with spin.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom::run::{Impact, InteractionMode, Plane, Sphere};

use super::tight;

pub(crate) const GRAVITY: f64 = 9.81;
pub(crate) const RADIUS: f64 = 0.1;

/// A ball of 7 kg: 2/5 m r^2 = 0.028 kg m^2.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(crate) struct Bowling {
    #[body(free, mass = 7.0, inertia = [0.028, 0.028, 0.028], position = [0.0, 0.0, 0.1])]
    ball: Body,
    /// Of a bowl of 1 m.
    #[point(on = ground, at = [0.0, 0.0, 1.0])]
    middle: Point,
}

type State = StateOf<Bowling>;

pub(crate) fn start(position: [f64; 3], velocity: [f64; 3], spin: [f64; 3]) -> State {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let mut start = bowling.described_state().expect("it is described");
    let mut pose = bowling.view(0.0, &start).expect("a view").pose(h.ball);
    pose.position = position.into();
    Bowling::set_pose(&mut start, h.ball, pose);
    Bowling::set_velocity(&mut start, h.ball, velocity.into());
    Bowling::set_angular_velocity(&mut start, h.ball, spin.into());
    start
}

pub(crate) fn floor() -> Plane<f64, Bowling> {
    Plane::on_ground([0.0; 3], [0.0, 0.0, 1.0])
}

/// Slip is straight whatever the spin is: it ends after `2 |s| / (7 mu g)`, and takes 2/7 of it
/// from the velocity.
fn rolls_after<C: Coordinates<Bowling>>(velocity: [f64; 3], spin: [f64; 3], friction: f64) {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let slip =
        Vector3::from(velocity) + Vector3::from(spin).cross(&Vector3::new(0.0, 0.0, -RADIUS));
    let until = 2.0 * slip.norm() / (7.0 * friction * GRAVITY);
    let contact = Interaction::contact(h.ball, floor())
        .radius(RADIUS)
        .with_friction(friction);
    let [normal, along, across] = Interaction::handles(&contact);
    let mut rolling = None;
    let report = Simulation::new(&bowling, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start([0.0, 0.0, RADIUS], velocity, spin))
        .interactions(contact)
        .run(
            0.0..=1.5 * until,
            every(0.25 * until),
            |sample| -> Result<(), Fault> {
                let weight = 7.0 * GRAVITY;
                assert!((sample.effort(normal)? - weight).abs() < 1e-10);
                let sticks = sample.mode(along)? == InteractionMode::Sticking;
                assert_eq!(sample.mode(along), sample.mode(across));
                let friction_now = sample.effort(along)?.hypot(sample.effort(across)?);
                if sticks {
                    rolling = rolling.or(Some(sample.time()));
                    assert!(friction_now < 1e-9, "{friction_now:e}");
                } else {
                    assert!((friction_now - friction * weight).abs() < 1e-10);
                }
                let part = (sample.time() / until).min(1.0);
                let wanted = Vector3::from(velocity) - 2.0 / 7.0 * part * slip;
                let size = 1.0 + slip.norm();
                let touches = sample.contact_of(along)?;
                let below = sample.position(h.ball) - RADIUS * Vector3::z();
                assert!((touches.position - below).norm() < 1e-15);
                assert_eq!(touches.normal, Vector3::z());
                let left = (1.0 - part) * slip;
                assert!((touches.slip - left).norm() < 1e-8 * size);
                let error = (sample.velocity(h.ball) - wanted).norm();
                assert!(error < 1e-9 * size, "{error:e} at {}", sample.time());
                Ok(())
            },
        )
        .expect("it rolls");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let rolling = rolling.expect("it has rolled");
    assert!(
        (rolling - until).abs() < 1e-9 * until.max(1.0),
        "{rolling} {until}"
    );
}

#[test]
fn a_bowling_ball_slips_and_then_rolls() {
    rolls_after::<Relative>([8.0, 0.0, 0.0], [0.0; 3], 0.2);
    rolls_after::<Absolute>([8.0, 0.0, 0.0], [0.0; 3], 0.2);
    // Backspin: it comes back.
    rolls_after::<Relative>([1.0, 0.0, 0.0], [0.0, -60.0, 0.0], 0.3);
    // Slip and velocity are not in one plane, and it spins about the vertical.
    rolls_after::<Relative>([2.0, 1.0, 0.0], [-7.0, 5.0, 3.0], 0.1);
}

/// `tan a = 7/2 mu` decides.
#[test]
fn on_an_incline_it_rolls_or_slips_by_its_angle() {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    for friction in [0.0_f64, 0.05, 0.3, 1.0, 10.0] {
        for (slips, angle) in [
            (false, (3.5 * friction).atan() - 1e-6),
            (true, (3.5 * friction).atan() + 1e-6),
            (friction < 0.02, 0.1),
        ] {
            if angle < 0.0 {
                continue;
            }
            let (sine, cosine) = angle.sin_cos();
            let plane = Plane::on_ground([0.0; 3], [sine, 0.0, cosine]);
            let contact = Interaction::contact(h.ball, plane)
                .radius(RADIUS)
                .with_friction(friction);
            let [_, along, _] = Interaction::handles(&contact);
            let report = bowling
                .simulation(StandardLagrange, DormandPrince::new(tight()))
                .initial_state(start(
                    [RADIUS * sine, 0.0, RADIUS * cosine],
                    [0.0; 3],
                    [0.0; 3],
                ))
                .interactions(contact)
                .run(0.0..=1.0, every(0.5), |sample| {
                    let found = sample.mode(along) == Ok(InteractionMode::Slipping);
                    assert_eq!(found, slips, "{friction} {angle}");
                })
                .expect("it goes down");
            let speed = bowling
                .view(1.0, &report.state)
                .expect("a view")
                .velocity(h.ball)
                .norm();
            let wanted = if slips {
                GRAVITY * (sine - friction * cosine)
            } else {
                5.0 / 7.0 * GRAVITY * sine
            };
            assert!(
                (speed - wanted.abs()).abs() < 1e-11 * GRAVITY,
                "{speed} {wanted}"
            );
        }
    }
}

/// Against a cushion at 3 m/s: friction takes `min(mu (1 + e) v, 2/7 |s|)` of the slip.
fn bounces(
    spin: [f64; 3],
    friction: f64,
    poisson: bool,
) -> (Vector3<f64>, Vector3<f64>, Impact<f64>) {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let restitution = 0.8;
    let cushion = Plane::on_ground([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]).along([0.0, 1.0, 0.0]);
    let contact = Interaction::contact(h.ball, cushion).radius(RADIUS);
    let contact = if poisson {
        contact.restitution_of_impulses(restitution)
    } else {
        contact.restitution(restitution)
    };
    let contact = contact.with_friction(friction);
    let [normal, ..] = Interaction::handles(&contact);
    let mut impact = None;
    let report = bowling
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start([0.0, 0.0, 5.0], [3.0, 0.5, 0.3], spin))
        .interactions(contact)
        .run(0.0..=0.3 + 1e-9, every(0.1), |sample| {
            impact = sample.impact(normal).expect("one")
        })
        .unwrap_or_else(|fault| panic!("{friction} {spin:?} {poisson}: {fault}"));
    let view = bowling.view(0.3, &report.state).expect("a view");
    let impact = impact.expect("it has met the cushion");
    assert!((impact.time - 0.3).abs() < 1e-12);
    (
        view.velocity(h.ball),
        view.angular_velocity_global(h.ball),
        impact,
    )
}

#[test]
fn it_comes_off_a_cushion_with_the_spin_that_friction_leaves() {
    for friction in [0.0_f64, 0.05, 0.2, 2.0] {
        for spin in [[0.0_f64; 3], [0.0, 20.0, -10.0], [5.0, -3.0, 40.0]] {
            for poisson in [false, true] {
                let (velocity, turning, impact) = bounces(spin, friction, poisson);
                let before = Vector3::new(3.0, 0.5, 0.3 - GRAVITY * 0.3);
                let arm = Vector3::new(RADIUS, 0.0, 0.0);
                let slip = before + Vector3::from(spin).cross(&arm);
                let slip = Vector3::new(0.0, slip.y, slip.z);
                let taken = (friction * 1.8 * 3.0 / slip.norm()).min(2.0 / 7.0);
                let change = Vector3::new(-1.8 * 3.0, 0.0, 0.0) - taken * slip;
                let wanted = before + change;
                assert!((velocity - wanted).norm() < 1e-7, "{velocity} {wanted}");
                let wanted = Vector3::from(spin) + arm.cross(&change) * (7.0 / 0.028);
                assert!((turning - wanted).norm() < 1e-6, "{turning} {wanted}");
                let energy = |v: &Vector3<f64>, w: &Vector3<f64>| {
                    0.5 * (7.0 * v.norm_squared() + 0.028 * w.norm_squared())
                };
                let lost = energy(&before, &spin.into()) - energy(&(before + change), &wanted);
                assert!(
                    (impact.lost_energy - lost).abs() < 1e-8,
                    "{impact:?} {lost}"
                );
            }
        }
    }
}

/// It rolls through the bottom of a bowl after a quarter of its period: `v^2 = 10/7 g (R - r)
/// (cos a - cos a0)`, by Simpson's rule in the root of the way.
#[test]
fn it_rolls_in_a_bowl() {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let (way, first): (f64, f64) = (1.0 - RADIUS, 0.6);
    let rate = |s: f64| {
        let squared = 10.0 / 7.0 * GRAVITY / way;
        if s == 0.0 {
            2.0 / (squared * first.sin()).sqrt()
        } else {
            2.0 * s / (squared * ((first - s * s).cos() - first.cos())).sqrt()
        }
    };
    let step = first.sqrt() / 4000.0;
    let quarter = (0..=4000).fold(0.0, |sum, k| {
        let weight = match k {
            0 | 4000 => 1.0,
            k if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        sum + weight * step / 3.0 * rate(f64::from(k) * step)
    });
    let (sine, cosine) = first.sin_cos();
    let bowl = Sphere::about(h.middle, 1.0).hollow().along([0.0, 1.0, 0.0]);
    let contact = Interaction::contact_with_sphere(h.ball, bowl)
        .radius(RADIUS)
        .with_friction(0.5);
    let [normal, along, across] = Interaction::handles(&contact);
    let report = bowling
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start(
            [way * sine, 0.0, 1.0 - way * cosine],
            [0.0; 3],
            [0.0; 3],
        ))
        .interactions(contact)
        .run(0.0..=quarter, every(0.1), |sample| -> Result<(), Fault> {
            assert_eq!(sample.mode(along)?, InteractionMode::Sticking);
            let angle = (sample.position(h.ball).x / way).asin();
            // N = m g cos a + m v^2 / (R - r)
            let wanted = 7.0 * GRAVITY * (17.0 * angle.cos() - 10.0 * first.cos()) / 7.0;
            assert!((sample.effort(normal)? - wanted).abs() < 1e-8);
            let friction = sample.effort(along)?.hypot(sample.effort(across)?);
            assert!((friction - 2.0 * GRAVITY * angle.sin().abs()).abs() < 1e-8);
            Ok(())
        })
        .expect("it rolls");
    let x = bowling
        .view(quarter, &report.state)
        .expect("a view")
        .position(h.ball)
        .x;
    assert!(x.abs() < 1e-9, "{x:e}");
}

/// Two balls of 0.2 kg and 30 mm, without weight.
#[derive(Mechanism)]
struct Billiards {
    #[body(free, mass = 0.2, inertia = [7.2e-5, 7.2e-5, 7.2e-5])]
    cue: Body,
    #[body(free, mass = 0.2, inertia = [7.2e-5, 7.2e-5, 7.2e-5], position = [0.5, 0.03, 0.0])]
    object: Body,
}

/// With the slip `s`, which takes `7 / m` of an impulse across, friction gives `min(mu P, m |s| /
/// 7)`. Both balls turn by it, and linear and angular momentum are kept.
#[test]
fn balls_throw_each_other_by_their_friction() {
    let (billiards, h) = (Billiards::default(), Billiards::HANDLES);
    let (mass, radius, restitution) = (0.2, 0.03, 0.9);
    for friction in [0.0, 0.06, 0.5] {
        for spin in [[0.0; 3], [0.0, 0.0, 80.0], [10.0, -40.0, -30.0]] {
            let contact = Interaction::contact_with_sphere(h.cue, Sphere::about(h.object, radius))
                .radius(radius)
                .restitution(restitution)
                .with_friction(friction);
            let mut begun = billiards.described_state().expect("it is described");
            Billiards::set_velocity(&mut begun, h.cue, [2.0, 0.0, 0.0].into());
            Billiards::set_angular_velocity(&mut begun, h.cue, spin.into());
            let report = billiards
                .simulation(StandardLagrange, DormandPrince::new(tight()))
                .initial_state(begun)
                .interactions(contact)
                .run(0.0..=0.4, every(0.1), |_| ())
                .expect("they meet");
            let view = billiards.view(0.4, &report.state).expect("a view");
            // The line of both middles is at 30 degrees.
            let line = Vector3::new(3.0_f64.sqrt() / 2.0, 0.5, 0.0);
            let before = Vector3::new(2.0, 0.0, 0.0);
            let slip = before + Vector3::from(spin).cross(&(radius * line));
            let slip = slip - slip.dot(&line) * line;
            let pressed = 0.5 * mass * (1.0 + restitution) * before.dot(&line);
            let rubbed = if slip.norm() > 0.0 {
                (friction * pressed).min(mass / 7.0 * slip.norm()) / slip.norm() * slip
            } else {
                Vector3::zeros()
            };
            let impulse = -pressed * line - rubbed;
            let wanted = [before + impulse / mass, -impulse / mass];
            let found = [view.velocity(h.cue), view.velocity(h.object)];
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).norm() < 1e-9, "{found} {wanted}");
            }
            let turn = (radius * line).cross(&impulse) / 7.2e-5;
            let wanted = [Vector3::from(spin) + turn, turn];
            let found = [h.cue, h.object].map(|ball| view.angular_velocity_global(ball));
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).norm() < 1e-7, "{found} {wanted}");
            }
        }
    }
}
