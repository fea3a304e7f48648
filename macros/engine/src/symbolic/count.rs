//! What expressions cost. One of `+ - * / sqrt` is one operation, and so is a call of a function;
//! signs, comparisons and rounding are free.

use super::arena::{Arena, Expr, Node, Stage};

/// Operations by kind, and the longest chain of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Reciprocals.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Calls of `sin`, `cos`, `exp` and `atan2`, and readings of splines.
    pub functions: usize,
    /// The longest chain of dependent operations.
    pub depth: usize,
}

impl Count {
    /// All operations together.
    #[must_use]
    pub const fn total(&self) -> usize {
        self.additions + self.multiplications + self.divisions + self.square_roots + self.functions
    }

    /// What is compared where one way is chosen among several: the operations, those on the longest
    /// chain twice. A kernel that is called from step to step of an integrator waits for the chain,
    /// so that few operations are not worth a chain that is much longer.
    #[must_use]
    pub const fn weighted(&self) -> usize {
        self.total() + self.depth
    }
}

/// The operations that the outputs need, of the given stage or later.
#[must_use]
pub fn count(arena: &Arena, outputs: &[Expr], from: Stage) -> Count {
    let mut count = Count::default();
    let mut depth = vec![0_usize; arena.len()];
    for place in arena.live(outputs, from) {
        let node = arena.node(place);
        let (first, second) = node.pair();
        let of = |operand: Option<Expr>| operand.map_or(0, |operand| depth[operand.node()]);
        let before = of(first).max(of(second));
        match node {
            // Free, but part of the chain.
            _ if !node.is_operation() => {
                depth[place] = before;
                continue;
            }
            Node::Add(..) => count.additions += 1,
            Node::Multiply(..) => count.multiplications += 1,
            Node::Reciprocal(_) => count.divisions += 1,
            Node::SquareRoot(_) => count.square_roots += 1,
            _ => count.functions += 1,
        }
        depth[place] = before + 1;
        count.depth = count.depth.max(before + 1);
    }
    count
}
