//! From a model to expressions: vectors that know their frame above, a hash-consed arena of scalars below.

pub mod arena;
pub mod count;
pub mod evaluate;
pub mod fixed;
pub mod scene;
pub mod twist;
pub mod vector;
