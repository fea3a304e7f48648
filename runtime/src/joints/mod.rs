//! Joints, written with [`joint!`](crate::joint!) as a user would write them.
//!
//! They are not in the prelude: `use holonom::joints::Revolute;`.

mod revolute;
mod spherical;

pub use revolute::*;
pub use spherical::*;
