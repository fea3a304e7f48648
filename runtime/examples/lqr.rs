//! A linear-quadratic regulator: a pole on a cart is linearised, a gain computed, and the pole
//! balanced at 1 kHz.
//!
//! ```text
//! cargo run -p holonom --example lqr
//! ```

use holonom::independent::to_discrete;
use holonom::nalgebra::{Matrix1, Matrix4, RowVector4, SMatrix, Vector4};
use holonom::prelude::*;

/// A cart of 1 kg on a rail, and a pole of 0.6 m that stands on it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct CartPole {
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01])]
    cart: Body,
    #[body(mass = 0.2, inertia = [0.006, 0.0001, 0.006], position = [0.0, 0.0, 0.3])]
    pole: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, pole], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [0.0, push, 0.0])]
    motor: PointForce,
}

/// The period of the loop (s).
const PERIOD: f64 = 1e-3;

/// The gain `K` of `u = -K x` that minimises the sum of `x^T Q x + u^T R u`; `None` where doubling
/// does not converge.
///
/// From the discrete algebraic Riccati equation by structured doubling (Chu, Fan, Lin and Wang
/// 2004).
pub fn gain<const X: usize, const U: usize>(
    a: &SMatrix<f64, X, X>,
    b: &SMatrix<f64, X, U>,
    q: &SMatrix<f64, X, X>,
    r: &SMatrix<f64, U, U>,
) -> Option<SMatrix<f64, U, X>> {
    let (mut step, mut g, mut p) = (*a, b * r.try_inverse()? * b.transpose(), *q);
    for _ in 0..60 {
        let w = (SMatrix::identity() + g * p).try_inverse()?;
        let next = p + step.transpose() * p * w * step;
        g += step * w * g * step.transpose();
        step = step * w * step;
        let change = (next - p).amax();
        p = next;
        if change <= 1e-15 * p.amax() {
            break;
        }
    }
    Some((r + b.transpose() * p * b).try_inverse()? * b.transpose() * p * a)
}

/// `A_d` and `B_d` of the pole upright.
pub fn model() -> Result<(Matrix4<f64>, Vector4<f64>), Fault> {
    let (cart_pole, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart_pole.coordinates((h.rail, h.pin))?;
    let upright = space.state([0.0, 0.0], [0.0, 0.0])?;
    let linear = space.linearise(&upright, [h.push], |_| [])?;
    Ok(to_discrete(&linear.a(), &linear.b(), PERIOD))
}

/// The gain on displacement, angle and their rates.
pub fn regulator() -> Result<RowVector4<f64>, Fault> {
    let (a, b) = model()?;
    let q = Matrix4::from_diagonal(&Vector4::new(10.0, 100.0, 1.0, 1.0));
    Ok(gain(&a, &b, &q, &Matrix1::new(0.1)).expect("the cart moves the pole"))
}

fn main() -> Result<(), Fault> {
    let (cart_pole, h) = (CartPole::default(), CartPole::HANDLES);
    let space = cart_pole.coordinates((h.rail, h.pin))?;
    let k = regulator()?;
    println!("gain of {:?} and their rates: {k:.3}", space.names());
    let mut state = space.state([0.0, 0.3], [0.0, 0.0])?;
    let mut stepper = Stepper::new(&cart_pole, StandardLagrange, Rk4)?;
    for period in 0..6000 {
        let (q, v) = (space.positions(&state)?, space.rates(&state));
        if period % 500 == 0 {
            println!("{:.1} s: {:7.3} m, {:7.4} rad", stepper.time(), q[0], q[1]);
        }
        let push = -(k * Vector4::new(q[0], q[1], v[0], v[1]))[0];
        stepper.step_with(&mut state, &InputsOf::<CartPole> { push }, PERIOD)?;
    }
    let rest = space.positions(&state)?;
    assert!(rest.amax() < 1e-2);
    Ok(())
}
