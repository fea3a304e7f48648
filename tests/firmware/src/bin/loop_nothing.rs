//! What a program has without a mechanism, for its size.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| true)
}
