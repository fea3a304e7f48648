//! A UR5 with torques in, by its joints.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::panic::PanicInfo;

use holonom_firmware::check;
use holonom_firmware::reference::UR5_BY_JOINTS;
use holonom_firmware::trials::Ur5ByJoints;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    holonom_firmware::explain(info)
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| check::<Ur5ByJoints<_>>(UR5_BY_JOINTS) == Ok(true))
}
