//! Derivatives of what an arena holds: forward, node by node, along directions of its inputs.
//!
//! Equal terms of several directions are one node, as everywhere in an arena, and zeros vanish.

use std::collections::BTreeMap;

use super::arena::{Arena, Expr, Input, Node, Stage};

/// What the inputs change by along a direction.
pub(crate) type Direction = BTreeMap<Input, Expr>;

/// The derivatives of some outputs along each of some directions.
pub(crate) fn along(
    arena: &mut Arena,
    outputs: &[Expr],
    directions: &[Direction],
) -> Vec<Vec<Expr>> {
    let live = arena.live(outputs, Stage::Parameter);
    let size = live.last().map_or(0, |last| last + 1);
    let of_direction = |direction: &Direction| {
        let mut slopes = vec![Arena::ZERO; size];
        for &place in &live {
            let node = arena.node(place);
            slopes[place] = match node {
                Node::Input(input) => direction.get(&input).copied().unwrap_or(Arena::ZERO),
                _ => {
                    let mut operands = node.operands();
                    let is_still = operands.all(|operand| of(&slopes, operand) == Arena::ZERO);
                    if is_still {
                        Arena::ZERO
                    } else {
                        slope(arena, place, &slopes)
                    }
                }
            };
        }
        outputs.iter().map(|&output| of(&slopes, output)).collect()
    };
    directions.iter().map(of_direction).collect()
}

/// The derivative of a signed reference. What is no operation later than literals has none.
fn of(slopes: &[Expr], operand: Expr) -> Expr {
    let slope = slopes.get(operand.node()).copied().unwrap_or(Arena::ZERO);
    if operand.is_negative() { -slope } else { slope }
}

/// The derivative of an operation by those of its operands.
fn slope(arena: &mut Arena, place: usize, slopes: &[Expr]) -> Expr {
    let node = arena.node(place);
    let value = arena.again(node, |operand| operand);
    match node {
        Node::Constant(_) | Node::Input(_) | Node::Sign(_) | Node::Round(_) | Node::Side(..) => {
            Arena::ZERO
        }
        Node::Add(a, b) => arena.add(of(slopes, a), of(slopes, b)),
        Node::Multiply(a, b) => {
            let first = arena.mul(of(slopes, a), b);
            let second = arena.mul(a, of(slopes, b));
            arena.add(first, second)
        }
        Node::Reciprocal(a) => {
            let square = arena.square(value);
            -arena.mul(square, of(slopes, a))
        }
        Node::SquareRoot(a) => {
            let twice = arena.add(value, value);
            arena.div(of(slopes, a), twice)
        }
        Node::Clamp(a) => {
            // Of 0 and 1 the derivative from inside.
            let above = arena.sub(Arena::ONE, a);
            let (low, high) = (arena.sign(a), arena.sign(above));
            let inside = arena.above(low, of(slopes, a));
            arena.above(high, inside)
        }
        Node::Sine(a) => {
            let cosine = arena.cos(a);
            arena.mul(cosine, of(slopes, a))
        }
        Node::Cosine(a) => {
            let sine = arena.sin(a);
            -arena.mul(sine, of(slopes, a))
        }
        Node::Exponential(a) => arena.mul(value, of(slopes, a)),
        Node::Angle(sine, cosine) => {
            let along = arena.mul(cosine, of(slopes, sine));
            let across = arena.mul(sine, of(slopes, cosine));
            let turned = arena.sub(along, across);
            let (a, b) = (arena.square(sine), arena.square(cosine));
            let square = arena.add(a, b);
            arena.div(turned, square)
        }
        Node::Above(side, a) => arena.above(side, of(slopes, a)),
        Node::Below(side, a) => arena.below(side, of(slopes, a)),
        Node::Curve(curve, a) => {
            let slope = arena.curve(curve.derived(), a);
            arena.mul(slope, of(slopes, a))
        }
    }
}

/// The same expressions with others in the place of some inputs.
pub(crate) fn with_inputs(
    arena: &mut Arena,
    expressions: &[Expr],
    of: impl Fn(Input) -> Option<Expr>,
) -> Vec<Expr> {
    let live = arena.live(expressions, Stage::Literal);
    let size = live.last().map_or(0, |last| last + 1);
    let mut known = vec![Arena::ZERO; size];
    let signed = |known: &[Expr], operand: Expr| {
        let value = known[operand.node()];
        if operand.is_negative() { -value } else { value }
    };
    for place in live {
        let node = arena.node(place);
        known[place] = match node {
            Node::Input(input) => of(input).unwrap_or_else(|| arena.input(input)),
            _ => arena.again(node, |operand| signed(&known, operand)),
        };
    }
    let expressions = expressions.iter();
    expressions
        .map(|&expression| signed(&known, expression))
        .collect()
}
