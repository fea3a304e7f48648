//! Plans: what they say is correct, whatever it is, and does not depend on the order of
//! declaration.

mod axes;
#[path = "../common/mod.rs"]
mod common;
mod declaration;
mod dense;
mod library;
mod pivots;
mod repeated;
mod trees;
