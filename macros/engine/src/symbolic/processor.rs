//! Processors, as the time of a straight line needs them: what operations take, in cycles.

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
        /// Units for products, alone or with a sum, and what functions are made of.
        products: usize,
        /// Units for sums. Some of them are those for products.
        sums: usize,
        /// Units for either.
        arithmetic: usize,
        /// Values that are loaded in a cycle.
        loads: usize,
        /// Values that are stored in a cycle.
        stores: usize,
        /// Cycles for each output, up to a number of them, until another call can read it. It reads
        /// several at once, which have to reach the cache one by one before.
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
    /// Zen 4. Latencies and times of units are those of chains and of independent operations;
    /// `handover`, `cached` and `fetched` were fitted to kernels on a core with 64 KiB for
    /// instructions.
    pub const X86_64_V3: Self = Self {
        sum: unit(3, 1),
        product: unit(3, 1),
        fused: Some(unit(4, 1)),
        reciprocal: unit(14, 4),
        square_root: unit(18, 6),
        function: unit(47, 40),
        load: unit(5, 1),
        store: unit(0, 1),
        registers: 16,
        order: Order::OutOfOrder {
            products: 2,
            sums: 2,
            arithmetic: 3,
            loads: 2,
            stores: 1,
            handover: (6, 8),
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

    /// A product and a sum: one after the other where the code has them so.
    pub(super) fn product_with_sum(&self) -> Unit {
        let apart = unit(
            self.product.latency + self.sum.latency,
            self.product.busy + self.sum.busy,
        );
        self.fused.unwrap_or(apart)
    }
}
