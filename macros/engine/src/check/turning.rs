//! Rotations that the macro sees, or whose angles are known later.
//!
//! One of these is a single expression, an array of four. Formulas of its components would double
//! with every product.

use proc_macro2::{Span, TokenStream};
use quote::quote;

use super::later::{Later, Value, union};
use super::number::Numbers;
use crate::model::Number;
use crate::model::inertia::{IDENTITY, compose, rotation};
use crate::model::number::literals;

/// Euler parameters, scalar first.
#[derive(Clone, Debug)]
pub(super) enum Turn {
    Seen([f64; 4]),
    Later(LaterTurn),
}

/// Euler parameters as an expression.
#[derive(Clone, Debug)]
pub(super) struct LaterTurn {
    /// Of the type `[f64; 4]`.
    expression: TokenStream,
    /// Of the type `[__S; 4]`, where it depends on run-time values.
    scalar: Option<TokenStream>,
    is_varying: bool,
    values: Vec<usize>,
    like: Option<[f64; 4]>,
}

impl Turn {
    pub(super) const NONE: Self = Self::Seen(IDENTITY);

    pub(super) const fn seen(&self) -> Option<[f64; 4]> {
        match self {
            Self::Seen(p) => Some(*p),
            Self::Later(_) => None,
        }
    }

    fn tokens(&self) -> TokenStream {
        match self {
            Self::Seen([a, b, c, d]) => quote!([#a, #b, #c, #d]),
            Self::Later(later) => later.expression.clone(),
        }
    }

    /// Over `__S`.
    fn scalar(&self) -> TokenStream {
        match self {
            Self::Later(LaterTurn {
                scalar: Some(scalar),
                ..
            }) => scalar.clone(),
            other => {
                let tokens = other.tokens();
                quote!((#tokens).map(|e| __S::constant(e)))
            }
        }
    }

    const fn like(&self) -> Option<[f64; 4]> {
        match self {
            Self::Seen(p) => Some(*p),
            Self::Later(later) => later.like,
        }
    }

    fn values(&self) -> &[usize] {
        match self {
            Self::Seen(_) => &[],
            Self::Later(later) => &later.values,
        }
    }

    const fn is_run_time(&self) -> bool {
        matches!(self, Self::Later(later) if later.scalar.is_some())
    }

    const fn is_varying(&self) -> bool {
        matches!(self, Self::Later(later) if later.is_varying)
    }
}

impl Numbers<'_> {
    /// Four numbers as a rotation.
    pub(super) fn turn(&self, p: [Number; 4]) -> Turn {
        if let Some(p) = literals(&p) {
            return Turn::Seen(p);
        }
        let all = p.map(|number| self.later(number));
        let tokens = all.each_ref().map(Value::tokens);
        let scalars = all.each_ref().map(Value::scalar);
        let like = all.each_ref().map(Value::like);
        let like = match like {
            [Some(a), Some(b), Some(c), Some(d)] => Some([a, b, c, d]),
            _ => None,
        };
        Turn::Later(LaterTurn {
            expression: quote!([#(#tokens),*]),
            scalar: all
                .iter()
                .any(Value::is_run_time)
                .then(|| quote!([#(#scalars),*])),
            is_varying: all.iter().any(Value::is_varying),
            values: all
                .iter()
                .fold(Vec::new(), |known, one| union(&known, one.values())),
            like,
        })
    }

    /// The Euler parameters as four numbers.
    pub(super) fn parameters(&mut self, turn: &Turn) -> [Number; 4] {
        let later = match turn {
            Turn::Seen(p) => return p.map(Number::Literal),
            Turn::Later(later) => later,
        };
        [0_usize, 1, 2, 3].map(|k| {
            let expression = &later.expression;
            let value = Value::Later(Later {
                expression: quote!((#expression)[#k]),
                scalar: later.scalar.as_ref().map(|scalar| quote!((#scalar)[#k])),
                is_const: false,
                is_varying: later.is_varying,
                values: later.values.clone(),
                like: later.like.map(|p| p[k]),
            });
            self.number(value, Span::call_site())
        })
    }

    /// First the inner rotation, then the outer one.
    pub(super) fn composed(&self, outer: &Turn, inner: &Turn) -> Turn {
        if let (Some(outer), Some(inner)) = (outer.seen(), inner.seen()) {
            return Turn::Seen(compose(outer, inner));
        }
        let facade = self.facade;
        let (a, b) = (outer.tokens(), inner.tokens());
        let scalar = (outer.is_run_time() || inner.is_run_time()).then(|| {
            let (a, b) = (outer.scalar(), inner.scalar());
            quote!(#facade::__private::composed(#a, #b))
        });
        Turn::Later(LaterTurn {
            expression: quote!(#facade::__private::composed(#a, #b)),
            scalar,
            is_varying: outer.is_varying() || inner.is_varying(),
            values: union(outer.values(), inner.values()),
            like: outer.like().zip(inner.like()).map(|(a, b)| compose(a, b)),
        })
    }

    /// A rotation that is seen in a mirror.
    pub(super) fn mirrored(&self, turn: &Turn, mirror: Option<usize>) -> Turn {
        let Some(axis) = mirror else {
            return turn.clone();
        };
        let seen =
            |p: [f64; 4]| [0, 1, 2, 3].map(|k| if k == 0 || k == 1 + axis { p[k] } else { -p[k] });
        let later = match turn {
            Turn::Seen(p) => return Turn::Seen(seen(*p)),
            Turn::Later(later) => later,
        };
        let facade = self.facade;
        let turned = |p: &TokenStream| quote!(#facade::__private::mirrored(#p, #axis));
        Turn::Later(LaterTurn {
            expression: turned(&later.expression),
            scalar: later.scalar.as_ref().map(turned),
            like: later.like.map(seen),
            ..later.clone()
        })
    }

    /// A vector that is turned, and something added.
    pub(super) fn turned(
        &mut self,
        turn: &Turn,
        vector: [Number; 3],
        constant: [Number; 3],
    ) -> [Number; 3] {
        let all = vector.map(|number| self.later(number));
        let (p, facade) = (turn.tokens(), self.facade);
        let tokens = all.each_ref().map(Value::tokens);
        let expression = quote!(#facade::__private::turned(#p, [#(#tokens),*]));
        let is_run_time = turn.is_run_time() || all.iter().any(Value::is_run_time);
        let scalar = is_run_time.then(|| {
            let (p, scalars) = (turn.scalar(), all.each_ref().map(Value::scalar));
            quote!(#facade::__private::turned(#p, [#(#scalars),*]))
        });
        let own = turn.values().to_vec();
        let values = all
            .iter()
            .fold(own, |known, one| union(&known, one.values()));
        let like = match all.each_ref().map(Value::like) {
            [Some(x), Some(y), Some(z)] => turn
                .like()
                .map(|p| rotation(p).map(|row| row[0] * x + row[1] * y + row[2] * z)),
            _ => None,
        };
        let is_varying = turn.is_varying() || all.iter().any(Value::is_varying);
        [0_usize, 1, 2].map(|k| {
            let value = Value::Later(Later {
                expression: quote!((#expression)[#k]),
                scalar: scalar.as_ref().map(|scalar| quote!((#scalar)[#k])),
                is_const: false,
                is_varying,
                values: values.clone(),
                like: like.map(|vector| vector[k]),
            });
            let sum = self.later(constant[k]).plus(value);
            self.number(sum, Span::call_site())
        })
    }
}
