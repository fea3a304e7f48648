//! The function itself.

use holonom::lanes::Lanes;
use holonom::spline::{Spline, SplineFault, uniform_knots};
use holonom::{Forward, Scalar};

use super::data::{AT, CLAMPED, KNOTS, MONOTONE, NATURAL, PERIODIC, THREE_POINTS, VALUES};

fn orders<const N: usize>(spline: &Spline<N>, x: f64) -> [f64; 3] {
    [spline.value(x), spline.slope(x), spline.curvature(x)]
}

fn assert_near<const N: usize>(spline: &Spline<N>, at: &[f64], expected: &[[f64; 3]]) {
    for (&x, expected) in at.iter().zip(expected) {
        for (order, (found, expected)) in orders(spline, x).into_iter().zip(expected).enumerate() {
            let difference = (found - expected).abs();
            let tolerance = 2e-13 * [1.0, 10.0, 100.0][order];
            assert!(
                difference < tolerance,
                "{order} at {x}: {found}, {expected}"
            );
        }
    }
}

const NATURAL_ONE: Spline<6> = Spline::natural(KNOTS, VALUES);
const CLAMPED_ONE: Spline<6> = Spline::clamped(KNOTS, VALUES, [0.5, -0.25]);
static PERIODIC_ONE: Spline<6> = Spline::periodic(KNOTS, VALUES);
const MONOTONE_ONE: Spline<6> = Spline::monotone(KNOTS, VALUES);

#[test]
fn every_kind_is_that_of_scipy() {
    assert_near(&NATURAL_ONE, &AT, &NATURAL);
    assert_near(&CLAMPED_ONE, &AT, &CLAMPED);
    assert_near(&PERIODIC_ONE, &AT, &PERIODIC);
    assert_near(&MONOTONE_ONE, &AT, &MONOTONE);
    let three = Spline::periodic([0.0, 1.0, 3.0], [1.0, 4.0, 1.0]);
    assert_near(&three, &[0.5, 2.5], &THREE_POINTS);
}

#[test]
fn a_periodic_one_repeats_itself() {
    for turns in [-7.0, -1.0, 1.0, 12.0] {
        for x in AT {
            let (here, there) = (
                orders(&PERIODIC_ONE, x),
                orders(&PERIODIC_ONE, x + 3.0 * turns),
            );
            for (here, there) in here.into_iter().zip(there) {
                assert!(
                    (here - there).abs() < 1e-12 * (1.0 + here.abs()),
                    "{x}, {turns}"
                );
            }
        }
    }
    // Its ends are one place, also to the second derivative.
    let [first, .., last] = [0.0, 3.0_f64.next_down()].map(|x| orders(&PERIODIC_ONE, x));
    for (first, last) in first.into_iter().zip(last) {
        assert!((first - last).abs() < 1e-12);
    }
}

#[test]
fn outside_it_goes_on_straight_or_is_held() {
    let [_, before, _] = orders(&CLAMPED_ONE, 0.0);
    assert_eq!(
        orders(&CLAMPED_ONE, -2.0),
        [0.2 - 2.0 * before, before, 0.0]
    );
    let past = orders(&CLAMPED_ONE, 5.0);
    assert!((past[0] - (0.2 - 0.25 * 2.0)).abs() < 1e-15);
    assert_eq!(past[1..], [-0.25, 0.0]);
    let held = CLAMPED_ONE.held();
    assert_eq!(orders(&held, -2.0), [0.2, 0.0, 0.0]);
    assert_eq!(orders(&held, 5.0), [0.2, 0.0, 0.0]);
    assert_eq!(PERIODIC_ONE.held(), PERIODIC_ONE);
}

/// A cubic is its own spline where the slopes at the ends are its own, and a line in any case.
#[test]
fn cubics_are_reproduced() {
    let cubic = |x: f64| 1.0 + x * (-2.0 + x * (0.5 - 0.75 * x));
    let slope = |x: f64| -2.0 + x * (1.0 - 2.25 * x);
    let clamped = Spline::clamped(KNOTS, KNOTS.map(cubic), [slope(0.0), slope(3.0)]);
    let line = |x: f64| 3.0 - 2.0 * x;
    let lines = [
        Spline::natural(KNOTS, KNOTS.map(line)),
        Spline::monotone(KNOTS, KNOTS.map(line)),
    ];
    for k in 0..=60 {
        let x = 0.05 * f64::from(k);
        let expected = [cubic(x), slope(x), 1.0 - 4.5 * x];
        for (found, expected) in orders(&clamped, x).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{x}: {found}, {expected}");
        }
        for line_again in lines {
            assert!((line_again.value(x) - line(x)).abs() < 1e-14);
            assert!((line_again.slope(x) + 2.0).abs() < 1e-13);
        }
    }
    let two = Spline::natural([1.0, 3.0], [2.0, 8.0]);
    assert_eq!(orders(&two, 2.0), [5.0, 3.0, 0.0]);
}

#[test]
fn a_monotone_one_does_not_overshoot() {
    // A step: the others do overshoot it.
    let knots = uniform_knots::<8>(0.0, 7.0);
    let step = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let (monotone, natural) = (Spline::monotone(knots, step), Spline::natural(knots, step));
    let values = |spline: &Spline<8>| -> Vec<f64> {
        (0..=700)
            .map(|k| spline.value(0.01 * f64::from(k)))
            .collect()
    };
    let found = values(&monotone);
    assert!(found.windows(2).all(|pair| pair[1] >= pair[0]));
    assert!(found.iter().all(|value| (0.0..=1.0).contains(value)));
    assert!(values(&natural).iter().any(|value| *value > 1.05));
}

#[test]
fn derivatives_are_carried_and_lanes_choose_their_own_pieces() {
    for x in [-0.4, 0.0, 0.3, 0.7, 2.9, 3.3] {
        for spline in [&NATURAL_ONE, &CLAMPED_ONE, &PERIODIC_ONE, &MONOTONE_ONE] {
            let [value, slope, curvature] = orders(spline, x);
            let carried: Forward<f64, 1> = Forward::along(x, 0);
            assert_eq!(spline.value(carried).value(), value);
            let [found] = spline.value(carried).derivatives();
            assert!((found - slope).abs() < 1e-13 * (1.0 + slope.abs()));
            let [found] = spline.slope(carried).derivatives();
            assert!((found - curvature).abs() < 1e-12 * (1.0 + curvature.abs()));
        }
    }
    // All in one piece, and each in another one.
    for at in [
        [0.4, 0.5, 0.6, 0.7],
        [-0.5, 0.1, 1.2, 2.5],
        [0.3, 1.1, 3.0, f64::NAN],
    ] {
        let lanes = Lanes::new(at);
        for spline in [&CLAMPED_ONE, &PERIODIC_ONE] {
            let found = [
                spline.value(lanes),
                spline.slope(lanes),
                spline.curvature(lanes),
            ];
            for (lane, x) in at.into_iter().enumerate() {
                for (found, expected) in found.into_iter().zip(orders(spline, x)) {
                    let found = found.lane(lane).expect("there are four");
                    assert!(
                        found == expected || (found.is_nan() && expected.is_nan()),
                        "{x}"
                    );
                }
            }
        }
    }
    let single = CLAMPED_ONE.value(1.3_f32);
    assert!((f64::from(single) - CLAMPED_ONE.value(1.3)).abs() < 1e-6);
}

/// A type of numbers that says nothing of its order: every knot is compared.
#[test]
fn numbers_without_order_find_their_pieces() {
    for x in AT {
        let lanes = Lanes::<f64, 2>::new([x, 2.95 - x]);
        assert_eq!(CLAMPED_ONE.value(lanes).lane(0), Some(CLAMPED_ONE.value(x)));
    }
    assert_eq!(
        Lanes::<f64, 2>::new([0.0, 2.0]).bounds_passed(1, |_| Lanes::constant(1.0)),
        None
    );
}

#[test]
fn what_is_no_spline_says_so() {
    let nan = f64::NAN;
    for (spline, fault) in [
        (
            Spline::natural([0.0, 1.0, 1.0], [0.0; 3]),
            SplineFault::KnotsNotIncreasing,
        ),
        (
            Spline::natural([0.0, 2.0, 1.0], [0.0; 3]),
            SplineFault::KnotsNotIncreasing,
        ),
        (
            Spline::monotone([0.0, 1.0, 2.0], [0.0, nan, 0.0]),
            SplineFault::NotFinite,
        ),
        (
            Spline::monotone([0.0, 1.0, f64::INFINITY], [0.0; 3]),
            SplineFault::NotFinite,
        ),
        (
            Spline::clamped([0.0, 1.0, 2.0], [0.0; 3], [nan, 0.0]),
            SplineFault::NotFinite,
        ),
        (
            Spline::periodic([0.0, 1.0, 2.0], [0.0, 1.0, 0.1]),
            SplineFault::EndsDiffer,
        ),
        (
            Spline::natural([0.0, 1e-300, 1.0], [0.0, 1e200, 0.0]),
            SplineFault::OutOfRange,
        ),
    ] {
        assert_eq!(spline.fault(), Some(fault));
        assert!(spline.value(0.5_f64).is_nan() && spline.slope(-1.0_f64).is_nan());
    }
    assert_eq!(
        Spline::natural([0.0], [1.0]).fault(),
        Some(SplineFault::TooFewPoints)
    );
    assert_eq!(
        Spline::natural([], []).fault(),
        Some(SplineFault::TooFewPoints)
    );
    assert_eq!(
        Spline::periodic([0.0, 1.0], [1.0; 2]).fault(),
        Some(SplineFault::TooFewPoints)
    );
    assert!(Spline::natural([], []).held().value(0.0_f64).is_nan());
    assert!(NATURAL_ONE.value(f64::NAN).is_nan());
}
