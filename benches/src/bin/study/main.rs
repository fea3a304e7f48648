//! The studies of the workspace: `cargo run --release --bin study` reproduces chapter 15 of Flores
//! (2015), `study compare` shows what an evaluation costs, `study arms` what the equations of
//! motion of robots cost beside other programs, `study estimate` how right the cycles are that
//! reports tell, and `study trade` what accuracy costs. `study recommend` says which setting does,
//! `study extremes` where the numerics stop to hold, `study ensemble` what many rows of drawn
//! parameters give, `study show` how a problem moves. All but the first are a program of their own,
//! which is built where it is asked for.

#![forbid(unsafe_code)]

mod chapter15;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use holonom_benches::measures::{self, Arguments as Handed};

/// One pendulum, four formulations: chapter 15 of Flores, Concepts and Formulations for Spatial
/// Multibody Dynamics (2015), with what it cost and how right it is.
///
/// The other studies measure many mechanisms in many kinds, which takes longer to compile: each is
/// built when it is first asked for, and says before how long that takes. With `--large` they have
/// all mechanisms, without it those that compile soon.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    study: Option<Study>,
    #[command(flatten)]
    chapter15: chapter15::Chapter15,
}

#[derive(Debug, Subcommand)]
enum Study {
    /// What an evaluation costs: mechanisms in both descriptions, all formulations and both number
    /// types.
    Compare(Handed),
    /// What the equations of motion of two arms cost, beside Pinocchio and CasADi.
    Arms(Handed),
    /// The cycles of kernels that reports tell, beside those that they take.
    Estimate(Handed),
    /// What accuracy costs: a problem with every setting.
    Trade(Handed),
    /// Which setting does for an error or a time, and the lines of Rust that run it.
    Recommend(Handed),
    /// Where the numerics stop to hold.
    Extremes(Handed),
    /// Many rows of one model with drawn parameters, in shards: a table of their readings.
    Ensemble(Handed),
    /// How a problem moves: a page that opens from disk.
    Show(Handed),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.study {
        None => chapter15::study(&arguments.chapter15).map(|()| ExitCode::SUCCESS),
        Some(Study::Compare(handed)) => measures::COMPARE.run(handed),
        Some(Study::Arms(handed)) => measures::ARMS.run(handed),
        Some(Study::Estimate(handed)) => measures::ESTIMATE.run(handed),
        Some(Study::Trade(handed)) => measures::TRADE.run(handed),
        Some(Study::Recommend(handed)) => measures::RECOMMEND.run(handed),
        Some(Study::Extremes(handed)) => measures::EXTREMES.run(handed),
        Some(Study::Ensemble(handed)) => measures::ENSEMBLE.run(handed),
        Some(Study::Show(handed)) => measures::SHOW.run(handed),
    };
    outcome.unwrap_or_else(|error| {
        eprintln!("study: {error}");
        ExitCode::FAILURE
    })
}
