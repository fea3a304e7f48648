//! States of the user's own against closed forms.

#![forbid(unsafe_code)]

mod elements;
mod handling;
mod motor;
mod refusals;
mod sensitivities;

use holonom::prelude::*;
use holonom_fixtures as _;

/// The inductance of a motor (H).
const L: f64 = 2e-3;
/// Its torque for a current (N m/A), and its voltage for a speed (V s/rad).
const K: f64 = 0.05;
/// The moment of inertia on its shaft (kg m^2).
const J: f64 = 1e-4;
/// The torque of the air for a speed (N m s/rad).
const AIR: f64 = 1e-4;
/// The voltage (V).
const VOLTAGE: f64 = 12.0;

/// A fan on a motor.
#[derive(Mechanism)]
#[mechanism(coordinates = "both", kernels = [mass])]
struct Fan {
    #[input]
    voltage: f64,
    #[param]
    resistance: f64,
    #[state(rate = (voltage - resistance * current - K * bearing.rate) / L, start = 0.0)]
    current: f64,
    #[body(mass = 0.2, inertia = [1e-4, 1e-4, J], position = [0.0, 0.0, 0.1])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = K * current - AIR * rate)]
    motor: TorsionalActuator,
}

impl Fan {
    fn of(resistance: f64) -> Self {
        let mut fan = Self::new(resistance).expect("a sound resistance");
        fan.voltage = VOLTAGE;
        fan
    }

    /// Current (A) and speed (rad/s) after a time: `L i' = V - R i - K w`, `J w' = K i - AIR w`,
    /// both zero at the start.
    fn closed_form(resistance: f64, time: f64) -> [f64; 2] {
        let end = VOLTAGE / (resistance * AIR + K * K);
        let [current, speed] = [AIR * end, K * end];
        let (sum, product) = (
            resistance / L + AIR / J,
            (resistance * AIR + K * K) / (L * J),
        );
        let root = (sum * sum / 4.0 - product).sqrt();
        let [a, b] = [-sum / 2.0 + root, -sum / 2.0 - root];
        let [slow, fast] = [
            b * speed / (a - b) * (a * time).exp(),
            -a * speed / (a - b) * (b * time).exp(),
        ];
        let part = |rate: f64, speed: f64| (J * rate + AIR) / K * speed;
        [current + part(a, slow) + part(b, fast), speed + slow + fast]
    }
}

fn tight() -> DormandPrince<f64> {
    DormandPrince::new(Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    })
}
