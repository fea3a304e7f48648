//! What recorded pivots are compared with, as a number where that does as well.
//!
//! A pivot is small if it is small beside what it would be without the other rows. That is
//! `D M^-1 D^T` of one row: where it depends on orientations only, it stays between bounds, and
//! where these are near to each other, its greatest value says as much as the value at every state,
//! and costs nothing.

use super::eliminate::Check;
use crate::model::BodyKind;
use crate::symbolic::arena::{Expr, Input, Stage};
use crate::symbolic::scene::Scene;
use crate::symbolic::tape::Tape;

/// The least value of what is replaced by its greatest one, over that.
const LEAST: f64 = 0.1;

/// Orientations that are looked at.
const ORIENTATIONS: usize = 64;

/// Checks that compare with numbers where they can.
pub(super) fn by_numbers(scene: &mut Scene, kinds: &[BodyKind], checks: &mut [Check]) {
    for check in checks {
        let is_plain = check.pivot.abs() == check.before.abs();
        if is_plain || scene.space.arena.stage(check.before) < Stage::State {
            continue;
        }
        if let Some(greatest) = greatest(scene, kinds, check.before) {
            check.before = scene.space.arena.constant(greatest);
        }
    }
}

/// The greatest value of an expression, with its sign, among those of [`ORIENTATIONS`] random
/// orientations of the bodies, where it depends on nothing else and does not vary by more than a
/// decade. It is a scale, not a bound: a few hundredths more would change nothing.
fn greatest(scene: &Scene, kinds: &[BodyKind], expr: Expr) -> Option<f64> {
    let tape = Tape::new(&scene.space.arena, &[expr]);
    let values = (0..ORIENTATIONS).map(|sample| {
        let values = tape.evaluate(|input| turned(scene, kinds, input, sample))?;
        values.first().copied().filter(|value| value.is_finite())
    });
    let values: Vec<f64> = values.collect::<Option<_>>()?;
    let sizes = || values.iter().map(|value| value.abs());
    let (least, greatest) = (sizes().reduce(f64::min)?, sizes().reduce(f64::max)?);
    let sign = values.first()?.signum();
    let is_even = least > LEAST * greatest && values.iter().all(|value| value.signum() == sign);
    is_even.then_some(sign * greatest)
}

/// An Euler parameter of a random orientation; `None` for every other input.
fn turned(scene: &Scene, kinds: &[BodyKind], input: Input, sample: usize) -> Option<f64> {
    let Input::Coordinate(place) = input else {
        return None;
    };
    let place = place as usize;
    let first = &scene.layout.coordinate;
    let body = first.iter().rposition(|&first| first <= place)?;
    let component = place.checked_sub(first[body] + 3)?;
    if kinds[body] != BodyKind::Rigid || component > 3 {
        return None;
    }
    // Shoemake's uniform random rotations, of numbers that have no pattern.
    let number = |k: usize| {
        const RATIOS: [f64; 3] = [
            0.819_172_513_396_164_4,
            0.671_043_606_703_789_2,
            0.549_700_477_901_970_8,
        ];
        (0.5 + ((sample + 1) as f64 + 61.0 * body as f64) * RATIOS[k]).fract()
    };
    let (long, short) = (number(0).sqrt(), (1.0 - number(0)).sqrt());
    let [first, second] = [1, 2].map(|k| std::f64::consts::TAU * number(k));
    let parameters = [
        short * first.sin(),
        short * first.cos(),
        long * second.sin(),
        long * second.cos(),
    ];
    parameters.get(component).copied()
}
