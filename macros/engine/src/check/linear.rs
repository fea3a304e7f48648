//! Linear functions of numbers that may be symbols.

use syn::BinOp;

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
        let mut sum = self.later(constant);
        for (factor, number) in row.into_iter().zip(vector) {
            if factor == 0.0 || number == Number::ZERO {
                continue;
            }
            let value = self.later(number);
            let (value, op) = match factor {
                1.0 => (Some(value), syn::parse_quote!(+)),
                -1.0 => (Some(value), syn::parse_quote!(-)),
                _ => {
                    let factor = Value::Literal(factor);
                    let product = factor.combined(&syn::parse_quote!(*), value);
                    (product, syn::parse_quote!(+))
                }
            };
            let Some(value) = value else { continue };
            sum = match (sum, &op) {
                (Value::Literal(0.0), BinOp::Add(_)) => value,
                (Value::Literal(0.0), _) => value.negated(),
                (other, op) => match other.combined(op, value) {
                    Some(sum) => sum,
                    None => return constant,
                },
            };
        }
        let span = proc_macro2::Span::call_site();
        self.number(sum, span).unwrap_or(constant)
    }

    /// A number with the other sign.
    pub(super) fn negated(&mut self, number: Number) -> Number {
        self.linear([-1.0], [number], Number::ZERO)
    }

    fn later(&self, number: Number) -> Value {
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
