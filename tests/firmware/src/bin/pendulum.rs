//! The pendulum of chapter 15, in both descriptions.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::panic::PanicInfo;

use holonom_firmware::check;
use holonom_firmware::reference::{PENDULUM_BY_BODIES, PENDULUM_BY_JOINTS};
use holonom_firmware::trials::{PendulumByBodies, PendulumByJoints};

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    holonom_firmware::explain(info)
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| {
        let bodies = check::<PendulumByBodies<_>>(PENDULUM_BY_BODIES);
        let joints = check::<PendulumByJoints<_>>(PENDULUM_BY_JOINTS);
        bodies == Ok(true) && joints == Ok(true)
    })
}
