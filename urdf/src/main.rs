//! The command: `holonom-urdf arm.urdf > arm.rs`.

#![forbid(unsafe_code)]

use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use holonom_urdf::{Options, Robot};

/// Prints the annotated struct that holonom takes, from a URDF file.
///
/// The source goes to standard output. Every fault of the file goes to standard error with its
/// line, and so does what is skipped.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// The URDF file; of a xacro file, what `xacro` makes of it.
    file: PathBuf,
    /// Let the root link float. Otherwise it is the ground.
    #[arg(long)]
    floating: bool,
    /// Leave out the inputs and motors of the joints. Damping stays.
    #[arg(long)]
    passive: bool,
    /// Take masses and inertias that no body has as the file gives them, if the robot as a whole
    /// has inertia. Each is named.
    #[arg(long)]
    accept_inertia: bool,
    /// Take angles of frames within 1e-5 rad of a quarter turn as exact: 1.5708 is pi / 2.
    #[arg(long)]
    round_angles: bool,
    /// The name of the struct, in place of the robot's.
    #[arg(long, value_name = "TYPE")]
    name: Option<String>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let file = arguments.file.display().to_string();
    let text = match fs::read_to_string(&arguments.file) {
        Ok(text) => text,
        Err(error) => {
            eprintln!("{file}: {error}");
            return ExitCode::FAILURE;
        }
    };
    let mut options = Options::default();
    options.floating = arguments.floating;
    options.passive = arguments.passive;
    options.accept_inertia = arguments.accept_inertia;
    options.name = arguments.name;
    options.source = arguments
        .file
        .file_name()
        .map(|name| name.to_string_lossy().into_owned());
    let robot = if arguments.round_angles {
        Robot::parse_rounded(&text)
    } else {
        Robot::parse(&text)
    };
    match robot.and_then(|robot| robot.mechanism(&options)) {
        Ok(mechanism) => {
            for note in &mechanism.notes {
                eprintln!("{file}:{}: {note}", note.line);
            }
            // A reader may close its end before all is there.
            match write!(io::stdout(), "{mechanism}") {
                Ok(()) => ExitCode::SUCCESS,
                Err(_) => ExitCode::FAILURE,
            }
        }
        Err(faults) => {
            eprintln!("{}", faults.in_file(&file));
            ExitCode::FAILURE
        }
    }
}
