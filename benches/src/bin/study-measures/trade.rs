//! `study trade` and `study recommend`.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use holonom_benches::reference_kernel::candidate;
use holonom_benches::trade::{names, problem};
use holonom_study::StudyError;
use holonom_study::chapter15::Method;
use holonom_study::compare::{Coordinates, Precision};
use holonom_study::page::write_page;
use holonom_study::timing::{Candidate, Schedule};
use holonom_study::trade::{
    self, Choice, Family, Formulated, Grid, PostStabilisation, Processor, Subject, Timing, Wish,
    measure, report,
};

use holonom_benches::output::{announce, bar, show, show_all};

/// Which part of the grid.
#[derive(Debug, Args)]
pub(crate) struct Part {
    /// This description alone; may be given more than once, as all that follow.
    #[arg(long, value_parser = keys([Coordinates::Bodies, Coordinates::Joints], Coordinates::key))]
    coordinates: Vec<Coordinates>,
    /// This formulation alone.
    #[arg(long, value_parser = keys(Method::ALL, Method::key))]
    formulation: Vec<Method>,
    /// This stabilisation of states after steps alone.
    #[arg(long, value_parser = keys(PostStabilisation::ALL, PostStabilisation::key))]
    stabilisation: Vec<PostStabilisation>,
    /// This integrator alone.
    #[arg(long, value_parser = keys(Family::ALL, Family::key))]
    integrator: Vec<Family>,
    /// This number type alone.
    #[arg(long, value_parser = keys([Precision::Double, Precision::Single], Precision::key))]
    scalar: Vec<Precision>,
    /// With the coefficients of chapter 15, in the place of those that follow from the mechanism.
    #[arg(long)]
    book: bool,
    /// How many times every run is timed.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

/// Names of values on the command line.
fn keys<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    key: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(key)).try_map(move |name| {
        let found = all.into_iter().find(|&value| key(value) == name);
        found.ok_or("no such name")
    })
}

impl Part {
    fn grid(&self) -> Grid {
        fn chosen<T: Clone>(part: &[T], all: Vec<T>) -> Vec<T> {
            if part.is_empty() { all } else { part.to_vec() }
        }
        let all = Grid::default();
        let choice = |method| {
            if self.book {
                Choice::Given(Formulated::default_of(method))
            } else {
                Choice::Derived(method)
            }
        };
        let methods = chosen(&self.formulation, Method::ALL.into());
        let formulations = methods.into_iter().map(choice).collect();
        Grid {
            coordinates: chosen(&self.coordinates, all.coordinates),
            formulations,
            stabilisations: chosen(&self.stabilisation, all.stabilisations),
            families: chosen(&self.integrator, all.families),
            scalars: chosen(&self.scalar, all.scalars),
            ..all
        }
    }

    /// Measures what is not in the journal.
    fn measured(
        &self,
        subject: &dyn Subject,
        journal: &Path,
    ) -> Result<trade::Trade, Box<dyn Error>> {
        let beside = beside()?;
        let (grid, timing) = (self.grid(), self.timing(&beside));
        let planned = grid.settings(subject);
        let runs = planned.iter().filter(|planned| planned.refused.is_none());
        let runs = u32::try_from(runs.count()).unwrap_or(u32::MAX);
        // A run and the reference kernel take turns; the first round is not counted.
        let turns = 2 * (u32::from(self.rounds) + 1) * runs;
        let name = subject.facts().name;
        announce(
            &format!("{runs} runs of {name} where none is known, by the count of turns at least"),
            timing.schedule.turn * turns,
        );
        let bar = bar(0, "reference")?;
        let trade = measure(subject, &grid, timing, journal, |done, all| {
            bar.set_message("runs");
            bar.set_length(all as u64);
            bar.set_position(done as u64);
        });
        bar.finish_and_clear();
        Ok(trade?)
    }

    fn timing<'a>(&self, beside: &'a dyn Fn() -> Candidate<'static>) -> Timing<'a> {
        Timing {
            schedule: Schedule {
                rounds: self.rounds.into(),
                turn: Duration::from_millis(2),
            },
            reference_kernel: Some(beside),
        }
    }
}

/// The reference kernel, as often as it is needed.
fn beside() -> Result<impl Fn() -> Candidate<'static>, StudyError> {
    candidate()?;
    Ok(|| candidate().expect("it was made before"))
}

#[derive(Debug, Args)]
pub(crate) struct Trade {
    /// The motion; may be given more than once, and `all` are all of them.
    #[arg(long, value_name = "NAME", required = true)]
    problem: Vec<String>,
    #[command(flatten)]
    part: Part,
    /// Where the numbers and the page go.
    #[arg(long, value_name = "DIR", default_value = "target/study/trade")]
    out: PathBuf,
}

pub(crate) fn study(arguments: &Trade) -> Result<(), Box<dyn Error>> {
    let problems = match &arguments.problem[..] {
        [all] if all == "all" => names(),
        some => some.to_vec(),
    };
    let mut trades = Vec::new();
    for name in &problems {
        let subject = problem(name)?;
        let journal = arguments.out.join(format!("{name}.journal"));
        let trade = arguments.part.measured(&*subject, &journal)?;
        let histories = report::histories(&*subject)?;
        let document = report::document(&trade, &histories, &command(name));
        let write = || {
            let written = report::write(&trade, &document, &arguments.out)?;
            // The next study measures anew; a recommendation takes what was measured.
            rename(&journal, &measured(&arguments.out, name))?;
            Ok::<_, StudyError>(written)
        };
        if problems.len() == 1 {
            return show_all(&document, write);
        }
        write()?;
        trades.push(trade);
    }
    let document = report::summary(&trades, &command("all"));
    show_all(&document, || write_page(&document, &arguments.out))
}

/// What a trade has measured, for recommendations.
fn measured(out: &Path, problem: &str) -> PathBuf {
    out.join(format!("{problem}.measured"))
}

/// What the numbers are made with.
fn command(problem: &str) -> String {
    let large = if cfg!(feature = "large") {
        " --large"
    } else {
        ""
    };
    format!(
        "RUSTFLAGS=\"-C target-cpu=native\" cargo run --release --target-dir target/native --bin study -- trade{large} --problem {problem}"
    )
}

fn rename(from: &Path, to: &Path) -> Result<(), StudyError> {
    std::fs::rename(from, to).map_err(|source| StudyError::Write {
        path: to.into(),
        source,
    })
}

#[derive(Debug, Args)]
pub(crate) struct Recommend {
    /// The motion.
    #[arg(long, value_name = "NAME")]
    problem: String,
    #[command(flatten)]
    part: Part,
    /// The error that no run may exceed, in the unit of the problem (rad for angles, m for places).
    #[arg(long, value_name = "E", required_unless_present = "budget", conflicts_with = "budget", allow_hyphen_values = true, value_parser = positive)]
    error: Option<f64>,
    /// What the whole run may take, such as 10us or 2ms: the most exact setting within it.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    budget: Option<f64>,
    /// The processor: this one, or an estimate by counts of operations.
    #[arg(long, default_value = Processor::Here.key(), value_parser = keys(Processor::ALL, Processor::key))]
    target: Processor,
    /// Where `study trade` wrote what it measured, and where goes what is not there yet.
    #[arg(long, value_name = "DIR", default_value = "target/study/trade")]
    out: PathBuf,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && f64::is_finite(value) => Ok(value),
        _ => Err("not a positive number, such as 1e-4".into()),
    }
}

/// Seconds of a time with its unit.
fn duration(text: &str) -> Result<f64, String> {
    let units = [
        ("ns", 1e-9),
        ("us", 1e-6),
        ("µs", 1e-6),
        ("ms", 1e-3),
        ("s", 1.0),
    ];
    let found = units
        .into_iter()
        .find_map(|(unit, seconds)| Some((text.strip_suffix(unit)?, seconds)));
    let (number, seconds) = found.ok_or("not a time with its unit, such as 10us, 2ms or 0.5s")?;
    Ok(seconds * positive(number.trim())?)
}

pub(crate) fn recommend(arguments: &Recommend) -> Result<(), Box<dyn Error>> {
    let subject = problem(&arguments.problem)?;
    let wish = match (arguments.error, arguments.budget) {
        (Some(error), _) => Wish::Error(error),
        (None, Some(seconds)) => Wish::Budget(seconds),
        (None, None) => return Err("neither --error nor --budget is given".into()),
    };
    let journal = measured(&arguments.out, &arguments.problem);
    let trade = arguments.part.measured(&*subject, &journal)?;
    let bar = bar(0, "starts nearby")?;
    let beside = beside()?;
    let on = (arguments.target, arguments.part.timing(&beside));
    let found = trade::recommend(&*subject, &trade, wish, on, || bar.inc(1));
    bar.finish_and_clear();
    let text = report::recommendation(&trade, wish, arguments.target, found?.as_ref());
    show(&text)?;
    Ok(())
}
