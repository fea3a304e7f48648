//! Derivatives of what stands on a tape, forward along one direction after the other.
//!
//! Zeros fold, and what several directions have in common stands there once.

use crate::tape::{Binary, Operation, Place, Tape, Unary};

/// What the numbers of a tape change by along a direction, where that is not zero.
pub(crate) struct Direction {
    changes: Vec<Option<Place>>,
}

impl Direction {
    /// The change of a number; `None` where it is zero.
    pub(crate) fn change(&self, place: Place) -> Option<Place> {
        self.changes.get(place as usize).copied().flatten()
    }

    /// The direction in which these arguments, by their places on the tape, change by this much.
    pub(crate) fn along(tape: &mut Tape, seeds: &[(Place, Place)], operations: usize) -> Self {
        let mut direction = Self {
            changes: vec![None; operations],
        };
        for place in 0..operations {
            let operation = tape.operations()[place];
            let seed = seeds.iter().find(|(of, _)| *of as usize == place);
            direction.changes[place] = match (seed, operation) {
                (Some(&(_, change)), _) => Some(change),
                (None, operation) => direction.of(tape, place, operation),
            };
        }
        direction
    }

    fn of(&self, tape: &mut Tape, place: usize, operation: Operation) -> Option<Place> {
        let own = Place::try_from(place).unwrap_or(Place::MAX);
        match operation {
            Operation::Constant(_) | Operation::Argument(_) | Operation::Result { .. } => None,
            Operation::Unary(function, of) => {
                let change = self.change(of)?;
                unary(tape, function, [of, own], change)
            }
            Operation::Binary(function, [a, b]) => {
                let changes = [self.change(a), self.change(b)];
                binary(tape, function, [a, b], changes)
            }
            Operation::Fused([a, b, c]) => {
                let of_product = {
                    let one = self.change(a).map(|change| [change, b]);
                    let other = self.change(b).map(|change| [change, a]);
                    products(tape, [one, other])
                };
                sum(tape, of_product, self.change(c))
            }
            Operation::Select([a, b, less, otherwise]) => {
                let changes = [self.change(less), self.change(otherwise)];
                selected(tape, [a, b], changes)
            }
        }
    }
}

fn times(tape: &mut Tape, a: Place, b: Place) -> Place {
    tape.put(Operation::Binary(Binary::Product, [a, b]))
}

fn negative(tape: &mut Tape, a: Place) -> Place {
    tape.put(Operation::Unary(Unary::Negation, a))
}

fn sum(tape: &mut Tape, a: Option<Place>, b: Option<Place>) -> Option<Place> {
    match (a, b) {
        (Some(a), Some(b)) => Some(tape.put(Operation::Binary(Binary::Sum, [a, b]))),
        (Some(only), None) | (None, Some(only)) => Some(only),
        (None, None) => None,
    }
}

/// The sum of two products, of which either may not be there.
fn products(tape: &mut Tape, products: [Option<[Place; 2]>; 2]) -> Option<Place> {
    match products {
        [Some([a, b]), Some([c, d])] => {
            let first = times(tape, a, b);
            Some(tape.put(Operation::Fused([c, d, first])))
        }
        [Some([a, b]), None] | [None, Some([a, b])] => Some(times(tape, a, b)),
        [None, None] => None,
    }
}

/// `a < b ? one : other` of changes.
fn selected(
    tape: &mut Tape,
    [a, b]: [Place; 2],
    [less, otherwise]: [Option<Place>; 2],
) -> Option<Place> {
    if less.is_none() && otherwise.is_none() {
        return None;
    }
    let zero = tape.number(0.0);
    let of = [a, b, less.unwrap_or(zero), otherwise.unwrap_or(zero)];
    Some(tape.put(Operation::Select(of)))
}

/// The change of a function of one number, which stands at `own`.
fn unary(tape: &mut Tape, function: Unary, [of, own]: [Place; 2], change: Place) -> Option<Place> {
    let unary = |tape: &mut Tape, function| tape.put(Operation::Unary(function, of));
    let factor = match function {
        Unary::Rounding => return None,
        Unary::Negation => return Some(negative(tape, change)),
        Unary::Magnitude => {
            let (zero, back) = (tape.number(0.0), negative(tape, change));
            return Some(tape.put(Operation::Select([of, zero, back, change])));
        }
        Unary::Reciprocal => {
            let square = times(tape, own, own);
            negative(tape, square)
        }
        Unary::SquareRoot => {
            let half = tape.number(0.5);
            let reciprocal = tape.put(Operation::Unary(Unary::Reciprocal, own));
            times(tape, half, reciprocal)
        }
        Unary::Sine => unary(tape, Unary::Cosine),
        Unary::Cosine => {
            let sine = unary(tape, Unary::Sine);
            negative(tape, sine)
        }
        Unary::Exponential => own,
        Unary::TurnSine => {
            let (one, versine) = (tape.number(1.0), unary(tape, Unary::TurnVersine));
            tape.put(Operation::Binary(Binary::Difference, [one, versine]))
        }
        Unary::TurnVersine => unary(tape, Unary::TurnSine),
    };
    Some(times(tape, factor, change))
}

fn binary(
    tape: &mut Tape,
    function: Binary,
    [a, b]: [Place; 2],
    [of_a, of_b]: [Option<Place>; 2],
) -> Option<Place> {
    match function {
        Binary::Sum => sum(tape, of_a, of_b),
        Binary::Difference => match (of_a, of_b) {
            (Some(x), Some(y)) => Some(tape.put(Operation::Binary(Binary::Difference, [x, y]))),
            (Some(x), None) => Some(x),
            (None, Some(y)) => Some(negative(tape, y)),
            (None, None) => None,
        },
        Binary::Product => {
            let (one, other) = (of_a.map(|x| [x, b]), of_b.map(|y| [y, a]));
            products(tape, [one, other])
        }
        Binary::Angle => {
            // Of the point `(b, a)`.
            let back = of_b.map(|y| negative(tape, y));
            let (one, other) = (of_a.map(|x| [x, b]), back.map(|y| [y, a]));
            let across = products(tape, [one, other])?;
            let square = times(tape, a, a);
            let square = tape.put(Operation::Fused([b, b, square]));
            let reciprocal = tape.put(Operation::Unary(Unary::Reciprocal, square));
            Some(times(tape, across, reciprocal))
        }
        Binary::Least => selected(tape, [a, b], [of_a, of_b]),
    }
}
