//! The value of expressions at a given state, for decisions at expansion.

use super::arena::{Arena, Expr, Input, Node, Stage};

/// The values of the outputs; `None` where an input is not known, or a spline.
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
            Node::Input(known) => input(known),
            Node::Curve(..) => None,
            node => {
                let is_known = |operand: Expr| values[operand.node()].is_some();
                let value = |operand| signed(&values, operand).unwrap_or(f64::NAN);
                node.operands().all(is_known).then(|| node.value(value))
            }
        };
    }
    outputs
        .iter()
        .map(|&output| signed(&values, output))
        .collect()
}
