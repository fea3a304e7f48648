//! The board virt of QEMU.

use riscv::register::minstret;
pub(crate) use riscv_stack::{current_stack_in_use, repaint_stack, stack_painted, stack_size};

pub use riscv_rt::entry;

/// Does some work. The processor counts its instructions from the start.
pub(crate) fn with_timer(work: impl FnOnce() -> bool) -> bool {
    work()
}

/// The instructions of some work, with `-icount shift=0`.
pub(crate) fn instructions(work: impl FnOnce()) -> u32 {
    let begin = minstret::read();
    work();
    minstret::read().wrapping_sub(begin) as u32
}
