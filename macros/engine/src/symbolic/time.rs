//! What a call of a kernel takes on a processor, in cycles.
//!
//! Out of order, a straight line is bound by its units, each busy with one operation after the
//! other, and by its path, the longest chain of operations that wait for each other. A processor
//! looks ahead over a few hundred operations, so that neither hides the other wholly. What a call
//! takes that waits for the one before was measured: the time of its units, half of its path, and
//! what its outputs take to come back through memory (decision 46). In order, it is the sum of what
//! its operations take: the path counts nothing.
//!
//! A product that one sum alone uses is one operation with it, as the code is written.

use std::collections::BTreeSet;

use super::arena::{Arena, Expr, Node, Stage};
use super::count::{Count, count};
use super::uses::Uses;

/// An operation of a processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// The cycles after which its result may be used.
    pub latency: usize,
    /// The cycles for which it keeps its unit from others.
    pub busy: usize,
}

const fn unit(latency: usize, busy: usize) -> Unit {
    Unit { latency, busy }
}

/// In which order a processor takes operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// As they are written, one at a time.
    InOrder,
    /// As their operands are there, several at a time.
    OutOfOrder {
        /// Units for sums, products and what functions are made of.
        arithmetic: usize,
        /// Values that are loaded in a cycle.
        loads: usize,
        /// Values that are stored in a cycle.
        stores: usize,
        /// For each output, up to a number of them, the cycles until another call can read it. It
        /// reads several at once, which have to reach the cache one by one before.
        handover: (usize, usize),
        /// The operations whose code stays in the instruction cache. What is longer runs over its
        /// own beginning, and all of it comes from the next cache at every call.
        cached: usize,
        /// Quarters of a cycle that such an operation takes more.
        fetched: usize,
    },
}

/// A processor: what its operations take, for the numbers that it has units for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// A sum or a difference. A comparison counts as one.
    pub sum: Unit,
    /// A product.
    pub product: Unit,
    /// A product and a sum as one, where the code has it so.
    pub fused: Option<Unit>,
    /// `1 / x`, which shares its unit with roots.
    pub reciprocal: Unit,
    /// A square root.
    pub square_root: Unit,
    /// A call of a function.
    pub function: Unit,
    /// A value from memory.
    pub load: Unit,
    /// A value to memory.
    pub store: Unit,
    /// How many values stand in registers.
    pub registers: usize,
    /// In which order.
    pub order: Order,
}

impl Processor {
    /// x86-64 with AVX2 and fused multiply-adds, in double precision: a core like Golden Cove or
    /// Zen 4. Latencies and times of units are those of chains and of independent operations; the
    /// numbers of [`Order::OutOfOrder`] were fitted to kernels on a core with 64 KiB for
    /// instructions.
    pub const X86_64_V3: Self = Self {
        sum: unit(3, 1),
        product: unit(3, 1),
        fused: Some(unit(4, 1)),
        reciprocal: unit(14, 4),
        square_root: unit(18, 6),
        function: unit(55, 40),
        load: unit(5, 1),
        store: unit(0, 1),
        registers: 16,
        order: Order::OutOfOrder {
            arithmetic: 2,
            loads: 2,
            stores: 1,
            handover: (4, 12),
            cached: 4500,
            fetched: 3,
        },
    };

    /// Cortex-M4F, in single precision, by its Technical Reference Manual. The code has no fused
    /// multiply-adds there, which take three cycles. What a function takes is a guess.
    pub const CORTEX_M4F: Self = Self {
        sum: unit(1, 1),
        product: unit(1, 1),
        fused: None,
        reciprocal: unit(14, 14),
        square_root: unit(14, 14),
        function: unit(100, 100),
        load: unit(2, 2),
        store: unit(2, 2),
        registers: 32,
        order: Order::InOrder,
    };

    /// Cortex-M7, in single precision, by the model that compilers schedule with: one operation of
    /// numbers in a cycle. That loads go beside them is left out.
    pub const CORTEX_M7: Self = Self {
        sum: unit(3, 1),
        product: unit(3, 1),
        reciprocal: unit(16, 16),
        square_root: unit(16, 16),
        load: unit(1, 1),
        store: unit(1, 1),
        ..Self::CORTEX_M4F
    };
}

/// What a straight line takes, in cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Time {
    /// What the busiest of the units is busy for.
    pub units: usize,
    /// The longest chain of operations that wait for each other.
    pub path: usize,
    /// A call that waits for the one before.
    pub call: usize,
}

/// What a kernel costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Its operations.
    pub count: Count,
    /// The cycles of a call by [`Processor::X86_64_V3`].
    pub cycles: usize,
}

impl Cost {
    /// Of the operations that the outputs need, of the given stage or later.
    #[must_use]
    pub fn of(arena: &Arena, outputs: &[Expr], from: Stage) -> Self {
        Self {
            count: count(arena, outputs, from),
            cycles: time(arena, outputs, from, &Processor::X86_64_V3).call,
        }
    }
}

/// The time of the operations that the outputs need, of the given stage or later.
#[must_use]
pub fn time(arena: &Arena, outputs: &[Expr], from: Stage, processor: &Processor) -> Time {
    let line = Line::new(arena, outputs, from, processor);
    if line.steps.is_empty() {
        return Time::default();
    }
    let path = line.path(processor.load.latency);
    let (spilled, reloaded) = line.spills(processor.registers);
    let [loads, stores] = [line.loads + reloaded, outputs.len() + spilled];
    let Line {
        arithmetic,
        divided,
        ..
    } = line;
    match processor.order {
        Order::InOrder => {
            let moved = loads * processor.load.busy + stores * processor.store.busy;
            let units = arithmetic + divided + moved;
            Time {
                units,
                path,
                call: units,
            }
        }
        Order::OutOfOrder {
            arithmetic: ports,
            loads: load_ports,
            stores: store_ports,
            handover: (each, most),
            cached,
            fetched,
        } => {
            let moved = [(loads, load_ports), (stores, store_ports)];
            let bounds = moved.map(|(values, ports)| values.div_ceil(ports));
            let units = bounds.into_iter().max().unwrap_or(0);
            let units = units.max(arithmetic.div_ceil(ports)).max(divided);
            let length = line.steps.len();
            let from_afar = if length > cached { length } else { 0 };
            Time {
                units,
                path,
                call: units + path / 2 + each * outputs.len().min(most) + from_afar * fetched / 4,
            }
        }
    }
}

/// An operation as it is written, on the results of others.
struct Step {
    latency: usize,
    operands: Vec<usize>,
    /// Whether an operand comes from memory.
    reads_memory: bool,
}

/// A straight line as operations of a processor.
struct Line {
    steps: Vec<Step>,
    /// The values that it loads: inputs, what is known earlier, numbers.
    loads: usize,
    /// The cycles that sums, products and functions keep units busy.
    arithmetic: usize,
    /// The cycles that reciprocals and roots keep theirs.
    divided: usize,
}

impl Line {
    fn new(arena: &Arena, outputs: &[Expr], from: Stage, processor: &Processor) -> Self {
        let live = arena.live(outputs, from);
        let uses = Uses::new(arena, &live, outputs);
        let fused = uses.fused_products();
        let mut step_of = vec![None; arena.len()];
        let mut loaded = BTreeSet::new();
        let mut line = Self {
            steps: Vec::new(),
            loads: 0,
            arithmetic: 0,
            divided: 0,
        };
        for &place in &live {
            let node = arena.node(place);
            let mut operands: Vec<Expr> = node.operands().collect();
            let unit = match node {
                Node::Constant(_) | Node::Input(_) => continue,
                Node::Multiply(..) if fused.contains(place) => continue,
                Node::Multiply(..) => processor.product,
                Node::Add(a, b) => match fused.operand(a, b) {
                    Some((product, other)) => {
                        operands = arena.get(product).operands().chain([other]).collect();
                        processor.fused()
                    }
                    None => processor.sum,
                },
                Node::Reciprocal(_) => processor.reciprocal,
                Node::SquareRoot(_) => processor.square_root,
                _ if !node.is_operation() => processor.sum,
                _ => processor.function,
            };
            if matches!(node, Node::Reciprocal(_) | Node::SquareRoot(_)) {
                line.divided += unit.busy;
            } else {
                line.arithmetic += unit.busy;
            }
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
    fn path(&self, load: usize) -> usize {
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
    fn spills(&self, registers: usize) -> (usize, usize) {
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

impl Processor {
    /// A product and a sum: one after the other where the code has them so.
    fn fused(&self) -> Unit {
        let apart = unit(
            self.product.latency + self.sum.latency,
            self.product.busy + self.sum.busy,
        );
        self.fused.unwrap_or(apart)
    }
}

#[cfg(test)]
mod tests;
