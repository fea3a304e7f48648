//! Mechanisms with equations left, in the standard formulation with Lagrange multipliers, without
//! any stabilisation.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::panic::PanicInfo;

use holonom::StandardLagrange;
use holonom_firmware::count_all;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    holonom_firmware::explain(info)
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| count_all::<StandardLagrange>().is_ok())
}
