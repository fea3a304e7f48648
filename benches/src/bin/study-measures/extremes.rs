//! `study extremes`.

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use holonom_benches::extremes::{self, Coefficients};
use holonom_study::StudyError;
use holonom_study::extremes::{report, run};

use holonom_benches::output::{announce, bar, show_all};

/// The time of a run on one processor: 5374 of them took two 53 s.
const A_RUN: Duration = Duration::from_millis(20);

#[derive(Debug, Args)]
pub(crate) struct Extremes {
    /// Where the page and extremes.json go.
    #[arg(long, value_name = "DIR", default_value = "target/study/extremes")]
    out: PathBuf,
    /// Sweep this axis alone; may be given more than once.
    #[arg(long, value_name = "AXIS")]
    axis: Vec<String>,
    /// With the coefficients of chapter 15 for all mechanisms, in the place of those that follow
    /// from each.
    #[arg(long)]
    book: bool,
}

pub(crate) fn study(arguments: &Extremes) -> Result<(), Box<dyn Error>> {
    let coefficients = if arguments.book {
        Coefficients::OfTheBook
    } else {
        Coefficients::Derived
    };
    let (axes, mut cells) = extremes::map(coefficients);
    for name in &arguments.axis {
        if !axes.iter().any(|axis| axis.name == name) {
            let names: Vec<_> = axes.iter().map(|axis| axis.name).collect();
            return Err(format!(
                "there is no axis `{name}` here; there are {}",
                names.join(", ")
            )
            .into());
        }
    }
    if !arguments.axis.is_empty() {
        cells.retain(|cell| {
            arguments
                .axis
                .iter()
                .any(|name| name == axes[cell.axis].name)
        });
    }
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    announce(
        &format!(
            "{} runs on {processors} processors, as an AMD EPYC (Zen 5) takes for them",
            cells.len()
        ),
        A_RUN.mul_f64(cells.len() as f64 / processors as f64),
    );
    let journal = arguments.out.join("extremes.journal");
    let bar = bar(cells.len() as u64, "runs")?;
    let rows = run::run(&axes, &cells, &journal, |done| {
        bar.set_position(done as u64)
    });
    bar.finish_and_clear();
    let rows = rows?;
    let document = report::document(&axes, &rows);
    show_all(&document, || {
        let written = report::write(&document, &rows, &arguments.out)?;
        std::fs::remove_file(&journal).map_err(|source| StudyError::Write {
            path: journal.clone(),
            source,
        })?;
        Ok::<_, StudyError>(written)
    })
}
