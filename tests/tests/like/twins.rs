//! What mechanisms whose numbers are parameters have to do as well as those whose numbers are
//! written.

use holonom::prelude::*;
use holonom::{JointCoordinates, StateParts, dynamics::Dynamics, integrate::OneStep, state::Array};

/// Positions and velocities of rigid bodies after some steps from the assembled start, by bodies
/// and by joints.
pub(crate) fn runs<M: JointCoordinates>(
    mechanism: &M,
    (step, steps): (f64, u32),
) -> Result<[Vec<f64>; 2], Fault> {
    let mut start = mechanism.described_state::<f64>()?;
    mechanism.assemble(0.0, &mut start)?;
    let mut by_bodies = Dynamics::new(mechanism, StandardLagrange)?.absolute_coordinates();
    let mut by_joints = Dynamics::new(mechanism, StandardLagrange)?.joint_coordinates();
    let (mut bodies, mut joints) = (start, by_joints.state_of(&start)?);
    for number in 0..steps {
        let time = step * f64::from(number);
        Rk4.step(&mut by_bodies, time, &mut bodies, step)?;
        Rk4.step(&mut by_joints, time, &mut joints, step)?;
    }
    Ok([bodies, by_joints.bodies(&joints)].map(|state| {
        // Euler parameters have two signs.
        let poses = state.coordinates().as_slice().chunks(7);
        let positions: Vec<f64> = poses.flat_map(|pose| pose[..3].to_vec()).collect();
        [&positions, state.velocities().as_slice()].concat()
    }))
}

/// The largest difference of two states, over their largest element.
pub(crate) fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let most = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let far = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    far.fold(0.0, |most, far| if far <= most { most } else { far }) / most
}

/// Two mechanisms of one kind, one with parameters and one with what is written, move alike in both
/// descriptions.
pub(crate) fn move_alike<A: JointCoordinates, B: JointCoordinates>(
    given: &A,
    written: &B,
    run: (f64, u32),
) {
    assert_eq!(A::REPORT.rank, B::REPORT.rank);
    assert_eq!(A::REPORT.redundant, B::REPORT.redundant);
    assert_eq!(A::REPORT.degrees_of_freedom, B::REPORT.degrees_of_freedom);
    assert_eq!(A::JOINT_REPORT.closing, B::JOINT_REPORT.closing);
    let given = runs(given, run).expect("it runs");
    let written = runs(written, run).expect("it runs");
    for (given, written) in given.iter().zip(&written) {
        let far = difference(given, written);
        assert!(far < 1e-10, "{far:e}");
    }
}
