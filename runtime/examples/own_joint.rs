//! A joint of one's own: a bead on a wire that is bent to a parabola.
//!
//! ```text
//! cargo run -p holonom --example own_joint
//! ```

use holonom::prelude::*;

holonom::joint! {
    /// The centre of mass of `j` stays on the parabola `z = bend x^2` of the plane through `point`
    /// that `across` is perpendicular to; `up` and `along` are its axes.
    pub joint ParabolicWire(i, j; point: Point, along: Axis, up: Axis, across: Axis, bend: Number) {
        let arm = j.origin - i.point;
        let x = dot(i.along, arm);
        dot(i.up, arm) - bend * x * x;                  // one equation
        dot(i.across, arm);                             // one equation
        displacement x;                                 // can be read: View::displacement
    }
}

/// A bead of 0.1 kg at rest, 1 m beside the lowest point.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Bead {
    #[body(mass = 0.1, position = [1.0, 0.0, 0.5])]
    bead: Particle,
    #[joint(
        between = [ground, bead], point = [0.0, 0.0, 0.0], along = [1.0, 0.0, 0.0],
        up = [0.0, 0.0, 1.0], across = [0.0, 1.0, 0.0], bend = 0.5
    )]
    wire: ParabolicWire,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (bead, handles) = (Bead::default(), Bead::HANDLES);
    let report = bead
        .simulation(StandardLagrange, DormandPrince::default())
        .projection(Projection::default())
        .run(0.0..=5.0, every(0.25), |sample| -> Result<(), Fault> {
            let x = sample.displacement(handles.wire);
            let push = sample.reaction(handles.wire, handles.bead)?.force;
            println!("{:.2} s: {x:7.4} m, {:.3} N", sample.time(), push.norm());
            // Without friction the bead keeps its energy: 0.1 kg * 9.81 m/s^2 * 0.5 m.
            assert!((sample.energy() - 0.4905).abs() < 1e-4);
            assert!((sample.pose(handles.bead).position.z - 0.5 * x * x).abs() < 1e-10);
            Ok(())
        })?;
    println!("{}", report.warnings());
    Ok(())
}
