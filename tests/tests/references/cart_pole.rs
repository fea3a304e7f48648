//! The cart-pole against its equations of motion in closed form.

use holonom::prelude::*;
use holonom::{Pose, StateParts, dynamics::Dynamics};
use holonom_models::CartPole;
use nalgebra::{UnitQuaternion, Vector3};

/// `theta''` (rad/s^2) and `x''` (m/s^2): Florian, *Correct equations for the dynamics of the
/// cart-pole system*, 2007, equations 23 and 24, without friction.
fn closed_form(push: f64, angle: f64, rate: f64) -> [f64; 2] {
    const G: f64 = 9.81;
    const CART: f64 = 1.0;
    const POLE: f64 = 0.1;
    const HALF: f64 = 0.5;
    let (sine, cosine) = angle.sin_cos();
    let pushed = (-push - POLE * HALF * rate * rate * sine) / (CART + POLE);
    let turning = (G * sine + cosine * pushed)
        / (HALF * (4.0 / 3.0 - POLE * cosine * cosine / (CART + POLE)));
    let moving = (push + POLE * HALF * (rate * rate * sine - turning * cosine)) / (CART + POLE);
    [turning, moving]
}

#[test]
fn accelerates_as_the_closed_form_says() {
    for (push, angle, rate, speed) in [
        (0.0, 0.1, 0.0, 0.0),
        (10.0, 0.3, 2.0, -1.0),
        (-3.0, 2.5, -7.0, 4.0),
        (1e3, -1.4, 30.0, 0.5),
    ] {
        let mut model = CartPole::default();
        model.push = push;
        let handles = CartPole::HANDLES;
        let mut state = model.described_state::<f64>().expect("sound");
        let turned = UnitQuaternion::from_axis_angle(&-Vector3::z_axis(), angle);
        let pole = turned * Vector3::new(0.0, 0.5, 0.0);
        let spin = Vector3::new(0.0, 0.0, -rate);
        let along = Vector3::new(speed, 0.0, 0.0);
        let pose = Pose {
            position: pole,
            orientation: turned.into_inner(),
        };
        CartPole::set_pose(&mut state, handles.pole, pose);
        CartPole::set_velocity(&mut state, handles.cart, along);
        CartPole::set_velocity(&mut state, handles.pole, along + spin.cross(&pole));
        CartPole::set_angular_velocity_global(&mut state, handles.pole, spin);
        let dynamics =
            Dynamics::<Problem<CartPole, _>>::new(&model, StandardLagrange).expect("sound");
        let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
        let mut rates = state;
        *rates.velocities_mut() = *evaluation.rates.velocities();
        let [turning, moving] = closed_form(push, angle, rate);
        let found = [
            -CartPole::angular_velocity_global(&rates, handles.pole).z,
            CartPole::velocity(&rates, handles.cart).x,
        ];
        let size = turning.abs().max(moving.abs());
        assert!(
            (found[0] - turning).abs() < 1e-13 * size,
            "{found:?}, {turning}"
        );
        assert!(
            (found[1] - moving).abs() < 1e-13 * size,
            "{found:?}, {moving}"
        );
    }
}
