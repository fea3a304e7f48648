//! A minute of Andronov's clock: dry friction, a beat every period, a wheel that a dog holds.
//!
//! ```text
//! cargo run -p holonom-film --example clock
//! ```

use holonom::prelude::*;
use holonom_film::Film;
use holonom_models::Clock;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (clock, h) = (Clock::default(), Clock::HANDLES);
    let mut film = Film::new().titled("Andronov's clock");
    let report = clock
        .simulation(
            StandardLagrange,
            DormandPrince::new(Tolerance::of(&clock, 1e-8)?),
        )
        .interactions(Clock::interactions())
        .on(
            "beat",
            Crossing::Rising,
            |sample| sample.angle(h.pivot),
            Clock::beat,
        )
        .on(
            "tooth",
            Crossing::Either,
            |s| Clock::tooth(s.angle(h.arbor)),
            Clock::lock,
        )
        .run(0.0..=60.0, every(1.0 / 60.0), |sample| {
            film.record(sample);
            film.reading("pendulum", "rad", sample.angle(h.pivot));
            film.reading("kinetic energy", "J", sample.kinetic_energy());
        })?;
    film.warnings(&report.warnings());
    let page = std::env::temp_dir().join("clock.html");
    film.save(&page)?;
    println!("{}", page.display());
    Ok(())
}
