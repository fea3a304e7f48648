use super::{Arena, Input, Node, Stage};
use crate::model::{Curve, Function};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::tape::Tape;

fn two_inputs(arena: &mut Arena) -> (super::Expr, super::Expr) {
    (
        arena.input(Input::Coordinate(0)),
        arena.input(Input::Coordinate(1)),
    )
}

#[test]
fn a_difference_and_its_opposite_share_a_node() {
    let mut arena = Arena::new();
    let (x, y) = two_inputs(&mut arena);
    let forth = arena.sub(x, y);
    let back = arena.sub(y, x);
    assert_eq!(forth, -back);
}

#[test]
fn constants_fold_and_merge() {
    let mut arena = Arena::new();
    let (x, _) = two_inputs(&mut arena);
    let three = arena.constant(3.0);
    let minus_two = arena.constant(-2.0);
    let inner = arena.mul(minus_two, x);
    let outer = arena.mul(three, inner);
    let six = arena.constant(6.0);
    let expected = arena.mul(six, x);
    assert_eq!(outer, -expected);
    let sum = arena.add(three, x);
    let back = arena.sub(sum, three);
    assert_eq!(back, x);
    let opposite = arena.sub(three, sum);
    assert_eq!(opposite, -x);
}

#[test]
fn a_rollback_forgets_what_was_tried() {
    let mut arena = Arena::new();
    let (x, y) = two_inputs(&mut arena);
    let mark = arena.mark();
    let tried = arena.mul(x, y);
    assert_eq!(arena.operations_since(mark), 1);
    arena.rollback(mark);
    let sum = arena.add(x, y);
    assert_eq!(tried.node(), sum.node(), "the place is free again");
    assert!(matches!(arena.get(sum), Node::Add(..)));
}

#[test]
fn what_has_no_number_is_left_to_the_kernels() {
    let mut arena = Arena::new();
    let infinite = arena.reciprocal(Arena::ZERO);
    assert_eq!(arena.literal(infinite), None);
    assert_eq!(arena.stage(infinite), Stage::State);
}

#[test]
fn what_is_made_of_it_is_not_simplified() {
    let mut arena = Arena::new();
    let (x, _) = two_inputs(&mut arena);
    let infinite = arena.reciprocal(Arena::ZERO);
    let huge = arena.constant(1e300);
    let tiny = arena.constant(1e-300);
    let scaled = arena.mul(infinite, x);
    let found = [
        ("0 / 0", arena.div(Arena::ZERO, Arena::ZERO)),
        ("0 (1 / 0)", arena.mul(Arena::ZERO, infinite)),
        ("0 (x / 0)", arena.mul(Arena::ZERO, scaled)),
        ("1 / 0 - 1 / 0", arena.sub(infinite, infinite)),
        ("(1 / 0) / (1 / 0)", arena.div(infinite, infinite)),
        ("1e600", arena.square(huge)),
        ("1e-600", arena.square(tiny)),
    ];
    for (what, expr) in found {
        assert_eq!(arena.literal(expr), None, "{what}");
    }
    let outputs = found.map(|(_, expr)| expr);
    let values = evaluate(&arena, &outputs, |_| Some(2.0));
    let values: Vec<f64> = values
        .into_iter()
        .map(|value| value.expect("known"))
        .collect();
    assert!(values[..5].iter().all(|value| value.is_nan()), "{values:?}");
    assert_eq!(values[5..], [f64::INFINITY, 0.0]);
}

#[test]
fn sums_and_merged_constants_overflow_in_the_kernels() {
    let mut arena = Arena::new();
    let (x, _) = two_inputs(&mut arena);
    let huge = arena.constant(1.5e308);
    let sum = arena.add(huge, huge);
    assert_eq!(arena.literal(sum), None);
    let product = arena.mul(huge, x);
    let again = arena.mul(huge, product);
    assert_eq!(arena.literal(again), None);
    let sum = arena.add(huge, x);
    let again = arena.add(huge, sum);
    assert_eq!(arena.literal(again), None);
    let least = arena.constant(1e-310);
    let reciprocal = arena.reciprocal(least);
    assert_eq!(arena.literal(reciprocal), None);
}

#[test]
fn a_product_is_as_late_as_its_latest_factor() {
    let mut arena = Arena::new();
    let (x, _) = two_inputs(&mut arena);
    let gain = arena.input(Input::RateGain);
    let product = arena.mul(gain, x);
    assert_eq!(arena.stage(product), Stage::State);
    assert_eq!(arena.stage(gain), Stage::Coefficient);
}

#[test]
fn inputs_and_coefficients_change_by_themselves() {
    let mut arena = Arena::new();
    let [gain, current, size] =
        [Input::RateGain, Input::Varying(0), Input::Symbol(1)].map(|input| arena.input(input));
    let scaled = arena.mul(size, current);
    let moment = arena.reciprocal(scaled);
    assert_eq!(arena.stage(moment), Stage::Input);
    let known = arena.mul(size, gain);
    assert_eq!(arena.stage(known), Stage::Coefficient);
    let both = arena.mul(moment, gain);
    assert_eq!(arena.stage(both), Stage::State);
}

#[test]
fn a_spline_is_left_to_the_evaluation() {
    let mut arena = Arena::new();
    let spline = Function::Curve(Curve {
        spline: 3,
        derivative: 0,
    });
    let half = arena.constant(0.5);
    let all = [Function::value, Function::slope, Function::curvature]
        .map(|order| order(spline, &mut arena, half));
    for (place, &expr) in all.iter().enumerate() {
        assert_eq!(arena.stage(expr), Stage::State);
        assert!(
            matches!(arena.get(expr), Node::Curve(curve, x) if usize::from(curve.derivative) == place && x == half)
        );
    }
    let again = spline.slope(&mut arena, half);
    assert_eq!(again, all[1], "one node for what is read twice");
    assert_eq!(
        evaluate(&arena, &[all[0], half], |_| None),
        [None, Some(0.5)]
    );
    let tape = Tape::new(&arena, &all);
    assert_eq!(tape.evaluate(|_| Some(1.0)), None);
}

#[test]
fn sides_fold_where_both_are_known_and_select_exactly() {
    let mut arena = Arena::new();
    let (x, y) = two_inputs(&mut arena);
    let held = arena.input(Input::Varying(0));
    for (number, sign) in [(3.0, 1.0), (-0.5, -1.0), (0.0, 0.0)] {
        let constant = arena.constant(number);
        let side = arena.side(Arena::ZERO, constant);
        assert_eq!(arena.literal(side), Some(sign));
    }
    let minus = -Arena::ONE;
    assert_eq!(arena.side(minus, Arena::ONE), minus);
    assert_eq!(arena.select(minus, x, y), y);
    assert_eq!(arena.select(Arena::ONE, x, y), x);
    let side = arena.side(held, x);
    assert_eq!(arena.stage(side), Stage::State);
    assert_eq!(arena.select(side, y, y), y);
    let (chosen, opposite) = (arena.select(side, x, y), arena.select(side, -x, -y));
    assert_eq!(chosen, -opposite);
    let values = |held: f64, x: f64| {
        evaluate(&arena, &[side, chosen], |input| match input {
            Input::Varying(_) => Some(held),
            Input::Coordinate(0) => Some(x),
            _ => Some(0.1 + 0.2),
        })
    };
    let y = Some(0.1 + 0.2);
    assert_eq!(values(0.0, 1e30), [Some(1.0), Some(1e30)]);
    assert_eq!(values(0.0, -1e30), [Some(-1.0), y]);
    assert_eq!(values(1.0, -1e30), [Some(1.0), Some(-1e30)]);
    assert_eq!(values(-1.0, 7.0), [Some(-1.0), y]);
    assert_eq!(values(0.0, 0.0), [Some(0.0), Some(0.0)]);
}
