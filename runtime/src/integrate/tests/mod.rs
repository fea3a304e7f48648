//! Order, counts and failures of the integrators on equations with closed solutions.

mod adams;
mod adams_fixed;
mod embedded;
mod failures;
mod implicit;
mod pairs;
mod stiff;
mod tableaus;

use std::boxed::Box;

use super::*;
use crate::math::scalar::Real;

/// An equation from a closure.
struct Equation<'a, S, const N: usize>(Law<'a, S, N>);

type Law<'a, S, const N: usize> = Box<dyn FnMut(S, &[S; N]) -> [S; N] + 'a>;

impl<S: Real, const N: usize> System<S> for Equation<'_, S, N> {
    type State = [S; N];

    fn rates(&mut self, time: S, state: &[S; N]) -> Result<[S; N], Fault> {
        Ok((self.0)(time, state))
    }
}

fn equation<'a, S: Real, const N: usize>(
    rates: impl FnMut(S, &[S; N]) -> [S; N] + 'a,
) -> Equation<'a, S, N> {
    Equation(Box::new(rates))
}

/// What moves every such equation.
trait Moves<const N: usize, S: Real = f64>: for<'a> Integrator<S, Equation<'a, S, N>> {}

impl<const N: usize, S: Real, I> Moves<N, S> for I where I: for<'a> Integrator<S, Equation<'a, S, N>>
{}

/// `y' = y cos t`, `z' = -2 t z^2`: `y = exp(sin t)`, `z = 1 / (1 + t^2)`.
fn curved(time: f64, &[y, z]: &[f64; 2]) -> [f64; 2] {
    [y * time.cos(), -2.0 * time * z * z]
}

fn curve(time: f64) -> [f64; 2] {
    [time.sin().exp(), 1.0 / (1.0 + time * time)]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

fn span(end: f64, first_output: f64) -> TimeSpan<f64> {
    TimeSpan {
        start: 0.0,
        end,
        first_output,
    }
}

/// The largest error at the ends of steps and at five times within each.
fn errors<I: Moves<2>>(method: I) -> (f64, f64) {
    let mut system = equation(curved);
    let mut integration = method
        .start(&mut system, span(2.0, 2.0), curve(0.0))
        .unwrap();
    let (mut at_ends, mut within) = (0.0_f64, 0.0_f64);
    while integration.time() < 2.0 {
        let start = integration.time();
        integration.advance(&mut system).unwrap();
        at_ends = at_ends.max(distance(*integration.state(), curve(integration.time())));
        for part in 1..6 {
            let time = start + (integration.time() - start) * f64::from(part) / 6.0;
            let state = integration.at(&mut system, time).unwrap();
            within = within.max(distance(state, curve(time)));
        }
    }
    (at_ends, within)
}

fn order((coarse, fine): (f64, f64)) -> f64 {
    (coarse / fine).log2()
}

#[test]
fn runge_kutta_has_order_four_at_and_within_steps() {
    let (coarse, fine) = (errors(Rk4::every(0.02)), errors(Rk4::every(0.01)));
    assert!(
        (order((coarse.0, fine.0)) - 4.0).abs() < 0.1,
        "{coarse:?} {fine:?}"
    );
    assert!(
        (order((coarse.1, fine.1)) - 4.0).abs() < 0.1,
        "{coarse:?} {fine:?}"
    );
}

#[test]
fn dormand_prince_has_order_five_and_an_interpolant_of_order_four() {
    let coarse = errors(DormandPrince::every(0.04));
    let fine = errors(DormandPrince::every(0.02));
    // The leading coefficients of the error are small: the next order shows.
    let order_at_ends = order((coarse.0, fine.0));
    assert!((4.8..5.4).contains(&order_at_ends), "{coarse:?} {fine:?}");
    // The error of the free interpolant within a step is of order h^5, as that of the steps
    // together.
    assert!(order((coarse.1, fine.1)) > 4.5, "{coarse:?} {fine:?}");
}

#[test]
fn the_fixed_step_ends_at_the_end() {
    let mut system = equation(curved);
    let mut integration = Rk4::every(0.3)
        .start(&mut system, span(1.0, 1.0), curve(0.0))
        .unwrap();
    while integration.time() < 1.0 {
        integration.advance(&mut system).unwrap();
    }
    assert_eq!(integration.time(), 1.0);
    assert_eq!(
        integration.counts(),
        Counts {
            evaluations: 16,
            accepted: 4,
            rejected: 0
        }
    );
    assert!(distance(*integration.state(), curve(1.0)) < 1e-3);
}

#[test]
fn single_steps_agree_with_a_course() {
    let mut system = equation(curved);
    let mut integration = DormandPrince::every(0.25)
        .start(&mut system, span(1.0, 1.0), curve(0.0))
        .unwrap();
    let mut state = curve(0.0);
    for step in 0..4 {
        integration.advance(&mut system).unwrap();
        DormandPrince5
            .step(&mut system, 0.25 * f64::from(step), &mut state, 0.25)
            .unwrap();
        assert_eq!(*integration.state(), state);
    }
    assert_eq!(integration.counts().evaluations, 24);
}

#[test]
fn the_adaptive_method_counts_six_evaluations_a_trial_and_one() {
    let tolerance = Tolerance {
        relative: 1e-6,
        absolute: 1e-9,
    };
    let mut calls = 0;
    // A pulse that the step control notices late: some trials are rejected.
    let mut system = equation(|time: f64, &[y]: &[f64; 1]| {
        calls += 1;
        [-y + 50.0 * (-200.0 * (time - 3.0) * (time - 3.0)).exp()]
    });
    let integrator = DormandPrince::new(tolerance);
    let mut integration = integrator
        .start(&mut system, span(10.0, 10.0), [1.0])
        .unwrap();
    while integration.time() < 10.0 {
        integration.advance(&mut system).unwrap();
    }
    let Counts {
        evaluations,
        accepted,
        rejected,
    } = integration.counts();
    assert!(rejected > 2);
    assert_eq!(evaluations, 6 * (accepted + rejected) + 1);
    drop(system);
    assert_eq!(evaluations, calls);
}

#[test]
fn the_first_step_is_that_of_ode45() {
    let mut times = [0.0; 16];
    let mut calls = 0;
    let mut system = equation(|time: f64, &[y]: &[f64; 1]| {
        if let Some(place) = times.get_mut(calls) {
            *place = time;
        }
        calls += 1;
        [-100.0 * y]
    });
    let integrator = DormandPrince::new(Tolerance {
        relative: 1e-6,
        absolute: 1e-9,
    });
    let mut integration = integrator
        .start(&mut system, span(10.0, 0.02), [1.0])
        .unwrap();
    integration.advance(&mut system).unwrap();
    // 0.8 rtol^(1/5) / 100, at the sixth stage.
    let expected = 0.8 * 1e-6_f64.powf(0.2) / 100.0;
    drop(system);
    assert!((times[5] - expected).abs() < 1e-17);
}

#[test]
fn the_adaptive_method_keeps_its_tolerance() {
    for relative in [1e-4, 1e-7, 1e-10] {
        let integrator = DormandPrince::new(Tolerance {
            relative,
            absolute: 1e-3 * relative,
        });
        let mut system = equation(curved);
        let mut integration = integrator
            .start(&mut system, span(5.0, 5.0), curve(0.0))
            .unwrap();
        let mut worst = 0.0_f64;
        while integration.time() < 5.0 {
            let start = integration.time();
            integration.advance(&mut system).unwrap();
            let middle = 0.5 * (start + integration.time());
            worst = worst.max(distance(
                integration.at(&mut system, middle).unwrap(),
                curve(middle),
            ));
            worst = worst.max(distance(*integration.state(), curve(integration.time())));
        }
        assert_eq!(integration.time(), 5.0);
        assert!(worst < 30.0 * relative, "{worst:e} at {relative:e}");
    }
}

#[test]
fn single_precision_works_with_a_tolerance_beyond_its_digits() {
    let integrator = DormandPrince::new(Tolerance {
        relative: 1e-9_f32,
        absolute: 1e-9,
    });
    let mut system = equation(|_: f32, &[y]: &[f32; 1]| [-y]);
    let span = TimeSpan {
        start: 0.0,
        end: 1.0,
        first_output: 1.0,
    };
    let mut integration = integrator.start(&mut system, span, [1.0]).unwrap();
    while integration.time() < 1.0 {
        integration.advance(&mut system).unwrap();
    }
    assert!((integration.state()[0] - (-1.0_f32).exp()).abs() < 1e-5);
}

/// Over a tenth of an interval: no step is longer than a tenth of the whole by default.
#[test]
fn a_part_of_an_interval_has_the_steps_of_the_whole() {
    fn longest<I: Moves<1>>(method: I) -> [f64; 2] {
        [method, method.for_duration(10.0)].map(|method| {
            let mut system = equation(|_: f64, _: &[f64; 1]| [1.0]);
            let mut integration = method.start(&mut system, span(1.0, 1.0), [0.0]).unwrap();
            let (mut time, mut longest) = (0.0, 0.0_f64);
            while time < 1.0 {
                integration.advance(&mut system).unwrap();
                longest = longest.max(integration.time() - time);
                time = integration.time();
            }
            longest
        })
    }
    let tolerance = Tolerance::default();
    let pair = DormandPrince::new(tolerance);
    for [of_part, of_whole] in [longest(pair), longest(RadauIIA::new(tolerance))] {
        assert!(of_part < 0.11 && of_whole > 0.3, "{of_part} {of_whole}");
    }
    let [_, of_whole] = longest(pair.largest_step(0.2));
    assert!(of_whole < 0.21, "{of_whole}");
}

#[test]
fn a_replaced_state_is_evaluated_anew() {
    let mut system = equation(|_: f64, &[y]: &[f64; 1]| [-y]);
    let mut integration = DormandPrince::<f64>::default()
        .start(&mut system, span(1.0, 0.1), [1.0])
        .unwrap();
    integration.advance(&mut system).unwrap();
    let evaluations = integration.counts().evaluations;
    integration.replace([2.0]);
    let start = integration.time();
    integration.advance(&mut system).unwrap();
    assert_eq!(integration.counts().evaluations, evaluations + 7);
    assert!((integration.state()[0] - 2.0 * (start - integration.time()).exp()).abs() < 1e-6);
}

/// Problem C03: a step of RK4 at a constant angular velocity multiplies `|p|^2` by
/// `1 - z^6/72 + z^8/576`.
#[test]
fn euler_parameters_lose_length_at_the_known_rate() {
    for (speed, drift) in [
        (10.0, -2.170_132_1e-12),
        (100.0, -2.169_458_367e-6),
        (1000.0, -0.877_854_591),
    ] {
        let half = 0.5 * speed;
        let mut system =
            equation(|_, &[a, b, c, d]: &[f64; 4]| [-half * b, half * a, half * d, -half * c]);
        let (mut p, step) = ([0.6, 0.0, 0.8, 0.0], 1e-3);
        let z: f64 = half * step;
        let factor = 1.0 - z.powi(6) / 72.0 + z.powi(8) / 576.0;
        let mut expected = 1.0;
        for index in 0..10_000 {
            Rk4.step(&mut system, step * f64::from(index), &mut p, step)
                .unwrap();
            expected *= factor;
        }
        let square: f64 = p.iter().map(|e| e * e).sum();
        assert!((square - expected).abs() < 2e-12, "{square} {expected}");
        assert!((square - 1.0 - drift).abs() < 2e-12 + 1e-9 * drift.abs());
    }
}

#[test]
fn the_cubic_of_plain_vectors_is_one_sum() {
    let value = |k: usize| (1.0 + k as f64).sqrt().sin();
    let vector = |place: usize| -> [f64; 5] { core::array::from_fn(|k| value(5 * place + k)) };
    let [from, to, first, last] = core::array::from_fn(vector);
    for part in 0..=64 {
        let theta = f64::from(part) / 64.0 * 0.9;
        let step = 0.37;
        let record = StepRecord {
            step,
            from: &from,
            first: &first,
            stages: &(),
            to: &to,
            last: &last,
        };
        let rest = 1.0 - theta;
        let weight = theta * theta * (3.0 - theta - theta);
        let bend = step * theta * rest;
        let expected = from.plus([
            (-weight, &from),
            (weight, &to),
            (bend * rest, &first),
            (-(bend * theta), &last),
        ]);
        assert_eq!(dense::cubic(&record, theta), expected);
    }
}

#[test]
fn midpoint_and_heun_have_order_two_at_and_within_steps() {
    for [coarse, fine] in [
        [errors(Midpoint::every(0.02)), errors(Midpoint::every(0.01))],
        [errors(Heun::every(0.02)), errors(Heun::every(0.01))],
    ] {
        let orders = [order((coarse.0, fine.0)), order((coarse.1, fine.1))];
        assert!(
            orders.iter().all(|order| (order - 2.0).abs() < 0.1),
            "{orders:?}"
        );
    }
}

/// With `z` half the angle of a step, both multiply `|p|^2` by `1 + z^4 / 4`, and semi-implicit
/// Euler, where velocities stay, by `1 + z^2`.
#[test]
fn euler_parameters_gain_length_by_methods_of_low_order() {
    let half = 5.0;
    let mut system =
        equation(|_, &[a, b, c, d]: &[f64; 4]| [-half * b, half * a, half * d, -half * c]);
    let z: f64 = half * 0.05;
    let [mut first, mut second] = [[0.6, 0.0, 0.8, 0.0]; 2];
    Midpoint.step(&mut system, 0.0, &mut first, 0.05).unwrap();
    Heun.step(&mut system, 0.0, &mut second, 0.05).unwrap();
    for p in [first, second] {
        let square: f64 = p.iter().map(|e| e * e).sum();
        assert!((square - 1.0 - z.powi(4) / 4.0).abs() < 1e-15, "{square}");
    }
}

/// `q'' = -q`.
struct Spring;

impl System<f64> for Spring {
    type State = [f64; 2];

    fn rates(&mut self, _time: f64, &[q, u]: &[f64; 2]) -> Result<[f64; 2], Fault> {
        Ok([u, -q])
    }
}

impl SecondOrder<f64> for Spring {
    fn with_new_velocities(
        &mut self,
        _time: f64,
        state: &[f64; 2],
        step: f64,
        rates: &mut [f64; 2],
    ) {
        rates[0] = state[1] + step * rates[1];
    }
}

/// `q^2 + u^2 - h q u` stays what it is: Hairer, Lubich and Wanner, *Geometric Numerical
/// Integration*, IX.3.
#[test]
fn semi_implicit_euler_keeps_its_energy_and_has_order_one() {
    let at = |step: f64, steps: u32| {
        let mut state = [1.0, 0.0];
        for _ in 0..steps {
            SemiImplicitEuler
                .step(&mut Spring, 0.0, &mut state, step)
                .unwrap();
            let [q, u] = state;
            let energy = q * q + u * u - step * q * u;
            assert!((energy - 1.0).abs() < 1e-12, "{energy}");
        }
        state
    };
    at(0.1, 100_000);
    let error = |[q, u]: [f64; 2]| distance([q, u], [1.0_f64.cos(), -(1.0_f64.sin())]);
    let found = order((error(at(0.01, 100)), error(at(0.005, 200))));
    assert!((found - 1.0).abs() < 0.05, "{found}");
    let mut integration = SemiImplicitEuler::every(0.01)
        .start(&mut Spring, span(1.0, 1.0), [1.0, 0.0])
        .unwrap();
    while integration.time() < 1.0 {
        integration.advance(&mut Spring).unwrap();
    }
    assert!(distance(*integration.state(), at(0.01, 100)) < 1e-14);
    assert_eq!(integration.counts().evaluations, 100);
}
