//! A linear-quadratic regulator: a pole on a cart is linearised, a gain computed, and the pole
//! balanced at 1 kHz. Between the instants of the controller, steps are adaptive.
//!
//! ```text
//! cargo run -p holonom --example lqr
//! ```

use holonom::independent::{discrete_lqr, to_discrete};
use holonom::nalgebra::{Matrix1, Matrix4, RowVector4, Vector4};
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

/// The period of the controller (s).
const PERIOD: f64 = 1e-3;

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
    Ok(discrete_lqr(&a, &b, &q, &Matrix1::new(0.1)).expect("the cart moves the pole"))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (cart_pole, h, k) = (CartPole::default(), CartPole::HANDLES, regulator()?);
    let mut start = cart_pole.described_state::<f64>()?;
    cart_pole.set_angle(&mut start, h.pin, 0.3)?;
    let report = cart_pole
        .simulation(StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .every_period(PERIOD, |sample, inputs| {
            let (q, v) = (
                sample.displacement(h.rail),
                sample.displacement_rate(h.rail),
            );
            let (angle, rate) = (sample.angle(h.pin), sample.angle_rate(h.pin));
            inputs.push = -(k * Vector4::new(q, angle, v, rate))[0];
        })
        .run(0.0..=6.0, every(0.5), |sample| {
            let (q, angle) = (sample.displacement(h.rail), sample.angle(h.pin));
            println!("{:.1} s: {q:7.3} m, {angle:7.4} rad", sample.time());
        })?;
    let rest = cart_pole.view(report.time, &report.state)?;
    assert!(rest.angle(h.pin).abs().max(rest.displacement(h.rail).abs()) < 1e-2);
    Ok(())
}
