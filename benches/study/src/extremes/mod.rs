//! Where the numerics stop to hold: motions with closed forms, swept along one axis at a time to
//! where they break.
//!
//! | what | where |
//! |---|---|
//! | what a run promises, stated beforehand | [`thresholds`] |
//! | what became of it | [`outcome`] |
//! | the cells of a map, and their runs | [`run`] |
//! | the map as a document and as files | [`report`] |

pub mod outcome;
pub mod report;
pub mod run;
pub mod thresholds;

pub use outcome::{Outcome, Verdict};
pub use run::{Axis, Cell, Row};
pub use thresholds::Motion;
