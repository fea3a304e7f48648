//! The studies of the workspace: `cargo run --release --bin study` reproduces chapter 15 of Flores (2015), `study compare` shows what an evaluation costs,
//! `study trade` what accuracy costs, `study recommend` which setting does, and `study extremes` where the numerics stop to hold.

#![forbid(unsafe_code)]

mod chapter15;
mod comparison;
mod extremes;
mod output;
mod trade;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// One pendulum, four formulations: chapter 15 of Flores, Concepts and Formulations for Spatial Multibody Dynamics
/// (2015), with what it cost and how right it is.
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
    /// What an evaluation costs: every mechanism in both descriptions, all formulations and both number types, beside a
    /// pendulum written by hand and the run-time assembler.
    Compare(comparison::Compare),
    /// What accuracy costs: one problem with every description, formulation, treatment after steps, integrator, step or tolerance, and number type. An
    /// interrupted study goes on with the same command.
    Trade(trade::Trade),
    /// The cheapest setting for an error, or the most exact one for a time, that does so from ten starts nearby as well, and the lines of Rust that run it.
    Recommend(trade::Recommend),
    /// Where the numerics stop to hold: motions with closed forms, swept to where they break. An interrupted map goes on with the same command.
    Extremes(extremes::Extremes),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.study {
        None => chapter15::study(&arguments.chapter15),
        Some(Study::Compare(arguments)) => comparison::study(arguments),
        Some(Study::Trade(arguments)) => trade::study(arguments),
        Some(Study::Recommend(arguments)) => trade::recommend(arguments),
        Some(Study::Extremes(arguments)) => extremes::study(arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("study: {error}");
            ExitCode::FAILURE
        }
    }
}
