//! The Jacobians that implicit methods take stand beside those of dual numbers and of differences
//! under `tests`.
#![forbid(unsafe_code)]
