//! The studies of the workspace: `cargo run --release --bin study` reproduces chapter 15 of Flores (2015), `study compare` shows what an evaluation costs.

#![forbid(unsafe_code)]

use std::error::Error;
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use holonom::Mechanism;
use holonom_benches::compare::{self, compile};
use holonom_benches::{opponents, terminal};
use holonom_models::RodPendulum;
use holonom_study::StudyError;
use holonom_study::chapter15::run::Subject;
use holonom_study::chapter15::{self, Settings};
use holonom_study::compare::report::{self, Beside};
use holonom_study::document::Document;
use holonom_study::target::Target;
use holonom_study::timing::Schedule;
use indicatif::{ProgressBar, ProgressStyle};

/// One pendulum, four formulations: chapter 15 of Flores, Concepts and Formulations for Spatial Multibody Dynamics
/// (2015), with what it cost and how right it is.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    study: Option<Study>,
    #[command(flatten)]
    chapter15: Chapter15,
}

#[derive(Debug, Args)]
struct Chapter15 {
    /// Where the page, its pictures and chapter15.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/chapter15")]
    out: PathBuf,
    /// How many times every contestant is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

#[derive(Debug, Subcommand)]
enum Study {
    /// What an evaluation costs: every mechanism in both descriptions, all formulations and both number types, beside a
    /// pendulum written by hand and the run-time assembler.
    Compare(Compare),
}

#[derive(Debug, Args)]
struct Compare {
    /// Where the page, its pictures and compare.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/compare")]
    out: PathBuf,
    /// How many times everything is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
    /// Time this mechanism alone; may be given more than once.
    #[arg(long, value_name = "SCENE")]
    only: Vec<String>,
    /// Write plain.json, which the page of a later run shows beside its own numbers, instead of compare.json: for a build without
    /// `-C target-cpu=native`.
    #[arg(long)]
    plain: bool,
    /// Build small crates, too, in the folder `compile` beside the page, and time that.
    #[arg(long)]
    compile: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.study {
        None => chapter_15(&arguments.chapter15),
        Some(Study::Compare(arguments)) => comparison(arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("study: {error}");
            ExitCode::FAILURE
        }
    }
}

fn chapter_15(arguments: &Chapter15) -> Result<(), Box<dyn Error>> {
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

    let bar = bar(1000, "chapter 15")?;
    let rivals = opponents::rivals(&settings);
    let outcomes = chapter15::run::compare(&subject, &settings, rivals, schedule, |done| {
        bar.set_position((1000.0 * done) as u64);
    });
    bar.finish_and_clear();
    let outcomes = outcomes?;

    let document = chapter15::report::document(&outcomes, &settings, &Target::CURRENT);
    show_all(&document, || {
        chapter15::report::write(&document, &outcomes, &arguments.out)
    })
}

fn comparison(arguments: &Compare) -> Result<(), Box<dyn Error>> {
    let names = compare::names();
    for name in &arguments.only {
        if !names.contains(&name.as_str()) {
            let names = names.join(", ");
            return Err(format!("there is no scene `{name}` here; there are {names}").into());
        }
    }
    let mut entries = compare::entries();
    if !arguments.only.is_empty() {
        entries.retain(|entry| arguments.only.iter().any(|name| name == entry.scene));
    }
    let schedule = Schedule {
        rounds: arguments.rounds.into(),
        turn: Duration::from_millis(1),
    };

    let rounds = u64::from(arguments.rounds);
    let scenes = entries.len() as u64;
    let bar = bar(scenes + rounds, "mechanisms")?;
    let measured = compare::measure(
        &entries,
        schedule,
        |prepared| bar.set_position(prepared as u64),
        |done| {
            bar.set_message("rounds");
            bar.set_position(scenes + done as u64);
        },
    );
    bar.finish_and_clear();
    let (rows, refused) = measured?;
    if arguments.plain {
        let path = report::write_plain(&rows, &arguments.out)?;
        let document = report::document(&rows, &refused, &Beside::default(), &Target::CURRENT);
        return show_all(&document, || Ok::<_, StudyError>(vec![path]));
    }
    if arguments.compile {
        let bar = self::bar(compile::BUILDS as u64, "builds")?;
        let compiled = compile::compile(&arguments.out.join("compile"), |done| {
            bar.set_position(done as u64);
        });
        bar.finish_and_clear();
        report::write_compiled(&compiled?, &arguments.out)?;
    }
    let beside = Beside::of(&arguments.out)?;
    let document = report::document(&rows, &refused, &beside, &Target::CURRENT);
    show_all(&document, || {
        report::write(&document, &rows, &arguments.out)
    })
}

/// Prints a document, writes its files and prints their names.
fn show_all<E: Error + 'static>(
    document: &Document,
    write: impl FnOnce() -> Result<Vec<PathBuf>, E>,
) -> Result<(), Box<dyn Error>> {
    show(&terminal::text(document, terminal::width())?)?;
    for path in write()? {
        show(&format!("\n{}", path.display()))?;
    }
    show("\n")?;
    Ok(())
}

fn bar(length: u64, message: &'static str) -> Result<ProgressBar, Box<dyn Error>> {
    let bar = ProgressBar::new(length);
    bar.set_style(ProgressStyle::with_template(
        "{msg} {wide_bar} {percent} %",
    )?);
    bar.set_message(message);
    Ok(bar)
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
