//! How often the nodes of a straight line are used, and which products are written with a sum.

use super::arena::{Arena, Expr, Node};

/// How often nodes are used.
pub(crate) struct Uses<'a> {
    pub(crate) arena: &'a Arena,
    /// The nodes in order of computation.
    pub(crate) live: &'a [usize],
    /// By node.
    pub(crate) uses: Vec<u32>,
    /// Whether a node is among those.
    pub(crate) is_own: Vec<bool>,
}

impl<'a> Uses<'a> {
    pub(crate) fn new(arena: &'a Arena, live: &'a [usize], outputs: &[Expr]) -> Self {
        let mut uses = vec![0_u32; arena.len()];
        let mut is_own = vec![false; arena.len()];
        for &place in live {
            is_own[place] = true;
            let node = arena.node(place);
            let written = if matches!(node, Node::Clamp(_)) { 3 } else { 1 };
            for operand in node.operands() {
                uses[operand.node()] += written;
            }
        }
        // What is an output is used besides.
        for output in outputs {
            uses[output.node()] += 2;
        }
        Self {
            arena,
            live,
            uses,
            is_own,
        }
    }

    /// Products that one sum alone uses, one for each sum: they are written there, as a fused
    /// multiply-add.
    pub(crate) fn fused_products(&self) -> Fused {
        let arena = self.arena;
        let fusible = |x: Expr| {
            let is_product = matches!(arena.get(x), Node::Multiply(..));
            is_product && self.is_own[x.node()] && self.uses[x.node()] == 1
        };
        let mut is_fused = vec![false; arena.len()];
        for &place in self.live {
            match arena.node(place) {
                Node::Add(_, b) if fusible(b) => is_fused[b.node()] = true,
                Node::Add(a, _) if fusible(a) => is_fused[a.node()] = true,
                _ => {}
            }
        }
        Fused(is_fused)
    }
}

/// The products that are written with a sum.
pub(crate) struct Fused(Vec<bool>);

impl Fused {
    /// Whether a node is one of them.
    pub(crate) fn contains(&self, place: usize) -> bool {
        self.0[place]
    }

    /// The operand of a sum that is fused into it, and the other one.
    pub(crate) fn operand(&self, a: Expr, b: Expr) -> Option<(Expr, Expr)> {
        if self.contains(b.node()) {
            Some((b, a))
        } else if self.contains(a.node()) {
            Some((a, b))
        } else {
            None
        }
    }
}
