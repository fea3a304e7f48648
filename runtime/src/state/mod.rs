//! What integrators move.

pub(crate) mod each;
pub(crate) mod joint_state;
pub(crate) mod vector;

pub use each::{EachOfJoints, EachOfState};
pub use joint_state::JointState;
pub use vector::{Array, State, Vector};
