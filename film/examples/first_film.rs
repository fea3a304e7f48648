//! A first film: a double pendulum as one HTML page, to be opened in a browser.
//!
//! ```text
//! cargo run -p holonom-film --example first_film
//! ```

use holonom::prelude::*;
use holonom_film::Film;

/// Two steel rods of 1 m, one hinged to the other.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct DoublePendulum {
    #[body(
        shape = bar(width = 0.03, height = 0.03, from = [0.0, 0.0, 0.0], to = [0.0, 1.0, 0.0]),
        density = 7800.0
    )]
    upper: Body,
    #[body(
        shape = bar(width = 0.03, height = 0.03, from = [0.0, 1.0, 0.0], to = [0.0, 2.0, 0.0]),
        density = 7800.0
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
    #[point(on = lower, at = [0.0, 2.0, 0.0])]
    tip: Point,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (pendulum, handles) = (DoublePendulum::default(), DoublePendulum::HANDLES);
    let mut film = Film::new().titled("Double pendulum").with_reactions();
    film.trace(handles.tip);
    let report = pendulum
        .simulation(StandardLagrange, DormandPrince::default())
        .run(0.0..=5.0, every(1.0 / 60.0), |sample| {
            film.record(sample);
            film.reading("elbow", "rad", sample.angle(handles.elbow));
        })?;
    film.warnings(&report.warnings());
    let page = std::env::temp_dir().join("double-pendulum.html");
    film.save(&page)?;
    println!("{}", page.display());
    Ok(())
}
