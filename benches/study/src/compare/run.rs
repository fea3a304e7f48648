//! The race.

use std::collections::HashMap;

use holonom::mechanism::Operations;

use super::measure::{Case, Contestants, Scene};
use super::record::Row;
use super::{Coordinates, Precision, YARDSTICK};
use crate::chapter15::Method;
use crate::error::StudyError;
use crate::target::Target;
use crate::timing::{Contestant, Schedule, race};

/// The run-time assembler of a mechanism, in one of its forms.
#[derive(Debug)]
pub struct Opponent {
    /// The mechanism.
    pub scene: &'static str,
    /// As in [`Case`].
    pub n: usize,
    /// The formulation.
    pub method: Method,
    /// What to time.
    pub contestant: Contestant<'static>,
}

/// The yardstick: its operations and what can be timed of it.
#[derive(Debug)]
pub struct Yardstick {
    /// The operations of an evaluation.
    pub operations: Operations,
    /// What can be timed.
    pub contestants: Contestants,
}

/// Times everything in one race, the yardstick first; one row for each case, in their order.
///
/// `progress` is called with the rounds done.
///
/// # Errors
/// The first error of a contestant, a time that is not finite.
pub fn run(
    yardstick: Yardstick,
    scenes: Vec<Scene>,
    opponents: Vec<Opponent>,
    schedule: Schedule,
    progress: impl FnMut(usize),
) -> Result<Vec<Row>, StudyError> {
    let yardstick = Case {
        scene: YARDSTICK,
        n: 1,
        coordinates: Coordinates::Bodies,
        method: Method::Standard,
        precision: Precision::Double,
        operations: yardstick.operations,
        stage: yardstick.operations,
        contestants: yardstick.contestants,
    };
    let cases = scenes.into_iter().flat_map(|scene| scene.cases);
    let mut all = Vec::new();
    let entries: Vec<_> = std::iter::once(yardstick)
        .chain(cases)
        .map(|case| Entry::of(case, &mut all))
        .collect();
    let mut forms: HashMap<_, Vec<usize>> = HashMap::new();
    for Opponent {
        scene,
        n,
        method,
        contestant,
    } in opponents
    {
        let places = forms.entry((scene, n, method.key())).or_default();
        places.push(all.len());
        all.push(contestant);
    }

    let timings = race(&mut all, schedule, progress)?;
    let time = |place: usize| timings[place].time.median;
    let unit = entries
        .first()
        .map_or(f64::NAN, |entry| time(entry.places[0]));
    let build = Target::CURRENT.to_string();
    let row = |entry: &Entry| {
        let [throughput, dependent, step] = entry.places.map(time);
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
            nanoseconds_dependent: dependent,
            rk4_step_nanoseconds: step,
            assembler_nanoseconds: assembler.map(fastest),
            kernel_nanoseconds: entry.kernel.map(time),
            yardsticks: throughput / unit,
            build: build.clone(),
        }
    };
    Ok(entries.iter().map(row).collect())
}

/// A case whose contestants are in the race.
struct Entry {
    scene: &'static str,
    n: usize,
    coordinates: Coordinates,
    method: Method,
    precision: Precision,
    operations: Operations,
    stage: Operations,
    /// Where throughput, dependent evaluations and steps stand among the contestants.
    places: [usize; 3],
    kernel: Option<usize>,
}

impl Entry {
    fn of(case: Case, all: &mut Vec<Contestant<'static>>) -> Self {
        let mut enter = |contestant| {
            all.push(contestant);
            all.len() - 1
        };
        let Contestants {
            throughput,
            dependent,
            step,
            kernel,
        } = case.contestants;
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
