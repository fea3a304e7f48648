//! Kernels to Rust. Nothing here can fail: what could be wrong was refused before.

mod coordinates;
pub mod documentation;
pub mod fallback;
pub mod joint;
pub mod mechanism;
pub mod parameters;
mod parts;
mod readings;
pub mod report;
mod rows;
pub mod solution;
pub mod store;
pub mod straight_line;

use proc_macro2::{Ident, Span};

/// A local name that belongs to the generator: variables of users and of other macros cannot meet it, by its hygiene. Constants, statics and
/// unit structs could, because hygiene does not part those from a pattern of the same name; hence the underscores.
#[must_use]
pub fn local(name: &str) -> Ident {
    Ident::new(&format!("__{name}"), Span::mixed_site())
}
