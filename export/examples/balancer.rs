//! Writes the balancer of the guide's page on controllers into a folder, in single precision.
//! `balancer.h` and `balancer.c` have the angle of its pivot as a reading. `tests/firmware/run`
//! compiles them for a Cortex-M4F.

use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::{Export, ExportError, Single};

/// A wheel on a pendulum; the motor turns the wheel against the pendulum.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Balancer {
    #[input]
    torque: f64,
    #[body(mass = 0.5, inertia = [0.004, 0.004, 1e-4], position = [0.0, 0.0, 0.1])]
    pendulum: Body,
    #[body(mass = 0.2, inertia = [1e-3, 5e-4, 5e-4], position = [0.0, 0.0, 0.2])]
    wheel: Body,
    #[joint(between = [ground, pendulum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [pendulum, wheel], point = [0.0, 0.0, 0.2], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
    #[force(between = [pendulum, wheel], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

fn main() -> Result<(), ExportError> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let (balancer, pivot) = (Balancer::default(), Balancer::HANDLES.pivot);
    // Aside by 0.05 rad, at rest.
    let mut start = balancer.described_state()?;
    balancer.set_angle(&mut start, pivot, 0.05)?;
    Export::<_, Single, Relative>::new(&balancer, StandardLagrange)
        .starting_from(&balancer, &start)
        .step(Rk4)
        .reading("angle", "The angle of the pivot (rad).", |view| {
            view.angle(pivot)
        })
        .reading("angle_rate", "Its rate (rad/s).", |view| {
            view.angle_rate(pivot)
        })
        .write_c(folder)
}
