//! Parts and bodies that are turned by parameters and by constants: they move as with the same
//! numbers written, and derivatives by the angle are those of differences.

#![forbid(unsafe_code)]

use holonom::prelude::*;

/// An angle by its path, in another module.
mod drawing {
    pub(super) const TILT: f64 = 0.7;
}

/// Two links with all that a rotation moves: points, axes, axes of bodies and of inertia, forces.
#[derive(Assembly, Clone, Copy)]
struct Leg {
    #[port]
    frame: Body,
    #[body(
        mass = 0.8, inertia = [[0.02, 0.003, -0.002], [0.003, 0.03, 0.004], [-0.002, 0.004, 0.025]],
        position = [0.1, 0.2, -0.3], orientation = rpy(0.2, -0.1, 0.4)
    )]
    thigh: Body,
    #[joint(between = [frame, thigh], point = [0.0, 0.2, 0.0], axis = [0.1, 1.0, 0.2])]
    hip: Revolute,
    #[body(shape = rod(radius = 0.02, from = [0.2, 0.2, -0.6], to = [0.1, 0.3, -1.0]), mass = 0.4)]
    shin: Body,
    #[joint(between = [thigh, shin], point = [0.2, 0.2, -0.6], axis = [0.0, 1.0, 0.3])]
    knee: Revolute,
    #[force(
        between = [frame, shin], head = [0.5, 0.0, -0.2], tail = [0.1, 0.3, -1.0],
        stiffness = 20.0, damping = 0.1, free_length = 0.7
    )]
    tendon: SpringDamper,
    #[force(between = [thigh], point = [0.1, 0.2, -0.4], force = [0.3, -0.2, 0.5])]
    thrust: FollowerForce,
}

/// A part in a part, so that rotations are composed.
#[derive(Assembly, Clone, Copy)]
struct Side {
    #[port]
    frame: Body,
    #[param(like = 0.5)]
    splay: f64,
    #[part(frame = frame, mirror = y, rotation = rotation([1.0, 2.0, 3.0], 2.0 * splay), at = [0.1, 0.0, 0.2])]
    leg: Leg,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass])]
struct ByParameters {
    #[param(like = 0.6)]
    tilt: f64,
    #[part(frame = ground, mirror = x, rotation = rpy(0.3, tilt, deg(-20.0)) * euler_zxz(tilt, 0.1, 0.2))]
    side: Side,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.25], orientation = bryant_xyz(0.1, tilt, 0.3), free)]
    box_: Body,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Written {
    #[part(frame = ground, mirror = x, rotation = rpy(0.3, 0.7, deg(-20.0)) * euler_zxz(0.7, 0.1, 0.2))]
    side: Side2,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.25], orientation = bryant_xyz(0.1, 0.7, 0.3), free)]
    box_: Body,
}

#[derive(Assembly, Clone, Copy)]
struct Side2 {
    #[port]
    frame: Body,
    #[part(frame = frame, mirror = y, rotation = rotation([1.0, 2.0, 3.0], 0.8), at = [0.1, 0.0, 0.2])]
    leg: Leg,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct ByConstants {
    #[part(
        frame = ground, mirror = x,
        rotation = rpy(0.3, drawing::TILT, deg(-20.0)) * euler_zxz(drawing::TILT, 0.1, 0.2)
    )]
    side: Side2,
    #[body(
        mass = 1.0, inertia = [0.1, 0.2, 0.25],
        orientation = bryant_xyz(0.1, drawing::TILT, 0.3), free
    )]
    box_: Body,
}

/// Where the shin and the box are, how they are turned, and what the hip carries, over a run.
macro_rules! course {
    ($mechanism:expr, $type:ty $(, $joints:ident)?) => {{
        let (mechanism, h) = ($mechanism, <$type>::HANDLES);
        let mut course: Vec<f64> = Vec::new();
        let simulation = Simulation::new(&mechanism, StandardLagrange, Rk4::every(0.005));
        $(let simulation = simulation.$joints();)?
        simulation.run(0.0_f64..=0.5, every(0.1), |sample| -> Result<(), Fault> {
            let leg = h.side.leg;
            for body in [leg.shin, leg.thigh, h.box_] {
                let pose = sample.pose(body);
                course.extend(pose.position.iter());
                // Of the two equal quaternions, either.
                let q = pose.orientation;
                course.extend(q.coords.iter().map(|part| part * q.w));
            }
            course.extend([sample.angle(leg.hip), sample.angle(leg.knee)]);
            course.extend(sample.reaction(leg.hip, leg.thigh)?.force.iter());
            Ok(())
        })?;
        course
    }};
}

fn agree(found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len());
    for (place, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let off = (found - wanted).abs();
        assert!(off < tolerance, "{place}: {found} {wanted}");
    }
}

#[test]
fn parameters_and_constants_turn_as_numbers_do() -> Result<(), Box<dyn std::error::Error>> {
    let wanted = course!(Written::default(), Written);
    let moved = (wanted[0] - wanted[wanted.len() - 26]).abs();
    assert!(moved > 0.01, "{moved}");
    let by_parameters = || ByParameters::new(0.7, Side::new(0.4));
    agree(&course!(by_parameters()?, ByParameters), &wanted, 1e-10);
    agree(
        &course!(ByConstants::default(), ByConstants),
        &wanted,
        1e-10,
    );
    let wanted = course!(Written::default(), Written, joint_coordinates);
    let found = course!(by_parameters()?, ByParameters, joint_coordinates);
    agree(&found, &wanted, 1e-10);
    let found = course!(ByConstants::default(), ByConstants, joint_coordinates);
    agree(&found, &wanted, 1e-10);
    Ok(())
}

/// The start by the angles: centres of mass, by differences and by derivatives.
#[test]
fn derivatives_by_an_angle_are_differences() -> Result<(), Box<dyn std::error::Error>> {
    let h = ByParameters::HANDLES;
    let place = |tilt: f64, splay: f64| -> Result<_, Box<dyn std::error::Error>> {
        let turned = ByParameters::new(tilt, Side::new(splay))?;
        let state = turned.described_state::<f64>()?;
        Ok(ByParameters::pose(&state, h.side.leg.shin).position)
    };
    let turned = ByParameters::new(0.7, Side::new(0.4))?;
    let mut slopes = Vec::new();
    turned
        .sensitivities([h.tilt, h.side.splay])?
        .simulation(StandardLagrange, Rk4::every(0.01))
        .run(0.0..=0.01, every(0.01), |sample| {
            if sample.time().value() == 0.0 {
                let position = sample.pose(h.side.leg.shin).position;
                slopes.extend(position.iter().map(|x| x.derivatives()));
            }
        })?;
    let step = 1e-5;
    let by_tilt = (place(0.7 + step, 0.4)? - place(0.7 - step, 0.4)?) / (2.0 * step);
    let by_splay = (place(0.7, 0.4 + step)? - place(0.7, 0.4 - step)?) / (2.0 * step);
    assert!(by_tilt.norm() > 0.1 && by_splay.norm() > 0.1);
    for (k, [tilt, splay]) in slopes.into_iter().enumerate() {
        assert!((tilt - by_tilt[k]).abs() < 1e-9, "{tilt} {by_tilt}");
        assert!((splay - by_splay[k]).abs() < 1e-9, "{splay} {by_splay}");
    }
    Ok(())
}
