//! The resolution of ranks.

/// Relative to the length of a row. Configurations are good to about 1e-12, and lengths and axes
/// given to six digits are to count as what they are.
pub const TOLERANCE: f64 = 1e-7;
