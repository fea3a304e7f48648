//! What one evaluation of the pendulum of chapter 15 costs: generated kernels, static matrices,
//! run-time assembler.
//!
//! - `throughput`: evaluations that do not depend on each other, over many states;
//! - `dependent`: every evaluation needs the result of the one before, as in an integrator;
//! - `chapter 15`: the whole standard run with step control and dense output.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use holonom::{
    Mechanism, StandardLagrange,
    dynamics::{Dynamics, Problem},
    integrate::System,
    state::Vector,
};
use holonom_benches::baselines::{START, Schur, StaticElimination, StaticSchur, Textbook};
use holonom_models::RodPendulum;
use holonom_study::chapter15::{Method, Settings};
use holonom_study::run::integrate;

/// States in the benches that evaluate.
const STATES: usize = 256;

fn generated() -> Dynamics<Problem<RodPendulum, StandardLagrange>> {
    Dynamics::new(&RodPendulum::default(), StandardLagrange)
        .expect("the data of the book are sound")
}

fn generated_start() -> <RodPendulum as Mechanism>::State<f64> {
    RodPendulum::initial_state(generated().constants())
}

/// The states that an integration goes through, as many as the benches need.
fn states<Y: System<f64>>(mut system: Y, start: Y::State) -> Vec<Y::State> {
    let settings = Settings::TABLE_15_2;
    let mut states = Vec::new();
    integrate(
        &mut system,
        &settings.integrator(),
        settings.span(),
        start,
        |_, state| {
            states.push(state.clone());
        },
    )
    .expect("the pendulum has no singular configuration");
    states.truncate(STATES);
    states
}

/// Calls `$bench!(name, system, start)` with every candidate.
macro_rules! candidates {
    ($bench:ident) => {
        $bench!("generated", generated(), generated_start());
        $bench!(
            "static matrices, Schur complement",
            StaticSchur::default(),
            START
        );
        $bench!(
            "static matrices, whole matrix",
            StaticElimination::default(),
            START
        );
        $bench!("assembler, Schur complement", Schur::new(0.0, 0.0), START);
        $bench!("assembler, whole matrix", textbook(), START);
    };
}

fn textbook() -> Textbook {
    Textbook::of(Method::Standard, &Settings::TABLE_15_2)
}

fn throughput(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("throughput");
    group.throughput(Throughput::Elements(STATES as u64));
    macro_rules! bench {
        ($name:expr, $system:expr, $start:expr) => {
            let (mut system, states) = ($system, states($system, $start));
            group.bench_function($name, |bencher| {
                bencher.iter(|| {
                    for state in &states {
                        let _ = black_box(system.rates(0.0, black_box(state)));
                    }
                });
            });
        };
    }
    candidates!(bench);
    group.finish();
}

fn dependent(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("dependent");
    group.throughput(Throughput::Elements(STATES as u64));
    macro_rules! bench {
        ($name:expr, $system:expr, $start:expr) => {
            let (mut system, start) = ($system, $start);
            group.bench_function($name, |bencher| {
                bencher.iter(|| {
                    let mut state = black_box(start);
                    for _ in 0..STATES {
                        // A step far below round-off: the next evaluation waits for this one, the
                        // state stays.
                        if let Ok(rates) = system.rates(0.0, &state) {
                            state = state.plus([(1e-30, &rates)]);
                        }
                    }
                    state
                });
            });
        };
    }
    candidates!(bench);
    group.finish();
}

fn chapter_15(criterion: &mut Criterion) {
    let settings = Settings::TABLE_15_2;
    let mut group = criterion.benchmark_group("chapter 15, standard");
    macro_rules! bench {
        ($name:expr, $system:expr, $start:expr) => {
            let (mut system, start) = ($system, $start);
            let mut run = || {
                let report = |_, state: &_| {
                    black_box(state);
                };
                let start = black_box(start);
                integrate(
                    &mut system,
                    &settings.integrator(),
                    settings.span(),
                    start,
                    report,
                )
            };
            let evaluations = run()
                .expect("the pendulum has no singular configuration")
                .evaluations;
            group.throughput(Throughput::Elements(evaluations as u64));
            group.bench_function($name, |bencher| bencher.iter(&mut run));
        };
    }
    candidates!(bench);
    group.finish();
}

criterion_group!(benches, throughput, dependent, chapter_15);
criterion_main!(benches);
