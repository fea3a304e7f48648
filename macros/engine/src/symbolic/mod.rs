//! From a model to expressions: vectors that know their frame above, a hash-consed arena of scalars
//! below.

pub mod arena;
pub mod bind;
pub mod count;
pub mod differentiate;
pub mod equations;
pub mod evaluate;
pub mod fixed;
mod force;
pub mod functions;
mod gather;
mod identities;
mod index;
mod kept;
pub mod left_out;
mod node;
pub mod rotation;
pub mod scene;
mod start;
pub(crate) mod table;
pub mod tape;
pub mod vector;
