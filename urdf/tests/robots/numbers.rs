//! Bodies, joints and frames of robots, against what Pinocchio makes of the same files.

use std::collections::BTreeMap;

use holonom::nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use holonom_urdf::Mechanism;
use serde::Deserialize;

/// What Pinocchio knows of a robot with all joints at zero, in global axes.
#[derive(Deserialize)]
struct Reference {
    ground_mass: f64,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    frames: Vec<Frame>,
}

#[derive(Deserialize)]
struct Body {
    /// The joint that carries it.
    joint: String,
    mass: f64,
    centre: [f64; 3],
    /// About the centre of mass.
    inertia: [[f64; 3]; 3],
}

#[derive(Deserialize)]
struct Joint {
    name: String,
    point: [f64; 3],
    axis: [f64; 3],
}

#[derive(Deserialize)]
struct Frame {
    link: String,
    origin: [f64; 3],
    rotation: [[f64; 3]; 3],
}

/// Relative errors, and those of lengths in m.
const LIMIT: f64 = 1e-12;

fn rotation(parameters: [f64; 4]) -> Matrix3<f64> {
    let [w, x, y, z] = parameters;
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    rotation.to_rotation_matrix().into_inner()
}

fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_rows(&rows.map(|row| Vector3::from(row).transpose()))
}

fn apart(found: [f64; 3], wanted: [f64; 3]) -> f64 {
    (Vector3::from(found) - Vector3::from(wanted)).norm()
}

/// The largest error of all numbers of a robot.
fn error(found: &Mechanism, wanted: &Reference) -> f64 {
    let mut errors = vec![(found.ground_mass - wanted.ground_mass).abs()];
    assert_eq!(found.bodies.len(), wanted.bodies.len(), "bodies");
    for body in &wanted.bodies {
        let joint = found.joints.iter().find(|joint| joint.name == body.joint);
        let joint = joint.unwrap_or_else(|| panic!("no joint {}", body.joint));
        let own = &found.bodies[joint.between[1].expect("a body")];
        errors.push((own.mass - body.mass).abs() / body.mass);
        errors.push(apart(own.position, body.centre));
        let turned = rotation(own.orientation);
        let inertia = turned * matrix(own.inertia) * turned.transpose();
        let wanted = matrix(body.inertia);
        errors.push((inertia - wanted).amax() / wanted.amax());
    }
    let single = found.joints.iter().filter(|joint| joint.kind.is_single());
    assert_eq!(single.count(), wanted.joints.len(), "joints");
    for joint in &wanted.joints {
        let own = found.joints.iter().find(|other| other.name == joint.name);
        let own = own.expect("it was found above");
        errors.push(apart(own.point, joint.point));
        errors.push(apart(
            Vector3::from(own.axis).normalize().into(),
            joint.axis,
        ));
    }
    assert_eq!(found.frames.len(), wanted.frames.len(), "frames");
    for frame in &wanted.frames {
        let own = found.frames.iter().find(|other| other.link == frame.link);
        let own = own.unwrap_or_else(|| panic!("no frame {}", frame.link));
        errors.push(apart(own.global_origin, frame.origin));
        errors.push((rotation(own.global_orientation) - matrix(frame.rotation)).amax());
        // By its body, as a user of the printed constants goes.
        if let Some(body) = own.body {
            let body = &found.bodies[body];
            let turned = rotation(body.orientation);
            let origin = Vector3::from(body.position) + turned * Vector3::from(own.origin);
            errors.push(apart(origin.into(), frame.origin));
            let axes = turned * rotation(own.orientation);
            errors.push((axes - matrix(frame.rotation)).amax());
        }
    }
    errors.into_iter().fold(0.0, f64::max)
}

#[test]
fn numbers_are_those_of_pinocchio() {
    let reference = crate::text("data/reference.json");
    let reference: BTreeMap<String, Reference> =
        serde_json::from_str(&reference).expect("what the script wrote");
    assert!(reference.len() >= 13, "{} robots", reference.len());
    for (name, wanted) in &reference {
        let error = error(&crate::mechanism(name), wanted);
        println!("{name}: {error:.1e}");
        assert!(error < LIMIT, "{name}: {error:e}");
    }
}
