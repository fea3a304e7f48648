//! Accelerations of laws that switch against the same laws as closures, at random states.

use holonom::dynamics::Dynamics;
use holonom::integrate::{OneStep as _, Rk4};
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;

/// Two links with a motor between them, and a rope with a damper that pull alone.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Switching {
    #[body(mass = 1.0, inertia = [0.1, 0.02, 0.1], position = [0.0, 0.5, 0.0])]
    first: Body,
    #[body(mass = 0.7, inertia = [0.05, 0.02, 0.05], position = [0.0, 1.5, 0.0])]
    second: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [first, second], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[force(
        between = [first, second], axis = [1.0, 0.0, 0.0],
        moment = if angle > 0.2 && rate < 1.0 || time > 2.0 {
            -3.0 * sign(rate) * abs(angle)
        } else {
            max(-1.5, min(1.5, 4.0 * angle - rate))
        }
    )]
    motor: TorsionalActuator,
    #[force(
        between = [ground, second], head = [0.0, 0.0, 3.0], tail = [0.0, 2.0, 0.0],
        force = -max(0.0, 40.0 * (length - 3.0) + if rate >= 0.0 { 5.0 * rate } else { 0.0 })
    )]
    rope: Actuator,
}

/// The links alone.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Plain {
    #[body(mass = 1.0, inertia = [0.1, 0.02, 0.1], position = [0.0, 0.5, 0.0])]
    first: Body,
    #[body(mass = 0.7, inertia = [0.05, 0.02, 0.05], position = [0.0, 1.5, 0.0])]
    second: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [first, second], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// A step (s) that moves nothing past its switch, but for some states of a million.
const STEP: f64 = 1e-6;

/// Numbers between -1 and 1, the same at every run.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005);
    *seed = seed.wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The laws as a program, over what can be read of the links.
fn law(time: f64, loads: &mut holonom::Loads<'_, f64, Plain>) {
    let h = Plain::HANDLES;
    let view = loads.view();
    let (angle, rate) = (view.angle(h.elbow), view.angle_rate(h.elbow));
    let moment = if angle > 0.2 && rate < 1.0 || time > 2.0 {
        -3.0 * rate.signum() * angle.abs()
    } else {
        (4.0 * angle - rate).clamp(-1.5, 1.5)
    };
    let tip = [0.0, 0.5, 0.0];
    let way = view.point(h.second, tip.into());
    let way = [way.x, way.y, way.z - 3.0];
    let velocity = view.point_velocity(h.second, tip.into());
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
    let rate = (way[0] * velocity.x + way[1] * velocity.y + way[2] * velocity.z) / length;
    let damper = if rate >= 0.0 { 5.0 * rate } else { 0.0 };
    let pull = (40.0 * (length - 3.0) + damper).max(0.0);
    loads.moment_between(h.elbow, moment);
    loads.force_at(h.second, tip, way.map(|x| -pull * x / length));
}

/// By how much accelerations differ, and how often each law did something else.
fn compare<C, P>() -> (f64, [usize; 3])
where
    C: Coordinates<Switching>,
    P: Coordinates<Plain>,
{
    let (switching, plain) = (Switching::default(), Plain::default());
    let (h, of_plain) = (Switching::HANDLES, Plain::HANDLES);
    let own = Dynamics::<Problem<_, _>>::new(&switching, StandardLagrange).expect("sound");
    let mut own = own.coordinates::<C>();
    let other = Dynamics::<Problem<_, _>>::new(&plain, StandardLagrange).expect("sound");
    let other = other.forces(|time, _, loads| law(time, loads));
    let mut other = other.coordinates::<P>();
    let (mut worst, mut seed, mut counts) = (0.0_f64, 5, [0; 3]);
    for _ in 0..2000 {
        let [shoulder, elbow] = [(); 2].map(|()| 1.5 * random(&mut seed));
        let [turning, bending] = [(); 2].map(|()| 3.0 * random(&mut seed));
        let time = 1.5 + random(&mut seed);
        let mut state = switching.described_state().expect("sound");
        switching
            .set_angle(&mut state, h.shoulder, shoulder)
            .expect("free");
        switching
            .set_angle(&mut state, h.elbow, elbow)
            .expect("free");
        switching
            .set_angle_rate(&mut state, h.shoulder, turning)
            .expect("free");
        switching
            .set_angle_rate(&mut state, h.elbow, bending)
            .expect("free");
        let mut same = plain.described_state().expect("sound");
        plain
            .set_angle(&mut same, of_plain.shoulder, shoulder)
            .expect("free");
        plain
            .set_angle(&mut same, of_plain.elbow, elbow)
            .expect("free");
        plain
            .set_angle_rate(&mut same, of_plain.shoulder, turning)
            .expect("free");
        plain
            .set_angle_rate(&mut same, of_plain.elbow, bending)
            .expect("free");
        let accelerations = own.evaluate_bodies(time, &state).expect("sound").rates;
        let wanted = other.evaluate_bodies(time, &same).expect("sound").rates;
        let both = accelerations.velocities().iter().zip(wanted.velocities());
        for (found, wanted) in both {
            worst = worst.max((found - wanted).abs() / (1.0 + wanted.abs()));
        }
        // In the coordinates themselves: what a short step does to the rates.
        let mut moved = own.state_of(&state).expect("sound");
        Rk4.step(&mut own, time, &mut moved, STEP).expect("sound");
        let mut wanted = other.state_of(&same).expect("sound");
        Rk4.step(&mut other, time, &mut wanted, STEP)
            .expect("sound");
        let (moved, wanted) = (own.bodies(&moved), other.bodies(&wanted));
        let both = moved.velocities().iter().zip(wanted.velocities());
        for (found, wanted) in both {
            worst = worst.max((found - wanted).abs());
        }
        counts[0] += usize::from(elbow > 0.2 && bending < 1.0 || time > 2.0);
        let view = switching.view(time, &state).expect("sound");
        let pull = view.load(h.rope, h.second).expect("an end").force;
        counts[1] += usize::from(pull.norm() > 0.0);
        counts[2] += usize::from((4.0 * elbow - bending).abs() < 1.5);
    }
    (worst, counts)
}

#[test]
fn laws_are_those_of_closures() {
    for (worst, counts) in [
        compare::<Absolute, Absolute>(),
        compare::<Relative, Relative>(),
    ] {
        assert!(worst < 1e-11, "{worst:e}");
        assert!(
            counts.iter().all(|&count| count > 200 && count < 1800),
            "{counts:?}"
        );
    }
}
