//! The race.

use std::collections::HashMap;

use holonom::mechanism::Operations;

use super::measure::{Candidates, Case, Scene};
use super::record::Row;
use super::{Coordinates, Precision, REFERENCE_KERNEL};
use crate::chapter15::Method;
use crate::error::StudyError;
use crate::target::Target;
use crate::timing::{Candidate, Schedule, race};

/// The run-time assembler of a mechanism, in one of its forms.
#[derive(Debug)]
pub struct Baseline {
    /// The mechanism.
    pub scene: &'static str,
    /// As in [`Case`].
    pub n: usize,
    /// The formulation.
    pub method: Method,
    /// What to time.
    pub candidate: Candidate<'static>,
}

/// The reference kernel: its operations and what can be timed of it.
#[derive(Debug)]
pub struct ReferenceKernel {
    /// The operations of an evaluation.
    pub operations: Operations,
    /// What can be timed.
    pub candidates: Candidates,
}

/// Times everything in one race, the reference kernel first; one row for each case, in their order.
///
/// `progress` is called with the rounds done.
///
/// # Errors
/// The first error of a candidate, a time that is not finite.
pub fn run(
    reference_kernel: ReferenceKernel,
    scenes: Vec<Scene>,
    baselines: Vec<Baseline>,
    schedule: Schedule,
    progress: impl FnMut(usize),
) -> Result<Vec<Row>, StudyError> {
    let reference_kernel = Case {
        scene: REFERENCE_KERNEL,
        n: 1,
        coordinates: Coordinates::Bodies,
        method: Method::Standard,
        precision: Precision::Double,
        operations: reference_kernel.operations,
        stage: reference_kernel.operations,
        candidates: reference_kernel.candidates,
    };
    let cases = scenes.into_iter().flat_map(|scene| scene.cases);
    let mut all = Vec::new();
    let entries: Vec<_> = std::iter::once(reference_kernel)
        .chain(cases)
        .map(|case| Entry::of(case, &mut all))
        .collect();
    let mut forms: HashMap<_, Vec<usize>> = HashMap::new();
    for Baseline {
        scene,
        n,
        method,
        candidate,
    } in baselines
    {
        let places = forms.entry((scene, n, method.key())).or_default();
        places.push(all.len());
        all.push(candidate);
    }

    let timings = race(&mut all, schedule, progress)?;
    let time = |place: usize| timings[place].time.least;
    let unit = entries
        .first()
        .map_or(f64::NAN, |entry| time(entry.places[0]));
    let build = Target::CURRENT.to_string();
    let row = |entry: &Entry| {
        let [throughput, dependent, step] = entry.places.map(time);
        let turns = timings[entry.places[0]].time;
        let forms = forms.get(&(entry.scene, entry.n, entry.method.key()));
        let assembler = forms.filter(|_| entry.precision == Precision::Double);
        let fastest = |places: &Vec<usize>| {
            let times = places.iter().map(|&place| time(place));
            times.fold(f64::INFINITY, f64::min)
        };
        Row {
            scene: entry.scene.into(),
            n: entry.n,
            coordinates: entry.coordinates.key().into(),
            formulation: entry.method.key().into(),
            scalar: entry.precision.key().into(),
            operations: entry.operations.total(),
            path: entry.operations.depth,
            stage_operations: entry.stage.total(),
            nanoseconds_throughput: throughput,
            upper_quartile_nanoseconds: turns.upper,
            spread: turns.median / turns.least,
            nanoseconds_dependent: dependent,
            rk4_step_nanoseconds: step,
            assembler_nanoseconds: assembler.map(fastest),
            kernel_nanoseconds: entry.kernel.map(time),
            reference_kernels: throughput / unit,
            build: build.clone(),
            processor_share: timings[entry.places[0]].share,
        }
    };
    Ok(entries.iter().map(row).collect())
}

/// A case whose candidates are in the race.
struct Entry {
    scene: &'static str,
    n: usize,
    coordinates: Coordinates,
    method: Method,
    precision: Precision,
    operations: Operations,
    stage: Operations,
    /// Where throughput, dependent evaluations and steps stand among the candidates.
    places: [usize; 3],
    kernel: Option<usize>,
}

impl Entry {
    fn of(case: Case, all: &mut Vec<Candidate<'static>>) -> Self {
        let mut enter = |candidate| {
            all.push(candidate);
            all.len() - 1
        };
        let Candidates {
            throughput,
            dependent,
            step,
            kernel,
        } = case.candidates;
        // The kernel runs beside the evaluation that it is compared with.
        let kernel = kernel.map(&mut enter);
        Self {
            places: [throughput, dependent, step].map(enter),
            scene: case.scene,
            n: case.n,
            coordinates: case.coordinates,
            method: case.method,
            precision: case.precision,
            operations: case.operations,
            stage: case.stage,
            kernel,
        }
    }
}
