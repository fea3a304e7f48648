//! A sweep over a length on all cores, with its progress: a mechanism with a parameter is compiled
//! once and made a thousand times.
//!
//! ```text
//! cargo run --release -p holonom --example sweep
//! ```

use holonom::prelude::*;
use indicatif::ParallelProgressIterator as _;
use rayon::prelude::*;

/// A rod of 1 kg, of any length, released from the horizontal.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Pendulum {
    #[param]
    length: f64,
    #[body(
        mass = 1.0,
        inertia = [length * length / 12.0, length * length / 1200.0, length * length / 12.0],
        position = [0.0, length / 2.0, 0.0]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

/// The time (s) at which the rod first comes to its lowest point.
fn fall(length: f64) -> Result<f64, Box<dyn std::error::Error + Send + Sync>> {
    let (pendulum, handles) = (Pendulum::new(length)?, Pendulum::HANDLES);
    let lowest =
        |view: &View<'_, f64, Pendulum>| view.angle(handles.pivot) <= -std::f64::consts::FRAC_PI_2;
    let report = pendulum
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=5.0, every(1e-3), |sample| {
            if lowest(sample) {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        })?;
    Ok(report.time)
}

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let lengths: Vec<f64> = (1..=1000).map(|k| 0.002 * f64::from(k)).collect();
    let times = lengths
        .par_iter()
        .progress()
        .map(|&length| fall(length))
        .collect::<Result<Vec<_>, _>>()?;
    println!(
        "{:.3} s at {:.3} m, {:.3} s at {:.3} m",
        times[0], lengths[0], times[999], lengths[999]
    );
    // Times go with the root of the length: twice the time for four times the length.
    assert!((times[999] / times[249] - 2.0).abs() < 0.01);
    Ok(())
}
