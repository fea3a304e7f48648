//! What a call of a kernel takes on a processor, in cycles.
//!
//! Out of order, a straight line is bound by its units, each busy with one operation after the
//! other. It is bound by its path as well, the longest chain of operations that wait for each
//! other. A processor looks ahead over a few hundred operations, so that neither hides the other
//! wholly. Measured was a call that waits for the one before (decision 46): it takes the time of
//! its units, half of its path, and what its outputs take to come back through memory. In order, it
//! is the sum of what its operations take: the path counts nothing.
//!
//! A product that one sum alone uses is one operation with it, as the code is written.

use super::arena::{Arena, Expr, Stage};
use super::count::{Count, count};
use super::line::Line;
use super::processor::{Order, Processor};

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
        summed,
        multiplied,
        divided,
        ..
    } = line;
    match processor.order {
        Order::InOrder => {
            let moved = loads * processor.load.busy + stores * processor.store.busy;
            let units = summed + multiplied + divided + moved;
            Time {
                units,
                path,
                call: units,
            }
        }
        Order::OutOfOrder {
            products,
            sums,
            arithmetic,
            loads: at_once,
            stores: stored_at_once,
            handover: (each, most),
            cached,
            fetched,
        } => {
            let bounds = [
                (multiplied, products),
                (summed, sums),
                (multiplied + summed, arithmetic),
                (divided, 1),
                (loads, at_once),
                (stores, stored_at_once),
            ];
            let bounds = bounds.map(|(busy, units)| busy.div_ceil(units));
            let units = bounds.into_iter().max().unwrap_or(0);
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

#[cfg(test)]
mod tests;
