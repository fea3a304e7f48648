//! A pole on a cart, balanced by a linear-quadratic regulator at 1 kHz. The host computes the gain
//! from this struct (`tests/tests/firmware.rs`).

use holonom::Real;
use holonom::error::StepFault;
use holonom::independent::IndependentCoordinates;
use holonom::prelude::*;

/// A cart of 1 kg on a rail, and a pole of 0.6 m that stands on it.
#[derive(Mechanism)]
#[mechanism(
    gravity = [0.0, 0.0, -9.81],
    coordinates = "joints",
    kernels = [mass, inverse, gravity, coriolis, jacobian]
)]
pub struct CartPole {
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01])]
    cart: Body,
    #[body(mass = 0.2, inertia = [0.006, 0.0001, 0.006], position = [0.0, 0.0, 0.3])]
    pole: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    pub rail: Prismatic,
    #[joint(between = [cart, pole], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pub pin: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [0.0, push, 0.0])]
    motor: PointForce,
}

/// Of displacement, angle and their rates, for weights of 10, 100, 1 and 1 and of 0.1 on the push.
pub const GAIN: [f64; 4] = [-9.902_763_4, 69.877_183_8, -11.274_561_0, 12.670_892_9];

/// The period of the loop (s).
pub const PERIOD: f64 = 1e-3;

/// Six seconds from 0.3 rad aside; the displacement (m) and the angle (rad) then.
///
/// # Errors
/// What a step or a reading refuses.
pub fn balance<S: Real>() -> Result<[S; 2], Fault> {
    let (cart_pole, h) = (CartPole::default(), CartPole::HANDLES);
    let space: IndependentCoordinates<CartPole, 2, S> =
        cart_pole.coordinates_in((h.rail, h.pin))?;
    let mut state = space.state([S::zero(), S::constant(0.3)], [S::zero(); 2])?;
    let mut stepper = Stepper::<Problem<_, _, S>, _>::new(&cart_pole, StandardLagrange, Rk4)?;
    for _ in 0..6000 {
        let (q, v) = (space.positions(&state)?, space.rates(&state));
        let measured = [q.x, q.y, v.x, v.y];
        let products = measured.into_iter().zip(GAIN);
        let push = products.fold(S::zero(), |push, (x, k)| push - S::constant(k) * x);
        let inputs = InputsOf::<CartPole, S> { push };
        stepper.step_with(&mut state, &inputs, S::constant(PERIOD))?;
    }
    Ok(space.positions(&state)?.into())
}

/// Everything that there is in chosen coordinates, once, so that a program shows that nothing in it
/// panics: the largest difference between accelerations and those that come back of their efforts.
///
/// # Errors
/// What is refused.
pub fn everything<S: Real>() -> Result<S, Fault> {
    let (cart_pole, h) = (CartPole::default(), CartPole::HANDLES);
    let mut space: IndependentCoordinates<CartPole, 2, S> =
        cart_pole.coordinates_in((h.rail, h.pin))?;
    space.set_inputs(&InputsOf::<CartPole, S> { push: S::one() })?;
    let state = space.state([S::zero(), S::constant(0.3)], [S::one(), S::one()])?;
    let wanted = [S::one(), -S::one()];
    let efforts = space.inverse(&state, wanted)?;
    let back = space.forward(&state, efforts)?;
    let parts = [
        space.bias(&state)?,
        space.gravity(&state)?,
        space.coriolis(&state)?,
    ];
    let mass = space.mass(&state)?;
    let jacobian = space.jacobian(&state, h.pole)?;
    let rate = space.jacobian_rate(&state, h.pole)?;
    let linear = space.linearise(&state, [h.push], |view| [view.angle(h.pin)])?;
    let block = space.regressor(&state, wanted, h.pole)?;
    let inertia = space.inertial_parameters(h.pole);
    let used = parts.iter().flat_map(|part| part.iter()).chain(mass.iter());
    let used = used.chain(jacobian.iter()).chain(rate.iter());
    let used = used.chain(block.iter()).chain(inertia.iter());
    let used = used
        .chain(linear.a::<4>().iter())
        .fold(S::zero(), |sum, x| sum + x.abs());
    if !used.is_finite() {
        return Err(Fault::Step(StepFault::StateNotFinite));
    }
    let off = back
        .iter()
        .zip(wanted)
        .map(|(back, wanted)| (*back - wanted).abs());
    Ok(off.fold(S::zero(), S::max))
}
