//! Mechanisms with equations left, in the augmented Lagrangian formulation.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom::AugmentedLagrangian;
use holonom_firmware::count_all;

#[cortex_m_rt::entry]
fn main() -> ! {
    holonom_firmware::main(|| count_all::<AugmentedLagrangian<_>>().is_ok())
}
