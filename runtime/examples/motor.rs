//! A DC motor with its current as a state of the mechanism: it starts a fan from rest, and the
//! current and the speed are printed beside the closed form.
//!
//! `cargo run --release --example motor`

use holonom::prelude::*;

/// The resistance of the winding (ohm).
const R: f64 = 0.5;
/// Its inductance (H).
const L: f64 = 2e-3;
/// The torque for a current (N m/A), and the voltage for a speed (V s/rad).
const K: f64 = 0.05;
/// The moment of inertia of the rotor and the fan (kg m^2).
const J: f64 = 1e-4;
/// The torque of the air for a speed (N m s/rad).
const AIR: f64 = 1e-4;

/// A fan on a motor.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Fan {
    /// The voltage (V) on the motor.
    #[input]
    voltage: f64,
    /// The current (A), which the voltage drives against resistance, speed and inductance.
    #[state(rate = (voltage - R * current - K * motor.rate) / L, start = 0.0)]
    current: f64,
    #[body(mass = 0.2, inertia = [1e-4, 1e-4, J])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = K * current - AIR * rate)]
    motor: TorsionalActuator,
}

/// Current (A) and speed (rad/s) a time after the voltage was put on:
/// `L i' = V - R i - K w`, `J w' = K i - AIR w`.
fn closed_form(voltage: f64, time: f64) -> [f64; 2] {
    // The motion is an end and two exponentials that leave it.
    let end = voltage / (R * AIR + K * K);
    let [current, speed] = [AIR * end, K * end];
    let (sum, product) = (R / L + AIR / J, (R * AIR + K * K) / (L * J));
    let root = (sum * sum / 4.0 - product).sqrt();
    let [a, b] = [-sum / 2.0 + root, -sum / 2.0 - root];
    // Both begin at zero, and the speed with no acceleration.
    let [of_a, of_b] = [b * speed / (a - b), -a * speed / (a - b)];
    let [fast, slow] = [of_b * (b * time).exp(), of_a * (a * time).exp()];
    let rest = |rate: f64, part: f64| (J * rate + AIR) / K * part;
    [current + rest(a, slow) + rest(b, fast), speed + slow + fast]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (fan, h) = (
        Fan {
            voltage: 12.0,
            ..Fan::default()
        },
        Fan::HANDLES,
    );
    let mut worst = 0.0_f64;
    println!("time [s]  current [A]  speed [rad/s]");
    fan.simulation(
        StandardLagrange,
        DormandPrince::new(Tolerance {
            relative: 1e-12,
            absolute: 1e-12,
        }),
    )
    .run(0.0..=0.2, every(0.01), |sample| {
        let found = [sample.state_value(h.current), sample.angle_rate(h.bearing)];
        let expected = closed_form(fan.voltage, sample.time());
        for (found, expected) in found.into_iter().zip(expected) {
            worst = worst.max((found - expected).abs() / (1.0 + expected.abs()));
        }
        println!(
            "{:8.2}  {:11.6}  {:13.6}",
            sample.time(),
            found[0],
            found[1]
        );
    })?;
    println!("largest difference from the closed form: {worst:.1e}");
    Ok(())
}
