//! The angles of a universal joint between two shafts, against the closed form.

use holonom::prelude::*;
use nalgebra::{Unit, UnitQuaternion, Vector3};

/// Two shafts that a universal joint connects, the first along x, the second bent by `bend` about z
/// against it. No other mechanism of the tests has a loop with a cross.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass])]
struct Shafts {
    #[param(like = 0.5)]
    bend: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.03], position = [-0.5, 0.0, 0.0])]
    first: Body,
    #[body(
        mass = 1.0, inertia = [0.02, 0.03, 0.03], position = [0.5 * cos(bend), 0.5 * sin(bend), 0.0],
        orientation = rotation([0.0, 0.0, 1.0], bend)
    )]
    second: Body,
    #[joint(between = [ground, first], point = [-0.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bearing: Revolute,
    #[joint(
        between = [first, second], point = [0.0, 0.0, 0.0],
        axis_i = [0.0, 0.0, 1.0], axis_j = [-sin(bend), cos(bend), 0.0]
    )]
    cross: Universal,
    #[joint(
        between = [ground, second],
        axis_i = [cos(bend), sin(bend), 0.0],
        axis_j = [cos(bend), sin(bend), 0.0]
    )]
    guide: Parallel1,
}

/// With the first shaft turned by `f`, the second axis is `X(f) Z(bend + a) Y(b) x`. So
/// `sin(b) = sin(bend) sin(f)` and `tan(bend + a) = tan(bend) cos(f)`. The second shaft is turned
/// by `g`, `tan(g) = tan(f) cos(bend)` (Hooke), as the arms of the cross say.
#[test]
fn a_cardan_shaft() -> Result<(), Fault> {
    let h = Shafts::HANDLES;
    for bend in [0.3, 0.5, 1.1_f64] {
        let shafts = Shafts::new(bend)?;
        let space = shafts.coordinates([h.bearing])?;
        let mut near = space.state([0.0], [0.0])?;
        for step in -40..=40 {
            let (turn, rate) = (0.15 * f64::from(step), 2.0);
            near = space.state_near(&near, [turn], [rate])?;
            let bodies = space.bodies(&near);
            let view = shafts.view(0.0, &bodies)?;
            let (sine, cosine) = turn.sin_cos();
            let [a, b] = view.angles(h.cross);
            let wanted = [
                (bend.sin() * cosine).atan2(bend.cos()) - bend,
                (bend.sin() * sine).asin(),
            ];
            assert!(
                (a - wanted[0]).abs() < 1e-12 && (b - wanted[1]).abs() < 1e-12,
                "{turn}"
            );
            let rates = [
                -bend.tan() * sine * rate * (wanted[0] + bend).cos().powi(2),
                bend.sin() * cosine * rate / wanted[1].cos(),
            ];
            let found = view.angle_rates(h.cross);
            assert!((found[0] - rates[0]).abs() < 1e-11 && (found[1] - rates[1]).abs() < 1e-11);
            // The second shaft itself, by its pose.
            let second = view.pose(h.second).orientation;
            let second = UnitQuaternion::from_quaternion(second);
            let straight = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), bend);
            let turned = (second * straight.inverse()).scaled_axis();
            let along = Vector3::new(bend.cos(), bend.sin(), 0.0);
            let hooke = (sine * bend.cos()).atan2(cosine);
            let off = (turned.dot(&along) - hooke) / core::f64::consts::TAU;
            assert!((off - off.round()).abs() < 1e-11, "{turn}: {off}");
            assert!(turned.cross(&along).norm() < 1e-10);
        }
    }
    Ok(())
}

/// The rotation of the second body is that about the second axis, then that about the first.
#[test]
fn angles_of_a_cross_make_its_rotation() -> Result<(), Fault> {
    let (shafts, h) = (Shafts::new(0.5)?, Shafts::HANDLES);
    let mut state = shafts.described_state::<f64>()?;
    let view = shafts.view(0.0, &state)?;
    assert!(view.angles(h.cross).iter().all(|angle| angle.abs() < 1e-15));
    let straight = UnitQuaternion::from_quaternion(view.pose(h.second).orientation);
    let pitched = Unit::new_normalize(Vector3::new(-0.5_f64.sin(), 0.5_f64.cos(), 0.0));
    for (a, b) in [(0.4, -0.7), (-2.5, 1.2), (3.0, -3.0), (1e-9, 2e-9)] {
        // Whatever the first body does is no part of it.
        let carried = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.7);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a)
            * UnitQuaternion::from_axis_angle(&pitched, b);
        let mut pose = Shafts::pose(&state, h.first);
        pose.orientation = carried.into_inner();
        Shafts::set_pose(&mut state, h.first, pose);
        pose.orientation = (carried * turn * straight).into_inner();
        Shafts::set_pose(&mut state, h.second, pose);
        // `w = a' u + b' v`, beside what the first body does.
        let own = Vector3::new(0.2, 0.5, -0.1);
        let [u, v] = [
            carried * Vector3::z(),
            carried * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a) * pitched.into_inner(),
        ];
        Shafts::set_angular_velocity_global(&mut state, h.first, own);
        Shafts::set_angular_velocity_global(&mut state, h.second, own + u * 1.5 - v * 0.6);
        let view = shafts.view(0.0, &state)?;
        let (found, rates) = (view.angles(h.cross), view.angle_rates(h.cross));
        assert!(
            (found[0] - a).abs() < 1e-13 && (found[1] - b).abs() < 1e-13,
            "{found:?}"
        );
        assert!(
            (rates[0] - 1.5).abs() < 1e-13 && (rates[1] + 0.6).abs() < 1e-13,
            "{rates:?}"
        );
    }
    Ok(())
}
