//! Films of models of the catalogue, into a folder:
//!
//! ```text
//! cargo run --release -p holonom-film --example models -- target/films
//! ```

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use holonom::Runs;
use holonom::joints::{AngleDriver, Revolute, Spherical};
use holonom::mechanism::Absolute;
use holonom::prelude::*;
use holonom_film::{Film, Sketch};
use holonom_models::{
    CartPole, Door, FlyballGovernor, FourBar, HeavyTop, RodPendulum, SliderCrank,
    SqueezingMechanism, Ur5,
};

/// A digger whose bodies are described by shapes: all that there are.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Digger {
    #[param(like = 1.4)]
    reach: f64,
    #[body(shapes = [
        cylinder(radius = 0.25, from = [0.0, 0.0, 0.0], to = [0.0, 0.0, 0.5]),
        block(size = [0.7, 0.5, 0.35], at = [-0.15, 0.0, 0.65]),
        ball(radius = 0.14, at = [-0.6, 0.0, 0.65]),
    ], density = 900.0)]
    tower: Body,
    #[body(shape = bar(width = 0.12, height = 0.2, from = [0.2, 0.0, 0.7], to = [1.4, 0.0, 1.6], up = [0.0, 0.0, 1.0]), density = 700.0)]
    boom: Body,
    #[body(shape = tube(outer = 0.07, inner = 0.05, from = [1.4, 0.0, 1.6], to = [1.4 + reach, 0.0, 1.6]), density = 2700.0)]
    stick: Body,
    #[body(shapes = [
        cone(radius = 0.2, from = [1.4 + 1.4, 0.0, 1.45], to = [1.4 + 1.4, 0.0, 0.95]),
        disc(radius = 0.22, thickness = 0.05, at = [1.4 + 1.4, 0.0, 1.475], axis = [0.0, 0.0, 1.0]),
        rod(radius = 0.02, from = [1.4 + 1.4, 0.0, 1.6], to = [1.4 + 1.4, 0.0, 1.475]),
    ], density = 1500.0)]
    weight: Body,
    #[joint(between = [ground, tower], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    turntable: Revolute,
    #[joint(between = [tower, boom], point = [0.2, 0.0, 0.7], axis = [0.0, 1.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [boom, stick], point = [1.4, 0.0, 1.6], axis = [0.0, 1.0, 0.0])]
    elbow: Revolute,
    #[joint(between = [stick, weight], point = [1.4 + reach, 0.0, 1.6])]
    hook: Spherical,
    #[joint(between = [ground, tower], axis = [0.0, 0.0, 1.0], motion = 1.2 * smooth_step(time / 4.0))]
    swing: AngleDriver,
    #[joint(between = [tower, boom], axis = [0.0, 1.0, 0.0], motion = 0.5 * smooth_step(time / 3.0))]
    lower: AngleDriver,
    #[joint(between = [boom, stick], axis = [0.0, 1.0, 0.0], motion = 0.4 * smooth_step(time / 3.0))]
    reach_down: AngleDriver,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).unwrap_or("target/films".into()));
    fs::create_dir_all(&folder)?;

    let handles = FourBar::HANDLES;
    film(
        &folder,
        "four-bar",
        "Four-bar",
        &FourBar::default(),
        6.0,
        |film| {
            film.trace(handles.coupler, "middle of the coupler", [0.0; 3]);
        },
    )?;
    let handles = RodPendulum::HANDLES;
    film(
        &folder,
        "pendulum",
        "Pendulum",
        &RodPendulum::default(),
        5.0,
        |film| {
            film.trace(handles.rod, "centre of mass", [0.0; 3]);
        },
    )?;
    film(
        &folder,
        "ur5",
        "UR5 that falls",
        &Ur5::default(),
        3.0,
        |_| (),
    )?;
    film(
        &folder,
        "squeezer",
        "Andrews' squeezing mechanism",
        &SqueezingMechanism::default(),
        0.03,
        |_| (),
    )?;
    film(
        &folder,
        "slider-crank",
        "Slider-crank",
        &SliderCrank::default(),
        0.2,
        |_| (),
    )?;
    film(
        &folder,
        "heavy-top",
        "Heavy top",
        &HeavyTop::default(),
        2.0,
        |_| (),
    )?;
    film(
        &folder,
        "governor",
        "Flyball governor",
        &FlyballGovernor::default(),
        10.0,
        |_| (),
    )?;
    film(&folder, "door", "Door", &Door::default(), 5.0, |_| ())?;
    film(
        &folder,
        "cart-pole",
        "Cart and pole",
        &CartPole::default(),
        5.0,
        |_| (),
    )?;
    film(&folder, "digger", "Digger", &Digger::default(), 6.0, |_| ())
}

/// A run of a model, with its energies.
fn film<M: Mechanism>(
    folder: &Path,
    file: &str,
    title: &str,
    model: &M,
    end: f64,
    prepare: impl FnOnce(&mut Film<M>),
) -> Result<(), Box<dyn Error>>
where
    DormandPrince<f64>: Runs<f64, M, AugmentedLagrangian<f64>, Absolute>,
{
    let mut film = Film::new().titled(title).with_reactions();
    prepare(&mut film);
    let simulation = Simulation::new(
        model,
        AugmentedLagrangian::default(),
        DormandPrince::default(),
    );
    let run = simulation
        .absolute_coordinates()
        .projection(Projection::default());
    let report = run.run(0.0..=end, every(end / 360.0), |sample| {
        film.record(sample);
        film.reading("kinetic energy", "J", sample.kinetic_energy());
        film.reading("potential energy", "J", sample.potential_energy());
    });
    match report {
        Ok(report) => film.warnings(&report.warnings()),
        Err(error) => eprintln!("{title}: {error}"),
    }
    let path = folder.join(file).with_extension("html");
    film.save(&path)?;
    film.save_svg(path.with_extension("svg"))?;
    film.save_gltf(path.with_extension("gltf"))?;
    fs::write(path.with_extension("sketch.svg"), model.sketch()?)?;
    println!("{}: {} frames", path.display(), film.frames());
    Ok(())
}
