//! Refusals: from what was written to what it means. The only pass that says no.
//!
//! Order of work. A definition is checked where it is written, before any mechanism uses it.
//! `joint!` and `force!` have one grammar and one reader (`syntax/joint.rs`).
//!
//! - `joint.rs`: the statements of a definition.
//! - `expression.rs`: the shape of every expression, scalar or vector, single or twofold. The two
//!   normals of an axis are twofold, and so is what is made of them.
//! - `functions.rs`: the functions, and where they may be used. `initial` and `fixed` refer to the
//!   reference configuration, where there is no time and no rate.
//! - `number.rs`: numbers the macro can see. A path or a run-time value becomes a symbol with two
//!   expressions: one in `f64` for checks, one over the scalar type for kernels.
//! - `linear.rs`, `turning.rs`: linear functions of such numbers, and rotations by them.
//! - `laws.rs`: laws that a mechanism writes for a force or a driver.
//! - `states.rs`: rates of the user's own states.
//! - `switching.rs`, `switches.rs`: which laws may switch; such laws, and the switches of a
//!   mechanism.
//! - `readings.rs`: what these read of joints and forces.
//! - `tables.rs`: splines and inputs with derivatives, in laws.
//! - `values.rs`: parameters, inputs and starts of states. A reader that meets an input where none
//!   may be is given the reason.
//! - `elements.rs`: elements of arrays such as `links[k - 1]`, resolved by integer arithmetic once
//!   all names are known (`syntax/integer.rs`). See `docs/decisions/003-arrays-of-fields.md`.
//! - `fixed.rs`: what a definition fixes on its bodies.
//! - `between.rs`: bodies by name, of the mechanism and of its parts.
//! - `points.rs`: named points.
//! - `parts.rs`, `placement.rs`, `mirror.rs`: where parts are, and what that makes of what is in
//!   them. See `docs/decisions/022-assemblies.md`.
//! - `limits.rs`: limits of joints that leave one coordinate free.
//! - `asked.rs`: kernels that are asked for by `kernels = [..]`.
//! - `slopes.rs`: what numbers change by with those that are in them, as symbols of their own.
//! - `redundant.rs`, `moves.rs`: refusals of what `rank` found by numbers. `passes` hands it over.
//!   `apart.rs` says how far from each other things are.
//!
//! Bounds. `syntax/depth.rs` limits nesting before anything recurses. `model::Extent` limits what
//! is differentiated. Both refuse.

mod apart;
mod asked;
mod between;
pub mod bodies;
pub mod definition;
mod elements;
mod expression;
mod fixed;
mod functions;
pub mod joint;
mod joints;
pub mod kinds;
mod later;
mod laws;
mod limits;
mod linear;
pub mod mechanism;
mod mirror;
mod motion;
mod moves;
pub mod number;
pub mod pairs;
mod parts;
mod placement;
mod points;
mod rates;
mod readings;
mod redundant;
mod signature;
pub mod slopes;
mod states;
mod switches;
mod switching;
mod tables;
mod turning;
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
