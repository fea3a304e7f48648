//! Enclosures hold what plain numbers give, over random intervals.

use super::Interval;
use crate::forward::Forward;
use crate::math::scalar::Scalar;
use crate::tests::numbers::Numbers;

/// Functions that are made of everything.
fn functions<S: Scalar>(x: S) -> [S; 8] {
    let (one, three) = (S::one(), S::constant(3.0));
    let positive = x * x + S::constant(0.1);
    [
        (three * x).sin() * x - (x * x).cos(),
        x.exp() * positive.reciprocal(),
        positive.sqrt() - x.abs().min(one),
        x.select(S::constant(0.25), x * x, one - x),
        x.fused(x, -three) * (x - S::constant(0.5)),
        (x * S::constant(100.0)).sin(),
        (x * three).round() * x,
        one - positive.reciprocal().cos(),
    ]
}

#[test]
fn enclosures_hold_what_they_enclose() {
    let mut random = Numbers(7);
    for _ in 0..4000 {
        let (middle, width) = (4.0 * random.next(), random.next().abs().powi(3));
        let (low, high) = (middle - width, middle + width);
        let interval = Forward::new(Interval::new(low, high), [Interval::constant(1.0)]);
        let enclosed = functions(interval);
        for _ in 0..8 {
            let x = (middle + width * random.next()).clamp(low, high);
            let values = functions(Forward::new(x, [1.0]));
            for (value, bounds) in values.iter().zip(&enclosed) {
                let holds = |bounds: Interval, x: f64| bounds.low <= x && x <= bounds.high;
                assert!(holds(bounds.value(), value.value()), "{x} {bounds:?}");
                let [slope] = value.derivatives();
                assert!(holds(bounds.derivatives()[0], slope), "{x} {bounds:?}");
            }
        }
    }
}

#[test]
fn enclosures_are_tight_where_intervals_are_short() {
    let short = Interval::new(0.7, 0.7 + 1e-9);
    for (bounds, value) in functions(short).iter().zip(functions(0.7)) {
        assert!(bounds.high - bounds.low < 1e-6);
        assert!((bounds.low - value).abs() < 1e-6);
    }
    let wave = Interval::new(1.0, 2.0).sin();
    assert!(wave.high == 1.0 && (wave.low - 1.0_f64.sin()).abs() < 1e-14);
    let far = Interval::new(1e9, 1e9 + 0.1).sin();
    assert!(far.high - far.low < 0.11);
}

#[test]
fn what_is_unknown_is_told() {
    let unknown = Interval::new(-1.0, 1.0);
    assert_eq!(unknown.reciprocal(), Interval::ALL);
    assert!(Interval::new(-2.0, -1.0).sqrt().is_none());
    assert!((Interval::NONE + unknown).is_none());
    assert!(Interval::NONE.select(unknown, unknown, unknown).is_none());
    assert_eq!(Interval::ALL.sin(), unknown);
    assert_eq!(
        Interval::constant(0.0) * Interval::ALL,
        Interval::constant(0.0)
    );
    assert!(Interval::constant(0.0).sin().is_zero());
    assert!(!unknown.excludes_zero() && Interval::new(1.0, 2.0).is_beside_zero(1.0));
}

#[test]
fn what_is_zero_is_enclosed_by_zero() {
    // A smooth step before its start, as kernels write it.
    let step = |time: Forward<Interval, 1>| {
        let (zero, one) = (Forward::constant(0.0), Forward::constant(1.0));
        let x = time - Forward::constant(1.25);
        let u = x.select(zero, zero, one.select(x, one, x));
        let inner = u.fused(Forward::constant(6.0), Forward::constant(-15.0));
        let inner = u.fused(inner, Forward::constant(10.0));
        u * u * u * inner
    };
    let before = Forward::new(Interval::new(0.0, 1.0), [Interval::constant(1.0)]);
    assert!(step(before).value().is_zero(), "{:?}", step(before));
    let later = Forward::new(Interval::new(1.0, 1.5), [Interval::constant(1.0)]);
    assert!(!step(later).value().is_zero());
}
