//! Kernels to Rust. Nothing here can fail: what could be wrong was refused before.

pub mod documentation;
pub mod fallback;
pub mod joint;
pub mod mechanism;
pub mod parameters;
mod readings;
pub mod report;
pub mod solution;
pub mod store;
pub mod straight_line;

use proc_macro2::{Ident, Span};

/// A local name that belongs to the generator: names of users and of other macros cannot meet it.
#[must_use]
pub fn local(name: &str) -> Ident {
    Ident::new(name, Span::mixed_site())
}
