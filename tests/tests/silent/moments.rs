//! What a refusal of measured inertias advises: moments and masses that move across a hinge change
//! no motion.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{JointCoordinates, MechanismExt};

/// An arm of two links about crossed axes.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Published {
    #[body(mass = 1.0, inertia = [0.25, 0.26, 0.24], position = [0.1, 0.2, 0.3])]
    upper: Body,
    #[body(mass = 2.0, inertia = [0.03, 0.05, 0.04], position = [0.4, 0.5, 0.3])]
    fore: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.3], axis = [0.0, 0.0, 1.0])]
    shoulder: Revolute,
    #[joint(between = [upper, fore], point = [0.2, 0.5, 0.3], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// The same: 0.02 kg m^2 across the elbow's axis, which is x, moved to the upper arm; 0.5 across
/// the shoulder's, which is z, from the ground; and 0.5 kg at the point (0.2, 0.5, 0.3) of the
/// elbow's axis moved to the forearm.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Moved {
    #[body(
        mass = 0.5,
        inertia = [[0.66, 0.03, 0.0], [0.03, 0.77, 0.0], [0.0, 0.0, 0.16]],
        position = [0.0, -0.1, 0.3]
    )]
    upper: Body,
    #[body(
        mass = 2.5, inertia = [0.03, 0.046, 0.036],
        position = [0.36, 0.5, 0.3]
    )]
    fore: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.3], axis = [0.0, 0.0, 1.0])]
    shoulder: Revolute,
    #[joint(between = [upper, fore], point = [0.2, 0.5, 0.3], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// Angles of both hinges after two seconds from a start in motion.
fn angles<M: JointCoordinates, J: holonom::mechanism::HasAngle>(
    mechanism: &M,
    hinges: [holonom::JointHandle<M, J>; 2],
) -> [f64; 2] {
    let mut start = mechanism.described_state().expect("parameters");
    for (hinge, [angle, rate]) in hinges.into_iter().zip([[0.3, 2.0], [0.4, -3.0]]) {
        mechanism
            .set_angle(&mut start, hinge, angle)
            .expect("it carries");
        mechanism
            .set_angle_rate(&mut start, hinge, rate)
            .expect("it carries");
    }
    let tolerance = Tolerance {
        relative: 1e-11,
        absolute: 1e-11,
    };
    let mut angles = [0.0; 2];
    Simulation::new(mechanism, StandardLagrange, DormandPrince::new(tolerance))
        .initial_state(start)
        .joint_coordinates()
        .run(0.0..=2.0, every(2.0), |sample| {
            angles = hinges.map(|hinge| sample.angle(hinge));
            ControlFlow::Continue(())
        })
        .expect("it runs");
    angles
}

#[test]
fn moments_across_a_hinge_may_be_moved() {
    let (published, moved) = (Published::HANDLES, Moved::HANDLES);
    let one = angles(&Published::default(), [published.shoulder, published.elbow]);
    let other = angles(&Moved::default(), [moved.shoulder, moved.elbow]);
    for (one, other) in one.into_iter().zip(other) {
        assert!((one - other).abs() < 1e-8, "{one} {other}");
    }
}
