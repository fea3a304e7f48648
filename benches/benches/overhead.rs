//! What an evaluation, and a step of Runge-Kutta, cost beside the kernel that they run, over states
//! that do not depend on each other.
//!
//! - `kernel`: [`Mechanism::evaluate_into`] alone;
//! - `rates`: [`System::rates`], which refuses what is not finite;
//! - `evaluation`: [`Dynamics::evaluate`], which hands on multipliers and pivot too;
//! - `step`: one step of [`Rk4`], in the time of one of its four evaluations.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{
    Formulation, Mechanism, Rk4, StandardLagrange, StateParts,
    dynamics::Dynamics,
    integrate::{OneStep, System},
    mechanism::Plain,
    state::Array,
};
use holonom_models::{FourBar, RodPendulum};

/// States in every bench.
const STATES: usize = 64;
/// The step (s) between them.
const STEP: f64 = 1e-3;

/// Eight rods on hinges whose axes are at right angles in turn, along +y at the start, gravity
/// along -z.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct HingeChain {
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 0.25, 0.0])]
    first: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 0.75, 0.0])]
    second: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 1.25, 0.0])]
    third: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 1.75, 0.0])]
    fourth: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 2.25, 0.0])]
    fifth: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 2.75, 0.0])]
    sixth: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 3.25, 0.0])]
    seventh: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.004, 0.02], position = [0.0, 3.75, 0.0])]
    eighth: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge_1: Revolute,
    #[joint(between = [first, second], point = [0.0, 0.5, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge_2: Revolute,
    #[joint(between = [second, third], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge_3: Revolute,
    #[joint(between = [third, fourth], point = [0.0, 1.5, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge_4: Revolute,
    #[joint(between = [fourth, fifth], point = [0.0, 2.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge_5: Revolute,
    #[joint(between = [fifth, sixth], point = [0.0, 2.5, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge_6: Revolute,
    #[joint(between = [sixth, seventh], point = [0.0, 3.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge_7: Revolute,
    #[joint(between = [seventh, eighth], point = [0.0, 3.5, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge_8: Revolute,
}

fn overhead<M: Mechanism + Default>(criterion: &mut Criterion, name: &str) {
    let mut dynamics = Dynamics::new(&M::default(), StandardLagrange)
        .expect("the mechanism is sound")
        .absolute_coordinates();
    let constants = *dynamics.constants();
    let stabilisation = StandardLagrange
        .stabilisation()
        .expect("there are no coefficients");
    let coefficients = M::coefficients::<f64>(&constants, &stabilisation);
    let mut state = M::initial_state(&constants);
    let states: Vec<_> = (0..STATES)
        .map(|_| {
            Rk4.step(&mut dynamics, 0.0, &mut state, STEP)
                .expect("no singular configuration is near");
            state
        })
        .collect();

    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(STATES as u64));
    group.bench_function("kernel", |bencher| {
        let mut rates = M::State::from_parts(Array::zeros(), Array::zeros());
        let mut multipliers = Array::zeros();
        bencher.iter(|| {
            for state in &states {
                let (constants, coefficients) = (black_box(&constants), black_box(&coefficients));
                let pivot = M::evaluate_into::<f64, Plain>(
                    constants,
                    coefficients,
                    0.0,
                    black_box(state),
                    &mut rates,
                    &mut multipliers,
                );
                black_box((&rates, &multipliers, pivot));
            }
        });
    });
    group.bench_function("rates", |bencher| {
        bencher.iter(|| {
            for state in &states {
                black_box(&dynamics.rates(0.0, black_box(state)));
            }
        });
    });
    group.bench_function("evaluation", |bencher| {
        bencher.iter(|| {
            let mut place = holonom::mechanism::Evaluation::zeros();
            for state in &states {
                let _ = black_box(dynamics.evaluate_into(0.0, black_box(state), &mut place));
                black_box(&place);
            }
        });
    });
    group.throughput(Throughput::Elements(4 * STATES as u64));
    group.bench_function("step", |bencher| {
        let mut places = states.clone();
        bencher.iter(|| {
            places.copy_from_slice(&states);
            for place in &mut places {
                let _ = black_box(Rk4.step(&mut dynamics, 0.0, black_box(place), STEP));
            }
        });
    });
    group.finish();
}

fn pendulum(criterion: &mut Criterion) {
    overhead::<RodPendulum>(criterion, "kernel and step, pendulum");
}

fn four_bar(criterion: &mut Criterion) {
    overhead::<FourBar>(criterion, "kernel and step, four-bar");
}

fn chain(criterion: &mut Criterion) {
    overhead::<HingeChain>(criterion, "kernel and step, chain of eight hinges");
}

criterion_group!(benches, pendulum, four_bar, chain);
criterion_main!(benches);
