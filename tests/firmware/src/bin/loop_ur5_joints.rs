//! Nothing but a loop of the UR5 by its joints, for its size.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom_firmware::trials::Ur5ByJoints;
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| holonom_firmware::repeat::<Ur5ByJoints<_>>().is_ok())
}
