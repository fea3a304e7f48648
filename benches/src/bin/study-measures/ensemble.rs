//! `study ensemble`.

use std::error::Error;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use holonom_benches::ensemble::{self, Model};
use holonom_benches::output;
use holonom_study::ensemble::{Rows as Chosen, Shard, merge};

#[derive(Debug, Args)]
pub(crate) struct Rows {
    /// What is drawn and moved.
    #[arg(long, value_enum, default_value_t = Name::Pendulum)]
    model: Name,
    /// How many rows there are in all parts.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    rows: u64,
    /// The part that is computed: the second of eight is `2/8`.
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// What determines all draws.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Joins the files of all parts, and computes nothing.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["model", "rows", "shard", "seed"])]
    merge: Vec<PathBuf>,
    /// Where the rows go.
    #[arg(long, value_name = "FILE", default_value = "target/study/ensemble.csv")]
    out: PathBuf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Name {
    /// Rods with damping in the hinge, for 10 s.
    Pendulum,
    /// Crank-rockers with drawn masses and torques, for 10 s.
    FourBar,
}

pub(crate) fn study(arguments: &Rows) -> Result<(), Box<dyn Error>> {
    let table = if arguments.merge.is_empty() {
        let rows = Chosen {
            all: arguments.rows,
            shard: arguments.shard,
            seed: arguments.seed,
        };
        let model = match arguments.model {
            Name::Pendulum => Model::Pendulum,
            Name::FourBar => Model::FourBar,
        };
        let own = rows.shard.rows(rows.all);
        let bar = output::bar(own.end - own.start, "rows")?;
        // An interrupted study goes on where it was.
        let mut journal = arguments.out.clone().into_os_string();
        journal.push(".journal");
        let journal = PathBuf::from(journal);
        let table = ensemble::table(model, &rows, &journal, |further| bar.inc(further))?;
        bar.finish_and_clear();
        table.write(&arguments.out)?;
        std::fs::remove_file(&journal)?;
        table
    } else {
        let table = merge(&arguments.merge)?;
        table.write(&arguments.out)?;
        table
    };
    output::show(&format!(
        "{} rows\n{}\n",
        table.len(),
        arguments.out.display()
    ))?;
    Ok(())
}
