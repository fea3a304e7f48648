//! What integrators move.
//!
//! A state of bodies has its auxiliary variables, the angles that count turns, behind the
//! coordinates of bodies. An integrator moves them and knows nothing of them. Only the number of
//! whole turns is read from them; the rest comes from orientations. `Mechanism::rewrap` corrects
//! them after other displacements.
//!
//! A state in joint coordinates has pairs of cosine and sine. Its `plus` turns them, so
//! integrators are the same for both. How `Rk4` saves turns:
//! `docs/decisions/006-turns-in-a-step.md`. Columns of matrices:
//! `docs/decisions/010-matrices-by-columns.md`.

pub(crate) mod each;
pub(crate) mod joint_state;
pub(crate) mod sealed;
pub(crate) mod sums;
pub(crate) mod traits;
pub(crate) mod vector;

pub use each::{EachOfJoints, EachOfState};
pub use joint_state::JointState;
pub use vector::{Array, MovingState, State, Vector};
