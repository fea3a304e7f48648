//! Mechanisms at 1 kHz on a Cortex-M: what they take is counted, and what they compute is checked against the host.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(not(feature = "explain"))]
use panic_never as _;
#[cfg(feature = "explain")]
use panic_semihosting as _;

pub mod reference;
pub mod trials;

use core::hint::black_box;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::{hprint, hprintln};
use holonom::{Fault, Real};

use trials::{ByBodies, ByJoints, Plant, RodPendulum, Swing, Trial, Tried};

/// What the firmware computes with.
#[cfg(feature = "single")]
pub type Number = f32;
/// What the firmware computes with.
#[cfg(not(feature = "single"))]
pub type Number = f64;

/// Instructions of a tick of the timer, with `-icount shift=0`: an instruction takes 1 ns there, and the boards' clock 40.
const INSTRUCTIONS_PER_TICK: u32 = 40;

/// How often what is counted is done.
const REPETITIONS: u32 = 1000;

/// Starts the timer for [`instructions`], does what there is to do, and leaves the emulator: with success if all of it was right.
pub fn main(work: impl FnOnce() -> bool) -> ! {
    let is_right = cortex_m::Peripherals::take().is_some_and(|peripherals| {
        let mut timer = peripherals.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(0x00ff_ffff);
        timer.clear_current();
        timer.enable_counter();
        work()
    });
    debug::exit(if is_right { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}

/// The instructions of some work, on average.
fn instructions(mut work: impl FnMut()) -> u32 {
    let begin = SYST::get_current();
    for _ in 0..REPETITIONS {
        work();
    }
    let ticks = begin.wrapping_sub(SYST::get_current()) & 0x00ff_ffff;
    ticks * INSTRUCTIONS_PER_TICK / REPETITIONS
}

/// How far the readings may be from those of the host in `f64`: of the angle (rad), and of the force relative to its size.
const TOLERANCE: f64 = if cfg!(feature = "single") {
    1e-3
} else {
    1e-12
};

/// Counts what a trial takes, and prints it: mechanism and description, formulation, type of numbers, instructions of an evaluation and of a step, bytes of stack of a
/// step. Gives what there is after so many periods.
fn counted<T: Trial<Number>>(periods: u32) -> Result<(T, T::State), Fault> {
    let (mut trial, mut state) = T::new()?;
    let evaluation = instructions(|| {
        let _ = black_box(trial.evaluate(black_box(&state)));
    });
    let mut number = 0;
    let mut copy = state;
    let step = instructions(|| {
        let _ = black_box(trial.tick(&mut copy, number));
        number += 1;
    });
    // Once more, as not to count what looks for faults.
    (trial, state) = T::new()?;
    let before = cortex_m_stack::current_stack_in_use();
    cortex_m_stack::repaint_stack();
    for number in 0..periods {
        trial.tick(&mut state, number)?;
    }
    let stack = cortex_m_stack::stack_size() - cortex_m_stack::stack_painted() - before;
    hprint!(
        "{}, {} | {} | {} | {} | {} | {} | ",
        T::Plant::NAME,
        T::DESCRIPTION,
        T::Formulation::NAME,
        core::any::type_name::<Number>(),
        evaluation,
        step,
        stack,
    );
    Ok((trial, state))
}

/// Counts what a formulation takes with the pendulum and the four-bar, in a program of its own: a kernel with several callers is compiled in another way.
///
/// # Errors
/// Those of the trials.
pub fn count_all<F: Tried<Number>>() -> Result<(), Fault> {
    count::<ByBodies<_, RodPendulum, F>>()?;
    count::<ByBodies<_, Swing, F>>()?;
    count::<ByJoints<_, Swing, F>>()
}

fn count<T: Trial<Number>>() -> Result<(), Fault> {
    counted::<T>(REPETITIONS)?;
    hprintln!(" | ");
    Ok(())
}

/// Counts what a trial takes, and prints how far it is from the host. Whether that is little enough.
///
/// # Errors
/// Those of the trial.
pub fn check<T: Trial<Number>>([angle, force]: [f64; 2]) -> Result<bool, Fault> {
    let (trial, state) = counted::<T>(T::Plant::PERIODS)?;
    let [read_angle, read_force] = trial.read(&state)?.map(Real::to_f64);
    let off = [
        (read_angle - angle).abs(),
        ((read_force - force) / force).abs(),
    ];
    hprintln!("{:.1e} | {:.1e}", off[0], off[1]);
    Ok(off.iter().all(|&off| off < TOLERANCE))
}
