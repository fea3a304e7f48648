//! The value of expressions at a given state, for decisions at expansion.

use super::arena::{Arena, Expr, Input, Node, Stage};

/// The values of the outputs; `None` where an input is not known.
pub fn evaluate(
    arena: &Arena,
    outputs: &[Expr],
    input: impl Fn(Input) -> Option<f64>,
) -> Vec<Option<f64>> {
    let mut values: Vec<Option<f64>> = vec![None; arena.len()];
    let signed = |values: &[Option<f64>], expr: Expr| {
        values[expr.node()].map(|value| if expr.is_negative() { -value } else { value })
    };
    for place in arena.live(outputs, Stage::Literal) {
        values[place] = match arena.node(place) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            Node::Input(known) => input(known),
            Node::Add(a, b) => signed(&values, a)
                .zip(signed(&values, b))
                .map(|(a, b)| a + b),
            Node::Multiply(a, b) => signed(&values, a)
                .zip(signed(&values, b))
                .map(|(a, b)| a * b),
            Node::Reciprocal(a) => signed(&values, a).map(f64::recip),
            Node::SquareRoot(a) => signed(&values, a).map(f64::sqrt),
            Node::Sign(a) => signed(&values, a).map(|a| if a < 0.0 { -1.0 } else { 1.0 }),
            Node::Clamp(a) => signed(&values, a).map(|a| a.clamp(0.0, 1.0)),
            Node::Round(a) => signed(&values, a).map(f64::round),
            Node::Sine(a) => signed(&values, a).map(f64::sin),
            Node::Cosine(a) => signed(&values, a).map(f64::cos),
            Node::Exponential(a) => signed(&values, a).map(f64::exp),
            Node::Angle(sine, cosine) => signed(&values, sine)
                .zip(signed(&values, cosine))
                .map(|(sine, cosine)| sine.atan2(cosine)),
        };
    }
    outputs
        .iter()
        .map(|&output| signed(&values, output))
        .collect()
}
