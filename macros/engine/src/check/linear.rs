//! Linear functions of numbers that may be symbols.

use proc_macro2::Span;

use super::later::{Later, Value};
use super::number::Numbers;
use crate::model::Number;

impl Numbers<'_> {
    /// A linear function of numbers: `row . vector + constant`.
    pub(super) fn linear<const N: usize>(
        &mut self,
        row: [f64; N],
        vector: [Number; N],
        constant: Number,
    ) -> Number {
        let terms = row.into_iter().zip(vector);
        let terms = terms.filter(|(factor, number)| *factor != 0.0 && *number != Number::ZERO);
        let sum = terms.fold(self.later(constant), |sum, (factor, number)| {
            sum.plus(self.later(number).times(factor))
        });
        self.number(sum, Span::call_site())
    }

    /// A number with the other sign.
    pub(super) fn negated(&mut self, number: Number) -> Number {
        self.linear([-1.0], [number], Number::ZERO)
    }

    pub(super) fn later(&self, number: Number) -> Value {
        let (place, is_varying) = match number {
            Number::Literal(value) => return Value::Literal(value),
            Number::Symbol(place) => (place, false),
            Number::Varying(place) => (place, true),
        };
        let symbol = &self.symbols[place as usize];
        Value::Later(Later {
            expression: symbol.expression.clone(),
            scalar: symbol.scalar.clone(),
            is_const: symbol.values.is_empty(),
            is_varying,
            values: symbol.values.clone(),
            like: symbol.like,
        })
    }
}
