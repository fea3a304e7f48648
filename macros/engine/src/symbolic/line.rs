//! A straight line as operations of a processor, as the code is written.

use std::collections::BTreeSet;

use super::arena::{Arena, Expr, Node, Stage};
use super::processor::Processor;
use super::uses::Uses;

/// An operation as it is written, on the results of others.
pub(super) struct Step {
    latency: usize,
    operands: Vec<usize>,
    /// Whether an operand comes from memory.
    reads_memory: bool,
}

/// A straight line as operations of a processor.
pub(super) struct Line {
    pub(super) steps: Vec<Step>,
    /// The values that it loads: inputs, what is known earlier, numbers.
    pub(super) loads: usize,
    /// The cycles that sums keep units busy.
    pub(super) summed: usize,
    /// The cycles that products and functions keep units busy.
    pub(super) multiplied: usize,
    /// The cycles that reciprocals and roots keep theirs.
    pub(super) divided: usize,
}

impl Line {
    pub(super) fn new(arena: &Arena, outputs: &[Expr], from: Stage, processor: &Processor) -> Self {
        let live = arena.live(outputs, from);
        let uses = Uses::new(arena, &live, outputs);
        let fused = uses.fused_products();
        let mut step_of = vec![None; arena.len()];
        let mut loaded = BTreeSet::new();
        let mut line = Self {
            steps: Vec::new(),
            loads: 0,
            summed: 0,
            multiplied: 0,
            divided: 0,
        };
        for &place in &live {
            let node = arena.node(place);
            let mut operands: Vec<Expr> = node.operands().collect();
            let (unit, busy) = match node {
                Node::Constant(_) | Node::Input(_) => continue,
                Node::Multiply(..) if fused.contains(place) => continue,
                Node::Multiply(..) => (processor.product, &mut line.multiplied),
                Node::Add(a, b) => match fused.operand(a, b) {
                    Some((product, other)) => {
                        operands = arena.get(product).operands().chain([other]).collect();
                        (processor.product_with_sum(), &mut line.multiplied)
                    }
                    None => (processor.sum, &mut line.summed),
                },
                Node::Reciprocal(_) => (processor.reciprocal, &mut line.divided),
                Node::SquareRoot(_) => (processor.square_root, &mut line.divided),
                _ if !node.is_operation() => (processor.sum, &mut line.summed),
                _ => (processor.function, &mut line.multiplied),
            };
            *busy += unit.busy;
            let operands = operands.iter().map(|operand| operand.node());
            let (computed, read): (Vec<usize>, Vec<usize>) =
                operands.partition(|&operand| step_of[operand].is_some());
            step_of[place] = Some(line.steps.len());
            line.steps.push(Step {
                latency: unit.latency,
                reads_memory: !read.is_empty(),
                operands: computed.into_iter().filter_map(|of| step_of[of]).collect(),
            });
            loaded.extend(read);
        }
        line.loads = loaded.len();
        line
    }

    /// The longest chain of steps, the first of which may have to wait for a load.
    pub(super) fn path(&self, load: usize) -> usize {
        let mut ready: Vec<usize> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let first = if step.reads_memory { load } else { 0 };
            let operands = step.operands.iter().map(|&operand| ready[operand]);
            let start = operands.max().unwrap_or(0).max(first);
            ready.push(start + step.latency);
        }
        ready.into_iter().max().unwrap_or(0)
    }

    /// The results that wait in memory for their next use, and how often they are loaded again,
    /// where so many stand in registers. That whose next use is the last gives way: L. Belady, *A
    /// study of replacement algorithms for virtual-storage computers*, IBM Systems Journal 5, 1966.
    pub(super) fn spills(&self, registers: usize) -> (usize, usize) {
        // The next one stands last.
        let mut uses = vec![Vec::new(); self.steps.len()];
        for (number, step) in self.steps.iter().enumerate().rev() {
            for &operand in &step.operands {
                uses[operand].push(number);
            }
        }
        let mut held: Vec<usize> = Vec::with_capacity(registers + 4);
        let mut is_stored = vec![false; self.steps.len()];
        let (mut stored, mut loaded) = (0, 0);
        for (number, step) in self.steps.iter().enumerate() {
            for &operand in &step.operands {
                if !held.contains(&operand) {
                    loaded += 1;
                    held.push(operand);
                }
            }
            for &operand in &step.operands {
                while uses[operand].last() == Some(&number) {
                    uses[operand].pop();
                }
            }
            held.push(number);
            held.retain(|&value| !uses[value].is_empty());
            while held.len() > registers {
                let next = |place: &usize| uses[held[*place]].last().copied();
                let Some(place) = (0..held.len()).max_by_key(next) else {
                    break;
                };
                let value = held.swap_remove(place);
                stored += usize::from(!is_stored[value]);
                is_stored[value] = true;
            }
        }
        (stored, loaded)
    }
}
