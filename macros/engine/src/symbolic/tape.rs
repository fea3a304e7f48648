//! Outputs as a list of operations, for evaluation by numbers, again and again.

use super::arena::{Arena, Expr, Input, Node, Stage};

/// The operations that some outputs need, in order of computation.
#[derive(Clone, Debug)]
pub struct Tape {
    /// Operands are places of the tape.
    nodes: Vec<Node>,
    outputs: Vec<Expr>,
}

impl Tape {
    /// What the outputs need of an arena.
    #[must_use]
    pub fn new(arena: &Arena, outputs: &[Expr]) -> Self {
        let live = arena.live(outputs, Stage::Literal);
        let mut places = vec![0; arena.len()];
        for (place, &node) in live.iter().enumerate() {
            places[node] = place as u32;
        }
        let moved = |expr: Expr| Expr::new(places[expr.node()], expr.is_negative());
        Self {
            nodes: live
                .iter()
                .map(|&node| arena.node(node).with_operands(moved))
                .collect(),
            outputs: outputs.iter().map(|&output| moved(output)).collect(),
        }
    }

    /// Whether an input is read that has a property.
    pub fn reads(&self, property: impl Fn(Input) -> bool) -> bool {
        self.nodes
            .iter()
            .any(|node| matches!(*node, Node::Input(input) if property(input)))
    }

    /// The outputs; `None` where they need a spline, or an input that is not known.
    pub fn evaluate(&self, input: impl Fn(Input) -> Option<f64>) -> Option<Vec<f64>> {
        let mut values = Vec::with_capacity(self.nodes.len());
        for &node in &self.nodes {
            let value = match node {
                Node::Input(known) => input(known)?,
                Node::Curve(..) => return None,
                _ => node.value(|operand| signed(&values, operand)),
            };
            values.push(value);
        }
        let outputs = self.outputs.iter();
        Some(outputs.map(|&output| signed(&values, output)).collect())
    }
}

fn signed(values: &[f64], expr: Expr) -> f64 {
    let value = values[expr.node()];
    if expr.is_negative() { -value } else { value }
}
