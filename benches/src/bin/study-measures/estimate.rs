//! `study estimate`.

use std::error::Error;
use std::time::Duration;

use clap::Args;
use holonom_benches::estimate;
use holonom_benches::output::{announce, bar, show};
use holonom_benches::terminal;
use holonom_study::document::{Block, Document, Section};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;

#[derive(Debug, Args)]
pub(crate) struct Estimate {
    /// How many times everything is timed.
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
}

pub(crate) fn study(arguments: &Estimate) -> Result<(), Box<dyn Error>> {
    let schedule = Schedule {
        rounds: arguments.rounds.into(),
        turn: Duration::from_millis(1),
    };
    // About fifty kernels in two ways.
    let turns = 100 * (u32::from(arguments.rounds) + 1);
    announce("kernels, by the count of turns", schedule.turn * turns);
    let bar = bar(arguments.rounds.into(), "rounds")?;
    let measured = estimate::measure(schedule, |done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let measured = measured?;
    let busy = measured.busy.clone().map(Block::Text);
    let table = Block::Table(estimate::table(&measured));
    let document = Document {
        title: "Estimates of time".into(),
        lead: Vec::new(),
        sections: vec![Section {
            heading: "Kernels of mechanisms".into(),
            blocks: busy.into_iter().chain([table]).collect(),
        }],
        colophon: vec![Target::CURRENT.to_string()],
    };
    show(&terminal::text(&document, terminal::width())?)?;
    Ok(())
}
