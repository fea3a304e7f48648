//! The two descriptions of a mechanism: an evaluation, and a step of Runge-Kutta in the time of one
//! of its four evaluations, over states that do not depend on each other.
//!
//! - `bodies`, `joints`: [`System::rates`] of [`Dynamics`] in absolute and in relative coordinates,
//!   standard multipliers;
//! - `step by bodies`, `step by joints`: [`Rk4`].

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use holonom::prelude::*;
use holonom::{
    JointCoordinates,
    dynamics::Dynamics,
    integrate::{OneStep, System},
};
use holonom_models::{Bricard, CartPole, FourBar, HeavyTop, Panda, RodPendulum, SliderCrank, Ur5};

/// States in every bench.
const STATES: usize = 64;
/// The step (s) between them.
const STEP: f64 = 1e-3;

fn both<M: JointCoordinates + Default>(criterion: &mut Criterion, name: &str) {
    let mechanism = M::default();
    let bodies = Dynamics::<Problem<M, _>>::new(&mechanism, StandardLagrange);
    let mut bodies = bodies
        .expect("the mechanism is sound")
        .absolute_coordinates();
    let joints = Dynamics::<Problem<M, _>>::new(&mechanism, StandardLagrange);
    let mut joints = joints.expect("the mechanism is sound").joint_coordinates();
    let start = M::initial_state(bodies.constants());
    let joint_start = joints.initial_state().expect("it stands as described");
    let mut group = criterion.benchmark_group(name);
    let names = ["bodies", "step by bodies"];
    describe(&mut group, names, &mut bodies, start);
    let names = ["joints", "step by joints"];
    describe(&mut group, names, &mut joints, joint_start);
    group.finish();
}

fn describe<Y: System<f64>>(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    [rates, step]: [&str; 2],
    system: &mut Y,
    mut state: Y::State,
) {
    let states: Vec<Y::State> = (0..STATES)
        .map(|_| {
            Rk4.step(system, 0.0, &mut state, STEP)
                .expect("no singular configuration is near");
            state.clone()
        })
        .collect();
    group.throughput(Throughput::Elements(STATES as u64));
    group.bench_function(rates, |bencher| {
        bencher.iter(|| {
            for state in &states {
                let _ = black_box(&system.rates(0.0, black_box(state)));
            }
        });
    });
    group.throughput(Throughput::Elements(4 * STATES as u64));
    group.bench_function(step, |bencher| {
        let mut places = states.clone();
        bencher.iter(|| {
            places.clone_from_slice(&states);
            for place in &mut places {
                let _ = black_box(Rk4.step(system, 0.0, black_box(place), STEP));
            }
        });
    });
}

fn descriptions(criterion: &mut Criterion) {
    both::<RodPendulum>(criterion, "pendulum");
    both::<CartPole>(criterion, "cart-pole");
    both::<HeavyTop>(criterion, "heavy top");
    both::<FourBar>(criterion, "four-bar");
    both::<SliderCrank>(criterion, "slider-crank");
    both::<Bricard>(criterion, "Bricard's mechanism");
    both::<Ur5>(criterion, "UR5");
    both::<Panda>(criterion, "Panda");
}

criterion_group!(benches, descriptions);
criterion_main!(benches);
