//! A sweep over a length on all cores, with its progress: a four-bar is compiled once and made a
//! thousand times, each time with another coupler.
//!
//! ```text
//! cargo run --release -p holonom --example sweep
//! ```

use std::error::Error;

use holonom::prelude::*;
use indicatif::ParallelProgressIterator as _;
use rayon::prelude::*;

/// A crank of 0.25 m that a motor turns, a coupler of any length, a rocker of 0.6 m. The bearings
/// are 0.9 m from each other. Crank and rocker are described upright.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "joints")]
struct FourBar {
    #[param(like = 0.9)]
    length: f64,
    #[body(shape = rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.0, 0.25, 0.0]), mass = 0.5)]
    crank: Body,
    #[body(shape = rod(radius = 0.01, from = [0.0, 0.25, 0.0], to = [length, 0.25, 0.0]), mass = 1.6)]
    coupler: Body,
    #[body(shape = rod(radius = 0.01, from = [0.9, 0.0, 0.0], to = [0.9, 0.6, 0.0]), mass = 1.2)]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.25, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    // It closes the loop: half of the lengths along x, from the centres of mass.
    #[joint(
        between = [coupler, rocker], point = local([0.5 * length, 0.0, 0.0], [0.3, 0.0, 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    end: Revolute,
    #[joint(between = [ground, rocker], point = [0.9, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[force(between = [ground, crank], axis = [0.0, 0.0, 1.0], moment = 40.0 - 4.0 * rate)]
    motor: TorsionalActuator,
}

/// How far the rocker swings (rad).
fn swing(length: f64) -> Result<f64, Box<dyn Error + Send + Sync>> {
    let (bar, h) = (FourBar::new(length)?, FourBar::HANDLES);
    let (mut least, mut most) = (f64::MAX, f64::MIN);
    bar.simulation(StandardLagrange, DormandPrince::default())
        .assembled()
        .run(0.0..=2.0, every(2e-3), |sample| {
            let angle = sample.angle(h.foot);
            (least, most) = (least.min(angle), most.max(angle));
        })?;
    Ok(most - least)
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let lengths: Vec<f64> = (0..1000).map(|k| 0.75 + 3e-4 * f64::from(k)).collect();
    let swings = lengths.par_iter().progress().map(|&length| swing(length));
    let swings = swings.collect::<Result<Vec<_>, _>>()?;
    println!("length [m],swing [rad]");
    for (length, swing) in lengths.iter().zip(&swings) {
        println!("{length:.4},{swing:.5}");
        // At both ends crank and coupler are in line; the law of cosines gives the rocker there.
        let angle = |side: f64| ((0.81 + 0.36 - side * side) / (2.0 * 0.9 * 0.6)).acos();
        assert!((swing - angle(length + 0.25) + angle(length - 0.25)).abs() < 1e-3);
    }
    Ok(())
}
