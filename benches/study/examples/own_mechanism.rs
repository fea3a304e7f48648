//! What accuracy costs for a mechanism of one's own:
//! `cargo run --release -p holonom-study --example own_mechanism`.
//!
//! An arm of two links falls for a second. Nothing is known of its motion: the study integrates it
//! twice with tight tolerances, by means that differ, and says by how much these differ. Then it
//! runs a grid of settings, writes rows and a page, and names the cheapest setting for an error of
//! a millionth.

use std::error::Error;
use std::path::Path;

use holonom::prelude::*;
use holonom::{Real, integrate::TimeSpan};
use holonom_study::trade::{
    Grid, Posed, Problem, Processor, Quantity, Timing, Wish, measure, recommend, report,
};

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Arm {
    #[body(mass = 2.0, inertia = [0.07, 0.01, 0.07], position = [0.0, 0.3, 0.0])]
    upper: Body,
    #[body(mass = 1.0, inertia = [0.03, 0.03, 0.005], position = [0.0, 0.6, -0.2])]
    fore: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, fore], point = [0.0, 0.6, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// The motion that is studied.
struct Falling(Arm);

impl Problem for Falling {
    type Mechanism = Arm;

    fn name(&self) -> &str {
        "arm"
    }

    fn title(&self) -> String {
        "An arm of two links that falls for a second".into()
    }

    fn mechanism(&self) -> &Arm {
        &self.0
    }

    fn span(&self) -> TimeSpan<f64> {
        TimeSpan {
            start: 0.0,
            end: 1.0,
            first_output: 0.05,
        }
    }

    // About the period of the fastest motion (s).
    fn time_scale(&self) -> f64 {
        0.7
    }

    fn quantity(&self) -> Quantity {
        Quantity {
            name: "angles",
            unit: "rad",
        }
    }

    fn read<S: Real>(&self, view: &View<'_, S, Arm>) -> Vec<f64> {
        let handles = Arm::HANDLES;
        [view.angle(handles.shoulder), view.angle(handles.elbow)]
            .map(Real::to_f64)
            .into()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let subject = Posed::in_both(Falling(Arm::default()));
    let directory = Path::new("target/study/trade");
    let journal = directory.join("arm.journal");
    let grid = Grid {
        most_steps: 2000.0,
        least_tolerance: 1e-11,
        ..Grid::default()
    };
    let trade = measure(&subject, &grid, Timing::default(), &journal, |done, all| {
        if done % 100 == 0 {
            eprintln!("{done} of {all} runs");
        }
    })?;
    let document = report::document(
        &trade,
        &report::histories(&subject)?,
        "cargo run --release -p holonom-study --example own_mechanism",
    );
    for path in report::write(&trade, &document, directory)? {
        println!("{}", path.display());
    }

    let wish = Wish::Error(1e-6);
    let on = (Processor::Here, Timing::default());
    let found = recommend(&subject, &trade, wish, on, || ())?;
    println!(
        "{}",
        report::recommendation(&trade, wish, Processor::Here, found.as_ref())
    );
    // Not to be taken up again: the next study measures anew.
    std::fs::remove_file(journal)?;
    Ok(())
}
