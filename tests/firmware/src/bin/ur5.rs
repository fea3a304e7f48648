//! A UR5 with torques in, by its joints.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use holonom_firmware::reference::UR5_BY_JOINTS;
use holonom_firmware::trials::Ur5ByJoints;
use holonom_firmware::{report, start};

#[entry]
fn main() -> ! {
    let outcome = cortex_m::Peripherals::take().is_some_and(|peripherals| {
        start(peripherals.SYST);
        report::<Ur5ByJoints<_>>(UR5_BY_JOINTS) == Ok(true)
    });
    debug::exit(if outcome { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}
