//! The balancer of the guide, beside its twin in C.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use core::panic::PanicInfo;

use holonom_firmware::balancer::BalancerByJoints;
use holonom_firmware::count;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    holonom_firmware::explain(info)
}

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| count::<BalancerByJoints<_>>().is_ok())
}
