//! Numbers out of sums: `c a x + c b y` is `c (a x + b y)`.
//!
//! Which products meet in a sum is known at the end only, when an entry with a factor, such as an
//! arm of half a metre along an axis, has not been used by anything else. So this is done to what a
//! kernel computes, not while it is put together.

use super::arena::{Arena, Expr, Node, Stage};
use super::count::count;
use super::equations::Kernel;
use super::processor::Processor;
use super::time::time;

impl Kernel {
    /// Takes common numbers out of sums, if that leaves fewer operations, with those on the longest
    /// path counted twice, and takes no longer. `whole` nodes stay. Something else is put in their
    /// place later, and what is made of a sum taken apart would not be replaced.
    pub(crate) fn gather(&mut self, whole: &[Expr]) {
        let gathered = gathered(&mut self.arena, &self.outputs, whole);
        let cost = |outputs: &[Expr]| count(&self.arena, outputs, Stage::State).weighted();
        if cost(&gathered) < cost(&self.outputs) && !self.is_slower(&gathered) {
            self.outputs = gathered;
        }
    }

    /// Whether other outputs take longer, by more than estimates are wrong about two forms of one
    /// kernel. A number that comes out of one sum after the other makes their chain longer.
    fn is_slower(&self, outputs: &[Expr]) -> bool {
        /// A twentieth: smaller differences were not found again by measurements.
        const PARTS: usize = 20;
        let call = |outputs| time(&self.arena, outputs, Stage::State, &Processor::X86_64_V3).call;
        PARTS * call(outputs) > (PARTS + 1) * call(&self.outputs)
    }
}

/// A term of a sum: a number, and what it is multiplied with.
struct Term {
    number: f64,
    factors: [Expr; 2],
}

/// How often nodes are used, and what stands in their places.
struct Gathering {
    uses: Vec<usize>,
    known: Vec<Expr>,
}

fn gathered(arena: &mut Arena, outputs: &[Expr], whole: &[Expr]) -> Vec<Expr> {
    let live = arena.live(outputs, Stage::State);
    let mut uses = vec![0; arena.len()];
    // What is used by a sum alone is a part of it.
    let mut is_part = vec![false; arena.len()];
    for &place in &live {
        let node = arena.node(place);
        for operand in node.operands() {
            uses[operand.node()] += 1;
            is_part[operand.node()] = matches!(node, Node::Add(..));
        }
    }
    // No part of a sum, whatever else uses it.
    for expr in outputs.iter().chain(whole) {
        uses[expr.node()] += 2;
    }
    let mut is_whole = vec![false; arena.len()];
    for expr in whole {
        is_whole[expr.node()] = true;
    }
    let nodes = 0..arena.len() as u32;
    let mut gathering = Gathering {
        known: nodes.map(|place| Expr::new(place, false)).collect(),
        uses,
    };
    for place in live {
        if is_whole[place] {
            continue;
        }
        let node = arena.node(place);
        let is_part = is_part[place] && gathering.uses[place] == 1;
        let made = match node {
            Node::Add(..) if !is_part => gathering.sum(arena, place),
            _ => arena.again(node, |operand| gathering.of(operand)),
        };
        if let Some(label) = arena.label(place).map(str::to_owned) {
            arena.name(made, || label);
        }
        gathering.known[place] = made;
    }
    outputs.iter().map(|&output| gathering.of(output)).collect()
}

impl Gathering {
    fn of(&self, expr: Expr) -> Expr {
        let known = self.known[expr.node()];
        if expr.is_negative() { -known } else { known }
    }

    /// A sum with the numbers that its terms have in common taken out.
    fn sum(&self, arena: &mut Arena, place: usize) -> Expr {
        let mut groups: Vec<Vec<(bool, Term)>> = Vec::new();
        let mut terms = Vec::new();
        for leaf in self.leaves(arena, place) {
            let Some(term) = self.term(arena, leaf) else {
                terms.push(leaf);
                continue;
            };
            let same = |group: &&mut Vec<(bool, Term)>| group[0].1.number == term.number;
            match groups.iter_mut().find(same) {
                Some(group) => group.push((leaf.is_negative(), term)),
                None => groups.push(vec![(leaf.is_negative(), term)]),
            }
        }
        if groups.iter().all(|group| group.len() < 2) {
            return arena.again(arena.node(place), |operand| self.of(operand));
        }
        let mut sum = Arena::ZERO;
        for leaf in terms {
            let term = self.of(leaf);
            sum = arena.add(sum, term);
        }
        for group in groups {
            let mut rest = Arena::ZERO;
            let number = arena.constant(group[0].1.number);
            for (
                is_negative,
                Term {
                    factors: [a, b], ..
                },
            ) in group
            {
                let product = arena.mul(self.of(a), self.of(b));
                rest = arena.add(rest, if is_negative { -product } else { product });
            }
            let product = arena.mul(number, rest);
            sum = arena.add(sum, product);
        }
        sum
    }

    /// The terms of a sum; inner sums that nothing else needs are taken apart.
    fn leaves(&self, arena: &Arena, place: usize) -> Vec<Expr> {
        let mut leaves = Vec::new();
        let mut open: Vec<Expr> = arena.node(place).operands().collect();
        open.reverse();
        while let Some(expr) = open.pop() {
            match arena.node(expr.node()) {
                Node::Add(a, b) if self.uses[expr.node()] == 1 => {
                    let of = |x: Expr| if expr.is_negative() { -x } else { x };
                    open.extend([of(b), of(a)]);
                }
                _ => leaves.push(expr),
            }
        }
        leaves
    }

    /// `c a b` that nothing else needs, whose number may be taken out.
    fn term(&self, arena: &Arena, leaf: Expr) -> Option<Term> {
        let is_own = |expr: Expr| self.uses[expr.node()] == 1;
        let factors = |expr: Expr| match arena.node(expr.node()) {
            Node::Multiply(a, b) if is_own(expr) => Some((a, b)),
            _ => None,
        };
        let (a, b) = factors(leaf)?;
        for (number, rest) in [(a, b), (b, a)] {
            if let Some(number) = arena.literal(number) {
                let factors = [rest, Arena::ONE];
                return Some(Term { number, factors });
            }
        }
        for (scaled, other) in [(a, b), (b, a)] {
            let Some((a, b)) = factors(scaled) else {
                continue;
            };
            for (number, rest) in [(a, b), (b, a)] {
                // Before the state is known, a product costs nothing.
                if let Some(number) = arena.literal(number)
                    && arena.stage(rest) >= Stage::State
                {
                    let factors = [rest, other];
                    return Some(Term { number, factors });
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Arena, Kernel, Stage, count};
    use crate::symbolic::arena::Input;
    use crate::symbolic::evaluate::evaluate;

    /// `x0 + 0.5 x1 x4 - 0.5 x2 x5 + 0.25 x3`, and what else is given.
    fn kernel(others: &[usize]) -> Kernel {
        let mut arena = Arena::new();
        let x = [0, 1, 2, 3, 4, 5].map(|k| arena.input(Input::Coordinate(k)));
        let [half, quarter] = [0.5, 0.25].map(|number| arena.constant(number));
        let scaled = [1, 2].map(|k| arena.mul(half, x[k]));
        let [first, second] = [(0, 4), (1, 5)].map(|(k, l)| arena.mul(scaled[k], x[l]));
        let last = arena.mul(quarter, x[3]);
        let sum = arena.sum([x[0], first, -second, last]);
        let others = others.iter().map(|&k| scaled[k]);
        Kernel {
            outputs: std::iter::once(sum).chain(others).collect(),
            arena,
        }
    }

    fn operations(kernel: &Kernel) -> usize {
        count(&kernel.arena, &kernel.outputs, Stage::State).total()
    }

    fn values(kernel: &Kernel) -> Vec<Option<f64>> {
        evaluate(&kernel.arena, &kernel.outputs, |input| match input {
            Input::Coordinate(k) => Some(f64::from(k + 3)),
            _ => None,
        })
    }

    #[test]
    fn a_number_is_taken_out_of_the_products_that_have_it() {
        let mut gathered = kernel(&[]);
        gathered.gather(&[]);
        assert_eq!((operations(&kernel(&[])), operations(&gathered)), (8, 7));
        // 3 + 0.5 (4 * 7 - 5 * 8) + 0.25 * 6
        assert_eq!(values(&gathered), [Some(-1.5)]);
    }

    #[test]
    fn what_is_used_elsewhere_stays() {
        for others in [&[0][..], &[0, 1]] {
            let mut gathered = kernel(others);
            gathered.gather(&[]);
            assert_eq!(operations(&gathered), operations(&kernel(others)));
            assert_eq!(values(&gathered), values(&kernel(others)));
        }
    }

    #[test]
    fn a_whole_sum_stays_one_node() {
        // 2 x0 x1 + 2 x2 x3, alone and as a term of another sum.
        let mut arena = Arena::new();
        let x = [0, 1, 2, 3, 4].map(|k| arena.input(Input::Coordinate(k)));
        let two = arena.constant(2.0);
        let products = [(0, 1), (2, 3)].map(|(k, l)| {
            let doubled = arena.mul(two, x[k]);
            arena.mul(doubled, x[l])
        });
        let entry = arena.sum(products);
        let sum = arena.add(entry, x[4]);
        for output in [entry, sum] {
            let taken_apart = |whole: &[_]| {
                let mut gathered = Kernel {
                    arena: arena.clone(),
                    outputs: vec![output],
                };
                gathered.gather(whole);
                let live = gathered.arena.live(&gathered.outputs, Stage::State);
                !live.contains(&entry.node())
            };
            assert!(taken_apart(&[]) && !taken_apart(&[entry]));
        }
    }
}
