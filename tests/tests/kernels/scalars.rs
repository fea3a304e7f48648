//! Numbers that kernels were not made for: dual numbers, and numbers that count what is done with
//! them.
//!
//! Their operations are not inlined: a kernel of thousands of them would take minutes to compile.

mod dual;

pub(crate) use dual::Dual;
pub(crate) use holonom_study::counted::{Counted, counted};
