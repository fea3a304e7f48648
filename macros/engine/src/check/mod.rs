//! Refusals: from what was written to what it means. The only pass that says no.

pub mod bodies;
mod elements;
mod expression;
mod functions;
pub mod joint;
mod joints;
pub mod kinds;
mod later;
mod laws;
pub mod mechanism;
mod motion;
mod moves;
pub mod number;
pub mod pairs;
mod redundant;
mod values;

use crate::diag::Faults;

/// Refuses an operator that is none of numbers.
fn refuse_operator(op: &syn::BinOp, faults: &mut Faults) {
    let more = match op {
        syn::BinOp::BitXor(_) => "; there is no power: write `x * x`",
        _ => "",
    };
    faults.at(op, format!("expected `+`, `-`, `*` or `/`{more}"));
}
