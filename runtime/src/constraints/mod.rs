//! The constraints as equations at a state: their rows, units and sizes, and corrections onto them.

pub(crate) mod apart;
pub(crate) mod compliance;
pub(crate) mod extent;
pub(crate) mod frames;
pub(crate) mod newton;
pub(crate) mod projection;
pub(crate) mod retract;
pub(crate) mod row_units;
pub(crate) mod rows;
pub(crate) mod scales;
pub(crate) mod self_stress;
pub(crate) mod side;

pub use projection::Moved;
