//! A four-bar that swings, in both descriptions.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom_firmware::check;
use holonom_firmware::reference::{FOUR_BAR_BY_BODIES, FOUR_BAR_BY_JOINTS};
use holonom_firmware::trials::{SwingByBodies, SwingByJoints};

#[cortex_m_rt::entry]
fn main() -> ! {
    holonom_firmware::main(|| {
        let bodies = check::<SwingByBodies<_>>(FOUR_BAR_BY_BODIES);
        let joints = check::<SwingByJoints<_>>(FOUR_BAR_BY_JOINTS);
        bodies == Ok(true) && joints == Ok(true)
    })
}
