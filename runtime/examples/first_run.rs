//! A first run: a pendulum, its angle and the reaction of its hinge.
//!
//! ```text
//! cargo run -p holonom --example first_run
//! ```

use holonom::prelude::*;

/// A steel rod of 1 m, hinged to the ground about x, released from the horizontal.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Pendulum {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum::default();
    let handles = Pendulum::HANDLES;
    let mut largest = 0.0_f64;
    let report = pendulum
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=2.0, every(0.1), |sample| -> Result<(), Fault> {
            let (time, angle) = (sample.time(), sample.angle(handles.pivot));
            let force = sample.reaction(handles.pivot, handles.rod)?.force.norm();
            println!("{time:.1} s: {angle:8.4} rad, {force:8.3} N");
            largest = largest.max(force);
            Ok(())
        })?;
    println!("{} evaluations; {}", report.evaluations, report.warnings());
    // At the lowest point: two and a half times the weight.
    assert!(largest > 2.0 * 7.02 * 9.81 && largest < 2.5 * 7.02 * 9.81 + 1.0);
    assert!(report.warnings().is_empty());
    Ok(())
}
