//! What an order of rows fills in, once all bodies are eliminated.

use std::collections::BTreeSet;

/// Rows that are eliminated one after the other.
pub(super) struct Block {
    pub(super) equations: usize,
    /// The bodies that they act on.
    pub(super) bodies: BTreeSet<usize>,
}

/// How many entries of `D M^-1 D^T` become other than zero if rows are eliminated in this order.
/// Rows are coupled where they act on the same body.
pub(super) fn fill(blocks: &[Block]) -> usize {
    let is_coupled = |k: usize, l: &usize| !blocks[k].bodies.is_disjoint(&blocks[*l].bodies);
    let coupled = |k: usize| {
        (k + 1..blocks.len())
            .filter(move |l| is_coupled(k, l))
            .collect()
    };
    let mut behind: Vec<BTreeSet<usize>> = (0..blocks.len()).map(coupled).collect();
    let mut fill = 0;
    for place in 0..blocks.len() {
        let coupled: Vec<usize> = behind[place].iter().copied().collect();
        for (at, &k) in coupled.iter().enumerate() {
            for &l in &coupled[at + 1..] {
                if behind[k].insert(l) {
                    fill += blocks[k].equations * blocks[l].equations;
                }
            }
        }
    }
    fill
}

#[cfg(test)]
mod tests {
    use super::{Block, fill};

    /// Hinges of a tree in which each body carries two others, by the body that they carry.
    fn filled(order: [usize; 7]) -> usize {
        let hinge = |body: usize| Block {
            equations: 5,
            bodies: [body, (body - 1) / 2].into_iter().collect(),
        };
        let trunk = || Block {
            equations: 5,
            bodies: [0].into_iter().collect(),
        };
        let blocks = order.map(|body| if body == 0 { trunk() } else { hinge(body) });
        fill(&blocks)
    }

    #[test]
    fn a_tree_fills_in_from_the_ground_and_not_from_its_leaves() {
        assert_eq!(filled([3, 4, 5, 6, 1, 2, 0]), 0);
        // Hinge 1 couples 2 with 3 and 4, and hinge 2 those with 5 and 6.
        assert_eq!(filled([0, 1, 2, 3, 4, 5, 6]), 6 * 25);
    }
}
