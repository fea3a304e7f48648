//! The benchmark bicycle is pushed at 4.6 m/s, leans, and recovers by itself.
//!
//! ```text
//! cargo run -p holonom-film --example bicycle -- FOLDER
//! ```

use holonom::nalgebra::Vector3;
use holonom::prelude::*;
use holonom_film::Film;
use holonom_models::Bicycle;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let (bicycle, h) = (Bicycle::default(), Bicycle::HANDLES);
    let mut state: StateOf<Bicycle> = bicycle.described_state()?;
    // It rolls, and its lean grows by 0.5 rad/s.
    let (speed, lean) = (4.6, Vector3::new(0.5, 0.0, 0.0));
    for (body, radius) in [
        (h.rear_wheel, 0.3),
        (h.frame, f64::INFINITY),
        (h.fork, f64::INFINITY),
        (h.front_wheel, 0.35),
    ] {
        let place = Bicycle::pose(&state, body).position;
        let rolling = Vector3::new(0.0, -speed / radius, 0.0);
        let velocity = Vector3::new(speed, 0.0, 0.0) + lean.cross(&place);
        Bicycle::set_velocity(&mut state, body, velocity);
        Bicycle::set_angular_velocity_global(&mut state, body, lean + rolling);
    }
    let mut film = Film::new().titled("Bicycle").with_reactions();
    let report = Simulation::new(&bicycle, StandardLagrange, DormandPrince::default())
        .initial_state(state)
        .joint_coordinates()
        .run(0.0..=3.0, every(1.0 / 60.0), |sample| {
            film.record(sample);
            film.reading("steering", "rad", sample.angle(h.steering));
        })?;
    film.warnings(&report.warnings());
    let folder = std::path::Path::new(&folder);
    film.save(folder.join("bicycle.html"))?;
    film.save_svg(folder.join("bicycle.svg"))?;
    println!("{}", folder.join("bicycle.html").display());
    Ok(())
}
