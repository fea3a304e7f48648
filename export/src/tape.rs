//! What is computed, written down: operations on places of a tape, each of which stands there once.

use std::cell::RefCell;
use std::collections::HashMap;

use crate::fold;

/// The place of a number on a tape.
pub(crate) type Place = u32;

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Unary {
    Negation,
    Reciprocal,
    SquareRoot,
    Magnitude,
    Sine,
    Cosine,
    Exponential,
    /// The nearest integer, halves away from zero.
    Rounding,
    /// The sine of a turn by an angle, as [`holonom::Scalar::sines_and_versines`] has it.
    TurnSine,
    /// `1 - cos` of it.
    TurnVersine,
}

/// A function of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Sum,
    Difference,
    Product,
    /// The angle of the point whose sine comes first.
    Angle,
    Least,
}

/// What stands at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Operation {
    /// A number, by the bits of its `f64`.
    Constant(u64),
    /// A number that the function is given, by its place among all of these.
    Argument(u32),
    Unary(Unary, Place),
    Binary(Binary, [Place; 2]),
    /// `a b + c`.
    Fused([Place; 3]),
    /// `a < b ? c : d`.
    Select([Place; 4]),
    /// What a call gives, by the place of the call and of the number among its results.
    Result {
        call: u32,
        result: u32,
    },
}

impl Operation {
    /// The places that it reads, but for those of a call.
    pub(crate) fn operands(&self) -> impl DoubleEndedIterator<Item = Place> + use<> {
        let mut operands = [None; 4];
        let given: &[Place] = match self {
            Self::Constant(_) | Self::Argument(_) | Self::Result { .. } => &[],
            Self::Unary(_, of) => std::slice::from_ref(of),
            Self::Binary(_, of) => of,
            Self::Fused(of) => of,
            Self::Select(of) => of,
        };
        for (operand, &place) in operands.iter_mut().zip(given) {
            *operand = Some(place);
        }
        operands.into_iter().flatten()
    }

    /// How many additions, multiplications and functions of numbers it is.
    pub(crate) fn cost(&self) -> usize {
        match self {
            Self::Constant(_)
            | Self::Argument(_)
            | Self::Result { .. }
            | Self::Unary(Unary::Negation, _) => 0,
            Self::Fused(_) => 2,
            Self::Unary(..) | Self::Binary(..) | Self::Select(_) => 1,
        }
    }
}

/// A call of another function of the program.
#[derive(Clone, Debug)]
pub(crate) struct Call {
    /// Its place among the functions.
    pub(crate) function: usize,
    /// The numbers that it is given, argument by argument, behind the constants: these are handed
    /// on as they are.
    pub(crate) given: Vec<Place>,
}

/// Why something cannot be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Obstacle {
    /// Two numbers were compared, and what follows depends on it.
    Comparison,
}

/// Operations in the order in which they were done.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    operations: Vec<Operation>,
    known: HashMap<Operation, Place>,
    /// The calls, and how many operations there were before each.
    calls: Vec<(Call, usize)>,
    obstacle: Option<Obstacle>,
    /// Whether numbers are `f32`, by which constants are combined.
    is_single: bool,
}

impl Tape {
    pub(crate) fn new(is_single: bool) -> Self {
        Self {
            is_single,
            ..Self::default()
        }
    }

    pub(crate) fn is_single(&self) -> bool {
        self.is_single
    }

    pub(crate) fn operations(&self) -> &[Operation] {
        &self.operations
    }

    pub(crate) fn calls(&self) -> &[(Call, usize)] {
        &self.calls
    }

    pub(crate) fn at(&self, place: Place) -> Operation {
        self.operations[place as usize]
    }

    /// The number at a place, if it is known.
    pub(crate) fn constant(&self, place: Place) -> Option<f64> {
        match self.at(place) {
            Operation::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Writes an operation down, unless it is known what comes out or stands there already.
    pub(crate) fn put(&mut self, operation: Operation) -> Place {
        match fold::folded(self, operation) {
            fold::Folded::Known(place) => place,
            fold::Folded::Operation(operation) => self.intern(operation),
        }
    }

    pub(crate) fn intern(&mut self, operation: Operation) -> Place {
        let next = Place::try_from(self.operations.len()).unwrap_or(Place::MAX);
        let place = *self.known.entry(operation).or_insert(next);
        if place == next {
            self.operations.push(operation);
        }
        place
    }

    /// Where an operation stands, if it does.
    pub(crate) fn find(&self, operation: Operation) -> Option<Place> {
        self.known.get(&operation).copied()
    }

    pub(crate) fn number(&mut self, value: f64) -> Place {
        self.intern(Operation::Constant(value.to_bits()))
    }

    /// Calls a function that gives so many numbers.
    pub(crate) fn call(&mut self, call: Call, results: usize) -> Vec<Place> {
        let number = u32::try_from(self.calls.len()).unwrap_or(u32::MAX);
        self.calls.push((call, self.operations.len()));
        let results = 0..u32::try_from(results).unwrap_or(u32::MAX);
        let give = |result| {
            self.intern(Operation::Result {
                call: number,
                result,
            })
        };
        results.map(give).collect()
    }

    pub(crate) fn refuse(&mut self, obstacle: Obstacle) {
        self.obstacle = Some(obstacle);
    }

    pub(crate) fn obstacle(&self) -> Option<Obstacle> {
        self.obstacle
    }

    /// Which places some outputs need, and of which calls they need anything.
    pub(crate) fn needed(
        &self,
        outputs: impl IntoIterator<Item = Place>,
    ) -> (Vec<bool>, Vec<bool>) {
        let mut needed = vec![false; self.operations.len()];
        let mut called = vec![false; self.calls.len()];
        for output in outputs {
            needed[output as usize] = true;
        }
        for place in (0..self.operations.len()).rev() {
            if !needed[place] {
                continue;
            }
            let operation = self.operations[place];
            for operand in operation.operands() {
                needed[operand as usize] = true;
            }
            if let Operation::Result { call, .. } = operation
                && !called[call as usize]
            {
                called[call as usize] = true;
                for &given in &self.calls[call as usize].0.given {
                    needed[given as usize] = true;
                }
            }
        }
        (needed, called)
    }
}

thread_local! {
    static TAPE: RefCell<Tape> = RefCell::default();
}

/// What is done with the tape on which this thread writes.
pub(crate) fn with<R>(then: impl FnOnce(&mut Tape) -> R) -> R {
    TAPE.with_borrow_mut(then)
}

/// Writes on a tape of its own, and gives it with what comes out.
pub(crate) fn traced<R>(is_single: bool, then: impl FnOnce() -> R) -> (Tape, R) {
    let before = with(|tape| std::mem::replace(tape, Tape::new(is_single)));
    let result = then();
    let tape = with(|tape| std::mem::replace(tape, before));
    (tape, result)
}
