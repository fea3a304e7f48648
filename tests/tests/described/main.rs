//! What may be described, in which coordinates, at which place and of which size; what depends on
//! what.

#![forbid(unsafe_code)]

mod dependent;
mod descriptions;
mod oriented;
mod placing;
mod redundant;
mod scales;
mod screws;
mod shapes;
mod solved;

use holonom_fixtures as _;
