use super::{Forward, Lifted, by_forward_numbers, with_differences};
use crate::math::scalar::{Real, Scalar};
use crate::math::side::{above, below, side};
use crate::state::joint_state::JointState;
use crate::state::vector::Vector;

type Two = Forward<f64, 2>;

/// Derivatives along the argument and along three times the argument, against a central difference.
#[track_caller]
fn agrees(function: impl Fn(Two) -> Two, at: f64) {
    const STEP: f64 = 1e-6;
    let value = |x: f64| function(Two::fixed(x)).value();
    let exact = function(Two::new(at, [1.0, 3.0]));
    let difference = (value(at + STEP) - value(at - STEP)) / (2.0 * STEP);
    let [once, threefold] = exact.derivatives();
    assert_eq!(exact.value(), value(at));
    assert!(
        (once - difference).abs() < 1e-8 * (1.0 + once.abs()),
        "{once} {difference}"
    );
    assert!(
        (threefold - 3.0 * once).abs() <= 1e-14 * once.abs(),
        "{once} {threefold}"
    );
}

#[test]
fn functions_carry_their_derivatives() {
    let c = Two::constant;
    for at in [-2.8, -1.1, -0.3, 0.2, 0.7, 1.9, 2.7] {
        agrees(|x| x + x * c(2.0) - c(0.5) * x * x, at);
        agrees(|x| -x * x - x, at);
        agrees(Scalar::reciprocal, at);
        agrees(|x| (x * x + c(0.1)).sqrt(), at);
        agrees(|x| (x * x).fused(x, x * c(3.0)), at);
        agrees(|x| x.fused(c(3.0), c(1.0)), at);
        agrees(Scalar::abs, at);
        agrees(|x| (x * x).min(c(1.0) - x), at);
        agrees(|x| (c(1.0) - x).min(x * x), at);
        agrees(|x| x.select(c(0.5), x * x, -x), at);
        agrees(Scalar::sin, at);
        agrees(Scalar::cos, at);
        agrees(Scalar::exp, at);
        agrees(|x| x.sin().atan2(x.cos()), at);
        agrees(|x| (x * x).atan2(x + c(0.5)), at);
        agrees(|x| x.atan2(c(-2.0)), at);
        agrees(Scalar::round, at);
        for angle in [1e-3, 0.4, 1.0] {
            agrees(|x| Two::sines_and_versines(&[c(angle) * x])[0][0], at);
            agrees(|x| Two::sines_and_versines(&[c(angle) * x])[0][1], at);
        }
    }
}

/// Where there is no derivative, that of one side.
#[test]
fn at_bends_one_side_counts() {
    let zero = Two::new(0.0, [1.0, -2.0]);
    assert_eq!(zero.abs(), zero);
    assert_eq!((-zero).abs().derivatives(), [-1.0, 2.0]);
    assert_eq!(zero.min(Two::zero()), Two::zero());
    assert_eq!(zero.select(Two::zero(), Two::one(), zero), zero);
    assert_eq!(Two::new(2.5, [1.0, 1.0]).round(), Two::fixed(3.0));
    let [slope, _] = zero.sqrt().derivatives();
    assert_eq!(slope, f64::INFINITY);
    let [slope, nothing] = Two::new(0.0, [1.0, 0.0]).sqrt().derivatives();
    assert!(slope.is_infinite() && nothing.is_nan());
}

#[test]
fn nan_travels() {
    let nan = Two::constant(f64::NAN);
    let one = Two::one();
    let travelled = [
        nan + one,
        one - nan,
        nan * one,
        -nan,
        nan.reciprocal(),
        nan.sqrt(),
        one.fused(nan, one),
        nan.abs(),
        nan.min(one),
        one.min(nan),
        nan.sin(),
        nan.cos(),
        nan.exp(),
        nan.atan2(one),
        one.atan2(nan),
        nan.round(),
    ];
    assert!(travelled.iter().all(|number| number.value().is_nan()));
    assert_eq!(nan.select(one, nan, one), one);
}

/// Derivatives of derivatives: of `x^3`.
#[test]
fn numbers_nest() {
    let x = Forward::new(Forward::new(2.0_f64, [1.0]), [Forward::fixed(1.0)]);
    let [slope] = (x * x * x).derivatives();
    assert_eq!((slope.value(), slope.derivatives()), (12.0, [12.0]));
}

/// Ordered by values; a control's choice depends on nothing.
#[test]
fn numbers_are_real() {
    let (less, more) = (Two::new(1.0, [5.0, 0.0]), Two::new(2.0, [-5.0, 1.0]));
    assert!(less < more && less <= Two::along(1.0, 1) && less >= Two::along(1.0, 1));
    assert!(less != Two::along(1.0, 1));
    assert_eq!(Real::max(less, more), more);
    assert_eq!(more.plain(), Two::fixed(2.0));
    assert_eq!(more.ulp(), Two::fixed(f64::EPSILON * 2.0));
    assert!(less.is_finite() && !Two::new(1.0, [f64::NAN, 0.0]).is_finite());
    for at in [0.3, 1.0, 2.5] {
        agrees(|x| x.powf(1.5), at);
        agrees(|x| Two::constant(2.0).quotient(x), at);
        agrees(|x| (x * x).quotient(x + Two::constant(1.0)), at);
    }
}

type Joints<S> = JointState<S, 3, 1, 4>;

/// Rates of three angles, of a displacement and of four velocities.
fn rates<S: Scalar>(state: &Joints<S>, law: S) -> Joints<S> {
    let [[c1, s1], [c2, s2], [c3, s3]] = *state.pairs();
    let ([x], [a, b, c, d]) = (*state.rest(), *state.rates());
    JointState::from_parts(
        [a, b + x, c * c1].map(|rate| [rate, S::zero()]),
        [d * s3],
        [
            s1 * c2 * a,
            x * x * c3 + law,
            s2.exp() * d,
            (a + b * c).sin(),
        ],
    )
}

fn state<S: Scalar>() -> Joints<S> {
    let c = S::constant;
    let pair = |angle: f64| [c(angle).cos(), c(angle).sin()];
    JointState::from_parts(
        [0.3, -2.0, 1.2].map(pair),
        [c(0.7)],
        [0.4, -0.9, 1.3, 0.2].map(c),
    )
}

/// What only plain numbers are asked for.
fn law(state: &Joints<f64>) -> [f64; 1] {
    let [[_, sine], ..] = *state.pairs();
    [sine * state.rates()[1]]
}

/// Eight columns, in two evaluations; those of second elements of pairs are zero, whatever stood
/// there.
#[test]
fn columns_are_those_of_increments() {
    let here = state::<f64>();
    let mut columns = here.each(here);
    let (mut evaluations, applied) = (0, law(&here));
    let count = by_forward_numbers(
        &here,
        &state::<Lifted<f64>>(),
        &mut columns,
        |at, slope, taken| {
            evaluations += 1;
            let [law] = with_differences(&here, taken, &applied, law);
            *slope = rates(at, law);
        },
    );
    assert_eq!((count, evaluations), (Some(8), 2));
    for column in 0..here.length() {
        let mut unit = here.zip(&here, |_, _| 0.0);
        unit.set_element(column, 1.0);
        let at = |step: f64| {
            let there = here.plus([(step, &unit)]);
            rates(&there, law(&there)[0])
        };
        let (ahead, behind) = (at(1e-5), at(-1e-5));
        for row in 0..here.length() {
            let difference = (ahead.element(row) - behind.element(row)) / 2e-5;
            let found = columns[column].element(row);
            assert!(
                (found - difference).abs() < 1e-7,
                "{row} {column}: {found} {difference}"
            );
        }
    }
}

#[test]
fn columns_that_are_not_finite_are_none() {
    let here = [1.0, 0.0];
    let mut columns = here.each(here);
    let zeros = [Lifted::<f64>::zero(); 2];
    let count = by_forward_numbers(&here, &zeros, &mut columns, |&[x, y], slope, _| {
        *slope = [x * y, y.sqrt()];
    });
    assert_eq!(count, None);
}

#[test]
fn single_precision_carries_derivatives() {
    let x = Forward::<f32, 1>::new(0.5, [1.0]);
    let [slope] = (x.sin() * x.exp()).derivatives();
    let exact = 0.5_f64.exp() * (0.5_f64.sin() + 0.5_f64.cos());
    assert!((slope.to_f64() - exact).abs() < 1e-6);
}

#[test]
fn laws_that_switch_have_the_derivatives_of_what_is_chosen() {
    let x = Forward::new(-0.5_f64, [1.0]);
    let none = Forward::constant(0.0);
    let size = side(none, x) * x;
    assert_eq!((size.value(), size.derivatives()), (0.5, [-1.0]));
    let at_zero = side(none, Forward::new(0.0_f64, [1.0]));
    assert_eq!((at_zero.value(), at_zero.derivatives()), (0.0, [0.0]));
    let chosen = above(side(none, x), x * x) + below(side(none, x), x);
    assert_eq!((chosen.value(), chosen.derivatives()), (-0.5, [1.0]));
}
