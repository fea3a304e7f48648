//! `study arms`.

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use holonom_benches::arms::{self, PARTS};
use holonom_benches::output::{announce, bar, show};
use holonom_benches::terminal;
use holonom_study::document::{Block, Document, Section};
use holonom_study::target::Target;
use holonom_study::timing::Schedule;

#[derive(Debug, Args)]
pub(crate) struct Arms {
    /// How many times everything is timed.
    #[arg(long, value_name = "N", default_value_t = 42, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
    /// Run the programs that `benches/peers/build` has built in this folder among the rounds.
    #[arg(long, value_name = "DIR")]
    peers: Option<PathBuf>,
}

pub(crate) fn study(arguments: &Arms) -> Result<(), Box<dyn Error>> {
    let schedule = Schedule {
        rounds: arguments.rounds.into(),
        ..Schedule::default()
    };
    // Nine candidates of two arms.
    let turns = 18 * (u32::from(arguments.rounds) + 1);
    announce(
        "two arms, by the count of turns",
        schedule.turn * turns + Duration::from_secs(1),
    );
    let bar = bar(PARTS, "arms")?;
    let measured = arms::measure(arguments.peers.as_deref(), schedule, |done| {
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    let measured = measured?;
    let busy = measured.busy.clone().map(Block::Text);
    let table = Block::Table(arms::table(&measured));
    let document = Document {
        title: "The equations of motion of two arms".into(),
        lead: Vec::new(),
        sections: vec![Section {
            heading: "In the angles of the axes".into(),
            blocks: busy.into_iter().chain([table]).collect(),
        }],
        colophon: vec![Target::CURRENT.to_string()],
    };
    show(&terminal::text(&document, terminal::width())?)?;
    Ok(())
}
