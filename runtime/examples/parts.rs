//! Parts: the front axle of a car, with one description of the suspension for left and right.
//!
//! ```text
//! cargo run -p holonom --example parts
//! ```

use holonom::prelude::*;

/// Double wishbones, a tie rod, a strut and a tyre of a left wheel: x ahead, y left, z up. The
/// origin is on the ground below the middle of the axle.
#[derive(Assembly)]
struct Suspension {
    #[port]
    chassis: Body,
    #[body(shape = bar(width = 0.05, height = 0.03, from = [0.0, 0.3, 0.2], to = [0.0, 0.7, 0.18]), mass = 3.0)]
    lower: Body,
    #[body(shape = bar(width = 0.05, height = 0.02, from = [0.0, 0.35, 0.45], to = [-0.02, 0.68, 0.44]), mass = 2.0)]
    upper: Body,
    #[body(shape = disc(radius = 0.3, thickness = 0.2, at = [0.0, 0.75, 0.3], axis = [0.0, 1.0, 0.0]), mass = 25.0)]
    wheel: Body,
    #[joint(between = [chassis, lower], point = [0.0, 0.3, 0.2], axis = [1.0, 0.0, 0.0])]
    lower_hinge: Revolute,
    #[joint(between = [chassis, upper], point = [0.0, 0.35, 0.45], axis = [1.0, 0.05, -0.02])]
    upper_hinge: Revolute,
    #[joint(between = [lower, wheel], point = [0.0, 0.7, 0.18])]
    lower_ball: Spherical,
    #[joint(between = [upper, wheel], point = [-0.02, 0.68, 0.44])]
    upper_ball: Spherical,
    #[joint(between = [chassis, wheel], head = [-0.12, 0.32, 0.25], tail = [-0.12, 0.69, 0.25])]
    tie_rod: Distance,
    #[force(
        between = [lower, chassis], head = [0.0, 0.55, 0.2], tail = [0.0, 0.4, 0.65],
        stiffness = 30e3, damping = 2e3, free_length = 0.55
    )]
    strut: SpringDamper,
    #[force(
        between = [ground, wheel], head = [0.0, 0.75, 0.0], tail = [0.0, 0.75, 0.3],
        stiffness = 200e3, damping = 300.0, free_length = 0.32
    )]
    tyre: SpringDamper,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Axle {
    #[body(shape = block(size = [1.0, 0.5, 0.2], at = [0.0, 0.0, 0.6]), mass = 400.0)]
    chassis: Body,
    #[joint(between = [ground, chassis], point = [0.0, 0.0, 0.6], axis = [0.0, 0.0, 1.0])]
    heave: Prismatic,
    #[part(chassis = chassis)]
    left: Suspension,
    #[part(chassis = chassis, mirror = y)]
    right: Suspension,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (axle, h) = (Axle::default(), Axle::HANDLES);
    let report = axle
        .simulation(Baumgarte::of(&axle)?, DormandPrince::default())
        .run(0.0..=8.0, every(1.0), |sample| {
            let [left, right] = [h.left, h.right].map(|side| sample.angle(side.lower_hinge));
            println!(
                "{:3.1} s: heave {:8.5} m, hinges {left:8.5} and {right:8.5} rad",
                sample.time(),
                sample.displacement(h.heave),
            );
            // A mirrored part moves as the mirror image, with the same angles.
            assert!((left - right).abs() < 1e-9);
        })?;
    println!("{}", report.warnings());
    Ok(())
}
