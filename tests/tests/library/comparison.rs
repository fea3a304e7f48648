//! What two computations of one thing may differ by.

pub(crate) use holonom_assembler::accuracy::{Worst, distance};

/// What kernels that compute one thing in two ways may differ by, relative to the norm of a block.
pub(crate) const ROUND_OFF: f64 = 1e-12;
