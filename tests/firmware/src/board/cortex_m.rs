//! The boards mps2-an386 and mps2-an500 of QEMU.

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
pub(crate) use cortex_m_stack::{current_stack_in_use, repaint_stack, stack_painted, stack_size};

pub use cortex_m_rt::entry;

/// Instructions of a tick of the timer, with `-icount shift=0`: an instruction takes 1 ns there,
/// and the boards' clock 40.
const INSTRUCTIONS_PER_TICK: u32 = 40;

/// Does some work while the timer runs.
pub(crate) fn with_timer(work: impl FnOnce() -> bool) -> bool {
    Peripherals::take().is_some_and(|peripherals| {
        let mut timer = peripherals.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(0x00ff_ffff);
        timer.clear_current();
        timer.enable_counter();
        work()
    })
}

/// The instructions of some work.
pub(crate) fn instructions(work: impl FnOnce()) -> u32 {
    let begin = SYST::get_current();
    work();
    let ticks = begin.wrapping_sub(SYST::get_current()) & 0x00ff_ffff;
    ticks * INSTRUCTIONS_PER_TICK
}
