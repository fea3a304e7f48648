//! What the equations in chosen coordinates cost, and derivatives: mass matrix, inverse and forward
//! dynamics, linearisation. A run of 500 steps of [`Rk4`], and the same with eight derivatives. A
//! thousand steps of an arm with other torques each, and the gradient of a cost at their end by all
//! torques.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use holonom::Forward;
use holonom::independent::{Chosen, Direction, IndependentCoordinates};
use holonom::mechanism::{HasInverse, HasMassMatrix};
use holonom::prelude::*;
use holonom_models::{FourBar, Ur5};

/// Of the last angle that is chosen, by a start.
fn equations<M, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    chosen: impl Chosen<M, N>,
    directions: [Direction<M>; 8],
) where
    M: HasMassMatrix + HasInverse + Default,
{
    let mechanism = M::default();
    let space = mechanism.coordinates(chosen).expect("they are independent");
    let [positions, rates] = [[0.3; N], [0.7; N]];
    let state = space.state(positions, rates).expect("it can be assembled");
    let mut group = criterion.benchmark_group(name);
    group.bench_function("mass", |bencher| {
        bencher.iter(|| space.mass(black_box(&state)));
    });
    group.bench_function("inverse", |bencher| {
        bencher.iter(|| space.inverse(black_box(&state), [1.0; N]));
    });
    group.bench_function("forward", |bencher| {
        bencher.iter(|| space.forward(black_box(&state), [0.0; N]));
    });
    group.bench_function("linearise", |bencher| {
        bencher.iter(|| space.linearise(black_box(&state), [], |_| []));
    });
    runs(&mut group, &mechanism, &space, directions);
}

/// A run, and the same with derivatives.
fn runs<M: HasMassMatrix, const N: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    mechanism: &M,
    space: &IndependentCoordinates<M, N>,
    directions: [Direction<M>; 8],
) {
    let state = space
        .state([0.3; N], [0.7; N])
        .expect("it can be assembled");
    let bodies = space.bodies(&state);
    group.bench_function("run", |bencher| {
        let simulation = mechanism
            .simulation(StandardLagrange, Rk4::every(1e-4))
            .joint_coordinates()
            .unmonitored()
            .initial_state(bodies);
        bencher.iter(|| simulation.run(0.0..=0.05, every(0.05), |sample| _ = black_box(sample)));
    });
    let along = space.sensitivities(&state, directions);
    let along = along.expect("the coordinates are chosen");
    group.bench_function("run with eight derivatives", |bencher| {
        let simulation = along
            .simulation(StandardLagrange, Rk4::every(1e-4))
            .joint_coordinates()
            .unmonitored();
        bencher.iter(|| simulation.run(0.0..=0.05, every(0.05), |sample| _ = black_box(sample)));
    });
}

/// The equations of arms are timed by `study arms`; here are their runs.
fn robots(criterion: &mut Criterion) {
    let h = Ur5::HANDLES;
    let arm = [h.pan, h.lift, h.elbow, h.wrist_1, h.wrist_2, h.wrist_3];
    let [a, b, c, d, ..] = arm;
    let directions = [
        [a, b, c, d].map(Direction::position),
        [a, b, c, d].map(Direction::rate),
    ];
    let ur5 = Ur5::default();
    let space = ur5.coordinates(arm).expect("they are independent");
    let mut group = criterion.benchmark_group("UR5");
    runs(&mut group, &ur5, &space, flattened(directions));
    gradient(&mut group, &ur5, &space);
}

/// Controls of every step: the steps, and the gradient by all controls.
fn gradient(
    group: &mut BenchmarkGroup<'_, WallTime>,
    arm: &Ur5,
    space: &IndependentCoordinates<Ur5, 6>,
) {
    const STEP: f64 = 1e-3;
    let h = Ur5::HANDLES;
    let motors = [
        h.pan_torque,
        h.lift_torque,
        h.elbow_torque,
        h.wrist_1_torque,
        h.wrist_2_torque,
        h.wrist_3_torque,
    ];
    let torque = |step: usize, motor: usize| 3.0 * (0.01 * (step * (motor + 1)) as f64).sin();
    let controls: Vec<[f64; 6]> = (0..1000)
        .map(|step| std::array::from_fn(|motor| torque(step, motor)))
        .collect();
    let start = space.state([0.3; 6], [0.7; 6]).expect("a tree");
    group.bench_function("1000 steps", |bencher| {
        let stepper = arm.stepper(StandardLagrange, Rk4).expect("it is sound");
        let mut stepper = stepper.joint_coordinates();
        bencher.iter(|| {
            let mut state = start;
            for &[
                pan_torque,
                lift_torque,
                elbow_torque,
                wrist_1_torque,
                wrist_2_torque,
                wrist_3_torque,
            ] in &controls
            {
                let inputs = InputsOf::<Ur5, f64> {
                    pan_torque,
                    lift_torque,
                    elbow_torque,
                    wrist_1_torque,
                    wrist_2_torque,
                    wrist_3_torque,
                };
                let stepped = stepper.step_with(&mut state, &inputs, STEP);
                stepped.expect("regular");
            }
            black_box(state)
        });
    });
    group.bench_function("gradient by 6000 controls", |bencher| {
        let run = space.adjoint(StandardLagrange, Rk4::every(STEP));
        bencher.iter(|| {
            run.gradient(&start, motors, &controls, [], |instant| {
                let at_end = instant.is_end().then(|| {
                    let pairs = instant.positions().iter().zip(instant.rates());
                    pairs.fold(Forward::fixed(0.0), |sum, (q, v)| sum + *q * *q + *v * *v)
                });
                at_end.unwrap_or(Forward::fixed(0.0))
            })
        });
    });
}

/// A loop, by one coordinate again and again.
fn loops(criterion: &mut Criterion) {
    let foot = FourBar::HANDLES.left_foot;
    let directions = [
        [foot; 4].map(Direction::position),
        [foot; 4].map(Direction::rate),
    ];
    equations::<FourBar, 1>(criterion, "four-bar", [foot], flattened(directions));
}

fn flattened<M>([[a, b, c, d], [e, f, g, h]]: [[Direction<M>; 4]; 2]) -> [Direction<M>; 8] {
    [a, b, c, d, e, f, g, h]
}

criterion_group!(benches, robots, loops);
criterion_main!(benches);
