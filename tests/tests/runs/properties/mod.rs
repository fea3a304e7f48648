//! What holds for any mechanism: random ones keep their energy and momentum and stay on their
//! constraints as well as the order of the method says, and how they are declared does not matter.

mod declarations;
mod invariants;
mod mechanisms;
mod reversal;

use holonom::prelude::*;
use holonom::{BodyHandle, JointCoordinates};
use holonom_tests::RunsBoth;
use nalgebra::Vector3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The same cases on every machine.
fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(0x0005_eed5),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// What the parameters of a mechanism are made of.
#[derive(Clone, Copy, Debug)]
struct Data {
    /// kg.
    heavy: f64,
    /// m.
    arm: f64,
    /// Slope of axes.
    lean: f64,
    /// N/m.
    stiffness: f64,
    /// Velocities (m/s) and angular velocities (rad/s) of four bodies, before they are corrected
    /// onto the constraints.
    motion: [[f64; 6]; 4],
}

fn data() -> impl Strategy<Value = Data> {
    let motion = prop::array::uniform4(prop::array::uniform6(-1.5..1.5));
    let numbers = (0.5..4.0, 0.5..0.9, -0.5..0.5, 5.0..60.0, motion);
    numbers.prop_map(|(heavy, arm, lean, stiffness, motion)| Data {
        heavy,
        arm,
        lean,
        stiffness,
        motion,
    })
}

/// The described configuration with the motion of the data, on the constraints.
fn start<M: Mechanism>(mechanism: &M, bodies: &[BodyHandle<M>], data: &Data) -> M::State<f64> {
    let mut state = mechanism.described_state().expect("described");
    for (&body, [x, y, z, a, b, c]) in bodies.iter().zip(data.motion) {
        M::set_velocity(&mut state, body, Vector3::new(x, y, z));
        M::set_angular_velocity_global(&mut state, body, Vector3::new(a, b, c));
    }
    mechanism.assemble(0.0, &mut state).expect("regular");
    state
}

/// Shows every sample of a run of one second, by bodies or by joints, and returns its end.
fn run<M: JointCoordinates, I: RunsBoth<M, StandardLagrange>>(
    mechanism: &M,
    integrator: I,
    by_joints: bool,
    state: M::State<f64>,
    mut look: impl FnMut(&Sample<'_, f64, M>),
) -> M::State<f64> {
    let look = |sample: &Sample<'_, f64, M>| {
        look(sample);
        ControlFlow::Continue(())
    };
    let simulation = Simulation::new(mechanism, StandardLagrange, integrator).initial_state(state);
    let report = if by_joints {
        let simulation = simulation.joint_coordinates();
        simulation.run(0.0..=1.0, every(0.0625), look)
    } else {
        let simulation = simulation.absolute_coordinates();
        simulation.run(0.0..=1.0, every(0.0625), look)
    };
    report.expect("regular").state
}
