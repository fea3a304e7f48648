//! Rows that are kept as they are done.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use csv::StringRecord;
use holonom::dynamics::Dynamics;
use holonom::integrate::OneStep;
use holonom::lanes::{LaneEquations, Lanes};
use holonom::prelude::*;
use rand_chacha::ChaCha8Rng;

use super::rows::line;
use super::{Draw, LANES, Row, Rows, Steps, Table, compute_these};
use crate::error::StudyError;
use crate::journal::Journal;

/// The names of what is drawn and of what is read.
pub type Names<'n, const P: usize, const R: usize> = ([&'n str; P], [&'n str; R]);

/// As [`compute`](super::compute), with every row in a journal as soon as it is done: after an
/// interruption, by whatever signal, the same call computes what is missing. Rows do not depend on
/// that. `done` is told of the rows that were there first.
///
/// A journal of other rows, steps, methods or names, or of another version of this crate, is begun
/// anew. It does not know what `draw` and `read` do: remove it when you change them, and when the
/// table is written.
///
/// # Errors
/// Those of [`compute`](super::compute), and [`StudyError::Write`] of the journal.
pub fn resume<M, F, K, const P: usize, const R: usize>(
    rows: &Rows,
    journal: &Path,
    names: Names<'_, P, R>,
    (formulation, scheme, steps): (F, K, Steps),
    draw: impl Fn(&mut ChaCha8Rng) -> Result<Draw<M, P>, ParameterError> + Sync,
    read: impl Fn(&mut [f64; R], &View<'_, f64, M>) + Sync,
    done: impl Fn(u64) + Sync,
) -> Result<Table, StudyError>
where
    M: Mechanism,
    F: Formulation<f64> + Sync,
    K: OneStep<f64, Dynamics<Problem<M, F>>>
        + OneStep<Lanes<f64, LANES>, LaneEquations<Problem<M, F>, LANES>>
        + Sync,
{
    let conditions = format!(
        "{} {} {rows:?} {formulation:?} {scheme:?} {steps:?} {names:?}",
        env!("CARGO_PKG_VERSION"),
        M::REPORT.name
    );
    let journal = Journal::<(u64, Vec<String>)>::open(journal, &conditions)?;
    let fields = 5 + P + R;
    let known = journal.entries().iter();
    let known = known.filter(|(_, line)| line.len() == fields);
    let mut lines: BTreeMap<u64, StringRecord> = known
        .map(|(number, line)| (*number, line.iter().collect()))
        .collect();
    let missing = rows.shard.rows(rows.all);
    let missing: Vec<u64> = missing.filter(|row| !lines.contains_key(row)).collect();
    done(lines.len() as u64);
    let journal = Mutex::new(journal);
    let keep = |batch: &[Row<P, R>]| {
        let mut journal = journal.lock().unwrap_or_else(PoisonError::into_inner);
        for row in batch {
            let line = line(rows, row);
            let fields = line.iter().map(String::from).collect();
            journal.add((row.number, fields))?;
        }
        done(batch.len() as u64);
        Ok(())
    };
    let method = (formulation, scheme, steps);
    let computed = compute_these(rows, &missing, method, draw, read, keep)?;
    lines.extend(computed.iter().map(|row| (row.number, line(rows, row))));
    Ok(Table::of_lines(rows, names, lines.into_values()))
}
