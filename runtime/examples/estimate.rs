//! Parameters from measurements, by least squares with derivatives of runs: the damping of a
//! pendulum from its angles, and the lengths of a four-bar from the curve of its coupler.
//!
//! ```text
//! cargo run -p holonom --example estimate
//! ```

use std::error::Error;

use holonom::Forward;
use holonom::prelude::*;
use holonom::sensitivity::{Fit, fit};

/// A rod that swings, with a damper in its hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Pendulum {
    /// N m s.
    #[param]
    damping: f64,
    /// kg m^2, about the hinge.
    #[param]
    inertia: f64,
    #[body(mass = 1.0, inertia = [inertia - 0.25, 0.01, inertia - 0.25], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], stiffness = 0.0, damping = damping)]
    damper: TorsionalSpringDamper,
}

/// Every 20 ms the angle of a pendulum with a damping of 0.2 N m s and 0.34 kg m^2, with an error
/// of up to 2 mrad that looks random.
pub fn measured() -> Result<Vec<f64>, Box<dyn Error>> {
    let (mut angles, mut noise) = (Vec::new(), 1_u32);
    Pendulum::new(0.2, 0.34)?
        .simulation(StandardLagrange, Rk4::every(0.01))
        .run(0.0..=3.0, every(0.02), |sample| {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let error = f64::from(noise) / f64::from(u32::MAX) - 0.5;
            angles.push(sample.angle(Pendulum::HANDLES.hinge) + 4e-3 * error);
        })?;
    Ok(angles)
}

/// Damping and inertia from such angles.
pub fn pendulum(angles: &[f64], guess: [f64; 2]) -> Result<Fit<2>, Box<dyn Error>> {
    let h = Pendulum::HANDLES;
    let found = fit(
        guess,
        |[damping, inertia], squares| -> Result<(), Box<dyn Error>> {
            let mut angles = angles.iter();
            Pendulum::new(damping, inertia)?
                .sensitivities([h.damping, h.inertia])?
                .simulation(StandardLagrange, Rk4::every(0.01))
                .run(0.0..=3.0, every(0.02), |sample| {
                    let measured = angles.next().expect("an angle for each sample");
                    squares.compare(sample.angle(h.hinge), *measured);
                })?;
            Ok(())
        },
    )?;
    Ok(found)
}

/// A four-bar whose coupler carries a pen.
#[derive(Mechanism)]
#[mechanism(redundant = "drop", coordinates = "joints", kernels = [mass])]
struct FourBar {
    #[param(like = 0.25)]
    crank: f64,
    #[param(like = 0.9)]
    coupler: f64,
    #[param(like = 0.6)]
    rocker: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5 * crank, 0.0])]
    first: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 * coupler, crank, 0.0])]
    second: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.9, 0.5 * rocker, 0.0])]
    third: Body,
    #[point(on = second, at = [0.5 * coupler, crank + 0.2, 0.0])]
    pen: Point,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    o: Revolute,
    #[joint(between = [first, second], point = [0.0, crank, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(
        between = [second, third],
        point = local([0.5 * coupler, 0.0, 0.0], [0.0, 0.5 * rocker, 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    b: Revolute,
    #[joint(between = [ground, third], point = [0.9, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Revolute,
}

/// Where the pen is at twelve angles of the crank, along the lengths.
fn curve([crank, coupler, rocker]: [f64; 3]) -> Result<Vec<[Forward<f64, 3>; 2]>, Box<dyn Error>> {
    let (bar, h) = (FourBar::new(crank, coupler, rocker)?, FourBar::HANDLES);
    let space = bar.coordinates([h.o])?;
    let mut points = Vec::new();
    for k in 0..12 {
        let state = space.state([f64::from(k) * std::f64::consts::TAU / 12.0], [0.0])?;
        let along = space.sensitivities(&state, [h.crank, h.coupler, h.rocker].map(Into::into))?;
        let dynamics = along.dynamics(StandardLagrange)?;
        let bodies = along.start();
        let pen = dynamics.view(Forward::fixed(0.0), &bodies).position(h.pen);
        points.push([pen.x, pen.y]);
    }
    Ok(points)
}

/// The lengths of crank, coupler and rocker (m) from the curve that these draw.
pub fn four_bar(drawn: [f64; 3], guess: [f64; 3]) -> Result<Fit<3>, Box<dyn Error>> {
    let drawn = curve(drawn)?;
    let found = fit(guess, |lengths, squares| -> Result<(), Box<dyn Error>> {
        let numbers = curve(lengths)?.into_iter().flatten();
        for (number, drawn) in numbers.zip(drawn.iter().flatten()) {
            squares.compare(number, drawn.value());
        }
        Ok(())
    })?;
    Ok(found)
}

fn main() -> Result<(), Box<dyn Error>> {
    let found = pendulum(&measured()?, [0.05, 0.4])?;
    let ([damping, inertia], [first, second]) = (found.values, found.deviations);
    println!("damping {damping:.4} +/- {first:.4} N m s for 0.2");
    println!("inertia {inertia:.4} +/- {second:.5} kg m^2 for 0.34");
    assert!((damping - 0.2).abs() < 4.0 * first && (inertia - 0.34).abs() < 4.0 * second);
    let found = four_bar([0.3, 1.0, 0.7], [0.25, 0.9, 0.6])?;
    println!(
        "lengths {:.9?} m for 0.3, 1.0 and 0.7: {} rounds",
        found.values, found.rounds
    );
    Ok(())
}
