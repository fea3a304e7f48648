//! Circular cams whose flat followers lift off, by a circle and by a spline of one.

use std::boxed::Box;

use holonom::prelude::*;
use holonom::run::{Cam as Profiled, InteractionMode, Plane};
use holonom::spline::{Spline, uniform_knots};

use super::tight;

/// A round cam of 50 mm, 20 mm from its shaft, below a flat follower with a spring. For other
/// profiles it is the body alone.
#[derive(Mechanism)]
pub(super) struct Cam {
    /// How fast it turns (rad/s).
    #[param]
    speed: f64,
    #[body(mass = 1.0, inertia = [0.001, 0.001, 0.001], position = [0.02, 0.0, 0.0])]
    cam: Body,
    #[body(mass = 0.4, inertia = [0.001, 0.001, 0.001], position = [0.0, 0.0, 0.15])]
    follower: Body,
    #[joint(between = [ground, cam], point = [0.0, 0.0, 0.0], axis = [0.0, -1.0, 0.0])]
    shaft: Revolute,
    #[joint(between = [ground, cam], axis = [0.0, -1.0, 0.0], motion = speed * time)]
    motor: AngleDriver,
    #[joint(between = [ground, follower], point = [0.0, 0.0, 0.05], axis = [0.0, 0.0, 1.0])]
    guide: Prismatic,
    #[force(
        between = [ground, follower], head = [0.0, 0.0, 0.55], tail = [0.0, 0.0, 0.05],
        stiffness = 500.0, free_length = 0.56
    )]
    spring: SpringDamper,
    /// Where the shaft is.
    #[point(on = cam, at = [0.0, 0.0, 0.0])]
    centre: Point,
    /// The middle of a roller, 12 mm beside the shaft.
    #[point(on = follower, at = [0.012, 0.0, 0.06])]
    roller: Point,
}

const OFFSET: f64 = 0.02;
pub(super) const FRICTION: f64 = 0.1;
pub(super) const MASS: f64 = 0.4;

pub(super) type Contact = [Interaction<f64, Cam>; 2];

/// What is known of the contact at an angle of the cam.
pub(super) struct Wanted {
    /// Of the follower (m), and its slope by the angle.
    pub(super) displacement: f64,
    pub(super) slope: f64,
    /// The normal effort (N).
    pub(super) effort: f64,
    /// Of the material of the cam against the follower, along the first direction (m/s).
    pub(super) slip: f64,
    /// Of the motor (N m).
    pub(super) torque: f64,
}

/// The force (N) that presses the follower, at its displacement (m).
pub(super) fn spring(displacement: f64) -> f64 {
    30.0 + 500.0 * displacement
}

/// The plane of the follower.
pub(super) fn flat() -> Plane<f64, Cam> {
    let on = Plane::on(Cam::HANDLES.follower, [0.0, 0.0, -0.1], [0.0, 0.0, -1.0]);
    on.along([1.0, 0.0, 0.0])
}

/// A spline whose zero direction is that of x at the start, about the shaft.
pub(super) fn profiled<const N: usize>(profile: &'static Spline<N>) -> Profiled<f64, Cam> {
    // The zero direction is made perpendicular, and both have any length.
    let (axis, zero) = ([0.0, -2.0, 0.0], [3.0, 1.0, 0.0]);
    Profiled::about(Cam::HANDLES.centre, axis, zero, profile)
}

/// A cam that turns, and its follower at a displacement (m) with a slope by the angle.
pub(super) fn turning(speed: f64, [displacement, slope]: [f64; 2]) -> (Cam, StateOf<Cam>) {
    let (cam, h) = (Cam::new(speed).expect("it is"), Cam::HANDLES);
    let mut start = cam.described_state().expect("it is described");
    cam.set_displacement(&mut start, h.guide, displacement)
        .expect("it slides");
    cam.set_angle_rate(&mut start, h.shaft, speed)
        .expect("it turns");
    cam.set_displacement_rate(&mut start, h.guide, speed * slope)
        .expect("it slides");
    (cam, start)
}

/// When (s) the follower lifts off in the first turn. Until then all is as wanted, to `share`.
pub(super) fn lifts(
    speed: f64,
    contact: Contact,
    lift: [f64; 2],
    wanted: impl Fn(f64) -> Wanted,
    share: f64,
) -> Option<f64> {
    let (cam, start) = turning(speed, lift);
    let h = Cam::HANDLES;
    let [normal, rubs] = Interaction::handles(&contact);
    let mut lifted = None;
    let turn = core::f64::consts::TAU / speed;
    let run = cam
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start)
        .interactions(contact)
        .run(
            0.0..=turn,
            every(turn / 40.0),
            |sample| -> Result<(), Fault> {
                if lifted.is_some() {
                    return Ok(());
                }
                if sample.mode(normal)? == InteractionMode::Free {
                    lifted = Some(sample.time());
                    return Ok(());
                }
                let near = |found: f64, wanted: f64, what: &str| {
                    let is_near = (found - wanted).abs() < share * (1.0 + wanted.abs());
                    assert!(is_near, "{what} {}: {found} {wanted}", sample.time());
                };
                let wanted = wanted(speed * sample.time());
                let effort = sample.effort(normal)?;
                near(effort, wanted.effort, "effort");
                near(sample.displacement(h.guide), wanted.displacement, "lift");
                near(sample.driving_effort(h.motor)?, wanted.torque, "torque");
                // Friction is against the slip, and is all that has power.
                let friction = sample.effort(rubs)?;
                let bound = -wanted.slip.signum() * FRICTION * effort;
                assert!((friction - bound).abs() < 1e-9, "{friction} {bound}");
                near(sample.power(), friction * wanted.slip, "power");
                Ok(())
            },
        );
    run.expect("it turns");
    lifted
}

/// The circle, by its closed form.
fn circle(speed: f64, angle: f64) -> Wanted {
    let displacement = OFFSET * angle.sin();
    let effort = spring(displacement) - MASS * displacement * speed * speed;
    let (height, slope) = (0.05 + displacement, OFFSET * angle.cos());
    Wanted {
        displacement,
        slope,
        effort,
        slip: -height * speed,
        torque: effort * (slope + FRICTION * height),
    }
}

/// When the closed form of the circle has no effort left (s).
fn end_on_circle(speed: f64) -> f64 {
    (30.0 / (OFFSET * (MASS * speed * speed - 500.0))).asin() / speed
}

/// The speed from which on a follower lifts off the circle: F + k e = m e w^2.
fn critical() -> f64 {
    f64::sqrt((30.0 / OFFSET + 500.0) / MASS)
}

#[test]
fn a_follower_lifts_off_from_the_speed_of_the_closed_form_on() {
    let lifts = |speed| {
        let contact = Interaction::contact(Cam::HANDLES.cam, flat()).radius(0.05);
        let contact = contact.with_plane_friction(FRICTION);
        let lift = [0.0, OFFSET];
        lifts(speed, contact, lift, |angle| circle(speed, angle), 1e-9)
    };
    assert_eq!(lifts(critical() - 1e-3), None);
    for speed in [critical() + 1e-3, 75.0, 200.0] {
        let wanted = end_on_circle(speed);
        let found = lifts(speed).expect("it lifts off");
        // Where it barely does, the instant goes with the root of the effort.
        let round_off = if speed < 71.0 { 1e-7 } else { 1e-11 };
        assert!(
            (found - wanted).abs() < round_off,
            "{speed}: {found} {wanted}"
        );
    }
}

/// The support function of the circle at so many points, with lift and slope at the start.
fn sampled<const N: usize>() -> (Contact, [f64; 2]) {
    let knots: [f64; N] = uniform_knots(0.0, core::f64::consts::TAU);
    let mut values = knots.map(|angle: f64| 0.05 + OFFSET * angle.cos());
    if let [first, .., last] = values.as_mut_slice() {
        *last = *first;
    }
    let spline: &'static _ = Box::leak(Box::new(Spline::periodic(knots, values)));
    let contact = Interaction::contact_of_cam(profiled(spline), flat());
    let up = core::f64::consts::FRAC_PI_2;
    let lift = [spline.value(up) - 0.05, -spline.slope(up)];
    (contact.with_plane_friction(FRICTION), lift)
}

/// How far a lift-off from a spline of so many points is from that of the circle (s), and a bound.
fn beside_circle<const N: usize>(speed: f64) -> [f64; 2] {
    let (contact, lift) = sampled::<N>();
    // Hall and Meyer, Optimal error bounds for cubic spline interpolation, 1976: the second
    // derivative is within 3/8 of the square of the distance of knots times the fourth one.
    let distance = core::f64::consts::TAU / (N - 1) as f64;
    let error = MASS * speed * speed * 0.375 * distance * distance * OFFSET;
    let found = lifts(speed, contact, lift, |angle| circle(speed, angle), error);
    let end = end_on_circle(speed);
    let falls = OFFSET * (speed * end).cos() * speed * (MASS * speed * speed - 500.0);
    let apart = (found.expect("it lifts off") - end).abs();
    [apart, 1.1 * error / falls]
}

#[test]
fn a_spline_of_a_circle_lifts_it_off_as_the_circle_does() {
    for speed in [75.0, 200.0] {
        let [coarse, bound] = beside_circle::<91>(speed);
        assert!(coarse < bound, "{coarse} {bound}");
        let [fine, bound] = beside_circle::<361>(speed);
        assert!(fine < bound, "{fine} {bound}");
    }
    // The least effort differs by so much of its part that goes with the square of the speed.
    let (contact, lift) = sampled::<361>();
    let speed = 0.999 * critical();
    let none = lifts(speed, contact, lift, |angle| circle(speed, angle), 1e-2);
    assert_eq!(none, None);
}
