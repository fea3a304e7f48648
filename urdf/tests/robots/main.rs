//! Robots from files: numbers against Pinocchio, the source that is printed, and refusals.

#![forbid(unsafe_code)]

mod merged;
mod numbers;
mod printed;
mod refusals;
mod visuals;

use std::fs;
use std::path::{Path, PathBuf};

use holonom_urdf::{Mechanism, Options, Robot};

/// A file beneath the folder of the tests.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(name)
}

fn text(name: &str) -> String {
    fs::read_to_string(path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A mechanism as the command makes it, from a name in `data/reference.json`.
fn mechanism(robot: &str) -> Mechanism {
    let file = match robot {
        "crane" | "gripper" => format!("data/{robot}.urdf"),
        _ => format!("data/robots/{robot}.urdf"),
    };
    let mut options = Options::default();
    options.source = Some(format!("{robot}.urdf"));
    let robot = Robot::parse(&text(&file)).unwrap_or_else(|faults| panic!("{file}: {faults}"));
    robot.mechanism(&options).expect("something moves")
}
