//! A digger whose bodies are described by shapes: a page, a moving picture, a glTF file and a
//! sketch, in a folder:
//!
//! ```text
//! cargo run --release -p holonom-film --example digger -- target/films
//! ```

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use holonom::joints::{AngleDriver, Revolute, Spherical};
use holonom::prelude::*;
use holonom_film::{Film, Sketch};

/// All shapes that there are.
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
    let digger = Digger::default();
    let integrator = DormandPrince::new(Tolerance::of(&digger, 1e-8)?);
    let mut film = Film::new().with_reactions();
    film.trace(Digger::HANDLES.weight);
    let report = digger
        .simulation(StandardLagrange, integrator)
        .projection(Projection::default())
        .run(0.0..=6.0, every(1.0 / 60.0), |sample| {
            film.record(sample);
            film.reading("kinetic energy", "J", sample.kinetic_energy());
            film.reading("potential energy", "J", sample.potential_energy());
        })?;
    film.warnings(&report.warnings());
    let path = folder.join("digger.html");
    film.save(&path)?;
    film.save_svg(path.with_extension("svg"))?;
    film.save_gltf(path.with_extension("gltf"))?;
    fs::write(path.with_extension("sketch.svg"), digger.sketch()?)?;
    println!("{}: {} frames", path.display(), film.frames());
    Ok(())
}
