//! What accuracy costs: one problem, run with many settings.
//!
//! | what | where |
//! |---|---|
//! | a motion, what is read of it and what that should be | [`Problem`] |
//! | description, formulation, stabilisation, integrator and number type as values | [`Setting`], [`Grid`] |
//! | a problem in one or two kinds of coordinates, without the mechanism in the type | [`Posed`], [`Subject`] |
//! | the runs, and what came of them | [`measure`], [`Trade`], [`Row`] |
//! | the setting that does what is asked for | [`recommend`] |
//! | what is shown of it | [`tables`], [`charts`], [`report`] |

pub mod charts;
mod direct;
mod dispatch;
mod front;
mod grid;
mod integration;
mod measure;
mod movable;
mod observation;
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
pub use crate::journal::Journal;
pub use direct::DirectCorrection;
pub use front::{front, front_by};
pub use grid::{Grid, Planned};
pub use integration::{AnyIntegration, FLOOR, Family, IntegratorSetting};
pub use measure::{Timing, Trade, measure};
pub use movable::{Described, Movable, OnConstraints, Studied};
pub use observation::{Observation, Start};
pub use problem::{Problem, Quantity};
pub use recommend::{MARGIN, NEARBY, Processor, Recommendation, STARTS, Wish, recommend};
pub use record::{Entry, Key, Row, Stopped, Time, csv, json};
pub use reference::{Reference, Source};
pub use setting::{Choice, Formulated, PostStabilisation, Setting};
pub use subject::{Facts, Posed, Subject};
