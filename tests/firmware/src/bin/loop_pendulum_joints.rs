//! Nothing but a loop of the pendulum by its joints, for its size.

#![no_std]
#![no_main]
#![forbid(unsafe_code)]

use holonom_firmware::trials::PendulumByJoints;
use panic_never as _;

#[holonom_firmware::entry]
fn main() -> ! {
    holonom_firmware::main(|| holonom_firmware::repeat::<PendulumByJoints<_>>().is_ok())
}
