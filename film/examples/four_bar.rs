//! A four-bar whose crank turns once in three seconds, as a page and as a moving picture:
//!
//! ```text
//! cargo run --release -p holonom-film --example four_bar -- target
//! ```
//!
//! The picture is that of the README.

use std::env;
use std::error::Error;
use std::path::PathBuf;

use holonom::prelude::*;
use holonom_film::Film;

/// A turn of the crank at 120 degrees a second (s).
const TURN: f64 = 3.0;

/// A crank of 0.3 m, a coupler of 0.86 m and a rocker of 0.7 m on a base of 0.8 m.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop")]
struct CrankRocker {
    #[body(mass = 0.3, inertia = [0.0001, 0.003, 0.003], position = [0.15, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.2, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.35, 0.0])]
    coupler: Body,
    #[body(mass = 0.7, inertia = [0.03, 0.03, 0.03], position = [0.8, 0.35, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [crank, coupler], point = [0.3, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [coupler, rocker], point = [0.8, 0.7, 0.0], axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(between = [ground, rocker], point = [0.8, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    stand: Revolute,
    #[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = deg(120.0) * time)]
    motor: AngleDriver,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).unwrap_or("target".into()));
    let handles = CrankRocker::HANDLES;
    let mut film = Film::new().titled("Crank and rocker").with_reactions();
    film.trace_point(handles.coupler, "tip of the coupler", [-0.1, 0.35, 0.0]);
    let mechanism = CrankRocker::default();
    let report = KinematicAnalysis::new(&mechanism, StandardLagrange).run(
        0.0..=TURN,
        every(TURN / 180.0),
        |sample| {
            film.record(sample);
            film.reading("rocker", "rad", sample.angle(handles.stand));
            if let Ok(torque) = sample.driving_effort(handles.motor) {
                film.reading("torque of the motor", "N m", torque);
            }
        },
    )?;
    film.warnings(&report.warnings());
    film.save(folder.join("four-bar.html"))?;
    film.save_svg(folder.join("four-bar.svg"))?;
    Ok(())
}
