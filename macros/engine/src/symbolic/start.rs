//! Expressions in the reference configuration, where every body stands as its attributes say.

use super::arena::{Arena, Expr};
use super::expression::{ScalarExpr, VectorExpr};
use super::fixed::{Placement, apply, clean, placement, size, transpose};
use super::vector::{Triple, ZERO, cross, dot};
use crate::model::Model;

/// A vector in the reference configuration, global axes.
pub(super) fn vector(arena: &mut Arena, model: &Model, expr: &VectorExpr) -> Triple {
    match expr {
        VectorExpr::Fixed(body, s) => {
            let Placement { axes, .. } = placement(arena, model, *body);
            let turned = apply(arena, axes, *s);
            let scale = size(arena, *s);
            clean(arena, turned, scale)
        }
        VectorExpr::Point(body, s) => {
            let Placement { axes, position, .. } = placement(arena, model, *body);
            let turned = apply(arena, axes, *s);
            let scale = size(arena, *s).max(size(arena, position));
            let point = [0, 1, 2].map(|k| arena.add(position[k], turned[k]));
            clean(arena, point, 2.0 * scale)
        }
        VectorExpr::Sum(terms) => {
            let mut sum = ZERO;
            let mut scale = 0.0_f64;
            for (factor, term) in terms {
                let term = vector(arena, model, term);
                let term = term.map(|component| arena.mul(*factor, component));
                scale = scale.max(size(arena, term));
                for (sum, component) in sum.iter_mut().zip(term) {
                    *sum = arena.add(*sum, component);
                }
            }
            clean(arena, sum, scale)
        }
        VectorExpr::Scaled(factor, term) => {
            let factor = scalar(arena, model, factor);
            vector(arena, model, term).map(|component| arena.mul(factor, component))
        }
        VectorExpr::Cross(a, b) => {
            let (a, b) = (vector(arena, model, a), vector(arena, model, b));
            cross(arena, a, b)
        }
        VectorExpr::Rate(_) | VectorExpr::Spin(_) => {
            unreachable!("the language refuses rates in the reference configuration")
        }
    }
}

/// A vector in the reference configuration, in the principal axes of a body.
pub(crate) fn on_body(
    arena: &mut Arena,
    model: &Model,
    expr: &VectorExpr,
    body: Option<usize>,
) -> Triple {
    let global = vector(arena, model, expr);
    let Placement { axes, .. } = placement(arena, model, body);
    let scale = size(arena, global);
    let turned = apply(arena, transpose(axes), global);
    clean(arena, turned, scale)
}

/// A scalar in the reference configuration; angles over many turns are zero there.
pub(super) fn scalar(arena: &mut Arena, model: &Model, expr: &ScalarExpr) -> Expr {
    match expr {
        ScalarExpr::Constant(value) => *value,
        ScalarExpr::Dot(a, b) => {
            let (a, b) = (vector(arena, model, a), vector(arena, model, b));
            dot(arena, a, b)
        }
        ScalarExpr::Sum(terms) => {
            let mut sum = Arena::ZERO;
            for (factor, term) in terms {
                let term = scalar(arena, model, term);
                let product = arena.mul(*factor, term);
                sum = arena.add(sum, product);
            }
            sum
        }
        ScalarExpr::Product(a, b) => {
            let (a, b) = (scalar(arena, model, a), scalar(arena, model, b));
            arena.mul(a, b)
        }
        ScalarExpr::Function(function, inner) => {
            let inner = scalar(arena, model, inner);
            function.value(arena, inner)
        }
        ScalarExpr::Direction(angle) => {
            let sine = scalar(arena, model, &angle.sine);
            let cosine = scalar(arena, model, &angle.cosine);
            arena.atan2(sine, cosine)
        }
        ScalarExpr::Angle(_) => Arena::ZERO,
        ScalarExpr::Time
        | ScalarExpr::Setpoint(_)
        | ScalarExpr::Rate(_)
        | ScalarExpr::Side { .. }
        | ScalarExpr::Select { .. }
        | ScalarExpr::State { .. } => {
            unreachable!("the language refuses time, rates and laws in the reference configuration")
        }
    }
}
