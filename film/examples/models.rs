//! Films of models of the catalogue, into a folder:
//!
//! ```text
//! cargo run --release -p holonom-film --example models -- target/films
//! ```

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use holonom::Runs;
use holonom::mechanism::Absolute;
use holonom::prelude::*;
use holonom_film::Film;
use holonom_models::{
    CartPole, Door, FlyballGovernor, FourBar, HeavyTop, RodPendulum, SliderCrank,
    SqueezingMechanism, Ur5,
};

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
    )
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
    println!("{}: {} frames", path.display(), film.frames());
    Ok(())
}
