//! A ball in a spherical bowl, and on the outside of a sphere, against closed forms.

use holonom::Pose;
use holonom::nalgebra::{Rotation3, UnitQuaternion, Vector3};
use holonom::prelude::*;

/// A ball of 0.7 kg and 5 cm.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Bowl {
    /// The radius of the bowl (m); negative outside of a sphere.
    #[param]
    bowl: f64,
    #[body(
        mass = 0.7, inertia = [0.4 * 0.7 * 0.05 * 0.05, 0.4 * 0.7 * 0.05 * 0.05, 0.4 * 0.7 * 0.05 * 0.05],
        position = [0.0, 0.0, 0.05 - bowl]
    )]
    ball: Body,
    #[joint(
        between = [ground, ball], center = [0.0, 0.0, 0.05 - bowl], bowl = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        radius = 0.05, bowl_radius = bowl
    )]
    contact: RollingBallInBowl,
}

/// Mass, moment of inertia, radius, gravity.
const BALL: [f64; 4] = [0.7, 0.4 * 0.7 * 0.05 * 0.05, 0.05, 9.81];

/// The state at an angle from the bottom, or from the top outside, and the direction `u` from the
/// ball to the point of contact. The spin is that about `u`. Without slip,
/// `w = v x u / r + spin u`.
fn state(
    bowl: &Bowl,
    angle: f64,
    velocity: Vector3<f64>,
    spin: f64,
) -> (StateOf<Bowl>, Vector3<f64>) {
    let [_, _, radius, _] = BALL;
    let h = Bowl::HANDLES;
    let outward = Vector3::new(angle.sin(), 0.0, -angle.cos());
    let mut state: StateOf<Bowl> = bowl.described_state().expect("as described");
    Bowl::set_pose(
        &mut state,
        h.ball,
        Pose {
            position: (bowl.bowl - radius) * outward,
            orientation: UnitQuaternion::identity().into_inner(),
        },
    );
    Bowl::set_velocity(&mut state, h.ball, velocity);
    let turns = velocity.cross(&outward) / radius + spin * outward;
    Bowl::set_angular_velocity_global(&mut state, h.ball, turns);
    (state, outward)
}

/// The ball is carried round a horizontal circle at a rate `W`. With `l` the radius of the bowl
/// less that of the ball, it has the velocity `W l k x u` and spins at `s u - (l / r) W k`. The
/// moment of the contact, `r u x m (a + g k)`, turns its angular momentum:
/// `J W s = r m (W^2 l cos(angle) - g)`.
#[test]
fn a_ball_runs_in_horizontal_circles() {
    let [mass, inertia, radius, gravity] = BALL;
    let (h, up) = (Bowl::HANDLES, Vector3::z());
    for (of_bowl, angle, turn) in [
        (0.6, 0.7, 3.0),
        (0.6, 1.5, -12.0),
        (0.6, 2.4, 9.0),
        (-0.4, 0.8, 2.0),
        (-0.4, 2.0, -5.0),
    ] {
        let bowl = Bowl::new(of_bowl).expect("a bowl");
        let gap = of_bowl - radius;
        let fall = turn * turn * gap * f64::cos(angle) - gravity;
        let about_line = radius * mass * fall / (inertia * turn);
        let spin = about_line + gap / radius * turn * f64::cos(angle);
        let circle = gap * f64::sin(angle);
        let (state, outward) = state(&bowl, angle, Vector3::new(0.0, turn * circle, 0.0), spin);
        let period = core::f64::consts::TAU / turn.abs();
        let observe = |sample: &Sample<'_, f64, Bowl>| -> Result<(), Fault> {
            let carried = Rotation3::from_axis_angle(&Vector3::z_axis(), turn * sample.time());
            let direction = carried * outward;
            let place = sample.pose(h.ball).position;
            assert!((place - gap * direction).norm() < 1e-9, "{angle} {place}");
            let spins = about_line * direction - gap / radius * turn * up;
            let off = (sample.angular_velocity_global(h.ball) - spins).norm();
            assert!(off < 1e-9 * (1.0 + spins.norm()), "{angle} {off:e}");
            let inward = Vector3::new(direction.x, direction.y, 0.0);
            let expected = mass * (gravity * up - turn * turn * gap * inward);
            let reaction = sample.reaction(h.contact, h.ball)?;
            assert!((reaction.force - expected).norm() < 1e-8 * expected.norm());
            let touches = sample.contact(h.contact);
            assert!((touches.position - of_bowl * direction).norm() < 1e-9);
            assert!((touches.normal + direction).norm() < 1e-9);
            assert!(touches.slip.norm() < 1e-9 * (1.0 + spins.norm()));
            let moment = radius * direction.cross(&expected);
            assert!((reaction.moment - moment).norm() < 1e-9 * expected.norm());
            Ok(())
        };
        let tight = DormandPrince853::new(Tolerance {
            relative: 1e-12,
            absolute: 1e-13,
        });
        let simulation = || Simulation::new(&bowl, StandardLagrange, tight).initial_state(state);
        simulation()
            .absolute_coordinates()
            .run(0.0..=period, every(period / 8.0), observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=period, every(period / 8.0), observe)
            .expect("a run");
    }
}

/// However it runs, the energy and the spin about the line of the centres stay. So does the moment
/// of momentum about the vertical less `l / r` times that of the spin. With `J w' = r u x F` and
/// the place `l u`, both take the same moment of the contact.
#[test]
fn the_spin_about_the_line_of_the_centres_stays() {
    let [mass, inertia, radius, _] = BALL;
    let h = Bowl::HANDLES;
    let bowl = Bowl::new(0.6).expect("a bowl");
    let (state, _) = state(&bowl, 0.9, Vector3::new(0.0, 0.8, 0.0), 30.0);
    let mut first = None;
    let observe = |sample: &Sample<'_, f64, Bowl>| {
        let (place, velocity) = (sample.pose(h.ball).position, sample.velocity(h.ball));
        let outward = place / (0.6 - radius);
        let spin = sample.angular_velocity_global(h.ball);
        let about_line = spin.dot(&outward);
        let turned = (0.6 - radius) / radius * inertia * spin.z;
        let about_vertical = mass * place.cross(&velocity).z - turned;
        let found = [about_line, sample.energy(), about_vertical];
        for (found, expected) in found.iter().zip(*first.get_or_insert(found)) {
            assert!(
                (found - expected).abs() < 1e-9 * expected.abs(),
                "{found} {expected}"
            );
        }
    };
    Simulation::new(&bowl, StandardLagrange, Rk4::every(5e-4))
        .initial_state(state)
        .run(0.0..=3.0, every(0.05), observe)
        .expect("a run");
}

/// At the rim of half a sphere its two equations of velocities are one, in any direction.
#[test]
fn a_ball_that_runs_over_the_rim_is_told() {
    let h = Bowl::HANDLES;
    let bowl = Bowl::new(0.6).expect("a bowl");
    for azimuth in [0.0, 0.4, 0.785] {
        let about = Rotation3::from_axis_angle(&Vector3::z_axis(), azimuth);
        let velocity = -3.0 * Vector3::new(1.4_f64.cos(), 0.0, 1.4_f64.sin());
        let (mut state, _) = state(&bowl, 1.4, velocity, 0.0);
        let position = about * Bowl::pose(&state, h.ball).position;
        let spin = about * Bowl::angular_velocity_global(&state, h.ball);
        let orientation = UnitQuaternion::identity().into_inner();
        Bowl::set_pose(
            &mut state,
            h.ball,
            Pose {
                position,
                orientation,
            },
        );
        Bowl::set_velocity(&mut state, h.ball, about * velocity);
        Bowl::set_angular_velocity_global(&mut state, h.ball, spin);
        let report = Simulation::new(&bowl, StandardLagrange, DormandPrince::default())
            .initial_state(state)
            .run(0.0..=1.0, every(0.1), |_| {})
            .expect("steps lead over it");
        let told = report.warnings().to_string();
        assert!(told.contains("joint `contact`"), "{azimuth}: {told}");
    }
}
