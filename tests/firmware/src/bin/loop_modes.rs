//! Stops, dry friction, a clutch, events, a state, a table and a law that switches at 1 kHz: right,
//! and without a panic.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::{Fault, Real};
use holonom_firmware::Number;
use holonom_firmware::modes::{sprung, worst};
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| {
        let is_near = |off: Result<Number, Fault>| off.is_ok_and(|off| off.abs().to_f64() < 1e-4);
        is_near(worst()) && is_near(sprung())
    })
}
