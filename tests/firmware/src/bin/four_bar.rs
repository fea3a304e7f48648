//! A four-bar that swings, in both descriptions.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::panic::PanicInfo;

use holonom_firmware::check;
use holonom_firmware::reference::{FOUR_BAR_BY_BODIES, FOUR_BAR_BY_JOINTS};
use holonom_firmware::trials::{SwingByBodies, SwingByJoints};

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    holonom_firmware::explain(info)
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| {
        let bodies = check::<SwingByBodies<_>>(FOUR_BAR_BY_BODIES);
        let joints = check::<SwingByJoints<_>>(FOUR_BAR_BY_JOINTS);
        bodies == Ok(true) && joints == Ok(true)
    })
}
