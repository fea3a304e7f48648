//! Loops that are open at a start: what is refused, and what closes them.

use std::path::Path;

use crate::compiled::{Language, Number, Program};
use crate::limits::moved;
use holonom::Real;
use holonom::mechanism::{Absolute, Relative, TracedCoordinates};
use holonom::prelude::*;
use holonom::state::Vector;
use holonom::traced::check_start;
use holonom_export::{Double, Export, ExportError, Precision, Single};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// A four-bar in the plane z = 0, described with the crank and the rocker upright: the loop is open
/// unless they are equally long.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
struct Linkage {
    #[param(like = 0.25)]
    crank: f64,
    #[param(like = 0.9)]
    coupler: f64,
    #[param(like = 0.6)]
    rocker: f64,
    #[param(like = 0.9)]
    base: f64,
    #[body(mass = 0.5, inertia = [0.0026, 1e-5, 0.0026], position = [0.0, 0.5 * crank, 0.0])]
    crank_link: Body,
    #[body(mass = 1.6, inertia = [1e-5, 0.0853, 0.0853], position = [0.5 * coupler, crank, 0.0])]
    coupler_link: Body,
    #[body(mass = 1.2, inertia = [0.036, 1e-5, 0.036], position = [base, 0.5 * rocker, 0.0])]
    rocker_link: Body,
    #[joint(between = [ground, crank_link], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    foot: Revolute,
    #[joint(between = [crank_link, coupler_link], point = [0.0, crank, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(
        between = [coupler_link, rocker_link],
        point = local([0.5 * coupler, 0.0, 0.0], [0.0, 0.5 * rocker, 0.0]),
        axis = [0.0, 0.0, 1.0]
    )]
    knee: Revolute,
    #[joint(between = [ground, rocker_link], point = [base, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    other_foot: Revolute,
}

fn export<P: Precision, C: TracedCoordinates<Linkage>>(name: &str) -> Export<Linkage, P, C> {
    let export = Export::<_, P, C>::new(&Linkage::default(), Baumgarte::default());
    export.named(name).step(Rk4)
}

fn closed<S: Real>() -> <Linkage as Mechanism>::State<S> {
    let linkage = Linkage::default();
    let mut bodies = linkage.described_state::<S>().expect("finite");
    let moved = linkage.assemble(S::zero(), &mut bodies);
    moved.expect("it is in reach");
    bodies
}

fn numbers<S: Real, X: Vector<S>>(state: &X) -> Vec<S> {
    let mut numbers = Vec::new();
    state.for_each(|number| numbers.push(number));
    numbers
}

/// A start that is open is refused, and closed where that is asked for: the program begins as a
/// stepper.
fn refused_or_closed<S: Number, P: Precision, C: TracedCoordinates<Linkage>>(name: &str) {
    let refused = export::<P, C>(name).c().expect_err("it is open");
    assert!(matches!(refused, ExportError::Open(_)), "{refused:?}");
    let message = refused.to_string();
    let expected = "joint `knee` is open by 0.35 m at the start: `.assembled(&mechanism)` corrects the described start, `.starting_from(&mechanism, &state)` sets another one";
    assert_eq!(message, expected);

    let (linkage, bodies) = (Linkage::default(), closed::<f64>());
    let stepper = Stepper::<Problem<_, _, S>, _>::new(&linkage, Baumgarte::default(), Rk4);
    let mut stepper = stepper.expect("finite").coordinates::<C>();
    let start = stepper.state_of(&closed::<S>()).expect("it is closed");
    for (export, is_start) in [
        (export::<P, C>(name).assembled(&linkage), true),
        // Whose numbers are those of double precision.
        (
            export::<P, C>(name).starting_from(&linkage, &bodies),
            !P::IS_SINGLE,
        ),
    ] {
        let source = export.c().expect("it is closed");
        let main = "\
#include \"@.h\"
#include <stdio.h>

int main(void)
{
    int k;
    @_parameters parameters;
    @_constants constants;
    @_state state;
    @_default_parameters(&parameters);
    @_prepare(&parameters, &constants);
    @_init(&state);
    if (@_check_joints(&constants, &state) != @_OK) {
        return 1;
    }
    fwrite(&state, sizeof state, 1, stdout);
    for (k = 0; k < 100; k++) {
        if (@_step(&constants, &state, 1e-3) != @_OK) {
            return 1;
        }
    }
    fwrite(&state, sizeof state, 1, stdout);
    return 0;
}
";
        let main = main.replace("@_OK", &format!("{}_OK", name.to_uppercase()));
        let main = main.replace("1e-3", if P::IS_SINGLE { "1e-3f" } else { "1e-3" });
        let program = Program::compiled(&source, &main.replace('@', name));
        let found = program.run::<S>(&[]);
        let (begun, ended) = found.split_at(found.len() / 2);
        let mut state = start;
        let same = |found: &[S], state: &C::State<S>| {
            let expected = numbers(state);
            let pairs = found[2..].iter().zip(&expected);
            assert!(
                pairs.clone().all(|(a, b)| a.same_bits(*b)),
                "{found:?} for {expected:?}"
            );
            assert_eq!(pairs.count(), expected.len());
        };
        if is_start {
            same(begun, &state);
            stepper = stepper.starting_at(S::zero());
            for _ in 0..100 {
                stepper.step(&mut state, S::constant(1e-3)).expect("a step");
            }
            same(ended, &state);
        }
    }
}

#[test]
fn an_open_start_is_refused_or_closed_in_joint_coordinates() {
    refused_or_closed::<f64, Double, Relative>("linkage_joints");
}

#[test]
fn an_open_start_is_refused_or_closed_of_bodies() {
    refused_or_closed::<f64, Double, Absolute>("linkage_bodies");
}

#[test]
fn an_open_start_is_refused_or_closed_in_single_precision() {
    refused_or_closed::<f32, Single, Relative>("linkage_single");
}

#[test]
fn a_start_that_is_given_has_to_be_closed() {
    let linkage = Linkage::default();
    let described = linkage.described_state().expect("finite");
    let open = export::<Double, Absolute>("given").starting_from(&linkage, &described);
    assert!(matches!(open.c(), Err(ExportError::Open(_))));
    // What is said last counts.
    let open = export::<Double, Relative>("given").starting_from(&linkage, &described);
    assert!(open.assembled(&linkage).c().is_ok());
}

/// The verdict of a program on states that are more or less open is that of a run.
fn checked<C: TracedCoordinates<Linkage>>(name: &str) {
    let (linkage, bodies) = (Linkage::default(), closed::<f64>());
    let source = export::<Double, C>(name).assembled(&linkage).c();
    let main = "\
#include \"@.h\"
#include <stdio.h>

struct { double status; @_openings openings; } found;

int main(void)
{
    @_parameters parameters;
    @_constants constants;
    @_state state;
    @_default_parameters(&parameters);
    @_prepare(&parameters, &constants);
    while (fread(&state, sizeof state, 1, stdin) == 1) {
        found.status = (double)@_check_joints(&constants, &state);
        @_get_openings(&constants, &state, &found.openings);
        fwrite(&found, sizeof found, 1, stdout);
    }
    return 0;
}
";
    let program = Program::compiled(&source.expect("closed"), &main.replace('@', name));
    let constants = linkage.constants::<f64>().expect("finite");
    let stepper = Stepper::new(&linkage, StandardLagrange, Rk4).expect("finite");
    let stepper = stepper.coordinates::<C>();
    let start = stepper.state_of(&bodies).expect("closed");
    // The crank turns at 300 rad/s, and the others with it.
    let mut fast = bodies;
    let set = linkage.set_angle_rate(&mut fast, Linkage::HANDLES.foot, 300.0);
    set.expect("it turns");
    linkage.assemble(0.0, &mut fast).expect("it is closed");
    let fast = stepper.state_of(&fast).expect("closed");
    let mut random = ChaCha8Rng::seed_from_u64(54);
    let mut seen = [0; 2];
    for number in 0..400 {
        let size = 10.0_f64.powf(random.random_range(-6.0..-2.0));
        let by: Vec<f64> = (0..start.length())
            .map(|_| random.random_range(-size..size))
            .collect();
        // Positions alone, rates alone, and rates beside a fast motion.
        let mut from = start;
        if number % 3 == 2 {
            from = fast;
        }
        let beside = |part: f64| {
            let is_moved = |place: usize| (place >= start.coordinate_count()) == (number % 3 > 0);
            moved(&from, |place| {
                if is_moved(place) {
                    part * by[place]
                } else {
                    0.0
                }
            })
        };
        let verdict = |part: f64| {
            let bodies = stepper.bodies(&beside(part));
            check_start::<f64, Linkage>(&constants, (0.0, 1.0), &bodies, false).is_ok()
        };
        let state = beside(1.0);
        let results = program.run(&[vec![0.0, 0.0], numbers(&state)].concat());
        let bodies = stepper.bodies(&state);
        let phi = Linkage::constraints(&constants, 0.0, &bodies);
        let rates = Linkage::constraint_rates(&constants, 0.0, &bodies);
        let all = [phi.as_slice(), rates.as_slice()]
            .map(|of| of.iter().fold(0.0_f64, |most, x| most.max(x.abs())));
        let largest = |first: usize| {
            let own = results[1 + first..].iter().step_by(2);
            own.fold(0.0_f64, |most, x| most.max(*x))
        };
        // All rows are lengths, or sines of angles.
        for (found, expected) in [largest(0), largest(1)].into_iter().zip(all) {
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
        // What is small is small beside sizes that differ a little between the two.
        if verdict(0.7) == verdict(1.4) {
            let is_closed = verdict(1.0);
            assert_eq!(
                results[0],
                if is_closed { 0.0 } else { 6.0 },
                "{number}: {results:?}"
            );
            seen[usize::from(is_closed)] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 100), "{seen:?}");
}

#[test]
fn a_program_accepts_the_starts_of_a_run_in_joint_coordinates() {
    checked::<Relative>("checked_joints");
}

#[test]
fn a_program_accepts_the_starts_of_a_run_of_bodies() {
    checked::<Absolute>("checked_bodies");
}

/// Of two worlds, the one with another length is open and takes no step.
#[test]
fn a_world_that_begins_with_an_open_loop_takes_no_step() {
    let linkage = Linkage::default();
    let export = export::<Double, Relative>("open_worlds").assembled(&linkage);
    let rollout = export.cuda().expect("closed");
    let main = "\
#include \"open_worlds_rollout.cu\"
#include <stdio.h>

int main(void)
{
    double parameters[4][2] = {{0.25, 0.3}, {0.9, 0.9}, {0.6, 0.6}, {0.9, 0.9}};
    double states[OPEN_WORLDS_ROLLOUT_STATE][2];
    size_t taken[2];
    int statuses[2], k;
    open_worlds_rollout_init(2, &states[0][0]);
    open_worlds_rollout(2, 10, 1e-3, &parameters[0][0], 0, 0, &states[0][0], 0, 0, taken, statuses);
    for (k = 0; k < 2; k++) {
        printf(\"%d steps, %s\\n\", (int)taken[k],
            statuses[k] == OPEN_WORLDS_OK ? \"OK\" : statuses[k] == OPEN_WORLDS_OPEN ? \"OPEN\" : \"?\");
    }
    return 0;
}
";
    let files = |folder: &Path| rollout.write(folder).expect("files are written");
    let program = Program::included("open_worlds", files, main, Language::C);
    assert_eq!(program.printed(), "10 steps, OK\n0 steps, OPEN\n");
}
