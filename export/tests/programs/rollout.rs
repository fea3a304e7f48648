//! Rollouts, compiled for the host as C and as C++, have the numbers of a [`Stepper`] to the last
//! bit: in every world, at every result, and where a world stops.

use crate::compiled::{Language, Number, Program, random_state};
use holonom::Real;
use holonom::mechanism::Relative;
use holonom::prelude::*;
use holonom::state::Vector;
use holonom_export::{Double, Export, ExportError, ExportExt as _, Rollout, Single};
use holonom_models::FourBar;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// A wheel on a pendulum, at a height (m); the motor turns the wheel against the pendulum.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(crate) struct Balancer {
    #[param(like = 0.2)]
    height: f64,
    #[input]
    torque: f64,
    #[body(mass = 0.5, inertia = [0.004, 0.004, 1e-4], position = [0.0, 0.0, 0.1])]
    pendulum: Body,
    #[body(mass = 0.2, inertia = [1e-3, 5e-4, 5e-4], position = [0.0, 0.0, height])]
    wheel: Body,
    #[joint(between = [ground, pendulum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [pendulum, wheel], point = [0.0, 0.0, height], axis = [1.0, 0.0, 0.0])]
    shaft: Revolute,
    #[force(between = [pendulum, wheel], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

type Inputs = InputsOf<Balancer, f64>;

const WORLDS: usize = 5;
const STEPS: usize = 60;
const HOLD: usize = 7;
const EVERY: usize = 9;
const DT: f64 = 1e-3;

/// What a rollout is given, number by number of all worlds; nothing where it is given 0.
#[derive(Default)]
struct Given<S> {
    parameters: Vec<S>,
    inputs: Vec<S>,
    states: Vec<S>,
}

/// What becomes of a world: the steps that it takes, whether none of them fails, and its time and
/// numbers at each result and at the end.
struct World<S> {
    taken: usize,
    is_ok: bool,
    results: Vec<Vec<S>>,
}

/// Reads the arrays, rolls out, writes the arrays. `before` is what stands before the include.
fn main_of(rollout: &Rollout, before: &str, given: [bool; 2]) -> String {
    let n = &rollout.program.name;
    let u = n.to_uppercase();
    let sets = STEPS.div_ceil(HOLD);
    let argument = |is_given, name| if is_given { name } else { "0" };
    let [parameters, inputs] = [
        argument(given[0], "parameters"),
        argument(given[1], "inputs"),
    ];
    let read = |is_given, name: &str| {
        let read =
            format!("    if (fread({name}, sizeof {name}, 1, stdin) != 1) {{ return 1; }}\n");
        if is_given { read } else { String::new() }
    };
    let read = [
        read(given[0], "parameters"),
        read(given[1], "inputs"),
        read(true, "states"),
    ];
    format!(
        "\
#include \"{n}.h\"
#include <stddef.h>
#include <stdio.h>
{before}
#include \"{n}_rollout.cu\"

#define WORLDS {WORLDS}
static {n}_real parameters[{u}_ROLLOUT_PARAMETERS * WORLDS + 1 - 1 * ({u}_ROLLOUT_PARAMETERS > 0)];
static {n}_real inputs[{sets} * {u}_ROLLOUT_INPUTS * WORLDS + 1 - 1 * ({u}_ROLLOUT_INPUTS > 0)];
static {n}_real states[{u}_ROLLOUT_STATE * WORLDS];
static {n}_real results[{STEPS} / {EVERY} * {u}_ROLLOUT_STATE * WORLDS];
static size_t taken[WORLDS];
static int statuses[WORLDS];

int main(void)
{{
    size_t k;
    {n}_rollout_init(WORLDS, states);
    fwrite(states, sizeof states, 1, stdout);
{read}    (void)parameters;
    (void)inputs;
    {n}_rollout(WORLDS, {STEPS}, ({n}_real){DT}, {parameters}, {inputs}, {HOLD}, states, {EVERY},
        results, taken, statuses);
    for (k = 0; k < WORLDS; k++) {{
        {n}_real of_world[2];
        of_world[0] = ({n}_real)taken[k];
        of_world[1] = ({n}_real)statuses[k];
        fwrite(of_world, sizeof of_world, 1, stdout);
    }}
    fwrite(results, sizeof results, 1, stdout);
    fwrite(states, sizeof states, 1, stdout);
    return 0;
}}
",
        read = read.concat(),
    )
}

/// Compares a rollout with worlds that were stepped by Rust; `start` is the start of the export.
fn compare<S: Number, X: Vector<S>>(
    rollout: &Rollout,
    before: &str,
    given: &Given<S>,
    start: &X,
    worlds: &[World<S>],
) {
    let name = &rollout.program.name;
    let main = main_of(
        rollout,
        before,
        [&given.parameters, &given.inputs].map(|numbers| !numbers.is_empty()),
    );
    let numbers = [&given.parameters[..], &given.inputs, &given.states].concat();
    let [results, of_cpp] = [Language::C, Language::Cpp].map(|language| {
        let files = |folder: &std::path::Path| rollout.write(folder).expect("files are written");
        Program::included(name, files, &main, language).run(&numbers)
    });
    let is_nan = |number: &S| number.to_f64().is_nan();
    let is_same = |(a, b): (&S, &S)| a.same_bits(*b) || is_nan(a) && is_nan(b);
    assert!(results.iter().zip(&of_cpp).all(is_same), "{name}: as C++");
    let length = given.states.len() / WORLDS;
    let (begun, results) = results.split_at(length * WORLDS);
    let (outcomes, results) = results.split_at(2 * WORLDS);
    for (number, world) in worlds.iter().enumerate() {
        let mut of_start = vec![S::zero(), S::zero()];
        start.for_each(|number| of_start.push(number));
        for (place, of_rust) in of_start.into_iter().enumerate() {
            let of_c = begun[place * WORLDS + number];
            assert!(of_c.same_bits(of_rust), "{name}: number {place} of a start");
        }
        let taken = S::constant(u32::try_from(world.taken).expect("few").into());
        assert_eq!(outcomes[2 * number], taken, "{name}, world {number}: steps");
        let is_ok = outcomes[2 * number + 1] == S::zero();
        assert_eq!(is_ok, world.is_ok, "{name}, world {number}: status");
        let records = results.chunks(length * WORLDS);
        assert_eq!(records.len(), world.results.len(), "{name}: results");
        for (record, expected) in records.zip(&world.results) {
            for (place, of_rust) in expected.iter().enumerate() {
                // What the last digits of the time leave over is no public number of a stepper.
                if place == 1 {
                    continue;
                }
                let of_c = record[place * WORLDS + number];
                let is_same = is_same((&of_c, of_rust));
                assert!(
                    is_same,
                    "{name}, world {number}, {place}: {of_c:?} for {of_rust:?}"
                );
            }
        }
    }
}

/// Steps a world as a rollout does. `step` takes the step of a number and gives the time.
fn stepped<S: Number, X: Vector<S> + Copy>(
    mut state: X,
    mut step: impl FnMut(usize, &mut X) -> Result<S, Fault>,
) -> World<S> {
    let (mut taken, mut is_ok, mut time) = (0, true, S::zero());
    let mut results = Vec::new();
    let mut record = |time: S, state: &X| {
        let mut numbers = vec![time, S::zero()];
        state.for_each(|number| numbers.push(number));
        results.push(numbers);
    };
    for number in 0..STEPS {
        if is_ok {
            match step(number, &mut state) {
                Ok(after) => (taken, time) = (taken + 1, after),
                Err(_) => is_ok = false,
            }
        }
        if (number + 1) % EVERY == 0 {
            record(time, &state);
        }
    }
    record(time, &state);
    World {
        taken,
        is_ok,
        results,
    }
}

/// Number by number of all worlds, from world by world.
fn transposed<S: Copy>(worlds: &[Vec<S>]) -> Vec<S> {
    let length = worlds.first().map_or(0, Vec::len);
    let number = |k: usize| worlds.iter().map(move |world| world[k]);
    (0..length).flat_map(number).collect()
}

fn begun<S: Number, X: Vector<S>>(states: &[X]) -> Vec<S> {
    let numbers = |state: &X| {
        let mut numbers = vec![S::zero(), S::zero()];
        state.for_each(|number| numbers.push(number));
        numbers
    };
    transposed(&states.iter().map(numbers).collect::<Vec<_>>())
}

fn balancer(name: &str) -> Rollout {
    let export = Balancer::default().export(StandardLagrange).named(name);
    export.step(Rk4).cuda().expect("exported")
}

/// A stepper of a balancer whose wheel is at a height (m).
fn stepper(height: f64) -> Stepper<Problem<Balancer, StandardLagrange>, Rk4> {
    let balancer = Balancer::new(height).expect("positive");
    balancer.stepper(StandardLagrange, Rk4).expect("described")
}

/// States at random.
fn states<X: Vector<S> + Copy, S: Real>(start: &X, random: &mut ChaCha8Rng) -> Vec<X> {
    let states = (0..WORLDS).map(|_| random_state(start, random));
    states.collect()
}

#[test]
fn worlds_have_parameters_and_inputs_of_their_own() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    let heights: Vec<f64> = (0..WORLDS).map(|_| random.random_range(0.1..0.4)).collect();
    let start = stepper(0.2).initial_state().expect("described");
    let states = states(&start, &mut random);
    let set = |_| {
        (0..WORLDS)
            .map(|_| random.random_range(-1.0..1.0))
            .collect()
    };
    let mut sets: Vec<Vec<f64>> = (0..STEPS.div_ceil(HOLD)).map(set).collect();
    // A world that fails on the way.
    sets[3][2] = f64::MAX;
    let worlds: Vec<_> = (0..WORLDS)
        .map(|world| {
            let mut stepper = stepper(heights[world]);
            stepped(states[world], |number, state| {
                let torque = sets[number / HOLD][world];
                stepper.step_with(state, &Inputs { torque }, DT)?;
                Ok(stepper.time())
            })
        })
        .collect();
    assert_eq!((worlds[2].taken, worlds[2].is_ok), (3 * HOLD, false));
    let given = Given {
        parameters: heights,
        inputs: sets.concat(),
        states: begun(&states),
    };
    compare(&balancer("rolled"), "", &given, &start, &worlds);
}

#[test]
fn a_feedback_sets_inputs_before_every_step() {
    let mut random = ChaCha8Rng::seed_from_u64(22);
    let start = stepper(0.2).initial_state().expect("described");
    let states = states(&start, &mut random);
    let before = "\
static void balance(const fed_state *state, fed_inputs *inputs, size_t world, size_t step)
{
    inputs->torque = 2.0 * state->pivot_sin + 0.2 * state->pivot_rate;
    inputs->torque += 1e-3 * (double)world + 1e-4 * (double)step;
}
#define FED_FEEDBACK(constants, state, inputs, world, step) balance(state, inputs, world, step)";
    let worlds: Vec<_> = (0..WORLDS)
        .map(|world| {
            let mut stepper = stepper(0.2);
            stepped(states[world], |number, state| {
                let [world, step] = [world, number].map(|k| f64::from(k as u32));
                let mut torque = 2.0 * state.element(1) + 0.2 * state.element(4);
                torque += 1e-3 * world + 1e-4 * step;
                stepper.step_with(state, &Inputs { torque }, DT)?;
                Ok(stepper.time())
            })
        })
        .collect();
    let given = Given {
        states: begun(&states),
        ..Given::default()
    };
    compare(&balancer("fed"), before, &given, &start, &worlds);
}

#[test]
fn worlds_without_inputs_in_single_precision() {
    let bars = FourBar::default();
    let export = Export::<FourBar, Single, Relative>::new(&bars, StandardLagrange);
    let rollout = export.named("bars").step(Rk4).cuda().expect("exported");
    let stepper = Stepper::<Problem<_, _, f32>, _>::new(&bars, StandardLagrange, Rk4);
    let stepper = stepper.expect("described").joint_coordinates();
    let start = stepper.initial_state().expect("described");
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut closed = || {
        let mut bodies = bars.described_state::<f32>().expect("finite");
        let foot = FourBar::HANDLES.left_foot;
        let angle = random.random_range(-0.6..0.6);
        bars.set_angle(&mut bodies, foot, angle).expect("it turns");
        let rate = random.random_range(-4.0..4.0);
        let set = bars.set_angle_rate(&mut bodies, foot, rate);
        set.expect("it turns");
        bars.assemble(0.0, &mut bodies).expect("it is closed");
        stepper.state_of(&bodies).expect("closed")
    };
    let mut states: Vec<_> = (0..WORLDS).map(|_| closed()).collect();
    // One that fails at once.
    states[1].set_element(start.length() - 1, f32::NAN);
    let worlds: Vec<_> = states
        .iter()
        .map(|state| {
            let mut stepper = stepper.clone();
            stepped(*state, |_, state| {
                stepper.step(state, DT as f32)?;
                Ok(stepper.time())
            })
        })
        .collect();
    assert_eq!((worlds[1].taken, worlds[1].is_ok), (0, false));
    let given = Given {
        states: begun(&states),
        ..Given::default()
    };
    compare(&rollout, "", &given, &start, &worlds);
}

#[test]
fn what_cannot_be_rolled_out_is_named() {
    let bars = FourBar::default();
    let refused = Export::<_, Double, Relative>::new(&bars, StandardLagrange).cuda();
    assert!(matches!(refused, Err(ExportError::Step)), "{refused:?}");
    let taken = bars.export(StandardLagrange).step(Rk4);
    let taken = taken.reading("rollout_time", "s", |view| view.time());
    let refused = taken.cuda().expect_err("the name is taken").to_string();
    assert_eq!(refused, "the name `rollout_time` is given twice");
}
