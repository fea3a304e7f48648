//! Turns of pairs: accuracy, length, numbers of other types.

use core::f64::consts::{PI, TAU};
use core::ops::{Add, Mul, Neg, Sub};

use super::{JointState, Vector};
use crate::math::scalar::{Real, Scalar};

type Turn<S> = JointState<S, 1, 0, 0>;

fn turn<S>(pair: [S; 2]) -> Turn<S> {
    JointState::from_parts([pair], [], [])
}

/// The pair of an angle, computed in `f64`.
fn pair<S: Scalar>(angle: f64) -> [S; 2] {
    [S::constant(angle.cos()), S::constant(angle.sin())]
}

/// What is missing from the length of a pair to 1.
fn off<S: Real>(state: &Turn<S>) -> f64 {
    let [c, s] = state.pairs()[0].map(S::to_f64);
    c.hypot(s) - 1.0
}

/// By how much (rad) a pair is ahead of an angle.
fn ahead<S: Real>(state: &Turn<S>, angle: f64) -> f64 {
    let [c, s] = state.pairs()[0].map(S::to_f64);
    let (sine, cosine) = angle.sin_cos();
    (s * cosine - c * sine).atan2(c * cosine + s * sine)
}

/// A million turns by one increment: the worst error of the length, of the angle.
fn million<S: Real>(increment: f64) -> (f64, f64) {
    let slope = turn([S::constant(increment), S::zero()]);
    let mut state = turn(pair::<S>(0.25));
    let (mut length, mut angle) = (0.0_f64, 0.0_f64);
    for count in 1..=1_000_000 {
        state = state.plus([(S::one(), &slope)]);
        length = length.max(off(&state).abs());
        if count % 1000 == 0 {
            // Exact: the increments have few digits.
            let whole = increment * f64::from(count);
            angle = angle.max(ahead(&state, whole + 0.25).abs());
        }
    }
    (length, angle)
}

/// Numbers of at most twelve binary digits, below and above the bound of the series, up to ten
/// turns.
const INCREMENTS: [f64; 14] = [
    0.0,
    1.0 / 1_048_576.0,
    0.0009765625,
    0.0625,
    -0.3125,
    0.49609375,
    0.5,
    0.69921875,
    0.8984375,
    0.90625,
    -1.5625,
    3.140625,
    6.28125,
    62.8125,
];

#[test]
fn a_million_turns_keep_the_length_and_the_angle() {
    for increment in INCREMENTS {
        let (length, angle) = million::<f64>(increment);
        assert!(
            length < 4.0 * f64::EPSILON,
            "{increment}: length {length:e}"
        );
        assert!(angle < 1e6 * f64::EPSILON, "{increment}: angle {angle:e}");
        let (length, angle) = million::<f32>(increment);
        let epsilon = f64::from(f32::EPSILON);
        assert!(length < 4.0 * epsilon, "{increment}: length {length:e}");
        assert!(angle < 1e6 * epsilon, "{increment}: angle {angle:e}");
    }
}

#[test]
fn one_turn_is_exact_to_round_off_at_any_angle() {
    fn worst<S: Real>(angle: f64, start: f64) -> f64 {
        let increment = S::constant(angle);
        let slope = turn([S::one(), S::zero()]);
        let from = turn(pair::<S>(start));
        let to = from.plus([(increment, &slope)]);
        assert!(off(&to).abs() < 4.0 * S::EPSILON.to_f64());
        // Turned back to the start as it is represented.
        let [c, s] = to.pairs()[0].map(S::to_f64);
        let [from_c, from_s] = from.pairs()[0].map(S::to_f64);
        let back = turn([c * from_c + s * from_s, s * from_c - c * from_s]);
        ahead(&back, increment.to_f64()).abs()
    }
    let (mut double, mut single) = (0.0_f64, 0.0_f64);
    for place in -4000..=4000 {
        // To 100 rad, and closer together about zero.
        let part = f64::from(place) / 4000.0;
        let angle = 100.0 * part * part * part;
        double = double.max(worst::<f64>(angle, part));
        single = single.max(worst::<f32>(angle, part));
    }
    assert!(double < 4.0 * f64::EPSILON);
    assert!(single < f64::from(2.0 * f32::EPSILON));
}

#[test]
fn series_and_functions_agree_with_all_digits() {
    fn worst<S: Real>(angle: f64) -> [f64; 2] {
        let [[sine, versine]] = S::sines_and_versines(&[S::constant(angle)]);
        let half = 0.5 * S::constant(angle).to_f64();
        let (s, c) = half.sin_cos();
        let relative = |value: S, exact: f64| {
            let error = value.to_f64() - exact;
            if exact == 0.0 { error } else { error / exact }
        };
        [relative(sine, 2.0 * s * c), relative(versine, 2.0 * s * s)].map(f64::abs)
    }
    for place in -2000..=2000 {
        let angle = f64::from(place) / 1000.0;
        for angle in [angle, 1e-3 * angle, 1e-9 * angle] {
            assert!(
                worst::<f64>(angle)
                    .into_iter()
                    .all(|e| e < 3.0 * f64::EPSILON),
                "{angle}"
            );
            let epsilon = f64::from(f32::EPSILON);
            assert!(
                worst::<f32>(angle).into_iter().all(|e| e < 3.0 * epsilon),
                "{angle}"
            );
        }
    }
}

#[test]
fn any_angle_has_its_digits() {
    /// The worst errors of sine and versine, relative to what they are.
    fn worst<S: Real>(angle: f64) -> [f64; 2] {
        let angle = S::constant(angle);
        let [[sine, versine]] = S::sines_and_versines(&[angle]);
        let half = 0.5 * angle.to_f64();
        let (s, c) = half.sin_cos();
        [(sine, 2.0 * s * c), (versine, 2.0 * s * s)]
            .map(|(value, exact)| ((value.to_f64() - exact) / exact).abs())
    }
    let mut most = [[0.0_f64; 2]; 2];
    let mut look = |angle: f64| {
        for (most, worst) in most
            .iter_mut()
            .zip([worst::<f64>(angle), worst::<f32>(angle)])
        {
            for (most, worst) in most.iter_mut().zip(worst) {
                *most = most.max(worst);
            }
        }
    };
    // Over all turns that are taken away, and beyond; near whole quarters, where little is left.
    for place in 1..=9000 {
        let angle = 0.37 * f64::from(place).powf(1.2);
        for angle in [angle, -angle] {
            look(angle);
        }
        let quarters = f64::from(place) * core::f64::consts::FRAC_PI_2;
        for angle in [quarters.next_down(), quarters, -quarters.next_up()] {
            look(angle);
        }
    }
    let [double, single] = most;
    let epsilon = f64::from(f32::EPSILON);
    assert!(
        double[0] < 2.5 * f64::EPSILON && single[0] < 2.0 * epsilon,
        "{most:?}"
    );
    assert!(
        double[1] < 3.5 * f64::EPSILON && single[1] < 3.5 * epsilon,
        "{most:?}"
    );
}

#[test]
fn a_turn_does_not_depend_on_its_neighbours() {
    let pairs = [pair(0.1), pair(-2.0), pair(3.0)];
    let slope = |last: f64| JointState::from_parts([[0.4, 0.0], [-0.02, 0.0], [last, 0.0]], [], []);
    let state: JointState<f64, 3, 0, 0> = JointState::from_parts(pairs, [], []);
    let [a, b, _] = *state.plus([(1.0, &slope(0.1))]).pairs();
    let [c, d, _] = *state.plus([(1.0, &slope(40.0))]).pairs();
    assert_eq!([a, b], [c, d]);
    let lost = state.plus([(1.0, &slope(f64::NAN))]);
    assert_eq!([a, b], [lost.pairs()[0], lost.pairs()[1]]);
    assert!(!lost.is_finite());
}

/// The errors of angle and length of a sum beside a known one, where the known one turns by `near`
/// and the sum by `more` beyond.
fn beside<S: Real>(start: f64, near: f64, more: f64) -> [f64; 2] {
    let number = S::constant;
    let slope = |rate: f64| JointState::from_parts([[number(rate), S::zero()]], [number(3.0)], []);
    let half = number(0.5);
    let from: JointState<S, 1, 1, 0> = JointState::from_parts([pair(start)], [S::one()], []);
    let along = slope(2.0 * near);
    let near_state = from.plus([(half, &along)]);
    let (first, second) = (slope(2.0 * near + 8.0 * more), slope(2.0 * near));
    let terms = [(number(0.125), &first), (number(0.375), &second)];
    let mut to = from;
    to.set_plus_beside((&from, &near_state), (half, &along), terms);
    assert_eq!(to.rest(), from.plus(terms).rest());
    let [c, s] = to.pairs()[0].map(S::to_f64);
    let [from_c, from_s] = from.pairs()[0].map(S::to_f64);
    let back = turn([c * from_c + s * from_s, s * from_c - c * from_s]);
    let [rate, _] = first.pairs()[0];
    // As the slope has it: exact, because the factors are powers of two and their sums.
    let whole = 0.125 * rate.to_f64() + 0.375 * second.pairs()[0][0].to_f64();
    [ahead(&back, whole).abs(), off(&turn(to.pairs()[0])).abs()]
}

#[test]
fn a_sum_beside_a_known_one_is_the_sum() {
    let (mut double, mut single) = (0.0_f64, 0.0_f64);
    for start in [0.0, 0.7, -2.2] {
        for near in INCREMENTS {
            for more in [0.0, 1e-9, -1e-3, 0.0124, -0.0125, 0.0126, 0.3, -2.0] {
                let worst = |errors: [f64; 2]| errors[0].max(errors[1]);
                double = double.max(worst(beside::<f64>(start, near, more)));
                // A rate of single precision has no more digits than its size leaves.
                let digits = near.abs().max(1.0);
                single = single.max(worst(beside::<f32>(start, near, more)) / digits);
            }
        }
    }
    assert!(double < 6.0 * f64::EPSILON, "{double:e}");
    assert!(single < f64::from(4.0 * f32::EPSILON), "{single:e}");
}

#[test]
fn little_turns_beside_do_not_depend_on_their_neighbours() {
    let pairs = [pair(0.1), pair(-2.0), pair(3.0)];
    let slope = |rates: [f64; 3]| JointState::from_parts(rates.map(|rate| [rate, 0.0]), [], []);
    let state: JointState<f64, 3, 0, 0> = JointState::from_parts(pairs, [], []);
    let along = slope([0.4, -0.02, 0.1]);
    let near = state.plus([(1.0, &along)]);
    let to = |last: f64| {
        let slope = slope([0.401, -0.5, last]);
        let mut to = state;
        to.set_plus_beside((&state, &near), (1.0, &along), [(1.0, &slope)]);
        *to.pairs()
    };
    let [a, b, _] = to(0.101);
    for last in [0.2, 40.0, f64::NAN, f64::INFINITY] {
        let [c, d, _] = to(last);
        assert_eq!([a, b], [c, d], "{last}");
    }
    assert!(to(f64::NAN)[2].iter().all(|element| element.is_nan()));
    assert!(to(f64::INFINITY)[2].iter().all(|element| element.is_nan()));
}

/// The worst errors of angle and length of the sum of one slope, once and twice, of a pair and what
/// stands beside it.
fn once_and_twice<S: Real, const T: usize>(start: f64, angle: f64) -> [f64; 2] {
    let number = S::constant;
    let (mut from, mut slope) = ([pair(0.4); T], [[number(0.003), S::zero()]; T]);
    (from[0], slope[0]) = (pair::<S>(start), [number(4.0 * angle), number(9.0)]);
    let slope = JointState::from_parts(slope, [number(3.0)], [number(0.25)]);
    let from = JointState::from_parts(from, [S::one()], [number(2.0)]);
    let mut both = [from; 2];
    let [once, twice] = &mut both;
    once.set_plus_once_and_twice(twice, &from, (number(0.25), &slope));
    let [c, s] = from.pairs()[0].map(S::to_f64);
    let [mut ahead_of, mut off_length] = [0.0_f64; 2];
    for (state, factor) in both.iter().zip([0.25, 0.5]) {
        let sum = from.plus([(number(factor), &slope)]);
        assert_eq!((state.rest(), state.rates()), (sum.rest(), sum.rates()));
        let to = state.pairs()[0].map(S::to_f64);
        let turned = turn([c * to[0] + s * to[1], c * to[1] - s * to[0]]);
        let whole = factor * number(4.0 * angle).to_f64();
        ahead_of = ahead_of.max(ahead(&turned, whole).abs());
        off_length = off_length.max(off(&turn(to)).abs());
    }
    [ahead_of, off_length]
}

#[test]
fn once_and_twice_are_two_sums() {
    let (mut double, mut single) = (0.0_f64, 0.0_f64);
    let little = [
        0.0, 1e-160, -3e-9, 1e-3, 0.0124, -0.0125, 0.0125, 0.0126, 0.02,
    ];
    for start in [0.0, 0.25, -2.2, 3.1] {
        for angle in little.into_iter().chain(INCREMENTS) {
            let size = angle.abs().max(1.0);
            let of_double = [
                once_and_twice::<f64, 1>(start, angle),
                once_and_twice::<f64, 3>(start, angle),
            ];
            let of_single = [
                once_and_twice::<f32, 1>(start, angle),
                once_and_twice::<f32, 3>(start, angle),
            ];
            for error in of_double.into_iter().flatten() {
                double = double.max(error / size);
            }
            for error in of_single.into_iter().flatten() {
                single = single.max(error / size);
            }
        }
    }
    assert!(double < 2.0 * f64::EPSILON, "{double:e}");
    assert!(single < f64::from(2.0 * f32::EPSILON), "{single:e}");
}

#[test]
fn little_turns_keep_the_length_and_find_it_again() {
    // Few digits, so that a million of them are known exactly.
    let increment = 0.009_765_625;
    let slope = turn([increment, 0.0]);
    for error in [0.0, 1e-3, -0.05] {
        let [c, s] = pair::<f64>(0.25);
        let mut state = turn([c * (1.0 + error), s * (1.0 + error)]);
        let (mut length, mut angle) = (0.0_f64, 0.0_f64);
        for count in 1..=1_000_000 {
            let mut twice = state;
            let from = state;
            state.set_plus_once_and_twice(&mut twice, &from, (1.0, &slope));
            if count == 1 {
                // Along the pair and across: the way is as long as the pair that was given.
                let left = -1.5 * error * error - 0.5 * error * error * error;
                let along = 1.0 + left + (1.0 + error) * (increment.cos() - 1.0);
                let across = (1.0 + error) * increment.sin();
                assert!((off(&state) - (along.hypot(across) - 1.0)).abs() < 1e-15);
            }
            if count >= 5 {
                length = length.max(off(&state).abs());
            }
            if count % 1000 == 0 {
                let whole = increment * f64::from(count);
                angle = angle.max(ahead(&state, whole + 0.25).abs());
            }
        }
        assert!(length < 4.0 * f64::EPSILON, "{error}: length {length:e}");
        let bound = 2.0 * increment * error.abs() + 1e6 * f64::EPSILON;
        assert!(angle < bound, "{error}: angle {angle:e}");
    }
}

#[test]
fn terms_are_summed_before_a_pair_turns() {
    let state = JointState::from_parts([pair::<f64>(0.3)], [1.0, 2.0], [3.0]);
    // The second element of a slope's pair is no part of it.
    let first = JointState::from_parts([[1.0, 7.0]], [10.0, 20.0], [30.0]);
    let second = JointState::from_parts([[4.0, f64::NAN]], [-1.0, 0.0], [1.0]);
    let next = state.plus([(0.5, &first), (0.25, &second)]);
    assert_eq!(*next.rest(), [5.75, 12.0]);
    assert_eq!(*next.rates(), [18.25]);
    assert!(ahead(&turn(next.pairs()[0]), 1.8).abs() < 4e-16);
    // Large increments that cancel leave a small one, by the series.
    let back = state.plus([(1e9, &first), (-1e9, &first), (0.25, &first)]);
    assert_eq!(back.pairs(), state.plus([(0.25, &first)]).pairs());
    assert_eq!(state.plus::<0>([]).pairs(), state.pairs());
}

#[test]
fn a_length_that_is_off_comes_back_by_its_square() {
    let slope = turn([0.1, 0.0]);
    for error in [1e-3, -1e-3, 0.1] {
        let [c, s] = pair::<f64>(0.7);
        let state = turn([c * (1.0 + error), s * (1.0 + error)]).plus([(1.0, &slope)]);
        let left = -1.5 * error * error - 0.5 * error * error * error;
        assert!(
            (off(&state) - left).abs() < 1e-4 * left.abs(),
            "{error}: {}",
            off(&state)
        );
    }
}

#[test]
fn what_is_not_finite_is_found() {
    let state: JointState<f64, 1, 1, 1> = JointState::from_parts([pair(0.3)], [1.0], [2.0]);
    assert!(state.is_finite());
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        let zero = JointState::from_parts([[0.0, 0.0]], [0.0], [0.0]);
        let (mut angle, mut rest, mut rate) = (zero, zero, zero);
        angle.pairs_mut()[0][0] = bad;
        rest.rest_mut()[0] = bad;
        rate.rates_mut()[0] = bad;
        for slope in [angle, rest, rate] {
            assert!(!slope.is_finite());
            assert!(!state.plus([(0.1, &slope)]).is_finite());
            assert!(
                !state
                    .weighted_norm(&state, 1e-3, [(0.1, &slope)])
                    .is_finite()
            );
        }
        let mut state = state;
        state.pairs_mut()[0][1] = bad;
        assert!(!state.is_finite());
    }
}

#[test]
fn what_is_not_finite_is_found_at_every_place_of_few_and_of_many() {
    fn at_every_place<S: Real, const T: usize, const Q: usize, const U: usize>() {
        let largest = S::constant(f64::from(f32::MAX));
        let state =
            JointState::<S, T, Q, U>::from_parts([[-largest; 2]; T], [largest; Q], [S::zero(); U]);
        assert!(state.is_finite());
        for place in 0..state.length() {
            for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
                let mut state = state;
                state.set_element(place, S::constant(bad));
                assert!(!state.is_finite(), "{place}");
            }
        }
    }
    at_every_place::<f64, 1, 1, 2>();
    at_every_place::<f64, 2, 0, 2>();
    at_every_place::<f64, 2, 1, 2>();
    at_every_place::<f64, 0, 4, 3>();
    at_every_place::<f64, 7, 6, 13>();
    at_every_place::<f32, 1, 1, 2>();
    at_every_place::<f32, 3, 5, 9>();
}

#[test]
fn increments_of_angles_are_measured_in_radians() {
    let state: JointState<f64, 2, 1, 1> =
        JointState::from_parts([pair(0.3), pair(1e-9)], [-4.0], [1e-6]);
    let other = JointState::from_parts([pair(0.3), pair(1e-9)], [3.0], [2e-6]);
    let slope = |a, b, rest, rate| JointState::from_parts([[a, 9.0], [b, 9.0]], [rest], [rate]);
    let norm = |floor, slope| state.weighted_norm(&other, floor, [(0.5, &slope), (-0.25, &slope)]);
    assert_eq!(norm(1e-3, slope(8.0, -16.0, 0.0, 0.0)), 4.0);
    assert_eq!(norm(1e-3, slope(-16.0, 8.0, 0.0, 0.0)), 4.0);
    assert_eq!(norm(2.0, slope(8.0, -16.0, 0.0, 0.0)), 2.0);
    assert_eq!(norm(1e-3, slope(0.0, 0.0, 32.0, 0.0)), 2.0);
    assert_eq!(norm(0.5, slope(0.0, 0.0, 0.0, -32.0)), 16.0);
}

#[test]
fn the_way_to_another_state_is_along_the_circle() {
    let from: JointState<f64, 1, 1, 0> = JointState::from_parts([pair(3.0)], [1.0], []);
    let to = JointState::from_parts([pair(-2.8)], [3.0], []);
    let gap = TAU - 5.8;
    for turns in [0.0, 1.0, -3.0] {
        // The way is known to less than half a turn.
        for miss in [-0.9 * PI, 0.0, 0.9 * PI] {
            let way = JointState::from_parts([[gap + turns * TAU + miss, 0.0]], [0.0], []);
            let side = JointState::from_parts([[0.125, 0.0]], [7.0], []);
            let state = from.towards(&to, 0.25, [(1.0, &way)], [(2.0, &side)]);
            let angle = 3.0 + 0.25 * (gap + turns * TAU) + 0.25;
            assert!(ahead(&turn(state.pairs()[0]), angle).abs() < 1e-14);
            assert!(off(&turn(state.pairs()[0])).abs() < 4.0 * f64::EPSILON);
            assert_eq!(*state.rest(), [15.5]);
            let end = from.towards(&to, 1.0, [(1.0, &way)], []);
            assert!(ahead(&turn(end.pairs()[0]), -2.8).abs() < 1e-14);
        }
    }
}

#[test]
fn plain_vectors_see_both_elements_of_a_pair() {
    let state = JointState::from_parts([[1.0, 2.0], [3.0, 4.0]], [5.0], [6.0, 7.0]);
    let mut seen = 0.0;
    state.for_each(|element: f64| seen = 10.0 * seen + element);
    assert_eq!(seen, 1_234_567.0);
    let sum = state.zip(&state, |x, y| 10.0 * x + y);
    let expected = JointState::from_parts([[11.0, 22.0], [33.0, 44.0]], [55.0], [66.0, 77.0]);
    assert_eq!(sum, expected);
}

/// Two numbers side by side, without a function of its own for turns.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lanes([f64; 2]);

impl Lanes {
    fn with(self, other: Self, f: fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

macro_rules! lane_by_lane {
    ($($operation:ident, $function:ident;)*) => {$(
        impl $operation for Lanes {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                self.with(other, $operation::$function)
            }
        }
    )*};
}

lane_by_lane! { Add, add; Sub, sub; Mul, mul; }

impl Neg for Lanes {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(f64::neg))
    }
}

impl Scalar for Lanes {
    fn constant(value: f64) -> Self {
        Self([value; 2])
    }
    fn reciprocal(self) -> Self {
        Self(self.0.map(Scalar::reciprocal))
    }
    fn sqrt(self) -> Self {
        Self(self.0.map(Scalar::sqrt))
    }
    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
    fn abs(self) -> Self {
        Self(self.0.map(Scalar::abs))
    }
    fn min(self, other: Self) -> Self {
        self.with(other, Scalar::min)
    }
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        let lane = |k: usize| self.0[k].select(bound.0[k], less.0[k], otherwise.0[k]);
        Self([lane(0), lane(1)])
    }
    fn sin(self) -> Self {
        Self(self.0.map(Scalar::sin))
    }
    fn cos(self) -> Self {
        Self(self.0.map(Scalar::cos))
    }
    fn exp(self) -> Self {
        Self(self.0.map(Scalar::exp))
    }
    fn atan2(self, cosine: Self) -> Self {
        self.with(cosine, Scalar::atan2)
    }
    fn round(self) -> Self {
        Self(self.0.map(Scalar::round))
    }
}

#[test]
fn lanes_turn_each_by_its_own_angle() {
    let angles = [0.3, -2.5];
    let mut state: JointState<Lanes, 1, 0, 1> = JointState::from_parts(
        [[Lanes(angles.map(f64::cos)), Lanes(angles.map(f64::sin))]],
        [],
        [Lanes([1.0, 2.0])],
    );
    // One lane by a small angle, the other by a large one.
    let increments = [0.001, 5.0];
    let slope = JointState::from_parts(
        [[Lanes(increments), Lanes([0.0; 2])]],
        [],
        [Lanes([8.0; 2])],
    );
    for _ in 0..1000 {
        state = state.plus([(Lanes([1.0; 2]), &slope)]);
    }
    for lane in 0..2 {
        let pair = state.pairs()[0].map(|element| element.0[lane]);
        let error = ahead(&turn(pair), angles[lane] + 1000.0 * increments[lane]);
        assert!(error.abs() < 1e-12, "{error:e}");
        assert!(off(&turn(pair)).abs() < 4.0 * f64::EPSILON);
    }
    assert_eq!(*state.rates(), [Lanes([8001.0, 8002.0])]);
    let one = Lanes([1.0; 2]);
    let sum = state.plus([(one, &slope)]);
    let mut beside = state;
    beside.set_plus_beside((&state, &state), (-one, &slope), [(one, &slope)]);
    assert_eq!(beside, sum);
    let back = state.towards(&state, Lanes([0.5; 2]), [], []);
    assert_eq!(back.rates(), state.rates());
}
