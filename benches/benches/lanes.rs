//! Several mechanisms in one evaluation against one after the other: times of one mechanism each.
//!
//! - `rates`: [`JointCoordinates::joint_rates_into`] at states that do not depend on each other;
//! - `rates of bodies`: [`Mechanism::evaluate_into`], likewise;
//! - `step`: a step of [`Rk4`] by joints, of a [`Stepper`] and of an [`Ensemble`].
//!
//! ```text
//! RUSTFLAGS="-C target-cpu=native" cargo bench -p holonom-benches --bench lanes
//! ```

use std::array::from_fn;
use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use holonom::prelude::*;
use holonom::{
    Real, Scalar,
    lanes::{Ensemble, Lanes},
    mechanism::Plain,
    state::{Array, Vector},
};
use holonom_models::{FourBar, RodPendulum, Ur5};

/// Evaluations, and steps, of each mechanism in a bench.
const TIMES: u64 = 64;
/// A step (s).
const STEP: f64 = 1e-3;

/// States beside a described one, with other velocities: `lanes` numbers in each.
fn states<S: Scalar, X: Vector<S>>(described: &X, number: impl Fn(f64) -> S) -> Vec<X> {
    let one = |k: u64| {
        let speed = number(0.01 * k as f64);
        let mut along = described.zip(described, |_, _| S::zero());
        for index in described.coordinate_count()..described.length() {
            along.set_element(index, speed);
        }
        described.plus([(S::one(), &along)])
    };
    (0..TIMES).map(one).collect()
}

/// Rates by joints.
fn rates<S: Scalar, M: JointCoordinates + Default>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    lanes: u64,
    number: impl Fn(f64) -> S,
) {
    let parameters = M::default().parameters().expect("the mechanism is sound");
    let constants = M::prepare_joints::<S>(&parameters);
    let stabilisation = holonom::mechanism::Stabilisation {
        rate: S::zero(),
        position: S::zero(),
        compliance: S::zero(),
    };
    let coefficients = M::joint_coefficients::<S>(&constants, &stabilisation, &Array::zeros());
    let bodies = M::initial_state::<S>(&M::prepare(&parameters));
    let states = states(&M::joint_state(&constants, &bodies), number);
    group.throughput(Throughput::Elements(TIMES * lanes));
    group.bench_function(name, |bencher| {
        let mut rates = states[0];
        bencher.iter(|| {
            for state in &states {
                let (state, time) = (black_box(state), S::zero());
                M::joint_rates_into::<S, Plain>(&constants, &coefficients, time, state, &mut rates);
                black_box(&rates);
            }
        });
    });
}

/// Rates by bodies.
fn rates_of_bodies<S: Scalar, M: Mechanism + Default>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    lanes: u64,
    number: impl Fn(f64) -> S,
) {
    let parameters = M::default().parameters().expect("the mechanism is sound");
    let constants = M::prepare::<S>(&parameters);
    let stabilisation = holonom::mechanism::Stabilisation {
        rate: S::zero(),
        position: S::zero(),
        compliance: S::zero(),
    };
    let coefficients = M::coefficients::<S>(&constants, &stabilisation);
    let states = states(&M::initial_state::<S>(&constants), number);
    group.throughput(Throughput::Elements(TIMES * lanes));
    group.bench_function(name, |bencher| {
        let (mut rates, mut multipliers) = (states[0], M::Multipliers::<S>::zeros());
        bencher.iter(|| {
            for state in &states {
                M::evaluate_into::<S, Plain>(
                    &constants,
                    &coefficients,
                    S::zero(),
                    black_box(state),
                    &mut rates,
                    &mut multipliers,
                );
                black_box((&rates, &multipliers));
            }
        });
    });
}

/// Steps of one mechanism.
fn step<T: Real, M: JointCoordinates + Default>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
) {
    let stepper = Stepper::<Problem<M, _, T>, _>::new(&M::default(), StandardLagrange, Rk4);
    let mut stepper = stepper.expect("the mechanism is sound").joint_coordinates();
    let start = stepper.initial_state().expect("it stands as described");
    group.throughput(Throughput::Elements(TIMES));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let mut state = start;
            for _ in 0..TIMES {
                let _ = black_box(stepper.step(&mut state, T::constant(STEP)));
            }
            state
        });
    });
}

/// Steps of an ensemble.
fn steps<T: Real, M: JointCoordinates + Default, const L: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
) {
    let mechanisms: [M; L] = from_fn(|_| M::default());
    let start = Ensemble::<Problem<M, _, T>, _, L>::new(&mechanisms, StandardLagrange, Rk4);
    let start = start.expect("the mechanisms are sound").joint_coordinates();
    group.throughput(Throughput::Elements(TIMES * L as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let mut ensemble = start.clone();
            for _ in 0..TIMES {
                let _ = black_box(ensemble.step(T::constant(STEP)));
            }
            ensemble
        });
    });
}

fn scene<M: JointCoordinates + Default>(criterion: &mut Criterion, name: &str) {
    let mut group = criterion.benchmark_group(format!("rates, {name}"));
    rates::<f64, M>(&mut group, "f64", 1, |x| x);
    rates::<_, M>(&mut group, "f64 x 4", 4, |x| {
        Lanes::<f64, 4>::new(from_fn(|k| x + 0.01 * k as f64))
    });
    rates::<_, M>(&mut group, "f64 x 8", 8, |x| {
        Lanes::<f64, 8>::new(from_fn(|k| x + 0.01 * k as f64))
    });
    rates::<f32, M>(&mut group, "f32", 1, |x| x as f32);
    rates::<_, M>(&mut group, "f32 x 16", 16, |x| {
        Lanes::<f32, 16>::new(from_fn(|k| x as f32 + 0.01 * k as f32))
    });
    group.finish();
    let mut group = criterion.benchmark_group(format!("rates of bodies, {name}"));
    rates_of_bodies::<f64, M>(&mut group, "f64", 1, |x| x);
    rates_of_bodies::<_, M>(&mut group, "f64 x 8", 8, |x| {
        Lanes::<f64, 8>::new(from_fn(|k| x + 0.01 * k as f64))
    });
    group.finish();
    let mut group = criterion.benchmark_group(format!("step, {name}"));
    step::<f64, M>(&mut group, "f64");
    steps::<f64, M, 4>(&mut group, "f64 x 4");
    steps::<f64, M, 8>(&mut group, "f64 x 8");
    step::<f32, M>(&mut group, "f32");
    steps::<f32, M, 16>(&mut group, "f32 x 16");
    group.finish();
}

fn scenes(criterion: &mut Criterion) {
    scene::<RodPendulum>(criterion, "pendulum");
    scene::<FourBar>(criterion, "four-bar");
    scene::<Ur5>(criterion, "UR5");
}

criterion_group!(benches, scenes);
criterion_main!(benches);
