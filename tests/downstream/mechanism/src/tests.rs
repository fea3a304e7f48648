//! The mechanisms of this crate, against formulas written by hand.

use std::vec::Vec;

use downstream_joints::differences::{assert_derivatives, assert_near, constraints, disturbed};
use mech::error::StepFault;
use mech::nalgebra::Vector3;
use mech::prelude::*;

use super::own_names::Swing;
use super::robots::inner::Arm;
use super::robots::{Gripper, Weightless};
use super::{Crane, Crossed, HALF, Linkage, Probe, sway};

#[test]
fn phi_is_what_the_formulas_say() {
    type M = Linkage;
    let mechanism = M::default();
    let state = disturbed(&mechanism);
    let (left, right, load) = (M::HANDLES.left, M::HANDLES.right, M::HANDLES.load);
    let fixed = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
    let on_left = |y: f64| M::point(&state, left, fixed(0.0, y - 0.5, 0.0));
    let on_right = |y: f64| M::point(&state, right, fixed(0.0, y - 0.5, 0.0));
    let [l, r, middle] = [left, right, load].map(|body| M::pose(&state, body).position);
    let along_x = |body| M::point(&state, body, Vector3::x()) - M::pose(&state, body).position;
    // The normals of the x axis on the ground: e_2 x e_1, and e_1 x that.
    let normals = [-Vector3::z(), Vector3::y()];
    let mut phi: Vec<f64> = Vec::new();
    phi.extend((on_left(0.0) - fixed(-HALF, 0.0, 0.0)).iter());
    phi.extend(normals.map(|normal| normal.dot(&along_x(left))));
    phi.extend(normals.map(|normal| normal.dot(&along_x(right))));
    phi.extend(normals.map(|normal| normal.dot(&(on_right(0.0) - fixed(HALF, 0.0, 0.0)))));
    phi.extend((middle - (l + r) / 2.0).iter());
    phi.push((on_right(1.0) - on_left(1.0)).norm_squared() - 1.0);
    phi.push((on_right(0.4) - on_left(0.2)).norm_squared() - 1.0);
    phi.push((r.norm_squared() - 0.49) / 2.0);
    phi.extend((on_right(0.0) - fixed(HALF, 0.0, 0.0)).iter());
    let centre_on_left = M::point(&state, left, fixed(HALF, 0.0, 0.0));
    let centre_on_right = M::point(&state, right, fixed(-HALF, 0.0, 0.0));
    let seat = M::point(&state, left, fixed(0.0, 0.1, 0.0)) - l;
    phi.extend((centre_on_right - centre_on_left - seat).iter());
    let found = constraints(&mechanism, &state);
    assert_eq!(found.len(), phi.len());
    for (row, (found, expected)) in found.iter().zip(phi).enumerate() {
        assert_near("Phi", [row, 0], *found, expected);
    }
}

#[test]
fn kernels_are_the_derivatives_of_phi() {
    let linkage = Linkage::default();
    assert_derivatives(&linkage, &disturbed(&linkage));
    let crane = Crane::default();
    assert_derivatives(&crane, &disturbed(&crane));
}

#[test]
fn joints_of_one_name_keep_apart() {
    let kinds: Vec<&str> = Linkage::REPORT
        .joints
        .iter()
        .map(|joint| joint.kind)
        .collect();
    let expected = [
        "Revolute",
        "Revolute",
        "Midpoint",
        "Rod",
        "Rod",
        "OnSphere",
        "Spherical",
        "Spherical",
    ];
    assert_eq!(kinds, expected);
    let rows: Vec<usize> = Linkage::REPORT
        .joints
        .iter()
        .map(|joint| joint.rows)
        .collect();
    assert_eq!(rows, [5, 4, 3, 1, 1, 1, 3, 3]);
}

#[test]
fn a_field_that_is_configured_out_leaves_no_trace() {
    assert_eq!(Linkage::REPORT.bodies.len(), 3);
}

#[test]
fn a_mechanism_in_a_function_moves() {
    // Hanging at rest at the angle a from the vertical: g sin(a) along the tangent, whose x
    // component is -cos(a) of it.
    let sine: f64 = 0.1;
    let expected = -10.0 * sine * (1.0 - sine * sine).sqrt();
    assert_near("u'", [0, 0], sway().unwrap(), expected);
}

/// Everything that a built-in driver and joint have, a joint of another crate has: handle,
/// readings, efforts, report, parameters.
#[test]
fn a_driven_joint_of_another_crate_reads_like_a_built_in_one() {
    let probe = Probe::new(0.3, 0.25).unwrap();
    let (tip, arm) = (Probe::HANDLES.tip, Probe::HANDLES.arm);
    assert_eq!((arm.name(), tip.name()), ("arm", "tip"));
    let report = Probe::REPORT;
    let info = report.joints[0];
    assert_eq!((info.kind, info.rows, info.row), ("Telescope", 6, 0));
    assert!(info.has_angle && info.has_displacement);
    assert_eq!((report.equations, report.auxiliaries), (6, 1));
    assert_eq!(
        <downstream_joints::Telescope as mech::mechanism::Joint>::EQUATIONS,
        6
    );
    let mut times = 0;
    let _ = KinematicAnalysis::new(&probe, StandardLagrange)
        .run(0.0..=3.0, every(0.1), |sample| {
            times += 1;
            let t: f64 = sample.time();
            let (reach, speed) = (0.3 * t * t, 0.6 * t);
            assert_near("displacement", [times, 0], sample.displacement(arm), reach);
            assert_near("its rate", [times, 1], sample.displacement_rate(arm), speed);
            // At 0.25 m a turn it is more than ten turns in the end.
            let turned = core::f64::consts::TAU * reach / 0.25;
            assert_near("angle", [times, 2], sample.angle(arm), turned);
            let rate = core::f64::consts::TAU * speed / 0.25;
            assert_near("its rate", [times, 3], sample.angle_rate(arm), rate);
            // 2 kg and 0.05 kg m^2 at 0.6 m/s^2, against 9.81 m/s^2 along the axis.
            let spin = 0.05 * (core::f64::consts::TAU / 0.25).powi(2);
            let effort = sample.driving_effort(arm).unwrap();
            assert_near(
                "effort",
                [times, 4],
                effort,
                2.0 * 9.81 + (2.0 + spin) * 0.6,
            );
            let wrench = sample.reaction(arm, tip).unwrap();
            assert_near("force", [times, 5], wrench.force.z, 2.0 * (9.81 + 0.6));
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(times, 31);
}

/// A number that is not acceptable, and rows that depend on each other, are reported under the name
/// of the field.
#[test]
fn errors_at_run_time_name_a_joint_of_another_crate() {
    let error = Probe::new(f64::NAN, 0.25).unwrap_err();
    assert_eq!(error.field, "speed");
    let crossed = Crossed::new(0.0, 0.0, 0.0).unwrap_err();
    assert_eq!((crossed.field, crossed.attribute), ("arm", "axis"));
    assert_eq!(
        std::format!("{crossed}"),
        "`axis` of `arm` must not be the zero vector"
    );
    // Two of them along one line hold the same five motions twice. What moves against them at the
    // start is beside the point.
    let twice = Crossed::new(0.0, 0.0, 1.0).unwrap();
    let error = Simulation::new(&twice, StandardLagrange, Rk4::every(0.1))
        .inconsistent_start()
        .run(0.0..=1.0, every(0.5), |_| ControlFlow::Continue(()))
        .unwrap_err();
    let Fault::Step(StepFault::Singular { name, .. }) = error.fault else {
        panic!("{}", error.fault);
    };
    assert!(["arm", "spare"].contains(&name), "{name}");
}

#[test]
fn a_joint_imported_by_name_comes_before_that_of_the_prelude() {
    let kinds: Vec<_> = Swing::REPORT
        .joints
        .iter()
        .map(|joint| (joint.kind, joint.rows))
        .collect();
    assert_eq!(kinds, [("Gear", 3), ("PointOnPlane", 1)]);
    assert_eq!(Swing::REPORT.forces.len(), 1);
}

/// A hinge turns about the mirrored axis with the same sign.
#[test]
fn parts_of_another_crate_are_like_what_is_written_by_hand() {
    use crate::swings::{ByHand, Swings};
    use downstream_joints::{Bob, Swing};
    use mech::{Rk4, Simulation, StandardLagrange, every};

    let parts = Swings::new([Swing::new(Bob::new(0.6)); 2]).unwrap();
    let hand = ByHand::new(0.6).unwrap();
    let mut courses = [[0.0_f64; 3]; 2];
    let h = Swings::HANDLES;
    let _ = Simulation::new(&parts, StandardLagrange, Rk4::every(0.01))
        .run(0.0..=0.5, every(0.5), |sample| {
            let [right, left] = h.pair.map(|swing| sample.angle(swing.hinge));
            courses[0] = [sample.displacement(h.slide), right, left];
        })
        .unwrap();
    let h = ByHand::HANDLES;
    let _ = Simulation::new(&hand, StandardLagrange, Rk4::every(0.01))
        .run(0.0..=0.5, every(0.5), |sample| {
            let [right, left] = h.hinges.map(|hinge| sample.angle(hinge));
            courses[1] = [sample.displacement(h.slide), right, left];
        })
        .unwrap();
    let [parts, hand] = courses;
    assert!(parts[1].abs() > 0.1, "{parts:?}");
    for (a, b) in parts.iter().zip(hand) {
        assert!((a - b).abs() < 1e-11, "{parts:?} {hand:?}");
    }
}

/// Robots of a file are what their options say, wherever they are.
#[test]
fn robots_are_made_in_modules_and_in_functions() {
    mech::urdf! {
        struct Local = "../../../urdf/tests/data/gripper.urdf";
    }
    assert_eq!(Local::REPORT.joints, Gripper::REPORT.joints);
    assert_eq!(Local::JOINT_NAMES, ["left", "tip", "right"]);
    assert_eq!(Gripper::REPORT.forces.len(), 1);
    assert!(Weightless::REPORT.forces.is_empty());
    assert_eq!(Weightless::default(), Weightless::default());
    let arm = Arm::new(3.0).expect("a stiffness");
    let mut state = arm.described_state::<f64>().expect("sound");
    arm.set_angle(&mut state, Arm::HANDLES.elbow, 0.5)
        .expect("it carries");
    let stored = |arm: &Arm| arm.view(0.0, &state).expect("sound").potential_energy();
    let slack = Arm::new(0.0).expect("a stiffness");
    assert!((stored(&arm) - stored(&slack) - 0.375).abs() < 1e-12);
}
