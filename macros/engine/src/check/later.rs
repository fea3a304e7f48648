//! Values of expressions: known at expansion, or later.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{BinOp, parse_quote};

use crate::syntax::words::local;

/// What an unknown number may be, where inputs may stand or not.
pub(super) const fn later_advice(are_inputs_refused: bool) -> &'static str {
    if are_inputs_refused {
        "; a number for run time is a field with `#[param]`"
    } else {
        "; a number for run time is a field with `#[param]`, or with `#[input]` if it changes during a run"
    }
}

/// A number, or an expression of type `f64`.
pub(super) enum Value {
    Literal(f64),
    Later(Later),
}

/// An expression of type `f64`.
pub(super) struct Later {
    /// As it was written.
    pub(super) expression: TokenStream,
    /// The same over `S`, where it depends on run-time values.
    pub(super) scalar: Option<TokenStream>,
    /// Whether the compiler can evaluate it.
    pub(super) is_const: bool,
    /// Whether it depends on inputs.
    pub(super) is_varying: bool,
    /// The places of the run-time values that it depends on, in order.
    pub(super) values: Vec<usize>,
    /// What it is at their typical values.
    pub(super) like: Option<f64>,
}

impl Value {
    /// The place of the run-time value that it is, without anything more.
    pub(super) fn itself(&self) -> Option<usize> {
        let Self::Later(later) = self else {
            return None;
        };
        let [place] = later.values[..] else {
            return None;
        };
        let parameters = local("parameters");
        let own = quote!(#parameters[#place]).to_string();
        let is_same = later
            .scalar
            .as_ref()
            .is_some_and(|found| found.to_string() == own);
        is_same.then_some(place)
    }

    pub(super) fn tokens(&self) -> TokenStream {
        match self {
            Self::Literal(value) => quote!(#value),
            Self::Later(later) => later.expression.clone(),
        }
    }

    pub(super) fn is_const(&self) -> bool {
        match self {
            Self::Literal(_) => true,
            Self::Later(later) => later.is_const,
        }
    }

    /// The value with the other sign.
    pub(super) fn negated(self) -> Self {
        match self {
            Self::Literal(value) => Self::Literal(-value),
            Self::Later(later) => {
                let expression = &later.expression;
                Self::Later(Later {
                    expression: quote!((-(#expression))),
                    scalar: later.scalar.map(|scalar| quote!((-(#scalar)))),
                    like: later.like.map(|like| -like),
                    ..later
                })
            }
        }
    }

    /// What an operator makes of two values; `None` if it is none of numbers.
    pub(super) fn combined(self, op: &BinOp, right: Self) -> Option<Self> {
        Some(match op {
            BinOp::Add(_) => self.by(op, |x, y| x + y, right),
            BinOp::Sub(_) => self.by(op, |x, y| x - y, right),
            BinOp::Mul(_) => self.by(op, |x, y| x * y, right),
            BinOp::Div(_) => self.by(op, |x, y| x / y, right),
            _ => return None,
        })
    }

    /// A sum. What is zero is left out.
    pub(super) fn plus(self, right: Self) -> Self {
        match self {
            Self::Literal(0.0) => right,
            _ => self.by(&parse_quote!(+), |x, y| x + y, right),
        }
    }

    /// A product with a number that is seen.
    pub(super) fn times(self, factor: f64) -> Self {
        match factor {
            1.0 => self,
            -1.0 => self.negated(),
            _ => Self::Literal(factor).by(&parse_quote!(*), |x, y| x * y, self),
        }
    }

    fn by(self, op: &BinOp, operation: fn(f64, f64) -> f64, right: Self) -> Self {
        if let (Self::Literal(x), Self::Literal(y)) = (&self, &right) {
            return Self::Literal(operation(*x, *y));
        }
        let (x, y) = (self.tokens(), right.tokens());
        let scalar = (self.is_run_time() || right.is_run_time()).then(|| {
            let (x, y) = (self.scalar(), right.scalar());
            match op {
                BinOp::Div(_) => quote!((#x * __S::reciprocal(#y))),
                _ => quote!((#x #op #y)),
            }
        });
        Self::Later(Later {
            expression: quote!((#x #op #y)),
            scalar,
            is_const: self.is_const() && right.is_const(),
            is_varying: self.is_varying() || right.is_varying(),
            values: union(self.values(), right.values()),
            like: self.like().zip(right.like()).map(|(x, y)| operation(x, y)),
        })
    }

    /// The value over `S`.
    pub(super) fn scalar(&self) -> TokenStream {
        match self {
            Self::Later(Later {
                scalar: Some(scalar),
                ..
            }) => scalar.clone(),
            other => {
                let value = other.tokens();
                quote!(__S::constant(#value))
            }
        }
    }

    pub(super) fn is_varying(&self) -> bool {
        matches!(self, Self::Later(later) if later.is_varying)
    }

    /// The places of the run-time values that it depends on.
    pub(super) fn values(&self) -> &[usize] {
        match self {
            Self::Literal(_) => &[],
            Self::Later(later) => &later.values,
        }
    }

    /// What it is at their typical values.
    pub(super) fn like(&self) -> Option<f64> {
        match self {
            Self::Literal(value) => Some(*value),
            Self::Later(later) => later.like,
        }
    }

    /// Whether it depends on run-time values.
    pub(super) fn is_run_time(&self) -> bool {
        matches!(self, Self::Later(later) if later.scalar.is_some())
    }
}

/// Places of two lists, in order.
pub(super) fn union(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut all = [a, b].concat();
    all.sort_unstable();
    all.dedup();
    all
}
