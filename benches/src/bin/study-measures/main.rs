//! The studies beside chapter 15, those that this build has: `study compare` and so on build and
//! run it.

#![forbid(unsafe_code)]

#[cfg(feature = "arms")]
mod arms;
#[cfg(feature = "compare")]
mod comparison;
#[cfg(feature = "ensemble")]
mod ensemble;
#[cfg(feature = "estimate")]
mod estimate;
#[cfg(feature = "extremes")]
mod extremes;
#[cfg(feature = "show")]
mod show;
#[cfg(feature = "trade")]
mod trade;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// What evaluations and accuracy cost, where the numerics stop to hold, and what moves.
#[derive(Debug, Parser)]
#[command(version, bin_name = "study")]
struct Arguments {
    #[command(subcommand)]
    study: Study,
}

#[derive(Debug, Subcommand)]
enum Study {
    /// What the equations of motion of two arms cost in their angles, beside Pinocchio and CasADi.
    #[cfg(feature = "arms")]
    Arms(arms::Arms),
    /// What an evaluation costs: every mechanism in both descriptions, all formulations and both
    /// number types, beside a pendulum written by hand and the run-time assembler.
    #[cfg(feature = "compare")]
    Compare(comparison::Compare),
    /// What accuracy costs: one problem with every description, formulation, stabilisation after
    /// steps, integrator, step or tolerance, and number type. An interrupted study goes on with the
    /// same command.
    #[cfg(feature = "trade")]
    Trade(trade::Trade),
    /// The cheapest setting for an error, or the most exact one for a time, that does so from ten
    /// starts nearby as well, and the lines of Rust that run it.
    #[cfg(feature = "trade")]
    Recommend(trade::Recommend),
    /// The cycles of kernels that reports tell, beside those that they take.
    #[cfg(feature = "estimate")]
    Estimate(estimate::Estimate),
    /// Where the numerics stop to hold: motions with closed forms, swept to where they break. An
    /// interrupted map goes on with the same command.
    #[cfg(feature = "extremes")]
    Extremes(extremes::Extremes),
    /// Many rows of one model, each with parameters that are drawn for it: a CSV file with a line
    /// for each. A part of all rows is computed by itself, and the files of all parts are joined.
    #[cfg(feature = "ensemble")]
    Ensemble(ensemble::Rows),
    /// A problem that moves: its run, recorded into a page that opens from disk.
    #[cfg(feature = "show")]
    Show(show::Show),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.study {
        #[cfg(feature = "arms")]
        Study::Arms(arguments) => arms::study(arguments),
        #[cfg(feature = "compare")]
        Study::Compare(arguments) => comparison::study(arguments),
        #[cfg(feature = "trade")]
        Study::Trade(arguments) => trade::study(arguments),
        #[cfg(feature = "trade")]
        Study::Recommend(arguments) => trade::recommend(arguments),
        #[cfg(feature = "estimate")]
        Study::Estimate(arguments) => estimate::study(arguments),
        #[cfg(feature = "extremes")]
        Study::Extremes(arguments) => extremes::study(arguments),
        #[cfg(feature = "ensemble")]
        Study::Ensemble(arguments) => ensemble::study(arguments),
        #[cfg(feature = "show")]
        Study::Show(arguments) => show::study(arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("study: {error}");
            ExitCode::FAILURE
        }
    }
}
