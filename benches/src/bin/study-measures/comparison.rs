//! `study compare`.

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use holonom_benches::compare::{self, compile};
use holonom_study::StudyError;
use holonom_study::compare::report::{self, Beside};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;

use holonom_benches::output::{announce, bar, show_all};

#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// Where the page, its pictures and compare.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/compare")]
    out: PathBuf,
    /// How many times everything is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
    /// Time this mechanism alone; may be given more than once.
    #[arg(long, value_name = "SCENE")]
    only: Vec<String>,
    /// Write plain.json, which the page of a later run shows beside its own numbers, instead of
    /// compare.json: for a build without `-C target-cpu=native`.
    #[arg(long)]
    plain: bool,
    /// Build small crates, too, in the folder `compile` beside the page, and time that.
    #[arg(long)]
    compile: bool,
}

pub(crate) fn study(arguments: &Compare) -> Result<(), Box<dyn Error>> {
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
    // Sixteen kinds of a mechanism, each timed in four ways, and at most six forms of its
    // assembler; the first round is not counted.
    let turns = (16 * 4 + 6) * scenes * (rounds + 1);
    announce(
        &format!("{scenes} mechanisms in {rounds} rounds, by the count of turns"),
        schedule.turn * u32::try_from(turns).unwrap_or(u32::MAX),
    );
    if arguments.compile {
        let builds = compile::BUILDS;
        eprintln!(
            "study: then {builds} small crates are built: the release builds took an AMD EPYC (Zen 5) 131 s"
        );
    }
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
