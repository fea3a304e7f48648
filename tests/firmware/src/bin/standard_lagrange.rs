//! Mechanisms with equations left, in the standard formulation with Lagrange multipliers, without any stabilisation.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::StandardLagrange;
use holonom_firmware::count_all;

#[cortex_m_rt::entry]
fn main() -> ! {
    holonom_firmware::main(|| count_all::<StandardLagrange>().is_ok())
}
