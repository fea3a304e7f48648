//! A pole that is balanced by readings and a gain, and all equations in chosen coordinates: right,
//! and without a panic.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::Real;
use holonom_firmware::Number;
use holonom_firmware::regulator::{balance, everything};
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| {
        let rests = balance::<Number>().is_ok_and(|rest| rest.iter().all(|x| x.abs() < 1e-2));
        rests && everything::<Number>().is_ok_and(|off| off.to_f64() < 1e-4)
    })
}
