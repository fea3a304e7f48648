//! Mechanisms at 1 kHz on a controller: what they take is counted, and what they compute is checked
//! against the host.

#![no_std]
#![forbid(unsafe_code)]

pub mod balancer;
#[cfg_attr(target_arch = "arm", path = "board/cortex_m.rs")]
#[cfg_attr(target_arch = "riscv32", path = "board/riscv.rs")]
mod board;
pub mod modes;
pub mod reference;
pub mod regulator;
pub mod trials;

use core::fmt::Display;
use core::hint::black_box;
use core::panic::PanicInfo;

use holonom::{Fault, Real, Scalar};
use semihosting::process::ExitCode;
use semihosting::{print, println};

pub use board::entry;
use trials::{ByBodies, ByJoints, PERIOD, Plant, RodPendulum, Swing, Trial, Tried};

/// What the firmware computes with.
#[cfg(feature = "single")]
pub type Number = f32;
/// What the firmware computes with.
#[cfg(not(feature = "single"))]
pub type Number = f64;

/// How often what is counted is done.
const REPETITIONS: u32 = 1000;

/// Does what there is to do, and leaves the emulator: with success if all of it was right.
pub fn main(work: impl FnOnce() -> bool) -> ! {
    let is_right = board::with_timer(work);
    let code = if is_right {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    };
    code.exit_process()
}

/// What programs that print do in a panic; what the others call cannot panic.
pub fn explain(info: &PanicInfo<'_>) -> ! {
    println!("{info}");
    ExitCode::FAILURE.exit_process()
}

/// The instructions of some work, on average.
fn instructions(mut work: impl FnMut()) -> u32 {
    let all = board::instructions(|| {
        for _ in 0..REPETITIONS {
            work();
        }
    });
    all / REPETITIONS
}

/// The bytes of stack of some work, as the crates of the boards count them.
fn stack(work: &mut dyn FnMut()) -> impl Display + use<> {
    let before = board::current_stack_in_use();
    board::repaint_stack();
    work();
    board::stack_size() - board::stack_painted() - before
}

/// How far the readings may be from those of the host in `f64`: of the angle (rad), and of the
/// force relative to its size.
const TOLERANCE: f64 = if cfg!(feature = "single") {
    1e-3
} else {
    1e-12
};

/// A second, which turns joints by more than the series for small angles take, and a time after
/// which nothing is finite: the longest ways that a step can go.
const LONG: [f64; 2] = [
    1.0,
    if cfg!(feature = "single") {
        1e30
    } else {
        1e200
    },
];

/// Counts what a trial takes, and prints it: mechanism and description, formulation, type of
/// numbers, instructions of an evaluation, of a step and of the longest, bytes of stack of a step
/// and of the deepest. Gives what there is after so many periods.
fn counted<T: Trial<Number>>(periods: u32) -> Result<(T, T::State), Fault> {
    let (mut trial, mut state) = T::new()?;
    let evaluation = instructions(|| {
        let _ = black_box(trial.evaluate(black_box(&state)));
    });
    let period = Number::constant(PERIOD);
    let mut number = 0;
    let mut copy = state;
    let step = instructions(|| {
        let _ = black_box(trial.tick(&mut copy, number, period));
        number += 1;
    });
    let longest = LONG.map(|step| {
        instructions(|| {
            let _ = black_box(trial.tick(&mut { state }, 0, Number::constant(step)));
        })
    });
    let longest = longest.into_iter().fold(step, u32::max);
    let deepest = stack(&mut || {
        for step in LONG {
            let _ = black_box(trial.tick(&mut { state }, 0, Number::constant(step)));
        }
    });
    (trial, state) = T::new()?;
    let mut outcome = Ok(());
    let stack = stack(&mut || {
        for number in 0..periods {
            outcome = outcome.and(trial.tick(&mut state, number, period));
        }
    });
    outcome?;
    print!(
        "{}, {} | {} | {} | {} | {} | {} | {} | {} | ",
        T::Plant::NAME,
        T::DESCRIPTION,
        T::Formulation::NAME,
        core::any::type_name::<Number>(),
        evaluation,
        step,
        longest,
        stack,
        deepest,
    );
    Ok((trial, state))
}

/// Counts what a formulation takes with the pendulum and the four-bar, in a program of its own: a
/// kernel with several callers is compiled in another way.
///
/// # Errors
/// Those of the trials.
pub fn count_all<F: Tried<Number>>() -> Result<(), Fault> {
    count::<ByBodies<_, RodPendulum, F>>()?;
    count::<ByBodies<_, Swing, F>>()?;
    count::<ByJoints<_, Swing, F>>()
}

/// Counts what a trial takes.
///
/// # Errors
/// Those of the trial.
pub fn count<T: Trial<Number>>() -> Result<(), Fault> {
    counted::<T>(REPETITIONS)?;
    println!(" | ");
    Ok(())
}

/// Counts what a trial takes, and prints how far it is from the host. Whether that is little
/// enough.
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
    println!("{:.1e} | {:.1e}", off[0], off[1]);
    Ok(off.iter().all(|&off| off < TOLERANCE))
}

/// Starts a trial and takes its steps, as a controller does.
///
/// # Errors
/// Those of the trial.
pub fn repeat<T: Trial<Number>>() -> Result<(), Fault> {
    let (mut trial, mut state) = T::new()?;
    for number in 0..REPETITIONS {
        trial.tick(&mut state, number, Number::constant(PERIOD))?;
    }
    black_box(state);
    Ok(())
}
