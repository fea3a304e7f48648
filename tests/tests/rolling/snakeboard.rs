//! A snakeboard against its minimal equation (Bloch, Krishnaprasad, Marsden and Murray 1996).

use holonom::nalgebra::UnitQuaternion;
use holonom::prelude::*;

/// A board on two axles 0.25 m before and behind its middle, which turn against each other, and a
/// rotor that is swung to and fro.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Snakeboard {
    #[body(mass = 1.5, inertia = [0.01, 0.06, 0.07])]
    board: Body,
    #[body(mass = 3.0, inertia = [0.05, 0.05, 0.1])]
    rotor: Body,
    #[body(mass = 0.4, inertia = [1e-3, 1e-3, 2e-3], position = [0.25, 0.0, 0.0])]
    front: Body,
    #[body(mass = 0.4, inertia = [1e-3, 1e-3, 2e-3], position = [-0.25, 0.0, 0.0])]
    rear: Body,
    #[joint(between = [ground, board], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: Planar,
    #[joint(between = [board, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rotor_hinge: Revolute,
    #[joint(between = [board, front], point = [0.25, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    front_hinge: Revolute,
    #[joint(between = [board, rear], point = [-0.25, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    rear_hinge: Revolute,
    #[joint(between = [ground, front], point = [0.25, 0.0, 0.0], side = [0.0, 1.0, 0.0])]
    front_wheels: KnifeEdge,
    #[joint(between = [ground, rear], point = [-0.25, 0.0, 0.0], side = [0.0, 1.0, 0.0])]
    rear_wheels: KnifeEdge,
    #[joint(between = [board, rotor], axis = [0.0, 0.0, 1.0], motion = 0.7 * sin(4.0 * time))]
    swing: AngleDriver,
    #[joint(between = [board, front], axis = [0.0, 0.0, 1.0], motion = 0.4 * sin(4.0 * time))]
    front_steering: AngleDriver,
    #[joint(between = [board, rear], axis = [0.0, 0.0, 1.0], motion = -0.4 * sin(4.0 * time))]
    rear_steering: AngleDriver,
}

/// Rates of the speed `u` along the board, of its angle and of its place. The axles let it turn
/// at `w = u tan(phi) / l`, and no point of its middle moves across. So
/// `m u' + (J w' + J_r psi'') tan(phi) / l = 0`, with the whole mass `m` and the moment of inertia
/// `J` of all. What the axles take for their turns, they take from each other.
fn rates(time: f64, [u, angle, ..]: [f64; 4]) -> [f64; 4] {
    let (mass, length, of_rotor) = (1.5 + 3.0 + 2.0 * 0.4, 0.25, 0.1);
    let inertia = 0.07 + of_rotor + 2.0 * (2e-3 + 0.4 * length * length);
    let (sine, cosine) = (4.0 * time).sin_cos();
    let (phi, phi_rate, swung) = (0.4 * sine, 1.6 * cosine, -0.7 * 16.0 * sine);
    let slope = phi.tan() / length;
    let slope_rate = phi_rate / (length * phi.cos().powi(2));
    let push = -slope * (inertia * slope_rate * u + of_rotor * swung);
    [
        push / (mass + inertia * slope * slope),
        slope * u,
        u * angle.cos(),
        u * angle.sin(),
    ]
}

/// From rest, by Runge-Kutta steps of 0.1 ms.
fn after(time: f64) -> [f64; 4] {
    let (mut y, h) = ([0.0; 4], 1e-4);
    for step in 0..(time / h).round() as usize {
        let t = h * step as f64;
        let at = |k: [f64; 4], h: f64| core::array::from_fn(|i| y[i] + h * k[i]);
        let first = rates(t, y);
        let second = rates(t + 0.5 * h, at(first, 0.5 * h));
        let third = rates(t + 0.5 * h, at(second, 0.5 * h));
        let last = rates(t + h, at(third, h));
        for i in 0..4 {
            y[i] += h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + last[i]);
        }
    }
    y
}

#[test]
fn a_snakeboard_is_swung_forwards() {
    let h = Snakeboard::HANDLES;
    let snakeboard = Snakeboard::default();
    let expected: Vec<_> = (0..5).map(|second| after(f64::from(second))).collect();
    assert!(
        expected[4][2].hypot(expected[4][3]) > 0.5,
        "it is moved: {expected:?}"
    );
    let observe = |sample: &Sample<'_, f64, Snakeboard>| {
        let [u, angle, x, y] = expected[sample.time().round() as usize];
        let pose = sample.pose(h.board);
        let turned = UnitQuaternion::new_unchecked(pose.orientation);
        let along = turned.inverse() * sample.velocity(h.board);
        for (found, expected) in [
            (along.x, u),
            (along.y, 0.0),
            (2.0 * pose.orientation.k.atan2(pose.orientation.w), angle),
            (pose.position.x, x),
            (pose.position.y, y),
        ] {
            let off = (found - expected).abs();
            assert!(off < 1e-9, "{}: {found} for {expected}", sample.time());
        }
    };
    let simulation =
        || Simulation::new(&snakeboard, StandardLagrange, Rk4::every(1e-3)).assembled();
    simulation()
        .absolute_coordinates()
        .run(0.0..=4.0, every(1.0), observe)
        .expect("a run");
    simulation()
        .joint_coordinates()
        .run(0.0..=4.0, every(1.0), observe)
        .expect("a run");
}
