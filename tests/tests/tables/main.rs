//! Splines, cams, recorded motions and forces from tables, against SciPy, Pinocchio and laws that
//! are written as expressions.

#![forbid(unsafe_code)]

mod arm;
mod cams;
mod data;
mod forces;
mod splines;

use holonom_fixtures as _;
