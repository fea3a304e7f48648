//! Many rows of one model: each has parameters that are drawn for it, runs by itself and gives
//! readings.
//!
//! A row is known by its number. The seed and this number determine the generator from which its
//! parameters are drawn: a row is the same in whatever shard, lane or thread it is computed. Rows
//! run [`LANES`] at a time in an [`Ensemble`], on all cores.
//!
//! Rows can be kept as they are done ([`fn@resume`]): a computation that was interrupted goes on.
//! For a cluster, compute each [`Shard`] by a job of its own and join the files by [`merge`].

mod resume;
mod rows;

use std::ops::Range;
use std::str::FromStr;

use holonom::dynamics::Dynamics;
use holonom::integrate::OneStep;
use holonom::lanes::{Ensemble, LaneEquations, Lanes};
use holonom::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng as _;
use rayon::prelude::*;

pub use rand_chacha;
pub use resume::{Names, resume};
pub use rows::{Table, merge};

use crate::error::StudyError;

/// Rows that are computed at once by one core.
pub const LANES: usize = 8;

/// A part of all rows: the `index`th of `count` nearly equal ones, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    count: u64,
}

impl Shard {
    /// All rows.
    pub const ALL: Self = Self { index: 1, count: 1 };

    /// The numbers of its rows, of so many in all.
    #[must_use]
    pub fn rows(&self, all: u64) -> Range<u64> {
        let bound = |part: u64| {
            let bound = u128::from(all) * u128::from(part) / u128::from(self.count);
            u64::try_from(bound).unwrap_or(all)
        };
        bound(self.index - 1)..bound(self.index)
    }
}

/// From `2/8`.
impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/');
        let parts =
            parts.and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if 1 <= index && index <= count => Ok(Self { index, count }),
            _ => Err("not a part of all rows, such as 2/8, the second of eight".into()),
        }
    }
}

/// Which rows are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rows {
    /// How many there are in all shards.
    pub all: u64,
    /// Which of them.
    pub shard: Shard,
    /// What determines all draws.
    pub seed: u64,
}

impl Rows {
    /// The generator of a row.
    fn generator(&self, row: u64) -> ChaCha8Rng {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(row);
        generator
    }
}

/// What is drawn for a row.
#[derive(Clone, Debug)]
pub struct Draw<M: Mechanism, const P: usize> {
    /// The mechanism, with its parameters and inputs.
    pub mechanism: M,
    /// The state in which its bodies start; the described one if there is none.
    pub start: Option<StateOf<M>>,
    /// What is written of the draw, in the order of the columns.
    pub columns: [f64; P],
}

/// Fixed steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// The step (s).
    pub step: f64,
    /// How many there are.
    pub count: u64,
    /// Readings are taken at the start and after every so many steps.
    pub every: u64,
}

/// A row that was computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<const P: usize, const R: usize> {
    /// Its number, from 0.
    pub number: u64,
    /// What was drawn.
    pub drawn: [f64; P],
    /// Its readings; NaN where none was taken.
    pub readings: [f64; R],
    /// When it stopped before the end (s), and why.
    pub stopped: Option<(f64, String)>,
}

/// Computes the rows of a shard on all cores.
///
/// `draw` makes a mechanism of random numbers. `read` is called with the readings of a row, NaN at
/// first, and a view, at the start and as often as the steps say: it may take the last value, or a
/// greatest one (`f64::max` passes over NaN). `done` is told how many further rows are done.
///
/// # Errors
/// A draw that the mechanism or the formulation refuses, [`StudyError::Run`]: the number of the row
/// is its name. A row whose start or step is refused is no error: it says so itself.
pub fn compute<M, F, K, const P: usize, const R: usize>(
    rows: &Rows,
    (formulation, scheme, steps): (F, K, Steps),
    draw: impl Fn(&mut ChaCha8Rng) -> Result<Draw<M, P>, ParameterError> + Sync,
    read: impl Fn(&mut [f64; R], &View<'_, f64, M>) + Sync,
    done: impl Fn(u64) + Sync,
) -> Result<Vec<Row<P, R>>, StudyError>
where
    M: Mechanism,
    F: Formulation<f64> + Sync,
    K: OneStep<f64, Dynamics<Problem<M, F>>>
        + OneStep<Lanes<f64, LANES>, LaneEquations<Problem<M, F>, LANES>>
        + Sync,
{
    let numbers: Vec<u64> = rows.shard.rows(rows.all).collect();
    let kept = |batch: &[Row<P, R>]| {
        done(batch.len() as u64);
        Ok(())
    };
    compute_these(
        rows,
        &numbers,
        (formulation, scheme, steps),
        draw,
        read,
        kept,
    )
}

/// Computes some rows, and has each batch of them kept.
fn compute_these<M, F, K, const P: usize, const R: usize>(
    rows: &Rows,
    numbers: &[u64],
    (formulation, scheme, steps): (F, K, Steps),
    draw: impl Fn(&mut ChaCha8Rng) -> Result<Draw<M, P>, ParameterError> + Sync,
    read: impl Fn(&mut [f64; R], &View<'_, f64, M>) + Sync,
    keep: impl Fn(&[Row<P, R>]) -> Result<(), StudyError> + Sync,
) -> Result<Vec<Row<P, R>>, StudyError>
where
    M: Mechanism,
    F: Formulation<f64> + Sync,
    K: OneStep<f64, Dynamics<Problem<M, F>>>
        + OneStep<Lanes<f64, LANES>, LaneEquations<Problem<M, F>, LANES>>
        + Sync,
{
    let batches = numbers.par_chunks(LANES).map(|numbers| {
        let mut drawn = Vec::with_capacity(LANES);
        for &number in numbers {
            drawn.push(draw(&mut rows.generator(number)).map_err(refused(number))?);
        }
        // Lanes that are left over repeat the last row.
        let last = *numbers.last().unwrap_or(&0);
        while drawn.len() < LANES {
            drawn.push(draw(&mut rows.generator(last)).map_err(refused(last))?);
        }
        let batch = batch(numbers, drawn, (formulation, scheme, steps), &read)?;
        keep(&batch)?;
        Ok(batch)
    });
    let batches = batches.collect::<Result<Vec<_>, StudyError>>()?;
    Ok(batches.into_iter().flatten().collect())
}

fn refused<E: ToString>(number: u64) -> impl Fn(E) -> StudyError {
    move |error| StudyError::Run {
        name: format!("row {number}"),
        reason: error.to_string(),
    }
}

/// The rows of one ensemble.
fn batch<M, F, K, const P: usize, const R: usize>(
    numbers: &[u64],
    drawn: Vec<Draw<M, P>>,
    (formulation, scheme, steps): (F, K, Steps),
    read: &impl Fn(&mut [f64; R], &View<'_, f64, M>),
) -> Result<Vec<Row<P, R>>, StudyError>
where
    M: Mechanism,
    F: Formulation<f64>,
    K: OneStep<f64, Dynamics<Problem<M, F>>>
        + OneStep<Lanes<f64, LANES>, LaneEquations<Problem<M, F>, LANES>>,
{
    let first = numbers.first().copied().unwrap_or(0);
    let (mut mechanisms, mut starts, mut columns) = (Vec::new(), Vec::new(), Vec::new());
    for draw in drawn {
        let described = draw.mechanism.described_state().map_err(refused(first))?;
        starts.push(draw.start.unwrap_or(described));
        mechanisms.push(draw.mechanism);
        columns.push(draw.columns);
    }
    let (Ok(mechanisms), Ok(starts)) = (
        <[M; LANES]>::try_from(mechanisms),
        <[StateOf<M>; LANES]>::try_from(starts),
    ) else {
        return Err(refused(first)("too few lanes"));
    };
    let ensemble = Ensemble::<Problem<_, _>, _, LANES>::new(&mechanisms, formulation, scheme);
    let mut ensemble = ensemble.map_err(refused(first))?;
    ensemble.start(&starts);
    let mut readings = [[f64::NAN; R]; LANES];
    let mut take = |ensemble: &Ensemble<Problem<_, _>, _, LANES>| {
        ensemble.each(|lane, view| read(&mut readings[lane], &view));
    };
    take(&ensemble);
    for step in 1..=steps.count {
        ensemble.step(steps.step).map_err(refused(first))?;
        if step.is_multiple_of(steps.every) {
            take(&ensemble);
        }
    }
    let rows = numbers
        .iter()
        .zip(columns)
        .zip(readings)
        .zip(ensemble.stopped());
    let row = |(((&number, drawn), readings), stopped): (((&u64, _), _), &Option<_>)| Row {
        number,
        drawn,
        readings,
        stopped: stopped
            .as_ref()
            .map(|stopped: &SimulationError<_>| (stopped.time, stopped.fault.to_string())),
    };
    Ok(rows.map(row).collect())
}
