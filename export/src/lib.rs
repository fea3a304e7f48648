#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod c;
mod constants;
mod derivative;
mod error;
mod export;
mod fold;
mod interface;
mod joints;
mod layout;
mod limits;
mod linear;
mod names;
mod number;
mod openings;
mod program;
mod projection;
mod step;
mod system;
mod tape;
mod values;

pub use c::{Rollout, Source};
pub use error::ExportError;
pub use export::{Export, ExportExt};
pub use interface::{Coordinate, Interface, Opens, Quantity, Turned};
pub use number::{Double, Precision, Single, Traced};
#[doc(hidden)]
pub use system::Called;
