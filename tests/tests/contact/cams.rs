//! A cam whose flat follower lifts off.

use holonom::prelude::*;
use holonom::run::{InteractionMode, Plane};

use super::tight;

/// A round cam of 50 mm, 20 mm from its shaft, below a flat follower with a spring.
#[derive(Mechanism)]
struct Cam {
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
}

const OFFSET: f64 = 0.02;
const FRICTION: f64 = 0.1;

/// The normal effort (N) at an angle of the cam, as long as they touch.
fn pressed(speed: f64, angle: f64) -> f64 {
    30.0 + OFFSET * angle.sin() * (500.0 - 0.4 * speed * speed)
}

/// When (s) the follower lifts off in the first turn.
fn lifts(speed: f64) -> Option<f64> {
    let cam = Cam::new(speed).expect("it is");
    let h = Cam::HANDLES;
    let mut start = cam.described_state().expect("it is described");
    cam.set_angle_rate(&mut start, h.shaft, speed)
        .expect("it turns");
    cam.set_displacement_rate(&mut start, h.guide, OFFSET * speed)
        .expect("it slides");
    let flat = Plane::on(h.follower, [0.0, 0.0, -0.1], [0.0, 0.0, -1.0]).along([1.0, 0.0, 0.0]);
    let contact = Interaction::contact(h.cam, flat)
        .radius(0.05)
        .with_plane_friction(FRICTION);
    let [normal, rubs] = Interaction::handles(&contact);
    let mut lifted = None;
    let turn = core::f64::consts::TAU / speed;
    cam.simulation(StandardLagrange, DormandPrince::new(tight()))
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
                let wanted = pressed(speed, speed * sample.time());
                let effort = sample.effort(normal)?;
                assert!((effort - wanted).abs() < 1e-8, "{effort} {wanted}");
                // The cam slips backwards at its top.
                assert!((sample.effort(rubs)? - FRICTION * effort).abs() < 1e-9);
                Ok(())
            },
        )
        .expect("it turns");
    lifted
}

#[test]
fn a_follower_lifts_off_from_the_speed_of_the_closed_form_on() {
    // F + k e = m e w^2
    let critical = f64::sqrt((30.0 / OFFSET + 500.0) / 0.4);
    assert_eq!(lifts(critical - 1e-3), None);
    for speed in [critical + 1e-3, 75.0, 200.0] {
        let sine = 30.0 / (OFFSET * (0.4 * speed * speed - 500.0));
        let wanted = sine.asin() / speed;
        let found = lifts(speed).expect("it lifts off");
        // Where it barely does, the instant goes with the root of the effort.
        let round_off = if speed < 71.0 { 1e-7 } else { 1e-11 };
        assert!(
            (found - wanted).abs() < round_off,
            "{speed}: {found} {wanted}"
        );
    }
}
