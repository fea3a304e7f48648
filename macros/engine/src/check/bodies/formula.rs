//! Formulas over what is written: sums and products of expressions, which are read like any other.
//! What is written as zero vanishes, so that what does not depend on a parameter is seen.

use quote::ToTokens;
use syn::{Expr, parse_quote};

use crate::diag::code;
use crate::syntax::ungroup;

/// A number as an expression.
pub(super) fn number(value: f64) -> Expr {
    parse_quote!(#value)
}

/// Whether zero is written.
pub(super) fn is_zero(expr: &Expr) -> bool {
    written(expr) == Some(0.0)
}

/// A number that is written as such, with its sign.
fn written(expr: &Expr) -> Option<f64> {
    match ungroup(expr) {
        Expr::Lit(found) => match &found.lit {
            syn::Lit::Float(float) => float.base10_parse().ok(),
            syn::Lit::Int(int) => int.base10_parse().ok(),
            _ => None,
        },
        Expr::Unary(unary) if matches!(unary.op, syn::UnOp::Neg(_)) => {
            written(&unary.expr).map(|value| -value)
        }
        _ => None,
    }
}

/// `a + b`.
pub(super) fn sum(a: &Expr, b: &Expr) -> Expr {
    match (is_zero(a), is_zero(b)) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => parse_quote!(((#a) + (#b))),
    }
}

/// `a - b`; zero where both are written alike.
pub(super) fn difference(a: &Expr, b: &Expr) -> Expr {
    let is_same = || code(ungroup(a).to_token_stream()) == code(ungroup(b).to_token_stream());
    match (is_zero(a), is_zero(b)) {
        (_, true) => a.clone(),
        (true, false) => negative(b),
        _ if is_same() => number(0.0),
        _ => parse_quote!(((#a) - (#b))),
    }
}

/// `-a`.
pub(super) fn negative(a: &Expr) -> Expr {
    if is_zero(a) {
        a.clone()
    } else {
        parse_quote!((-(#a)))
    }
}

/// `a * b`.
pub(super) fn product(a: &Expr, b: &Expr) -> Expr {
    match (written(a), written(b)) {
        (Some(0.0), _) | (_, Some(0.0)) => number(0.0),
        (Some(1.0), _) => b.clone(),
        (_, Some(1.0)) => a.clone(),
        _ => parse_quote!(((#a) * (#b))),
    }
}

/// `a * a`.
pub(super) fn square(a: &Expr) -> Expr {
    product(a, a)
}

/// `factor * a`.
pub(super) fn times(factor: f64, a: &Expr) -> Expr {
    product(&number(factor), a)
}

/// The length of a vector: of one component its size, of which the macro sees the sign.
pub(super) fn length(d: &[Expr; 3]) -> Expr {
    let squares = d.each_ref().map(square);
    let [x, y, z] = &squares;
    let sum = sum(&sum(x, y), z);
    parse_quote!(sqrt(#sum))
}
