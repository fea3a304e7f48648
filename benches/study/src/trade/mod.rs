//! What accuracy costs: one problem, run with many settings.
//!
//! | what | where |
//! |---|---|
//! | a motion, what is read of it and what that should be | [`Problem`], [`Both`], [`BodiesAlone`] |
//! | description, formulation, treatment, integrator and number type as values | [`Setting`], [`Grid`] |
//! | the same without the mechanism in the type | [`Subject`] |
//! | the runs, and what came of them | [`measure`], [`Trade`], [`Row`] |
//! | the setting that does what is asked for | [`recommend`] |
//! | what is shown of it | [`tables`], [`charts`], [`report`] |

pub mod charts;
mod dispatch;
mod front;
mod grid;
mod integration;
mod journal;
mod measure;
mod offered;
mod problem;
mod recommend;
mod record;
mod reference;
pub mod report;
mod setting;
mod subject;
pub mod tables;

pub use crate::chapter15::Method;
pub use crate::compare::{Coordinates, Precision};
pub use front::{front, front_by};
pub use grid::{Grid, Planned};
pub use integration::{AnyCourse, FLOOR, Family, Integration};
pub use journal::Journal;
pub use measure::{Timing, Trade, measure};
pub use offered::{Described, Offered, OnConstraints, Studied};
pub use problem::{BodiesAlone, Both, Problem, Quantity};
pub use recommend::{MARGIN, NEARBY, Processor, Recommendation, STARTS, Wish, recommend};
pub use record::{Entry, Key, Row, Stopped, Time, csv, json};
pub use reference::{Reference, Source};
pub use setting::{Choice, Formulated, Setting, Treatment};
pub use subject::{Facts, Observation, Start, Subject};
