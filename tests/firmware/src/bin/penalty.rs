//! Mechanisms with equations left, in the penalty formulation.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::Penalty;
use holonom_firmware::count_all;

#[cortex_m_rt::entry]
fn main() -> ! {
    holonom_firmware::main(|| count_all::<Penalty<_>>().is_ok())
}
