//! Parameters from measurements, by least squares with derivatives of runs: the damping of a
//! pendulum from its angles, and the lengths of a four-bar from the curve of its coupler.
//!
//! ```text
//! cargo run -p holonom --example estimate
//! ```

use std::error::Error;

use holonom::Forward;
use holonom::nalgebra::{SMatrix, SVector};
use holonom::prelude::*;

/// A sum of squares, its gradient, and the matrix of Gauss and Newton.
#[derive(Clone, Copy)]
pub struct Squares<const N: usize> {
    sum: f64,
    gradient: SVector<f64, N>,
    normal: SMatrix<f64, N, N>,
}

impl<const N: usize> Squares<N> {
    fn none() -> Self {
        Self {
            sum: 0.0,
            gradient: SVector::zeros(),
            normal: SMatrix::zeros(),
        }
    }

    fn add(&mut self, residual: Forward<f64, N>) {
        let slopes = SVector::from(residual.derivatives());
        self.sum += residual.value() * residual.value();
        self.gradient += slopes * residual.value();
        self.normal += slopes * slopes.transpose();
    }
}

/// The parameters with the least squares, after Levenberg and Marquardt, and how many rounds it
/// took. Parameters that are refused count as too far.
pub fn fit<const N: usize>(
    mut at: [f64; N],
    squares: impl Fn([f64; N]) -> Result<Squares<N>, Box<dyn Error>>,
) -> Result<([f64; N], usize), Box<dyn Error>> {
    let (mut here, mut damping) = (squares(at)?, 1e-3);
    for round in 1..=50 {
        let mut normal = here.normal;
        for k in 0..N {
            normal[(k, k)] *= 1.0 + damping;
        }
        let inverse = normal.try_inverse().ok_or("a parameter changes nothing")?;
        let step = -inverse * here.gradient;
        let next = core::array::from_fn(|k| at[k] + step[k]);
        match squares(next) {
            Ok(there) if there.sum <= here.sum => {
                (at, here, damping) = (next, there, 0.1 * damping);
            }
            _ => damping *= 10.0,
        }
        if step.norm() < 1e-9 * SVector::from(at).norm() {
            return Ok((at, round));
        }
    }
    Ok((at, 50))
}

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
pub fn pendulum(angles: &[f64], guess: [f64; 2]) -> Result<([f64; 2], usize), Box<dyn Error>> {
    let h = Pendulum::HANDLES;
    fit(guess, |[damping, inertia]| {
        let (mut squares, mut angles) = (Squares::none(), angles.iter());
        Pendulum::new(damping, inertia)?
            .sensitivities([h.damping, h.inertia])?
            .simulation(StandardLagrange, Rk4::every(0.01))
            .run(0.0..=3.0, every(0.02), |sample| {
                let measured = angles
                    .next()
                    .copied()
                    .map_or(sample.angle(h.hinge), Forward::fixed);
                squares.add(sample.angle(h.hinge) - measured);
            })?;
        Ok(squares)
    })
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
pub fn four_bar(drawn: [f64; 3], guess: [f64; 3]) -> Result<([f64; 3], usize), Box<dyn Error>> {
    let drawn = curve(drawn)?;
    fit(guess, |lengths| {
        let mut squares = Squares::none();
        for (point, drawn) in curve(lengths)?.into_iter().zip(&drawn) {
            for (number, drawn) in point.into_iter().zip(drawn) {
                squares.add(number - Forward::fixed(drawn.value()));
            }
        }
        Ok(squares)
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let ([damping, inertia], rounds) = pendulum(&measured()?, [0.05, 0.4])?;
    println!("damping {damping:.4} N m s for 0.2, {inertia:.4} kg m^2 for 0.34: {rounds} rounds");
    let (lengths, rounds) = four_bar([0.3, 1.0, 0.7], [0.25, 0.9, 0.6])?;
    println!("lengths {lengths:.9?} m for 0.3, 1.0 and 0.7: {rounds} rounds");
    Ok(())
}
