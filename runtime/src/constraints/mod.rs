//! The constraints as equations at a state: their rows, units and sizes, and corrections onto them.
//!
//! Violations (`rows`). Every row is measured by the length of its joint (arms, or the row's
//! radius of curvature) or by one radian. Its resolution is that of its terms. Both follow from
//! `D`, `gamma` and the points of the joints.
//!
//! Corrections. `newton.rs` iterates with compliances that are a part of each row's own
//! `D M^-1 D^T`. The projection and the kinematic analysis use it. Module `side` turns over what
//! `require` excludes, by the gradient of the requirement, before an assembly begins. Requirements
//! are readings, bound on demand.
//!
//! `traced.rs` has a fixed number of iterations, for programs in other languages.
//!
//! Scales: `docs/decisions/013-scales-of-a-scene.md`.

pub(crate) mod apart;
pub(crate) mod compliance;
pub(crate) mod extent;
pub(crate) mod frames;
pub(crate) mod joint_load;
pub(crate) mod newton;
pub(crate) mod projection;
pub(crate) mod retract;
pub(crate) mod row_units;
pub(crate) mod rows;
pub(crate) mod scales;
pub(crate) mod self_stress;
pub(crate) mod side;
pub(crate) mod traced;

pub use projection::{Correction, Moved};
pub use scales::Scales;
