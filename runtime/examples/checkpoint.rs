//! A run that is kept in a file every thousand steps, and goes on where it was when the program is
//! started again.
//!
//! ```text
//! cargo run -p holonom --features serde --example checkpoint
//! ```
//!
//! Interrupt it and start it again: it says where it goes on, and ends with the same numbers.

use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Write as _};
use std::path::Path;

use holonom::prelude::*;
use holonom::run::Checkpoint;

/// Two rods on hinges across each other, which swing without an end.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Rods {
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 1.5, 0.0])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [0.6, 0.0, 0.8])]
    elbow: Revolute,
}

/// Writes a checkpoint beside the file and renames it: an interruption leaves the former one.
fn write(path: &Path, checkpoint: &Checkpoint<Rods>) -> Result<(), Box<dyn std::error::Error>> {
    let beside = path.with_extension("new");
    let mut file = BufWriter::new(File::create(&beside)?);
    serde_json::to_writer(&mut file, checkpoint)?;
    file.flush()?;
    fs::rename(beside, path)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::temp_dir().join("holonom-example.checkpoint");
    let rods = Rods::default();
    let mut failed = None;
    let mut run = rods
        .simulation(StandardLagrange, DormandPrince::default())
        .checkpoints(1000, |checkpoint| match write(&path, checkpoint) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failed = Some(error);
                ControlFlow::Break(())
            }
        });
    let report = match File::open(&path) {
        Ok(file) => {
            let checkpoint = serde_json::from_reader(BufReader::new(file))?;
            println!("{checkpoint:?}");
            run.resume(&checkpoint, |_| ())?
        }
        Err(_) => run.run(0.0..=1000.0, every(1.0), |_| ())?,
    };
    if let Some(error) = failed {
        return Err(error);
    }
    fs::remove_file(&path)?;
    println!("{} steps, {:?}", report.accepted, report.state);
    println!("{}", report.warnings());
    Ok(())
}
