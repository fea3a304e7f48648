//! Where a lamp on springs comes to rest, and how it swings about that.
//!
//! ```text
//! cargo run -p holonom --example equilibrium
//! ```

use holonom::prelude::*;

/// Two arms stretched out along y, on hinges about x. A spring holds the lower one, a coil the
/// upper one.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct Lamp {
    #[body(mass = 1.0, inertia = [0.03, 0.001, 0.03], position = [0.0, 0.3, 0.0])]
    lower: Body,
    #[body(mass = 0.5, inertia = [0.01, 0.001, 0.01], position = [0.0, 0.8, 0.0])]
    upper: Body,
    #[joint(between = [ground, lower], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [lower, upper], point = [0.0, 0.6, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[force(
        between = [ground, lower], head = [0.0, 0.0, 0.5], tail = [0.0, 0.3, 0.0],
        stiffness = 300.0, free_length = 0.45
    )]
    spring: SpringDamper,
    #[force(between = [lower, upper], axis = [1.0, 0.0, 0.0], stiffness = 10.0)]
    coil: TorsionalSpringDamper,
}

/// By mpmath, with 30 digits: where the potential energy is least (rad), and the square roots of
/// the eigenvalues of `M^-1 K` there (rad/s).
const REST: [f64; 2] = [0.1938516769218037, -0.0976463696727381];
const FREQUENCIES: [f64; 2] = [6.335204313471399, 29.840534939648855];

fn main() -> Result<(), Fault> {
    let (lamp, h) = (Lamp::default(), Lamp::HANDLES);
    let space = lamp.coordinates([h.shoulder, h.elbow])?;
    let rest = space.equilibrium(&space.state([0.0, 0.0], [0.0, 0.0])?)?;
    let angles = space.positions(&rest)?;
    println!(
        "at rest: {:?}, {:.5?} rad",
        space.names(),
        angles.as_slice()
    );
    let modes = space.linearise(&rest, [], |_| [])?.modes();
    for (mode, expected) in modes.iter().zip(FREQUENCIES) {
        let frequency = mode.angular_frequency();
        let [shoulder, elbow] = mode.shape.map(|part| part.re);
        println!("{frequency:8.5} rad/s: shoulder {shoulder:6.3}, elbow {elbow:6.3}");
        assert!((frequency - expected).abs() < 1e-9);
    }
    assert!((angles - holonom::nalgebra::Vector2::from(REST)).amax() < 1e-12);
    Ok(())
}
