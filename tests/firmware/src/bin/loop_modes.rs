//! Stops, dry friction, a clutch, events, a state and a table at 1 kHz: right, and without a panic.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::Real;
use holonom_firmware::Number;
use holonom_firmware::modes::worst;
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| worst::<Number>().is_ok_and(|off| off.to_f64() < 1e-4))
}
