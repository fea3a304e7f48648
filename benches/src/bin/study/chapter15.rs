//! Chapter 15 of Flores (2015), which `study` alone reproduces.

use std::error::Error;
use std::path::PathBuf;

use clap::Args;
use holonom::Mechanism as _;
use holonom_benches::baselines;
use holonom_benches::output::{bar, show_all};
use holonom_models::RodPendulum;
use holonom_study::chapter15::run::Subject;
use holonom_study::chapter15::{self, Settings};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;

#[derive(Debug, Args)]
pub(crate) struct Chapter15 {
    /// Where the page, its pictures and chapter15.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/chapter15")]
    out: PathBuf,
    /// How many times every candidate is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

pub(crate) fn study(arguments: &Chapter15) -> Result<(), Box<dyn Error>> {
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
    let rivals = baselines::rivals(&settings);
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
