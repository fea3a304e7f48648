//! Nothing but a loop of the four-bar by its joints, for its size.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom_firmware::trials::SwingByJoints;
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| holonom_firmware::repeat::<SwingByJoints<_>>().is_ok())
}
