//! The pendulum of chapter 15, in both descriptions.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use holonom_firmware::reference::{PENDULUM_BY_BODIES, PENDULUM_BY_JOINTS};
use holonom_firmware::trials::{PendulumByBodies, PendulumByJoints};
use holonom_firmware::{report, start};

#[entry]
fn main() -> ! {
    let outcome = cortex_m::Peripherals::take().is_some_and(|peripherals| {
        start(peripherals.SYST);
        let bodies = report::<PendulumByBodies<_>>(PENDULUM_BY_BODIES);
        let joints = report::<PendulumByJoints<_>>(PENDULUM_BY_JOINTS);
        bodies == Ok(true) && joints == Ok(true)
    });
    debug::exit(if outcome { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}
