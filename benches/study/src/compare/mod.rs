//! What an evaluation of the equations of motion costs: every mechanism in both descriptions, all
//! formulations and both number types, beside a reference kernel and a run-time assembler, in one
//! race.
//!
//! | what | where |
//! |---|---|
//! | a mechanism as candidates | [`measure`] |
//! | the race, and what came of it | [`run`], [`record`] |
//! | what is shown of it | [`tables`], [`charts`], [`report`] |

pub mod charts;
pub mod measure;
pub mod record;
pub mod report;
pub mod run;
pub mod tables;

/// How a mechanism is described.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// By positions and orientations of its bodies; joints are equations.
    Bodies,
    /// By what its joints leave free; what closes loops stays equations.
    Joints,
}

impl Coordinates {
    /// The name in JSON, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Bodies => "bodies",
            Self::Joints => "joints",
        }
    }
}

/// The numbers that are computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// `f64`
    Double,
    /// `f32`
    Single,
}

impl Precision {
    /// The name in JSON, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Double => "f64",
            Self::Single => "f32",
        }
    }
}

/// The scene of the reference kernel.
pub const REFERENCE_KERNEL: &str = "reference kernel";
