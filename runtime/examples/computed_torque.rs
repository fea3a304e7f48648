//! The equations of motion of an arm in the coordinates of its joints: mass matrix, bias, gravity,
//! Jacobian of the tool, and the torques for accelerations that are wanted.
//!
//! ```text
//! cargo run -p holonom --features urdf --example computed_torque
//! ```

use holonom::nalgebra::{Matrix3, SMatrix, Vector3};
use holonom::prelude::*;

holonom::urdf! {
    /// Three axes with a tool. The inertial frames are turned against the links.
    #[mechanism(kernels = [mass, inverse, gravity, jacobian])]
    struct Arm = "examples/three_axes.urdf";
}

fn main() -> Result<(), Fault> {
    let (arm, h) = (Arm::default(), Arm::HANDLES);
    let space = arm.coordinates([h.j1, h.j2, h.j3])?;
    let state = space.state([0.4, -0.7, 1.1], [0.5, -1.0, 2.0])?; // rad, rad/s
    let wanted = Vector3::new(1.0, 2.0, -3.0); // rad/s^2
    let (mass, bias, gravity) = (
        space.mass(&state)?,
        space.bias(&state)?,
        space.gravity(&state)?,
    );
    let torques = space.inverse(&state, wanted)?; // M a + h, N m
    let jacobian = space.jacobian(&state, h.tool)?; // linear rows first, global axes
    let speed = jacobian * space.rates(&state);
    println!("M {mass:.4}h {bias:.4}g {gravity:.4}tool {speed:.4}torques {torques:.4}");

    let close = |worst: f64| assert!(worst < 1e-14, "{worst}");
    close((mass - Matrix3::from_row_slice(&MASS)).amax());
    close((bias - Vector3::from(BIAS)).amax());
    close((gravity - Vector3::from(GRAVITY)).amax());
    close((torques - Vector3::from(TORQUES)).amax());
    close((jacobian - SMatrix::<f64, 6, 3>::from_row_slice(&JACOBIAN)).amax());
    assert!((space.forward(&state, torques)? - wanted).amax() < 1e-12);
    Ok(())
}

/// By Pinocchio 4.1.0 (`crba`, `rnea` with the damping of the file, `computeGeneralizedGravity`,
/// `getFrameJacobian` in `LOCAL_WORLD_ALIGNED`).
const MASS: [f64; 9] = [
    0.0638326578653393,
    -0.01027567872038047,
    0.00076837869104666,
    -0.01027567872038047,
    0.23708929236603873,
    -0.01463782004052101,
    0.00076837869104666,
    -0.01463782004052101,
    0.03912,
];
const BIAS: [f64; 3] = [0.06661366701706822, 3.771516351494277, -1.7025250699116088];
const GRAVITY: [f64; 3] = [0.0, 3.8635680872343765, -1.7467053638055356];
const TORQUES: [f64; 3] = [0.1075898313685067, 4.279332717627536, -1.8483923313016042];
const JACOBIAN: [f64; 18] = [
    -0.07578441903595552,
    0.26252761534841995,
    -0.03958628078760451,
    -0.02124880587741845,
    0.11099489550081248,
    0.0139281605265047,
    0.0,
    0.02005960342902345,
    -0.24726288180346204,
    0.0,
    -0.3894183423086505,
    -0.6108966233612352,
    0.0,
    0.9210609940028851,
    0.778930107132595,
    1.0,
    0.0,
    0.1416799342470382,
];
