//! What is known of an operation before it is done, to the last bit whatever the numbers are.
//!
//! A product with zero is no zero where the other number is not finite, and the sum of two zeros
//! has the sign of neither: such operations stay.

use holonom::Scalar;

use crate::tape::{Binary, Operation, Place, Tape, Unary};

/// An operation, looked at.
pub(crate) enum Folded {
    /// The result stands at this place.
    Known(Place),
    /// It is to be written down, in this form.
    Operation(Operation),
}

use Folded::Known;

pub(crate) fn folded(tape: &mut Tape, operation: Operation) -> Folded {
    match operation {
        Operation::Constant(_) | Operation::Argument(_) | Operation::Result { .. } => {
            Folded::Operation(operation)
        }
        Operation::Unary(function, of) => unary(tape, function, of),
        Operation::Binary(function, of) => binary(tape, function, of),
        Operation::Fused(of) => fused(tape, of),
        Operation::Select([a, b, less, otherwise]) => {
            if less == otherwise {
                return Known(less);
            }
            match (tape.constant(a), tape.constant(b)) {
                (Some(a), Some(b)) => Known(if a < b { less } else { otherwise }),
                _ => Folded::Operation(operation),
            }
        }
    }
}

/// A constant as `f32` has it.
fn rounded(x: f64) -> f32 {
    Scalar::constant(x)
}

/// A number that was computed in the type of the tape.
fn computed(tape: &mut Tape, in_double: f64, in_single: impl FnOnce() -> f32) -> Folded {
    let value = if tape.is_single() {
        f64::from(in_single())
    } else {
        in_double
    };
    Known(tape.number(value))
}

fn unary(tape: &mut Tape, function: Unary, of: Place) -> Folded {
    let operation = Operation::Unary(function, of);
    if let (Unary::Negation, Operation::Unary(Unary::Negation, inner)) = (function, tape.at(of)) {
        return Known(inner);
    }
    let Some(x) = tape.constant(of) else {
        return Folded::Operation(operation);
    };
    let y = rounded(x);
    match function {
        Unary::Negation => computed(tape, -x, || -y),
        Unary::Reciprocal => computed(tape, 1.0 / x, || 1.0 / y),
        Unary::SquareRoot => computed(tape, x.sqrt(), || y.sqrt()),
        Unary::Magnitude => computed(tape, x.abs(), || y.abs()),
        Unary::Rounding => computed(tape, x.round(), || y.round()),
        // Libraries differ in the last bit of others.
        Unary::Sine if x == 0.0 => Known(of),
        Unary::Cosine | Unary::Exponential if x == 0.0 => Known(tape.number(1.0)),
        Unary::Sine | Unary::Cosine | Unary::Exponential | Unary::TurnSine | Unary::TurnVersine => {
            Folded::Operation(operation)
        }
    }
}

/// Whether a number is zero of this sign.
fn is_zero(number: Option<f64>, is_negative: bool) -> bool {
    number.is_some_and(|number| number == 0.0 && number.is_sign_negative() == is_negative)
}

fn binary(tape: &mut Tape, function: Binary, [a, b]: [Place; 2]) -> Folded {
    let (x, y) = (tape.constant(a), tape.constant(b));
    if let (Some(x), Some(y)) = (x, y) {
        let (p, q) = (rounded(x), rounded(y));
        match function {
            Binary::Sum => return computed(tape, x + y, || p + q),
            Binary::Difference => return computed(tape, x - y, || p - q),
            Binary::Product => return computed(tape, x * y, || p * q),
            Binary::Least | Binary::Angle => {}
        }
    }
    let negated = |tape: &mut Tape, of| Known(tape.put(Operation::Unary(Unary::Negation, of)));
    match function {
        // Minus zero is what changes no number when it is added.
        Binary::Sum if is_zero(x, true) => Known(b),
        Binary::Sum if is_zero(y, true) => Known(a),
        Binary::Difference if is_zero(y, false) => Known(a),
        Binary::Difference if is_zero(x, true) => negated(tape, b),
        Binary::Product if x == Some(1.0) => Known(b),
        Binary::Product if y == Some(1.0) => Known(a),
        Binary::Product if x == Some(-1.0) => negated(tape, b),
        Binary::Product if y == Some(-1.0) => negated(tape, a),
        // Neither order of operands changes a bit.
        Binary::Sum | Binary::Product => {
            Folded::Operation(Operation::Binary(function, [a.min(b), a.max(b)]))
        }
        _ => Folded::Operation(Operation::Binary(function, [a, b])),
    }
}

fn fused(tape: &mut Tape, [a, b, c]: [Place; 3]) -> Folded {
    let (x, y) = (tape.constant(a), tape.constant(b));
    let sum = |tape: &mut Tape, operation| Known(tape.put(operation));
    if is_zero(tape.constant(c), true) {
        return sum(tape, Operation::Binary(Binary::Product, [a, b]));
    }
    match (x, y) {
        (Some(1.0), _) => sum(tape, Operation::Binary(Binary::Sum, [b, c])),
        (_, Some(1.0)) => sum(tape, Operation::Binary(Binary::Sum, [a, c])),
        (Some(-1.0), _) => sum(tape, Operation::Binary(Binary::Difference, [c, b])),
        (_, Some(-1.0)) => sum(tape, Operation::Binary(Binary::Difference, [c, a])),
        _ => Folded::Operation(Operation::Fused([a.min(b), a.max(b), c])),
    }
}
