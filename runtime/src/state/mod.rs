//! What integrators move.

pub(crate) mod each;
pub(crate) mod joint_state;
pub(crate) mod vector;
