//! A trajectory that is found by Newton's method: the pushes with which a crane brings its load two
//! metres to the side, to rest. First and second derivatives are exact ones of a whole run.
//!
//! The gradient comes from the adjoint. Over numbers that carry derivatives it comes with products
//! of the Hessian, four columns by each pass. Where the Hessian is not positive definite, its
//! diagonal is raised until it is (Levenberg and Marquardt).
//!
//! ```text
//! cargo run --release -p holonom --example transfer
//! ```

use holonom::nalgebra::{Cholesky, DMatrix, DVector};
use holonom::prelude::*;
use holonom::sensitivity::Instant;
use holonom::{Forward, Real, Scalar};

/// A cart of 2 kg on a rail, and a load of 1 kg that swings 0.5 m below it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [adjoint])]
struct Crane {
    #[input]
    push: f64,
    #[body(mass = 2.0, inertia = [1.0, 1.0, 1.0])]
    cart: Body,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01], position = [0.0, 0.0, -0.5])]
    load: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, load], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    motor: PointForce,
}

/// Steps, for each of which a push is held, and their length (s).
const STEPS: usize = 60;
const STEP: f64 = 1.5 / STEPS as f64;
/// Displacement (m), angle (rad) and their rates at the end.
const END: [f64; 4] = [2.0, 0.0, 0.0, 0.0];

/// What pushes cost, and what is off at the end.
fn cost<S: Real>(instant: &Instant<'_, Crane, 1, S>) -> Forward<S, 4> {
    let number = Forward::<S, 4>::constant;
    if let Some([push]) = instant.controls() {
        return number(STEP) * push * push;
    }
    let state = instant.positions().iter().chain(instant.rates());
    state.zip(END).fold(number(0.0), |sum, (&found, wanted)| {
        let off = found - number(wanted);
        off.fused(number(1e4) * off, sum)
    })
}

/// A cost with its gradient and its Hessian by the pushes.
struct Found {
    cost: f64,
    gradient: DVector<f64>,
    hessian: DMatrix<f64>,
}

fn found(pushes: &DVector<f64>) -> Result<Found, Fault> {
    /// Numbers that carry four derivatives.
    type Number = Forward<f64, 4>;
    let (crane, h) = (Crane::default(), Crane::HANDLES);
    let space = crane.coordinates((h.rail, h.hinge))?.carrying::<4>();
    let run = space.adjoint(StandardLagrange, Rk4::every(Number::fixed(STEP)));
    let start = space.state([Number::fixed(0.0); 2], [Number::fixed(0.0); 2])?;
    let mut found = Found {
        cost: 0.0,
        gradient: DVector::zeros(STEPS),
        hessian: DMatrix::zeros(STEPS, STEPS),
    };
    for first in (0..STEPS).step_by(4) {
        let varied = |(step, &push): (usize, &f64)| match step.checked_sub(first) {
            Some(lane @ 0..4) => [Number::along(push, lane)],
            _ => [Number::fixed(push)],
        };
        let controls: Vec<[Number; 1]> = pushes.iter().enumerate().map(varied).collect();
        let slopes = run.gradient(&start, [h.push], &controls, [], cost)?;
        found.cost = slopes.cost.value();
        for (row, [slope]) in slopes.by_controls.iter().enumerate() {
            found.gradient[row] = slope.value();
            for (lane, second) in slope.derivatives().into_iter().enumerate() {
                found.hessian[(row, first + lane)] = second;
            }
        }
    }
    Ok(found)
}

/// The pushes of least cost, and how many steps of Newton's method that took.
pub fn transfer() -> Result<(DVector<f64>, usize), Fault> {
    let mut pushes = DVector::zeros(STEPS);
    let (mut here, mut raised) = (found(&pushes)?, 0.0);
    for iteration in 0..50 {
        let slope = here.gradient.norm();
        println!(
            "{iteration:2}: cost {:14.9}, gradient {slope:.1e}",
            here.cost
        );
        if slope < 1e-8 * here.cost {
            return Ok((pushes, iteration));
        }
        loop {
            let more = DMatrix::identity(STEPS, STEPS) * raised;
            let factors = Cholesky::new(&here.hessian + more);
            let step = factors.map(|factors| factors.solve(&-&here.gradient));
            let there = step.map(|step| &pushes + step);
            let next = there.as_ref().map(found).transpose()?;
            if let (Some(there), Some(next)) = (there, next)
                && next.cost <= here.cost
            {
                (pushes, here, raised) = (there, next, 0.1 * raised);
                break;
            }
            raised = (4.0 * raised).max(1e-3 * STEP);
        }
    }
    panic!("Newton's method did not end: {:e}", here.gradient.norm());
}

fn main() -> Result<(), Fault> {
    let (pushes, _) = transfer()?;
    println!("pushes (N): {:.1?}", pushes.as_slice());
    Ok(())
}
