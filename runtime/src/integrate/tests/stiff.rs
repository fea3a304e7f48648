//! Implicit methods on equations with known solutions, stiff ones among them.

use std::boxed::Box;
use std::vec;
use std::vec::Vec;

use super::{Moves, curve, curved, distance, equation, span};
use crate::error::{Fault, StartFault, StepFault};
use crate::integrate::{
    Advance as _, Bdf, Counts, Integration as _, Integrator, RadauIIA, System, Tolerance,
};
use crate::state::joint_state::JointState;
use crate::state::vector::Vector;

fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        relative,
        absolute: 1e-3 * relative,
    }
}

fn radau(relative: f64) -> RadauIIA<f64> {
    RadauIIA::new(tolerance(relative))
}

fn bdf(relative: f64) -> Bdf<f64> {
    Bdf::new(tolerance(relative))
}

/// Counts, and the largest error at and within steps.
fn run(method: impl Moves<2>) -> (Counts, f64, f64) {
    let mut system = equation(curved);
    let mut integration = method
        .start(&mut system, span(5.0, 5.0), curve(0.0))
        .unwrap();
    let (mut at_ends, mut within) = (0.0_f64, 0.0_f64);
    while integration.time() < 5.0 {
        let start = integration.time();
        integration.advance(&mut system).unwrap();
        at_ends = at_ends.max(distance(*integration.state(), curve(integration.time())));
        for part in [0.1, 0.4, 0.7] {
            let time = start + part * (integration.time() - start);
            within = within.max(distance(
                integration.at(&mut system, time).unwrap(),
                curve(time),
            ));
        }
    }
    (integration.counts(), at_ends, within)
}

#[test]
fn radau_has_order_five_at_and_within_steps() {
    let (few, coarse, coarse_within) = run(radau(1e-5));
    let (many, fine, fine_within) = run(radau(1e-9));
    let ratio = (many.accepted as f64 / few.accepted as f64).ln();
    let order = (coarse / fine).ln() / ratio;
    assert!(
        (4.5..6.0).contains(&order),
        "{few:?} {coarse:e} {many:?} {fine:e}"
    );
    let within = (coarse_within / fine_within).ln() / ratio;
    assert!(
        (4.5..6.0).contains(&within),
        "{coarse_within:e} {fine_within:e}"
    );
    assert!(
        fine < 1e-9 && fine_within < 1e-9,
        "{fine:e} {fine_within:e}"
    );
}

#[test]
fn backward_differentiation_keeps_its_tolerance_at_and_within_steps() {
    for relative in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let (counts, at_ends, within) = run(bdf(relative));
        let worst = at_ends.max(within);
        assert!(worst < 300.0 * relative, "{worst:e} at {relative:e}");
        // As many as order 5 needs, and those in which the order rises.
        let steps = 12.0 * relative.powf(-1.0 / 5.0) + 30.0;
        assert!(
            (counts.accepted as f64) < steps,
            "{counts:?} at {relative:e}"
        );
    }
}

fn evaluations_are_counted(method: impl Moves<2>) {
    let mut calls = 0;
    let mut system = equation(|time, state: &[f64; 2]| {
        calls += 1;
        curved(time, state)
    });
    let mut integration = method
        .start(&mut system, span(5.0, 5.0), curve(0.0))
        .unwrap();
    while integration.time() < 5.0 {
        integration.advance(&mut system).unwrap();
    }
    assert_eq!(integration.time(), 5.0);
    let counts = integration.counts();
    drop((integration, system));
    assert_eq!(counts.evaluations, calls);
}

#[test]
fn evaluations_are_counted_those_of_a_jacobian_with_them() {
    evaluations_are_counted(radau(1e-6));
    evaluations_are_counted(bdf(1e-6));
}

/// `y'' = ((1 - y^2) y' - y) / eps`, and the values at 1 and 2 of the test set of Hairer and
/// Wanner.
fn van_der_pol(time: f64, &[y, rate]: &[f64; 2]) -> [f64; 2] {
    let _ = time;
    [rate, ((1.0 - y * y) * rate - y) * 1e6]
}

/// Three reactions of rates 0.04, 1e4 and 3e7.
fn robertson(time: f64, &[a, b, c]: &[f64; 3]) -> [f64; 3] {
    let _ = time;
    let (first, second) = (0.04 * a - 1e4 * b * c, 3e7 * b * b);
    [-first, first - second, second]
}

fn relaxation(method: impl Moves<2>, asked: f64, most: Counts) {
    let mut system = equation(van_der_pol);
    let mut integration = method
        .start(&mut system, span(2.0, 2.0), [2.0, -0.66])
        .unwrap();
    let mut at_one = None;
    while integration.time() < 2.0 {
        integration.advance(&mut system).unwrap();
        if integration.time() >= 1.0 && at_one.is_none() {
            at_one = Some(integration.at(&mut system, 1.0).unwrap());
        }
    }
    let known = [
        (
            at_one.unwrap(),
            [-1.863_646_254_808_13, 0.753_543_086_543_546],
        ),
        (
            *integration.state(),
            [1.706_167_732_170_456, -0.892_809_701_024_825_7],
        ),
    ];
    for (state, known) in known {
        assert!(distance(state, known) < asked, "{state:?} {known:?}");
    }
    let counts = integration.counts();
    assert!(
        counts.accepted < most.accepted && counts.evaluations < most.evaluations,
        "{counts:?}"
    );
}

#[test]
fn relaxation_oscillations_come_out_as_published() {
    let even = Tolerance {
        relative: 1e-7,
        absolute: 1e-7,
    };
    let most = |accepted, evaluations| Counts {
        accepted,
        evaluations,
        rejected: 0,
    };
    relaxation(RadauIIA::new(even), 1e-4, most(1000, 8000));
    relaxation(Bdf::new(even), 1e-3, most(3000, 6000));
}

fn slow_reactions(method: impl Moves<3>, accepted: usize) {
    let mut system = equation(robertson);
    let mut integration = method
        .start(&mut system, span(40.0, 0.4), [1.0, 0.0, 0.0])
        .unwrap();
    while integration.time() < 40.0 {
        integration.advance(&mut system).unwrap();
    }
    let known = [
        0.715_827_068_719_394,
        9.185_534_764_557_338e-6,
        0.284_163_745_745_841_3,
    ];
    for (value, known) in integration.state().iter().zip(known) {
        assert!((value / known - 1.0).abs() < 1e-6, "{value} {known}");
    }
    let counts = integration.counts();
    assert!(counts.accepted < accepted, "{counts:?}");
}

#[test]
fn slow_reactions_are_not_held_up_by_fast_ones() {
    let fine = Tolerance {
        relative: 1e-8,
        absolute: 1e-12,
    };
    slow_reactions(RadauIIA::new(fine), 150);
    slow_reactions(Bdf::new(fine), 400);
}

/// A pendulum `angle'' = -sin(angle)` whose angle is held by a stiff, heavily damped spring to a
/// second one on its circle.
struct Pair;

impl System<f64> for Pair {
    type State = JointState<f64, 2, 0, 2>;

    fn rates(&mut self, _: f64, state: &Self::State) -> Result<Self::State, Fault> {
        let ([[c, s], [d, t]], [u, v]) = (*state.pairs(), *state.rates());
        let twist = (s * d - c * t).atan2(c * d + s * t);
        let moment = 1e8 * twist + 1e5 * (u - v);
        Ok(JointState::from_parts(
            [[u, 0.0], [v, 0.0]],
            [],
            [-s - moment, -t + moment],
        ))
    }
}

fn angles_turn(method: impl Integrator<f64, Pair>, (asked, accepted): (f64, usize)) {
    // Beyond the top, so that angles count turns.
    let start = JointState::from_parts([[1.0, 0.0]; 2], [], [2.5; 2]);
    let mut integration = method.start(&mut Pair, span(20.0, 20.0), start).unwrap();
    while integration.time() < 20.0 {
        let from = integration.time();
        integration.advance(&mut Pair).unwrap();
        let middle = integration
            .at(&mut Pair, 0.5 * (from + integration.time()))
            .unwrap();
        for state in [*integration.state(), middle] {
            let [[c, s], _] = *state.pairs();
            let [u, _] = *state.rates();
            let gain = (0.5 * u * u - c - 2.125).abs();
            assert!(gain < asked, "{gain:e} at {}", integration.time());
            assert!((c * c + s * s - 1.0).abs() < 1e-14);
        }
    }
    let counts = integration.counts();
    assert!(counts.accepted < accepted, "{counts:?}");
}

#[test]
fn angles_on_a_circle_turn_in_implicit_steps() {
    angles_turn(radau(1e-9), (1e-6, 600));
    angles_turn(bdf(1e-9), (1e-5, 6000));
}

fn replaced(method: impl Moves<1>) {
    let mut system = equation(|_: f64, &[y]: &[f64; 1]| [-1e4 * (y - 1.0)]);
    let mut integration = method.start(&mut system, span(1.0, 1.0), [1.0]).unwrap();
    while integration.time() < 1.0 {
        integration.advance(&mut system).unwrap();
        integration.replace([1.001]);
        assert_eq!(*integration.state(), [1.001]);
    }
    let mut integration = method.start(&mut system, span(1.0, 1.0), [1.001]).unwrap();
    for _ in 0..20 {
        integration.advance(&mut system).unwrap();
        let (time, [state]) = (integration.time(), *integration.state());
        let error = (state - 1.0 - 1e-3 * (-1e4 * time).exp()).abs();
        assert!(error < 3e-8, "{error:e} at {time:e}");
    }
}

#[test]
fn a_state_that_is_replaced_is_gone_on_from() {
    replaced(radau(1e-8));
    replaced(bdf(1e-8));
}

/// A motion that is corrected after every step, here onto `|state| = 1`.
fn corrected(method: impl Moves<2>, asked: f64) {
    let mut system = equation(|_: f64, &[x, y]: &[f64; 2]| [-y, x]);
    let mut integration = method
        .start(&mut system, span(10.0, 10.0), [1.0, 0.0])
        .unwrap();
    while integration.time() < 10.0 {
        integration.advance(&mut system).unwrap();
        let [x, y] = *integration.state();
        let length = x.hypot(y);
        integration.replace([x / length, y / length]);
    }
    let error = distance(*integration.state(), [10.0_f64.cos(), 10.0_f64.sin()]);
    assert!(error < asked, "{error:e}");
}

#[test]
fn corrections_after_steps_do_no_harm() {
    corrected(radau(1e-8), 1e-6);
    corrected(bdf(1e-8), 3e-6);
}

/// Rates that are not finite from 0.5 on, and whether it says why.
struct Hole(bool);

const WHY: Fault = Fault::Step(StepFault::ZeroOrientation { body: "rod" });

impl System<f64> for Hole {
    type State = [f64; 1];

    fn rates(&mut self, time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
        match time > 0.5 {
            true if self.0 => Err(WHY),
            true => Err(Fault::Step(StepFault::StateNotFinite)),
            false => Ok([-state[0]]),
        }
    }

    fn stage(&mut self, time: f64, state: &[f64; 1], rates: &mut [f64; 1]) -> Result<(), Fault> {
        *rates = if time > 0.5 { [f64::NAN] } else { [-state[0]] };
        Ok(())
    }
}

fn held_up(method: impl Integrator<f64, Hole>) {
    for told in [true, false] {
        let mut system = Hole(told);
        let mut integration = method.start(&mut system, span(1.0, 1.0), [1.0]).unwrap();
        let fault = loop {
            if let Err(fault) = integration.advance(&mut system) {
                break fault;
            }
        };
        assert_eq!(
            fault,
            if told {
                WHY
            } else {
                Fault::Step(StepFault::StateNotFinite)
            }
        );
        assert!(integration.time() <= 0.5 && integration.time() > 0.5 - 1e-12);
        assert!((integration.state()[0] - (-integration.time()).exp()).abs() < 1e-6);
    }
}

#[test]
fn what_cannot_be_gone_on_from_is_told_and_the_last_state_kept() {
    held_up(radau(1e-8));
    held_up(bdf(1e-8));
}

fn single_precision(method: impl Moves<1, f32>) {
    let mut system = equation(|time: f32, &[y]: &[f32; 1]| [-1e4 * (y - time.cos()) - time.sin()]);
    let span = crate::integrate::TimeSpan {
        start: 0.0,
        end: 3.0,
        first_output: 3.0,
    };
    let mut integration = method.start(&mut system, span, [2.0]).unwrap();
    while integration.time() < 3.0 {
        integration.advance(&mut system).unwrap();
    }
    assert!((integration.state()[0] - 3.0_f32.cos()).abs() < 1e-3);
    assert!(
        integration.counts().accepted < 100,
        "{:?}",
        integration.counts()
    );
}

/// A state of a user's own kind, with the three functions that a [`Vector`] must have.
#[derive(Clone)]
struct Three(Box<[f64; 3]>);

impl Vector<f64> for Three {
    type Each<T: Clone> = Vec<T>;

    fn zip(&self, other: &Self, mut f: impl FnMut(f64, f64) -> f64) -> Self {
        Self(Box::new(core::array::from_fn(|k| f(self.0[k], other.0[k]))))
    }

    fn for_each(&self, f: impl FnMut(f64)) {
        self.0.iter().copied().for_each(f);
    }

    fn each<T: Clone>(&self, value: T) -> Vec<T> {
        vec![value; 3]
    }
}

/// The same reactions in such a state.
struct Boxed;

impl System<f64> for Boxed {
    type State = Three;

    fn rates(&mut self, time: f64, state: &Three) -> Result<Three, Fault> {
        Ok(Three(Box::new(robertson(time, &state.0))))
    }
}

#[test]
fn states_of_ones_own_kind_move_as_arrays_do() {
    fn moves(method: impl Moves<3> + Integrator<f64, Boxed>) {
        let span = span(40.0, 0.4);
        let mut array = equation(robertson);
        let mut plain = method.start(&mut array, span, [1.0, 0.0, 0.0]).unwrap();
        let start = Three(Box::new([1.0, 0.0, 0.0]));
        let mut own = method.start(&mut Boxed, span, start).unwrap();
        while plain.time() < 40.0 {
            plain.advance(&mut array).unwrap();
            own.advance(&mut Boxed).unwrap();
            assert_eq!(own.time(), plain.time());
            assert_eq!(*own.state().0, *plain.state());
        }
    }
    moves(radau(1e-6));
    moves(bdf(1e-6));
}

#[test]
fn numbers_of_single_precision_do() {
    let coarse = Tolerance {
        relative: 1e-4,
        absolute: 1e-5,
    };
    single_precision(RadauIIA::new(coarse));
    single_precision(Bdf::new(coarse));
}

#[test]
fn settings_that_are_none_are_refused() {
    for relative in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let mut system = equation(curved);
        let span = span(1.0, 1.0);
        let of_radau = radau(relative).start(&mut system, span, curve(0.0));
        let of_bdf = bdf(relative).start(&mut system, span, curve(0.0));
        for fault in [of_radau.err(), of_bdf.err()] {
            let is_named = matches!(
                fault,
                Some(Fault::Start(StartFault::Setting {
                    name: "relative tolerance",
                    ..
                }))
            );
            assert!(is_named, "{fault:?}");
        }
    }
}
