//! A UR5 with torques in, by its joints.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom_firmware::check;
use holonom_firmware::reference::UR5_BY_JOINTS;
use holonom_firmware::trials::Ur5ByJoints;

#[cortex_m_rt::entry]
fn main() -> ! {
    holonom_firmware::main(|| check::<Ur5ByJoints<_>>(UR5_BY_JOINTS) == Ok(true))
}
