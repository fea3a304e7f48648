//! What a step by joints takes that its kernels do not: steps of [`Rk4`] one after the other,
//! standard multipliers, each in the time of one of its four evaluations.
//!
//! - `kernel`: [`JointCoordinates::joint_rates_into`], at states that wait for the rates before (by
//!   an increment of nothing);
//! - `two powers`: steps whose pairs are turned by a series of two powers of the angle: wrong by a
//!   sixth of its cube;
//! - `six powers`: by six, which are exact up to 0.0125 rad. No longer angle is provided for,
//!   lengths drift, nothing is looked at, as with two: a step that is right does more;
//! - `step`: [`Stepper::step`] in relative coordinates.
//!
//! Behind them, `sum of pairs`: [`Vector::plus`] of so many pairs and rates, which LLVM compiles
//! well for some numbers and not for others (`versine::cut`).
//!
//! The steps are so small that the state stays where it is.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use holonom::prelude::*;
use holonom::{
    Formulation, JointCoordinates, Rk4,
    mechanism::Plain,
    state::{Array, JointState, Vector},
};
use holonom_models::{
    Bricard, CartPole, FourBar, HeavyTop, Panda, RodPendulum, SliderCrank, SqueezingMechanism, Ur5,
};

/// Steps in every bench.
const STEPS: u64 = 250;
/// A step (s).
const STEP: f64 = 1e-6;

fn steps<M>(criterion: &mut Criterion, name: &str)
where
    M: JointCoordinates + Default,
    M::JointState<f64>: Turned,
{
    let mechanism = M::default();
    let parameters = mechanism.parameters().expect("the mechanism is sound");
    let constants = M::prepare_joints::<f64>(&parameters);
    let stabilisation = StandardLagrange.stabilisation();
    let stabilisation = stabilisation.expect("there are no coefficients");
    let coefficients = M::joint_coefficients::<f64>(&constants, &stabilisation, &Array::zeros());
    let kernel = |state: &M::JointState<f64>, rates: &mut M::JointState<f64>| {
        M::joint_rates_into::<f64, Plain>(&constants, &coefficients, 0.0, state, rates);
    };
    let stepper = Stepper::<Problem<M, _>, _>::new(&mechanism, StandardLagrange, Rk4);
    let mut stepper = stepper.expect("the mechanism is sound").joint_coordinates();
    let start = stepper.initial_state().expect("it stands as described");

    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(4 * STEPS));
    group.bench_function("kernel", |bencher| {
        let (mut rates, nothing) = (start, black_box(0.0));
        bencher.iter(|| {
            let mut state = start;
            for _ in 0..4 * STEPS {
                kernel(&state, &mut rates);
                state = plus(&start, nothing, &rates);
            }
            state
        });
    });
    by_powers::<2, _>(&mut group, "two powers", &start, kernel);
    by_powers::<6, _>(&mut group, "six powers", &start, kernel);
    group.bench_function("step", |bencher| {
        bencher.iter(|| {
            let mut state = start;
            for _ in 0..STEPS {
                let _ = black_box(stepper.step(&mut state, STEP));
            }
            state
        });
    });
    group.finish();
}

/// Steps whose pairs are turned by so many powers of the angle.
fn by_powers<const POWERS: usize, X: Turned>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    start: &X,
    kernel: impl Fn(&X, &mut X) + Copy,
) {
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let mut state = start.clone();
            for _ in 0..STEPS {
                unusable_step::<POWERS, X>(&mut state, kernel);
            }
            state
        });
    });
}

/// An increment, all elements taken as numbers.
#[inline(always)]
fn plus<X: Vector<f64>>(state: &X, factor: f64, rates: &X) -> X {
    state.zip(rates, |x, rate| rate.mul_add(factor, x))
}

/// A state whose pairs can be turned by a series of so many powers.
trait Turned: Vector<f64> {
    fn turned<const POWERS: usize>(&self, factor: f64, rates: &Self) -> Self;
}

impl<const T: usize, const Q: usize, const U: usize, const A: usize> Turned
    for JointState<f64, T, Q, U, A>
{
    #[inline(always)]
    fn turned<const POWERS: usize>(&self, factor: f64, rates: &Self) -> Self {
        let mut next = plus(self, factor, rates);
        let places = next.pairs_mut().iter_mut().zip(self.pairs());
        for ((next, &[c, s]), [rate, _]) in places.zip(rates.pairs()) {
            let angle = factor * rate;
            let square = angle * angle;
            let element = |p: f64, n: f64| {
                let term = |even: f64, odd: f64| angle.mul_add(p * even, n * odd);
                let mut way = angle.mul_add(-0.5 * p, n);
                if POWERS == 6 {
                    let five = term(-1.0 / 720.0, 1.0 / 120.0);
                    let three = square.mul_add(five, term(1.0 / 24.0, -1.0 / 6.0));
                    way = square.mul_add(three, way);
                }
                angle.mul_add(way, p)
            };
            *next = [element(c, -s), element(s, c)];
        }
        next
    }
}

/// A step of the classical method that looks at nothing.
#[inline(never)]
fn unusable_step<const POWERS: usize, X: Turned>(state: &mut X, kernel: impl Fn(&X, &mut X)) {
    let plus = X::turned::<POWERS>;
    let (half, third, sixth) = (STEP / 2.0, STEP / 3.0, STEP / 6.0);
    let from = state.clone();
    let mut first = from.clone();
    let mut second = from.clone();
    let mut penultimate = from.clone();
    let mut last = from.clone();
    kernel(&from, &mut first);
    kernel(&plus(&from, half, &first), &mut second);
    kernel(&plus(&from, half, &second), &mut penultimate);
    kernel(&plus(&from, STEP, &penultimate), &mut last);
    // The mean of the slopes, so that the end is one increment as well.
    let others = [(third, &second), (third, &penultimate), (sixth, &last)];
    let mut sum = first.zip(&first, |rate, _| sixth * rate);
    for (weight, slope) in others {
        sum = sum.zip(slope, |sum, rate| rate.mul_add(weight, sum));
    }
    *state = plus(&from, 1.0, &sum);
}

fn sum<const PAIRS: usize>(criterion: &mut Criterion) {
    let state = JointState::from_parts([[1.0, 0.0]; PAIRS], [], [0.0; PAIRS]);
    let slope = JointState::from_parts([[1.0, 0.0]; PAIRS], [], [0.1; PAIRS]);
    let mut group = criterion.benchmark_group("sum of pairs");
    group.bench_function(PAIRS.to_string(), |bencher| {
        bencher.iter(|| black_box(&state).plus([(black_box(1e-3), black_box(&slope))]));
    });
    group.finish();
}

fn sums(criterion: &mut Criterion) {
    sum::<8>(criterion);
    sum::<11>(criterion);
    sum::<12>(criterion);
    sum::<13>(criterion);
    sum::<14>(criterion);
    sum::<15>(criterion);
    sum::<16>(criterion);
    sum::<17>(criterion);
}

fn scenes(criterion: &mut Criterion) {
    steps::<RodPendulum>(criterion, "steps, pendulum");
    steps::<CartPole>(criterion, "steps, cart-pole");
    steps::<HeavyTop>(criterion, "steps, heavy top");
    steps::<FourBar>(criterion, "steps, four-bar");
    steps::<SliderCrank>(criterion, "steps, slider-crank");
    steps::<SqueezingMechanism>(criterion, "steps, squeezing mechanism");
    steps::<Bricard>(criterion, "steps, Bricard's mechanism");
    steps::<Ur5>(criterion, "steps, UR5");
    steps::<Panda>(criterion, "steps, Panda");
}

criterion_group!(benches, scenes, sums);
criterion_main!(benches);
