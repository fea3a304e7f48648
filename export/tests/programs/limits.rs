//! Limits of joints, laws that switch and the projection: in C as in Rust.

use crate::compiled::{Program, random_state};
use holonom::mechanism::{Absolute, AtTime, JointLimits, Relative, Stabilisation};
use holonom::mechanism::{Coordinates, TracedCoordinates};
use holonom::prelude::*;
use holonom::state::{Array, MovingState as _, Vector};
use holonom::traced::{impact, projected};
use holonom_export::{Double, Export, ExportExt as _, Source};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// A parallelogram with a motor at its left foot, which turns up to stops that are a parameter, and
/// a brake that acts in one direction.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
pub(crate) struct Bars {
    #[param(like = 0.9)]
    pub(crate) stop: f64,
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
    left: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 1.0, 0.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.5, 0.0])]
    right: Body,
    #[joint(
        between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0],
        limits = [-stop, 0.5 * stop], restitution = 0.6
    )]
    left_foot: Revolute,
    #[joint(between = [left, coupler], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_pin: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_foot: Revolute,
    #[joint(between = [coupler, right], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_pin: Revolute,
    #[force(
        between = [ground, left], axis = [0.0, 0.0, 1.0],
        moment = torque - if rate > 0.0 { 0.4 * rate } else { 0.1 * rate }
    )]
    motor: TorsionalActuator,
}

const STOP: f64 = 0.9;
const TORQUE: f64 = 3.0;
const STATES: usize = 300;

fn bars(stop: f64) -> Bars {
    let mut bars = Bars::new(stop).expect("positive");
    bars.torque = TORQUE;
    bars
}

fn export<C: TracedCoordinates<Bars>>(name: &str, stop: f64) -> Source {
    let export = Export::<_, Double, C>::new(&bars(stop), StandardLagrange).named(name);
    export.step(Rk4).project(4).c().expect("exported")
}

/// Writes what a state is given by each function.
fn all_functions(source: &Source) -> Program {
    let main = "\
#include \"@.h\"
#include <stdio.h>

struct { @_state state; double dt, within, rest, tolerance; } given;
struct { @_gaps gaps; @_switches switches; double status[3]; @_state state[3]; } all;

int main(void)
{
    int k;
    @_parameters parameters;
    @_inputs inputs;
    @_constants constants;
    @_default_parameters(&parameters);
    @_default_inputs(&inputs);
    @_prepare(&parameters, &inputs, &constants);
    while (fread(&given, sizeof given, 1, stdin) == 1) {
        for (k = 0; k < 3; k++) {
            all.state[k] = given.state;
        }
        @_get_gaps(&constants, &given.state, &all.gaps);
        @_get_switches(&constants, &given.state, &all.switches);
        all.status[0] = @_step(&constants, &all.state[0], given.dt);
        all.status[1] = @_impact(&constants, &all.state[1], given.within, given.rest);
        all.status[2] = @_project(&constants, &all.state[2], given.tolerance);
        fwrite(&all, sizeof all, 1, stdout);
    }
    return 0;
}
";
    Program::compiled(source, &main.replace('@', &source.name))
}

fn numbers<X: Vector<f64>>(state: &X) -> Vec<f64> {
    let mut numbers = Vec::new();
    state.for_each(|number| numbers.push(number));
    numbers
}

fn same(found: &[f64], expected: &[f64], what: &str) {
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(
        bits(found),
        bits(expected),
        "{what}: {found:?}, {expected:?}"
    );
}

/// A state near one that satisfies the equations.
fn near_by<X: Vector<f64> + Copy>(start: &X, random: &mut ChaCha8Rng) -> X {
    moved(start, |_| random.random_range(-1e-4..1e-4))
}

/// A state whose angles and other numbers are moved by so much, each by its place.
pub(crate) fn moved<X: Vector<f64> + Copy>(start: &X, mut by: impl FnMut(usize) -> f64) -> X {
    let mut state = *start;
    let is_turn = |place: usize| place + 1 < start.length() && !start.is_independent(place + 1);
    for place in (0..start.length()).filter(|&place| start.is_independent(place)) {
        let by = by(place);
        if is_turn(place) {
            let (c, s) = (start.element(place), start.element(place + 1));
            let (a, b) = (f64::cos(by), f64::sin(by));
            state.set_element(place, c * a - s * b);
            state.set_element(place + 1, s * a + c * b);
        } else {
            state.set_element(place, start.element(place) + by);
        }
    }
    state
}

/// All functions from random states, in Rust and in C.
fn compare<C: TracedCoordinates<Bars> + Coordinates<Bars>>(name: &str, stop: f64) {
    let source = export::<C>(name, stop);
    let program = all_functions(&source);
    let bars = bars(stop);
    let stepper = bars.stepper(StandardLagrange, Rk4).expect("described");
    let stepper = stepper.coordinates::<C>().without_limits();
    let start = stepper.initial_state().expect("described");
    let parameters = bars.parameters::<f64>().expect("acceptable");
    let rigid = Stabilisation {
        rate: 0.0,
        position: 0.0,
        compliance: 0.0,
    };
    let (own, coefficients) = C::prepare(&parameters, &rigid, &Array::zeros());
    let absolute = Bars::prepare(&parameters);
    let at = AtTime::<_, Bars, C> {
        own: &own,
        absolute: &absolute,
        coefficients: &coefficients,
        time: 0.0,
    };
    let limits: [JointLimits<f64>; 1] = Bars::limits_of(&parameters, |limits| limits);
    let mut random = ChaCha8Rng::seed_from_u64(47);
    let (mut refused, mut struck) = (0, 0);
    for number in 0..STATES {
        let state = if number % 2 == 0 {
            random_state(&start, &mut random)
        } else {
            near_by(&start, &mut random)
        };
        let dt = random.random_range(1e-3..2e-2) * [1.0, 4.0][number / 2 % 2];
        let [within, rest] = [[0.0, 0.0], [0.3, 0.5], [1.0, 2.0]][number % 3];
        let given = [&[0.0, 0.0][..], &numbers(&state), &[dt, within, rest, 1e-9]].concat();
        let results = program.run(&given);
        let (gaps, results) = results.split_at(3);
        let (switches, results) = results.split_at(1);
        let (statuses, results) = results.split_at(3);
        let length = results.len() / 3;
        let of_c = |k: usize| &results[k * length + 2..][..length - 2];

        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        let angle = view.angle(Bars::HANDLES.left_foot);
        let turned = |angle: f64| {
            let middle = -0.25 * stop;
            let turns = ((middle - angle) / std::f64::consts::TAU).round();
            angle + turns * std::f64::consts::TAU
        };
        let expected = [turned(angle) + stop, 0.5 * stop - turned(angle)];
        for (found, expected) in gaps.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-13,
                "gap {found} for {expected}"
            );
        }
        let rate = view.angle_rate(Bars::HANDLES.left_foot);
        assert!(
            (gaps[2] - rate).abs() < 1e-13,
            "rate {} for {rate}",
            gaps[2]
        );
        // Of bodies whose joint is open there are several rates.
        let is_one = !C::IS_RELATIVE || (switches[0].abs() - rate.abs()).abs() < 1e-13;
        assert!(is_one, "{switches:?} for {rate}");

        let mut next = state;
        let taken = stepper.clone().step(&mut next, dt).is_ok();
        let bodies = stepper.bodies(&next);
        let after = angle_after(&stepper.view(&bodies).angle(Bars::HANDLES.left_foot), angle);
        let beyond = |angle: f64| [-stop - angle, angle - 0.5 * stop];
        let [one, other] = [beyond(turned(angle)), beyond(turned(angle) + after)];
        let passes = (0..2).any(|side| other[side] > one[side].max(0.0));
        if taken {
            assert_eq!(
                statuses[0],
                if passes { 4.0 } else { 0.0 },
                "state {number}: step"
            );
            refused += usize::from(passes);
        }
        if taken && !passes {
            same(of_c(0), &numbers(&next), "step");
        } else {
            same(of_c(0), &numbers(&state), "a step that was refused");
        }

        let mut next = state;
        let pivot = impact(&at, &mut next, &limits, [within, rest]);
        assert!(pivot > 1e-12, "{pivot}");
        assert_eq!(statuses[1], 0.0, "state {number}: impact");
        same(of_c(1), &numbers(&next), "impact");
        if numbers(&next) != numbers(&state) {
            struck += 1;
            let bodies = stepper.bodies(&next);
            let after = stepper.view(&bodies).angle_rate(Bars::HANDLES.left_foot);
            let expected = if rate.abs() < rest { 0.0 } else { -0.6 * rate };
            assert!((after - expected).abs() < 1e-10, "{after} for {expected}");
        }

        let mut next = state;
        let left = projected(&at, &mut next, 4).expect("it is known");
        let worst = left.violation.max(left.velocity_violation);
        assert_eq!(
            statuses[2] == 0.0,
            worst <= 1e-9,
            "state {number}: {left:?}"
        );
        assert!(number % 2 == 0 || worst < 1e-13, "state {number}: {left:?}");
        let expected = if worst <= 1e-9 { next } else { state };
        same(of_c(2), &numbers(&expected), "projection");
        if number % 2 == 1 {
            // What iterates by the numbers that it finds leads to the same state, but for the
            // second order of the movement.
            let mut bodies = stepper.bodies(&state);
            let done = Projection::default().correct::<Bars>(&absolute, 0.0, &mut bodies);
            done.expect("it converges");
            let other = stepper.bodies(&next);
            for (a, b) in numbers(&bodies).into_iter().zip(numbers(&other)) {
                assert!((a - b).abs() < 1e-7, "{a} for {b}");
            }
        }
    }
    assert!(refused > 10 && struck > 10, "{refused} {struck}");
}

/// How far an angle has turned, the short way round.
fn angle_after(after: &f64, before: f64) -> f64 {
    let turned = after - before;
    turned.sin().atan2(turned.cos())
}

#[test]
fn gaps_impacts_and_projections_in_joint_coordinates() {
    compare::<Relative>("stopped_joints", STOP);
}

#[test]
fn gaps_impacts_and_projections_of_bodies() {
    compare::<Absolute>("stopped_bodies", 0.1);
}

/// What is compared with a distance or a tolerance that is none is no result.
#[test]
fn distances_and_tolerances_that_are_no_numbers_are_refused() {
    let program = all_functions(&export::<Relative>("unmeasured", STOP));
    let stepper = bars(STOP).stepper(StandardLagrange, Rk4);
    let stepper = stepper.expect("described").joint_coordinates();
    let start = stepper.initial_state().expect("described");
    for rate in [-1.0, 1.0] {
        let state = moved(&start, |place| {
            let is_rate = place >= start.length() - start.rates_slice().len();
            if is_rate { rate } else { 0.0 }
        });
        let before = [&[0.0, 0.0][..], &numbers(&state)].concat();
        for (within, rest, tolerance) in [
            (f64::NAN, 0.0, 1e-9),
            (1.0, f64::NAN, 1e-9),
            (0.0, 0.0, f64::NAN),
        ] {
            let given = [&before[..], &[1e-3, within, rest, tolerance]].concat();
            let results = program.run(&given);
            let of_limits = within.is_nan() || rest.is_nan();
            let function = if of_limits { 1 } else { 2 };
            assert_eq!(results[4 + function], 3.0, "{within} {rest} {tolerance}");
            let length = before.len();
            same(
                &results[7 + function * length..][..length],
                &before,
                "refused",
            );
        }
    }
}

/// The loop of the README, which steps up to a limit, bounces and goes on.
#[test]
fn a_loop_in_c_bounces_as_a_stepper() {
    let source = export::<Relative>("bars", STOP);
    let readme = include_str!("../../README.md");
    let step = readme.split("```c\n").nth(2);
    let step = step.and_then(|rest| rest.split("```").next());
    let main = format!(
        "\
#include \"bars.h\"
#include <stdio.h>

{}
int main(void)
{{
    int k;
    bars_parameters parameters;
    bars_inputs inputs;
    bars_constants constants;
    bars_state state;
    bars_joints joints;
    bars_default_parameters(&parameters);
    bars_default_inputs(&inputs);
    bars_prepare(&parameters, &inputs, &constants);
    bars_init(&state);
    for (k = 0; k < 200; k++) {{
        if (step(&constants, &state, 5e-3) != BARS_OK) {{
            return 1;
        }}
        bars_get_joints(&state, &joints);
        fwrite(&joints.left_foot, sizeof joints.left_foot, 1, stdout);
        fwrite(&joints.left_foot_rate, sizeof joints.left_foot_rate, 1, stdout);
    }}
    return 0;
}}
",
        step.expect("a loop in C")
    );
    let found = Program::compiled(&source, &main).run::<f64>(&[]);
    let mut stepper = bars(STOP)
        .stepper(StandardLagrange, Rk4)
        .expect("described");
    let mut state = stepper.initial_state().expect("described");
    let (mut bounces, mut before) = (0, 0.0);
    for pair in found.chunks_exact(2) {
        stepper.step(&mut state, 5e-3).expect("it bounces");
        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        let foot = Bars::HANDLES.left_foot;
        let expected = [view.angle(foot), view.angle_rate(foot)];
        for (found, expected) in pair.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
        }
        bounces += usize::from(pair[1] * before < 0.0);
        before = pair[1];
    }
    assert!(bounces == 3, "{bounces}");
}

#[test]
fn limits_a_turn_apart_are_passed_where_that_is_said() {
    let wide = Bars::new(5.0).expect("finite");
    let passed = wide.export(StandardLagrange).without_limits().step(Rk4);
    let source = passed.c().expect("exported").source;
    assert!(!source.contains("_LIMIT;"));
}
