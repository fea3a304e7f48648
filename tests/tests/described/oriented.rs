//! Bodies whose orientation is a parameter: joints carry them as they carry others, so that a run
//! in joint coordinates is that with the same numbers written.

use holonom::prelude::*;

/// Two links, in axes that are turned by four Euler parameters of another length than 1.
macro_rules! leg {
    ($name:ident, $one:expr, { $($parameter:tt)* }) => {
        #[derive(Mechanism)]
        #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
        struct $name {
            $($parameter)*
            #[body(
                mass = 0.8, position = [$one * 0.1, 0.2, -0.3],
                inertia = [[0.02, 0.003, -0.002], [0.003, 0.03, 0.004], [-0.002, 0.004, 0.025]],
                orientation = [0.9 * $one, 0.2, -0.1 * $one, 0.4]
            )]
            thigh: Body,
            #[joint(
                between = [ground, thigh], point = [0.0, 0.2, 0.0], axis = [0.1, 1.0 * $one, 0.2]
            )]
            hip: Revolute,
            #[body(
                mass = 0.4, inertia = [0.01, 0.02, 0.015], position = [0.15, 0.25, -0.8 * $one],
                orientation = [2.0, 0.2 * $one, 0.3 * $one, -0.1]
            )]
            shin: Body,
            #[joint(between = [thigh, shin], point = [0.2, 0.2, -0.6], axis = [0.0, 1.0, 0.3])]
            knee: Revolute,
            #[body(
                mass = 0.1, inertia = [1e-3, 2e-3, 1.5e-3], position = [0.1, 0.3, -1.1],
                orientation = [$one, 2.0, $one, 0.0]
            )]
            foot: Body,
            #[joint(between = [shin, foot], point = [0.1, 0.3, -1.0], axis = [0.2, 0.0, 1.0])]
            ankle: Prismatic,
            #[force(
                between = [ground, foot], head = [0.5, 0.0, -0.2], tail = [0.1, 0.3, -1.0],
                stiffness = 20.0, damping = 0.1, free_length = 0.7
            )]
            tendon: SpringDamper,
        }
    };
}

leg!(Written, 1.0, {});
leg!(Given, one, { #[param] one: f64, });

/// Readings of joints over a run.
macro_rules! course {
    ($leg:expr, $type:ty, $coordinates:ident) => {{
        let (leg, h) = ($leg, <$type>::HANDLES);
        let mut course: Vec<f64> = Vec::new();
        leg.simulation(StandardLagrange, Rk4::every(0.01))
            .$coordinates()
            .run(0.0..=0.5, every(0.1), |sample| {
                course.extend([sample.angle(h.hip), sample.angle(h.knee)]);
                course.push(sample.displacement(h.ankle));
            })
            .expect("it runs");
        course
    }};
}

fn agree(found: &[f64], wanted: &[f64]) {
    let moved = wanted.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(moved > 0.1, "{moved}");
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-11, "{found} {wanted}");
    }
}

/// Were a joint cut, its equations would be integrated with the error of absolute coordinates.
#[test]
fn joints_carry_bodies_that_are_turned_by_parameters() {
    let carried = Given::JOINT_REPORT.motions.iter();
    let carried: Vec<_> = carried.map(|motion| (motion.joint, motion.body)).collect();
    assert_eq!(
        carried,
        [("hip", "thigh"), ("knee", "shin"), ("ankle", "foot")]
    );
    assert!(Given::JOINT_REPORT.closing.is_empty());
    let given = || Given::new(1.0).expect("acceptable");
    agree(
        &course!(given(), Given, joint_coordinates),
        &course!(Written::default(), Written, joint_coordinates),
    );
    agree(
        &course!(given(), Given, absolute_coordinates),
        &course!(Written::default(), Written, absolute_coordinates),
    );
}
