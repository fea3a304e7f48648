//! Angles as pairs on a circle against the same angles as numbers.

use super::*;
use crate::state::JointState;
use crate::state::vector::{State, StateParts};

pub(super) type Turned<S, const N: usize> = JointState<S, N, 0, N>;
pub(super) type Plain<S, const N: usize> = State<S, N, N>;

/// Accelerations of angles, from their cosines and sines and from their rates.
pub(super) trait Law<S: Real, const N: usize> {
    fn accelerations(pairs: &[[S; 2]; N], rates: &[S; N]) -> [S; N];
}

/// The law with pairs as state.
pub(super) struct Pairs<L>(L);
/// The law with angles as state.
pub(super) struct Angles<L>(L);

impl<S: Real, const N: usize, L: Law<S, N>> System<S> for Pairs<(L, [S; N])> {
    type State = Turned<S, N>;

    fn rates(&mut self, _time: S, state: &Self::State) -> Result<Self::State, Fault> {
        let pairs = state.rates().map(|rate| [rate, S::zero()]);
        let accelerations = L::accelerations(state.pairs(), state.rates());
        Ok(JointState::from_parts(pairs, [], accelerations))
    }
}

impl<S: Real, const N: usize, L: Law<S, N>> System<S> for Angles<(L, [S; N])> {
    type State = Plain<S, N>;

    fn rates(&mut self, _time: S, state: &Self::State) -> Result<Self::State, Fault> {
        let pairs = state.coordinates().map(|a| [a.cos(), a.sin()]);
        let accelerations = L::accelerations(&pairs, state.velocities());
        Ok(State::from_parts(*state.velocities(), accelerations))
    }
}

/// The pendulum of chapter 15: angle from the horizontal, begun at zero and at rest.
#[derive(Clone, Copy)]
struct Pendulum;

impl<S: Real> Law<S, 1> for Pendulum {
    fn accelerations(&[[cosine, _]]: &[[S; 2]; 1], _: &[S; 1]) -> [S; 1] {
        let mass = 7.02;
        [-S::constant(mass * 9.81 * 0.5 / (0.5855265 + mass * 0.25)) * cosine]
    }
}

/// A pendulum that was pushed so as to go round and round, 2 to 4 rad/s.
#[derive(Clone, Copy)]
pub(super) struct Spinning;

impl<S: Real> Law<S, 1> for Spinning {
    fn accelerations(&[[cosine, _]]: &[[S; 2]; 1], _: &[S; 1]) -> [S; 1] {
        [-S::constant(3.0) * cosine]
    }
}

/// Two rods of 1 kg and 1 m, one on the other: absolute angles from the horizontal.
#[derive(Clone, Copy)]
pub(super) struct Rods;

impl Law<f64, 2> for Rods {
    fn accelerations(&[[c1, s1], [c2, s2]]: &[[f64; 2]; 2], &[w1, w2]: &[f64; 2]) -> [f64; 2] {
        let (cosine, sine) = (c1 * c2 + s1 * s2, s1 * c2 - c1 * s2);
        let (a, b, d) = (4.0 / 3.0, 0.5 * cosine, 1.0 / 3.0);
        let first = -9.81 * 1.5 * c1 - 0.5 * sine * w2 * w2;
        let second = -9.81 * 0.5 * c2 + 0.5 * sine * w1 * w1;
        let determinant = a * d - b * b;
        [
            (d * first - b * second) / determinant,
            (a * second - b * first) / determinant,
        ]
    }
}

pub(super) fn pairs<S: Real, const N: usize, L: Law<S, N>>(law: L) -> Pairs<(L, [S; N])> {
    Pairs((law, [S::zero(); N]))
}

pub(super) fn angles<S: Real, const N: usize, L: Law<S, N>>(law: L) -> Angles<(L, [S; N])> {
    Angles((law, [S::zero(); N]))
}

/// Both states at zero angles.
pub(super) fn starts<S: Real, const N: usize>(rates: [S; N]) -> (Turned<S, N>, Plain<S, N>) {
    let pair = [S::one(), S::zero()];
    (
        JointState::from_parts([pair; N], [], rates),
        State::from_parts([S::zero(); N], rates),
    )
}

/// The end of an integration, and what it has cost.
fn end<S: Real, I: Integrator<S, Y>, Y: System<S>>(
    method: I,
    mut system: Y,
    duration: S,
    state: Y::State,
) -> (Y::State, Counts) {
    let span = TimeSpan {
        start: S::zero(),
        end: duration,
        first_output: duration,
    };
    let mut integration = method.start(&mut system, span, state).unwrap();
    while integration.time() < duration {
        integration.advance(&mut system).unwrap();
    }
    (integration.state().clone(), integration.counts())
}

/// By how much (rad) a pair is ahead of an angle.
fn ahead<S: Real>(pair: [S; 2], angle: f64) -> f64 {
    let [c, s] = pair.map(S::to_f64);
    let (sine, cosine) = angle.sin_cos();
    (s * cosine - c * sine).atan2(c * cosine + s * sine)
}

/// What is missing from the length of a pair to 1.
fn off([c, s]: [f64; 2]) -> f64 {
    c.hypot(s) - 1.0
}

fn tight() -> DormandPrince<f64> {
    DormandPrince::new(Tolerance {
        relative: 1e-13,
        absolute: 1e-15,
    })
}

/// Errors (rad) of the angles after a time: of the pairs, of the numbers, with the worst length of
/// the pairs.
pub(super) fn compared<I, L: Law<f64, N> + Copy, const N: usize>(
    method: I,
    law: L,
    rates: [f64; N],
    duration: f64,
) -> ([f64; N], [f64; N], f64)
where
    I: Integrator<f64, Pairs<(L, [f64; N])>> + Integrator<f64, Angles<(L, [f64; N])>>,
{
    let (turned, plain) = starts(rates);
    let (exact, _) = end(tight(), angles(law), duration, plain);
    let (turned, _) = end(method, pairs(law), duration, turned);
    let (plain, _) = end(method, angles(law), duration, plain);
    let length = turned.pairs().iter().map(|pair| off(*pair).abs());
    (
        core::array::from_fn(|k| ahead(turned.pairs()[k], exact.coordinates()[k])),
        core::array::from_fn(|k| plain.coordinates()[k] - exact.coordinates()[k]),
        length.fold(0.0, f64::max),
    )
}

#[test]
fn runge_kutta_turns_a_pair_as_it_moves_an_angle() {
    let ([turned], [plain], length) = compared(Rk4::every(0.01), Pendulum, [0.0], 10.0);
    assert!((plain.abs() - 2.4e-7).abs() < 0.1e-7, "{plain:e}");
    assert!((turned - plain).abs() < 1e-11, "{turned:e} {plain:e}");
    assert!(length < 4.0 * f64::EPSILON, "{length:e}");
}

#[test]
fn dormand_prince_turns_a_pair_as_it_moves_an_angle() {
    let ([turned], [plain], length) = compared(DormandPrince::every(0.05), Pendulum, [0.0], 10.0);
    assert!(plain.abs() > 1e-8 && plain.abs() < 1e-4, "{plain:e}");
    assert!((turned - plain).abs() < 1e-12, "{turned:e} {plain:e}");
    assert!(length < 4.0 * f64::EPSILON, "{length:e}");
}

#[test]
fn two_rods_are_as_accurate_as_with_angles() {
    for step in [0.01, 0.0025] {
        let (turned, plain, length) = compared(Rk4::every(step), Rods, [0.0; 2], 10.0);
        for (turned, plain) in turned.into_iter().zip(plain) {
            assert!(plain.abs() > 1e-7 && turned.abs() < 1.2 * plain.abs());
        }
        assert!(length < 4.0 * f64::EPSILON, "{length:e}");
    }
}

#[test]
fn the_adaptive_method_keeps_its_tolerance_on_pairs() {
    for relative in [1e-4, 1e-7, 1e-10] {
        let method = DormandPrince::new(Tolerance {
            relative,
            absolute: 1e-3 * relative,
        });
        for speed in [0.0, 4.0] {
            let ([turned], _, length) = compared(method, Spinning, [speed], 10.0);
            assert!(turned.abs() < 300.0 * relative, "{turned:e}");
            assert!(length < 4.0 * f64::EPSILON);
        }
        // A tolerance in radians, not relative to the angle, takes about as many steps.
        let (turned, plain) = starts([4.0]);
        let (_, of_pairs) = end(method, pairs(Spinning), 10.0, turned);
        let (_, of_angles) = end(method, angles(Spinning), 10.0, plain);
        let ratio = of_pairs.accepted as f64 / of_angles.accepted as f64;
        assert!((0.7..1.4).contains(&ratio), "{of_pairs:?} {of_angles:?}");
    }
}

/// Nothing accelerates: every method is exact at any step, and the adaptive one makes it as long as
/// it may.
#[test]
fn a_wheel_turns_by_many_turns_in_a_step() {
    struct Wheel;
    impl Law<f64, 1> for Wheel {
        fn accelerations(_: &[[f64; 2]; 1], _: &[f64; 1]) -> [f64; 1] {
            [0.0]
        }
    }
    fn check<I: Integrator<f64, Pairs<(Wheel, [f64; 1])>>>(method: I) {
        let mut system = pairs(Wheel);
        let (start, _) = starts([100.0]);
        let mut integration = method.start(&mut system, span(10.0, 10.0), start).unwrap();
        while integration.time() < 10.0 {
            let from = integration.time();
            integration.advance(&mut system).unwrap();
            for part in 0..=4 {
                let time = from + 0.25 * f64::from(part) * (integration.time() - from);
                let [pair] = *integration.at(&mut system, time).unwrap().pairs();
                assert!(ahead(pair, 100.0 * time).abs() < 1e-11);
                assert!(off(pair).abs() < 4.0 * f64::EPSILON);
            }
        }
        assert!(integration.counts().accepted < 30);
    }
    check(Rk4::every(0.5));
    check(DormandPrince::every(0.5));
    check(DormandPrince::<f64>::default());
}

/// The worst difference (rad) between angles from pairs and from numbers, at ends of steps and
/// within; the worst error of pairs at ends, and within.
fn within<K>(method: FixedStep<f64, K>, speed: f64) -> [f64; 3]
where
    K: OneStep<f64, Pairs<(Spinning, [f64; 1])>> + OneStep<f64, Angles<(Spinning, [f64; 1])>>,
{
    let (mut of_pairs, mut of_angles) = (pairs(Spinning), angles(Spinning));
    let (turned, plain) = starts([speed]);
    let mut integration = method.start(&mut of_pairs, span(3.0, 3.0), turned).unwrap();
    let mut plain = method.start(&mut of_angles, span(3.0, 3.0), plain).unwrap();
    let mut exact = starts([speed]).1;
    let (mut difference, mut at_ends, mut within, mut reached) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
    while integration.time() < 3.0 {
        let start = integration.time();
        integration.advance(&mut of_pairs).unwrap();
        plain.advance(&mut of_angles).unwrap();
        for part in 1..=6 {
            let time = start + (integration.time() - start) * f64::from(part) / 6.0;
            let state = integration.at(&mut of_pairs, time).unwrap();
            let [angle] = *plain.at(&mut of_angles, time).unwrap().coordinates();
            difference = difference.max(ahead(state.pairs()[0], angle).abs());
            assert!(off(state.pairs()[0]).abs() < 4.0 * f64::EPSILON);
            exact = end(tight(), angles(Spinning), time - reached, exact).0;
            reached = time;
            let error =
                |state: &Turned<f64, 1>| ahead(state.pairs()[0], exact.coordinates()[0]).abs();
            within = within.max(error(&state));
            if part == 6 {
                at_ends = at_ends.max(error(integration.state()));
            }
        }
    }
    [difference, at_ends, within]
}

#[test]
fn orders_and_output_within_steps_are_those_of_the_angle() {
    for speed in [0.0, 4.0] {
        let [coarse, fine] = [0.04, 0.02].map(|step| within(Rk4::every(step), speed));
        assert!(coarse[0] < 1e-13 && fine[0] < 1e-13, "{coarse:?} {fine:?}");
        for place in [1, 2] {
            let order = order((coarse[place], fine[place]));
            assert!((order - 4.0).abs() < 0.15, "{order}: {coarse:?} {fine:?}");
        }
        let [coarse, fine] = [0.05, 0.025].map(|step| within(DormandPrince::every(step), speed));
        assert!(coarse[0] < 1e-13 && fine[0] < 1e-13, "{coarse:?} {fine:?}");
        for place in [1, 2] {
            let order = order((coarse[place], fine[place]));
            assert!((order - 5.0).abs() < 0.4, "{order}: {coarse:?} {fine:?}");
        }
    }
}

#[test]
fn single_precision_keeps_its_digits() {
    let (turned, plain) = starts::<f32, 1>([0.0]);
    let (exact, _) = end(tight(), angles(Pendulum), 10.0, starts([0.0]).1);
    let (turned, _) = end(Rk4::every(0.01_f32), pairs(Pendulum), 10.0, turned);
    let (plain, _) = end(Rk4::every(0.01_f32), angles(Pendulum), 10.0, plain);
    let [pair] = *turned.pairs();
    let error = ahead(pair, exact.coordinates()[0]).abs();
    let of_angle = (f64::from(plain.coordinates()[0]) - exact.coordinates()[0]).abs();
    assert!(error < 1e-4, "{error:e} {of_angle:e}");
    assert!((pair[0].hypot(pair[1]) - 1.0).abs() < 4.0 * f32::EPSILON);
}
