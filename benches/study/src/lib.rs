//! Measures what a formulation and an integrator cost and what they buy, for any mechanism of
//! [`holonom`].
//!
//! | what | where |
//! |---|---|
//! | one run with everything that can be read from it, or bare to be timed | [`run`] |
//! | time per evaluation of several candidates in turn | [`timing`], [`statistics`] |
//! | the closed form of a rigid pendulum | [`pendulum`], [`elliptic`] |
//! | results as tables and charts, as a page and as files | [`document`], [`chart`], [`page`], [`files`] |
//! | what an evaluation costs, in both descriptions, all formulations and both number types | [`compare`] |
//! | what accuracy costs, and which setting does for an error | [`trade`] |
//! | where the numerics stop to hold | [`extremes`] |
//! | thousands of rows with drawn parameters, in lanes and on all cores, in shards | [`ensemble`] |
//! | operations of a computation | [`counted`] |
//! | chapter 15 of Flores (2015): four formulations on one pendulum | [`chapter15`] |
//!
//! Units are SI, angles are in radians.

#![forbid(unsafe_code)]

pub mod chapter15;
pub mod chart;
#[cfg(feature = "compare")]
pub mod compare;
#[cfg(feature = "compare")]
pub mod counted;
pub mod document;
pub mod elliptic;
#[cfg(feature = "ensemble")]
pub mod ensemble;
mod error;
#[cfg(feature = "extremes")]
pub mod extremes;
pub mod files;
pub mod format;
#[cfg(any(feature = "ensemble", feature = "trade"))]
mod journal;
pub mod page;
pub mod pendulum;
pub mod run;
pub mod statistics;
pub mod target;
pub mod timing;
#[cfg(feature = "trade")]
pub mod trade;

pub use error::StudyError;
