//! A pendulum that stands on its head by a wheel, at 1 kHz: a torque in, an angle out.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_semihosting::{debug, hprintln};
use holonom::prelude::*;
use panic_halt as _;

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

/// The inputs in the number type of the run.
type Inputs = InputsOf<Balancer, f32>;

/// A second of control, one step a period; says the angle ten times.
fn run(timer: &mut SYST) -> Result<(), Fault> {
    let pivot = Balancer::HANDLES.pivot;
    let balancer = Balancer::default();
    let mut stepper = Stepper::<Problem<_, _, f32>, _>::new(&balancer, StandardLagrange, Rk4)?;
    // Aside by 0.05 rad, at rest.
    let mut start = balancer.described_state()?;
    balancer.set_angle(&mut start, pivot, 0.05)?;
    let mut state = stepper.state_of(&start)?;
    for period in 0..1000 {
        while !timer.has_wrapped() {}
        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        let angle = view.angle(pivot);
        if period % 100 == 0 {
            hprintln!("{:.1} s: {:.5} rad", stepper.time(), angle);
        }
        let inputs = Inputs {
            torque: 2.0 * angle + 0.2 * view.angle_rate(pivot),
        };
        stepper.step_with(&mut state, &inputs, 1e-3)?;
    }
    Ok(())
}

#[cortex_m_rt::entry]
fn main() -> ! {
    if let Some(peripherals) = cortex_m::Peripherals::take() {
        // 1 kHz of the board's 25 MHz.
        let mut timer = peripherals.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(24_999);
        timer.clear_current();
        timer.enable_counter();
        if let Err(fault) = run(&mut timer) {
            hprintln!("{}", fault);
        }
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {
        cortex_m::asm::wfi();
    }
}
