//! Forces from closures: readings by handle, and efforts of joints.

use nalgebra::Vector3;

use super::rod::{GRAVITY, PIVOT, ROD, Rod, rod};
use crate::state::State;
use crate::*;

/// The hinge's axis is that of x. A moment about it is one about x on the rod, in any position.
#[test]
fn a_moment_between_is_one_about_the_axis() {
    let rod = rod();
    let constants = rod.constants().unwrap();
    for turn in [0.0, 0.3, 2.0, -1.0_f64] {
        let mut state = rod.described_state().unwrap();
        let mut pose = Rod::pose(&state, ROD);
        let (sine, cosine) = (0.5 * turn).sin_cos();
        let about_x = nalgebra::Quaternion::new(cosine, sine, 0.0, 0.0);
        pose.orientation = about_x * pose.orientation;
        Rod::set_pose(&mut state, ROD, pose);
        let loaded = |add: &dyn Fn(&mut Loads<'_, f64, Rod>)| {
            let mut forces = [0.0; 6];
            let view = View::new(&constants, 0.0, &state);
            add(&mut Loads::new(view, &mut forces));
            forces
        };
        let by_joint = loaded(&|loads| loads.moment_between(PIVOT, 3.0));
        let by_body = loaded(&|loads| loads.moment(ROD, [3.0, 0.0, 0.0]));
        for (joint, body) in by_joint.iter().zip(by_body) {
            assert!((joint - body).abs() < 1e-14, "{by_joint:?}");
        }
        let nothing = loaded(&|loads| loads.moment_between(PIVOT, f64::NAN));
        assert!(nothing[3].is_nan());
    }
}

#[test]
fn a_closure_reads_the_state_by_handle() {
    let rod = rod();
    let inertia = 0.5855265 + rod.mass * 0.25;
    // Holds the rod against its weight, and slows it down.
    let law = |_: f64, state: &State<f64, 7, 6>, loads: &mut Loads<'_, f64, Rod>| {
        let view = loads.view();
        assert_eq!(view.state(), state);
        let weight = rod.mass * GRAVITY * 0.5 * view.angle(PIVOT).cos();
        loads.moment_between(PIVOT, weight - 0.5 * view.angle_rate(PIVOT));
    };
    let mut state = rod.described_state().unwrap();
    Rod::set_angular_velocity(&mut state, ROD, Vector3::new(2.0, 0.0, 0.0));
    Rod::set_velocity(&mut state, ROD, Vector3::new(0.0, 0.0, 1.0));
    let slowed = |time: f64| 2.0 * (-0.5 * time / inertia).exp();
    Simulation::new(&rod, StandardLagrange, Rk4::every(0.001))
        .forces(law)
        .initial_state(state)
        .run(0.0..=1.0, every(0.1), |sample| -> Result<(), Fault> {
            let rate = sample.angle_rate(PIVOT);
            assert!((rate - slowed(sample.time())).abs() < 1e-9, "{rate}");
            let slowing = -0.5 * rate / inertia;
            assert!((sample.angle_acceleration(PIVOT)? - slowing).abs() < 1e-9);
            Ok(())
        })
        .unwrap();
}
