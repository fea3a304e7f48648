//! Forces of the language once more as a closure at run time.

use holonom::forces::{Actuator, ConstantMoment, FollowerForce, FollowerMoment, PointForce};
use holonom::prelude::*;
use holonom::{StateParts, dynamics::Dynamics};
use nalgebra::Vector3;

use crate::comparison::{ROUND_OFF, distance};

#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Bare {
    #[body(free, mass = 0.7, inertia = [0.1, 0.15, 0.12], position = [-0.4, 0.3, 0.2], angular_velocity = [1.0, 0.5, -2.0])]
    j: Body,
}

#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Forced {
    #[body(free, mass = 0.7, inertia = [0.1, 0.15, 0.12], position = [-0.4, 0.3, 0.2], angular_velocity = [1.0, 0.5, -2.0])]
    j: Body,
    #[force(between = [ground, j], point = [0.1, 0.4, 0.0], force = [3.0, -1.0, 2.0])]
    push: PointForce,
    #[force(between = [j], point = [0.1, 0.4, 0.0], force = [0.5, 1.0, -2.0])]
    thrust: FollowerForce,
    #[force(between = [ground, j], moment = [0.3, 0.7, -0.2])]
    twist: ConstantMoment,
    #[force(between = [j], moment = [0.2, 0.1, 0.4])]
    spin: FollowerMoment,
    #[force(between = [ground, j], head = [0.0, 0.0, 1.0], tail = [0.1, 0.4, 0.0], force = 5.0 * length - 2.0 * rate + time)]
    ram: Actuator,
}

#[test]
fn accelerations_are_the_same() {
    let arm = Vector3::new(0.5, 0.1, -0.2);
    let handle = Bare::HANDLES.j;
    let bare = Dynamics::<Problem<Bare, _>>::new(&Bare::default(), StandardLagrange)
        .expect("acceptable")
        .forces(|time, state, loads| {
            loads.force_at(handle, arm.into(), [3.0, -1.0, 2.0]);
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()]
                .map(|axis| Bare::point(state, handle, axis) - Bare::pose(state, handle).position);
            let thrust = 0.5 * axes[0] + axes[1] - 2.0 * axes[2];
            loads.force_at(handle, arm.into(), thrust.into());
            loads.moment(handle, [0.3, 0.7, -0.2]);
            loads.moment_in_body_axes(handle, [0.2, 0.1, 0.4]);
            let line = Bare::point(state, handle, arm) - Vector3::z();
            let rate = Bare::point_velocity(state, handle, arm).dot(&line) / line.norm();
            let force = 5.0 * line.norm() - 2.0 * rate + time;
            loads.force_at(handle, arm.into(), (force * line.normalize()).into());
        });
    let forced = Dynamics::<Problem<Forced, _>>::new(&Forced::default(), StandardLagrange)
        .expect("acceptable");
    let mut x =
        holonom::MechanismExt::described_state::<f64>(&Forced::default()).expect("described");
    for (step, time) in [0.0, 0.4, 1.3].into_iter().enumerate() {
        let (said, _) = forced.evaluate(time, &x).expect("regular");
        let (done, _) = bare.evaluate(time, &x).expect("regular");
        let deviation = distance(done.rates.velocities(), said.rates.velocities(), 1.0);
        assert!(deviation <= ROUND_OFF, "{deviation:e} at {time}");
        // Somewhere else.
        let q = x.coordinates_mut();
        for (k, value) in q.iter_mut().enumerate() {
            *value += 0.1 * ((k + step) as f64).sin();
        }
    }
}
