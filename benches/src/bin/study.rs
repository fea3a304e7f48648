//! The studies of the workspace: `cargo run --release --bin study` reproduces chapter 15 of Flores (2015).

#![forbid(unsafe_code)]

use std::error::Error;
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use holonom::Mechanism;
use holonom_benches::{opponents, terminal};
use holonom_models::RodPendulum;
use holonom_study::chapter15::run::{Subject, compare};
use holonom_study::chapter15::{Settings, report};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;
use indicatif::{ProgressBar, ProgressStyle};

/// One pendulum, four formulations: chapter 15 of Flores, Concepts and Formulations for Spatial Multibody Dynamics
/// (2015), with what it cost and how right it is.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// Where the page, its pictures and chapter15.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/chapter15")]
    out: PathBuf,
    /// How many times every contestant is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

fn main() -> ExitCode {
    match study(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("study: {error}");
            ExitCode::FAILURE
        }
    }
}

fn study(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let settings = Settings::TABLE_15_2;
    let schedule = Schedule {
        rounds: arguments.rounds.into(),
        ..Schedule::default()
    };
    let pendulum = RodPendulum::default();
    let handles = RodPendulum::HANDLES;
    let subject = Subject {
        mechanism: &pendulum,
        rod: handles.rod,
        pivot: handles.pivot,
    };

    let bar = ProgressBar::new(1000);
    bar.set_style(ProgressStyle::with_template(
        "{msg} {wide_bar} {percent} %",
    )?);
    bar.set_message("chapter 15");
    let rivals = opponents::rivals(&settings);
    let outcomes = compare(&subject, &settings, rivals, schedule, |done| {
        bar.set_position((1000.0 * done) as u64);
    });
    bar.finish_and_clear();
    let outcomes = outcomes?;

    let document = report::document(&outcomes, &settings, &Target::CURRENT);
    show(&terminal::text(&document, terminal::width())?)?;
    for path in report::write(&document, &outcomes, &arguments.out)? {
        show(&format!("\n{}", path.display()))?;
    }
    show("\n")?;
    Ok(())
}

/// Writes to the terminal. A reader that has seen enough, such as `head`, is no fault.
fn show(text: &str) -> io::Result<()> {
    let mut terminal = io::stdout().lock();
    match terminal
        .write_all(text.as_bytes())
        .and_then(|()| terminal.flush())
    {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}
