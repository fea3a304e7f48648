//! Random mechanisms in C against the same in Rust, to the last bit: rates, steps, projections and
//! a reading, from random states, in both coordinates. Prints what differs and what is refused, and
//! fails where something differs or one of the coordinates has no program.

#![forbid(unsafe_code)]

#[path = "../../programs/compiled.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod compiled;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use compiled::{Number as _, Program, random_state, steps};
use holonom::Scalar;
use holonom::mechanism::{Absolute, Relative, Terms, TracedCoordinates};
use holonom::prelude::*;
use holonom::state::{Array as _, MovingState as _, Vector};
use holonom::traced::{AtTime, compliances, projected};
use holonom_export::{Double, Export, ExportError, Source};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));

/// So many states of each mechanism.
const STATES: usize = 200;
/// What a projection may leave.
const TOLERANCE: f64 = 1.0;
/// The least pivot of a `Stepper`.
const LEAST_PIVOT: f64 = 64.0 * f64::EPSILON;
const FUNCTIONS: [&str; 4] = ["reading", "rates", "projection", "step"];

/// What was found.
#[derive(Default)]
struct Tally {
    /// By coordinates: bodies, then joints.
    programs: [usize; 2],
    /// By reason.
    refused: BTreeMap<String, usize>,
    /// By function: calls that have no result, in both languages.
    faults: [usize; 4],
    different: usize,
}

impl Tally {
    fn refused(&mut self, seed: u64, reason: &str, why: impl Display) {
        println!("seed {seed} is refused: {why}");
        *self.refused.entry(reason.to_owned()).or_default() += 1;
    }
}

/// Of an export the name of its error, such as `Compliance`.
fn reason(error: &(dyn Error + 'static)) -> String {
    let Some(error) = error.downcast_ref::<ExportError>() else {
        let is_of_a_run = error.is::<Fault>();
        return if is_of_a_run { "a run" } else { "other" }.to_owned();
    };
    let text = format!("{error:?}");
    let letters = text.chars().take_while(|letter| letter.is_alphanumeric());
    letters.collect()
}

/// Calls all functions for each time and state; writes a status and numbers of each.
fn program(source: &Source) -> Program {
    let main = steps(source);
    let (before, _) = main
        .split_once(&format!("        {}_real status", source.name))
        .expect("it takes steps");
    let handed = if before.contains(" constants;") {
        "&constants, "
    } else {
        ""
    };
    let body = "        @_slope slope = {0};
        @_state moved = state;
        double numbers[3] = {0};
        numbers[1] = @_energy(HANDED&state);
        numbers[2] = @_rates(HANDED&state, &slope);
        fwrite(numbers, sizeof numbers[0], 3, stdout);
        fwrite(&slope, sizeof slope, 1, stdout);
        numbers[0] = @_project(HANDED&moved, TOLERANCE);
        fwrite(numbers, sizeof numbers[0], 1, stdout);
        fwrite((double *)&moved + 2, sizeof moved - 2 * sizeof dt, 1, stdout);
        numbers[0] = @_step(HANDED&state, dt);
        fwrite(numbers, sizeof numbers[0], 1, stdout);
        fwrite((double *)&state + 2, sizeof state - 2 * sizeof dt, 1, stdout);
    }
    return 0;
}
";
    let body = body
        .replace("HANDED", handed)
        .replace("TOLERANCE", &format!("{TOLERANCE:?}"));
    Program::compiled(
        source,
        &(before.to_owned() + &body).replace('@', &source.name),
    )
}

fn numbers<X: Vector<f64>>(state: &X) -> Vec<f64> {
    let mut numbers = Vec::new();
    state.for_each(|number| numbers.push(number));
    numbers
}

/// Whether a function has a result, and its numbers.
type Given = (bool, Vec<f64>);

/// The functions but the step, in Rust.
fn in_rust<M: Mechanism, T: Terms, C: TracedCoordinates<M>>(
    at: &AtTime<'_, f64, M, C>,
    state: &C::State<f64>,
) -> Option<[Given; 3]> {
    let bodies = C::bodies_by_selection(at.own, state);
    let energy = energy(&View::<f64, M>::new(at.absolute, at.time, &bodies));
    let mut rates = C::State::<f64>::zeros();
    let mut multipliers = C::Multipliers::<f64>::zeros();
    let (own, coefficients) = (at.own, at.coefficients);
    let pivot = C::rates_into::<f64, T>(
        own,
        coefficients,
        at.time,
        state,
        &mut rates,
        &mut multipliers,
    );
    let all = numbers(&rates).into_iter().enumerate();
    let slope = all.filter(|(place, _)| state.is_independent(*place));
    let slope: Vec<f64> = slope.map(|(_, number)| number).collect();
    // What yields has a solution wherever it is.
    let is_regular = T::COMPLIANT || pivot.relative >= LEAST_PIVOT;
    let mut moved = *state;
    let left = projected::<f64, M, C>(at, &mut moved, 2)?;
    let moved = numbers(&moved);
    let is_projected = left.violation <= TOLERANCE
        && left.velocity_violation <= TOLERANCE
        && left.pivot >= LEAST_PIVOT;
    let is_finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
    Some([
        (true, vec![energy]),
        (is_regular && is_finite(&slope), slope),
        (is_projected && is_finite(&moved), moved),
    ])
}

fn energy<S: Scalar, M: Mechanism>(view: &View<'_, S, M>) -> S {
    view.kinetic_energy() + view.potential_energy()
}

/// All functions of a mechanism from random states.
fn compare<M: Mechanism, F: Formulation<f64>, C: TracedCoordinates<M>>(
    tally: &mut Tally,
    mechanism: &M,
    formulation: F,
    name: &str,
) -> Result<(), Box<dyn Error>> {
    let export = Export::<M, Double, C>::new(mechanism, formulation).named(name);
    let mut bodies = mechanism.described_state()?;
    mechanism.assemble(0.0, &mut bodies)?;
    let export = export.starting_from(mechanism, &bodies).step(Rk4);
    let mut export = export.reading("energy", "J", |view| energy(view));
    if name.ends_with('0') {
        export = export.without_branches();
    }
    let program = program(&export.project(2).c()?);
    let stepper = Stepper::<Problem<_, _>, _>::new(mechanism, formulation, Rk4)?;
    let stepper = stepper.coordinates::<C>();
    let start = stepper.state_of(&bodies)?;
    let parameters = mechanism.parameters::<f64>()?;
    let absolute = M::prepare(&parameters);
    let (stabilisation, radian) = (formulation.stabilisation()?, formulation.radian());
    let yielding = compliances::<_, M, F::Terms>(&absolute, &stabilisation, radian)?;
    let (own, coefficients) = C::prepare(&parameters, &stabilisation, &yielding);
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let (mut given, mut expected) = (Vec::new(), Vec::new());
    for number in 0..STATES {
        let state = if number == 0 {
            start
        } else {
            random_state(&start, &mut random)
        };
        let [time, size] = [random.random_range(0.0..2.0), [1e-4, 1e-2, 0.3][number % 3]];
        let dt = size * random.random_range(0.5..1.0);
        given.extend([dt, time, 0.0]);
        given.extend(numbers(&state));
        let at = AtTime {
            own: &own,
            absolute: &absolute,
            coefficients: &coefficients,
            time,
        };
        expected.extend(in_rust::<M, F::Terms, C>(&at, &state).ok_or("it is not known")?);
        let (mut stepper, mut next) = (stepper.clone().starting_at(time), state);
        let is_stepped = stepper.step(&mut next, dt).is_ok();
        expected.push((is_stepped, numbers(&next)));
    }
    let results = program.run(&given);
    let mut results = &results[..];
    for (call, (is_ok, of_rust)) in expected.iter().enumerate() {
        let (status, rest) = results.split_first().ok_or("a status is missing")?;
        let (of_c, rest) = rest
            .split_at_checked(of_rust.len())
            .ok_or("numbers are missing")?;
        results = rest;
        let is_same = of_c.iter().zip(of_rust).all(|(a, b)| a.same_bits(*b));
        if (*status == 0.0) != *is_ok || *is_ok && !is_same {
            let function = FUNCTIONS[call % 4];
            println!(
                "{name}, state {}, {function}: {status} {of_c:?}, {of_rust:?}",
                call / 4
            );
            tally.different += 1;
        }
        tally.faults[call % 4] += usize::from(!is_ok);
    }
    tally.programs[usize::from(C::IS_RELATIVE)] += 1;
    Ok(())
}

/// The same of the mechanism of a seed, with what comes of it.
fn compared<M: Mechanism, F: Formulation<f64>, C: TracedCoordinates<M>>(
    tally: &mut Tally,
    seed: u64,
    made: fn() -> Result<M, Fault>,
    formulation: F,
) {
    let name = format!(
        "{}_{seed}",
        if C::IS_RELATIVE { "joints" } else { "bodies" }
    );
    let all = || compare::<M, F, C>(tally, &made()?, formulation, &name);
    match catch_unwind(AssertUnwindSafe(all)) {
        Ok(Ok(())) => {}
        Ok(Err(why)) => tally.refused(seed, &reason(&*why), format!("{name}: {why}")),
        Err(_) => tally.different += 1,
    }
}

fn main() -> ExitCode {
    let mut tally = Tally::default();
    all(&mut tally);
    let [bodies, joints] = tally.programs;
    println!("{bodies} programs by bodies and {joints} by joints, with {STATES} states");
    for (reason, count) in &tally.refused {
        println!("refused, {reason}: {count}");
    }
    for (function, faults) in FUNCTIONS.iter().zip(tally.faults) {
        println!("{function}: {faults} calls without a result in both languages");
    }
    println!("{} calls differ", tally.different);
    if tally.different > 0 || bodies == 0 || joints == 0 {
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
