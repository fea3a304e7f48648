//! Rolls out many UR5 arms on a GPU of NVIDIA, from Rust: each is thrown from the described
//! configuration with rates of its own, and falls freely.
//!
//! ```text
//! cargo run --release --manifest-path export/examples/cudarc/Cargo.toml -- [FOLDER] [ARMS]
//! ```
//!
//! It writes `ur5.h`, `ur5.c` and `ur5_rollout.cu` into the folder and compiles them by NVRTC. It
//! prints what a step of an arm takes, compares some arms with runs of Rust, and draws their elbows
//! into `elbows.svg` there. Where there is no GPU, it says so and fails.

mod gpu;
mod host;
mod plot;

use std::env;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom_export::Export;
use holonom_models::Ur5;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use gpu::{Gpu, Plan};
use host::Host;

/// The numbers of the rollout. `f32` and `Single` take less than half the time.
type Number = f64;
type Kind = holonom_export::Double;

const DT: Number = 1e-3;
/// A second of time.
const STEPS: usize = 1000;
/// Recorded arms are written after so many steps.
const EVERY: usize = 10;
/// The arms that are recorded, compared and drawn.
const RECORDED: usize = 6;
/// The largest difference of any number that is taken for round-off. A GPU rounds a product and a
/// sum at once, Rust one after the other. Compiled for a processor, the one and the other differ by
/// some hundred units of the last digit after this second.
const ROUND_OFF: Number = 1e5 * Number::EPSILON;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let usual = || env::temp_dir().join("thrown_arms");
    let folder = arguments.next().map_or_else(usual, PathBuf::from);
    let arms = arguments
        .next()
        .map_or(Ok(1 << 16), |arms| arms.parse::<usize>())?;
    let arms = arms.max(1);

    gpu::is_there()?;
    let export = Export::<Ur5, Kind, Relative>::new(&Ur5::default(), StandardLagrange);
    export.step(Rk4).write_cuda(&folder)?;
    let gpu = Gpu::new(&folder, "ur5")?;
    let host = Host::new()?;

    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut thrown = || std::array::from_fn(|_| random.random_range(-1.0..1.0));
    let starts: Vec<Vec<Number>> = (0..arms).map(|_| host.start(thrown())).collect();
    let described = host.start([0.0; 6]);
    if gpu.start(described.len())? != described {
        return Err("the start of the rollout is not that of Rust".into());
    }

    let plan = Plan {
        steps: STEPS,
        dt: DT,
        every: 0,
    };
    // A first launch also loads the kernel.
    gpu.rollout(&starts, &Plan { steps: 1, ..plan })?;
    let all = gpu.rollout(&starts, &plan)?;
    if let Some(arm) = all.statuses.iter().position(|status| *status != 0) {
        return Err(format!("arm {arm} stopped with status {}", all.statuses[arm]).into());
    }
    let taken: usize = all.taken.iter().sum();
    let each = all.nanoseconds / taken as f64;
    println!("{}: {arms} arms, {STEPS} steps of {DT} s", gpu.name);
    println!("{each:.4} ns a step of Runge-Kutta and arm");

    let plan = Plan {
        every: EVERY,
        ..plan
    };
    let some = gpu.rollout(&starts[..RECORDED.min(arms)], &plan)?;
    for (arm, recorded) in some.results.iter().enumerate() {
        let mut of_rust = host.run(&starts[arm], &plan)?;
        of_rust.extend(of_rust.last().cloned());
        // Its end among all others is compared as well.
        let of_gpu = [&recorded[..], &all.ends[arm..=arm]].concat();
        let most = host::difference(&of_gpu, &of_rust)?;
        println!("arm {arm}: numbers differ from those of Rust by at most {most:.1e}");
        if most.is_nan() || most > ROUND_OFF {
            return Err(format!("that is more than {ROUND_OFF:.1e}").into());
        }
    }

    let elbows = some.results.iter().map(|arm| host.elbow(arm));
    let path = folder.join("elbows.svg");
    plot::write(&path, DT * EVERY as Number, &elbows.collect::<Vec<_>>())?;
    println!("their elbows: {}", path.display());
    Ok(())
}
