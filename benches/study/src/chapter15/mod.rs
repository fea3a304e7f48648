//! Chapter 15 of Flores, *Concepts and Formulations for Spatial Multibody Dynamics* (2015): one
//! pendulum, four formulations of its equations of motion.
//!
//! What the chapter prints stands here beside what a mechanism of ours gives: [tables] 15.1 to 15.3
//! and figure 15.2, and what the chapter could not show, because the motion has a [closed
//! form](crate::pendulum).

pub mod charts;
pub mod outcome;
pub mod record;
pub mod report;
pub mod run;
pub mod tables;

/// `p' = 1/2 L(p / |p|)^T w`, and `p` left at the length that it has: the reading of Euler
/// parameters behind the published counts, here to reproduce them.
///
/// The orientation then turns at `w / |p|`, and nothing brings `|p|` back: at 20 rad/s and the
/// default tolerance nothing of it is right after 1000 s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Chapter15;

impl holonom::mechanism::Orientation for Chapter15 {
    const NORMALISED_RATES: bool = true;
}

/// The four ways to solve the equations of motion that the chapter compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Lagrange multipliers, nothing done about drift.
    Standard,
    /// Lagrange multipliers with Baumgarte's terms.
    Baumgarte,
    /// The penalty method.
    Penalty,
    /// The penalty method, iterated.
    AugmentedLagrangian,
}

/// What the chapter prints about one method in table 15.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    /// Function evaluations.
    pub evaluations: u64,
    /// Computation time (s), on a computer of that time.
    pub seconds: f64,
}

impl Method {
    /// All four in the order of the chapter.
    pub const ALL: [Self; 4] = [
        Self::Standard,
        Self::Baumgarte,
        Self::Penalty,
        Self::AugmentedLagrangian,
    ];

    /// The name in JSON.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Baumgarte => "baumgarte",
            Self::Penalty => "penalty",
            Self::AugmentedLagrangian => "augmented-lagrangian",
        }
    }

    /// The name for a reader.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Baumgarte => "Baumgarte",
            Self::Penalty => "penalty",
            Self::AugmentedLagrangian => "augmented Lagrangian",
        }
    }

    /// Table 15.3.
    #[must_use]
    pub const fn published(self) -> Published {
        let (evaluations, seconds) = match self {
            Self::Standard => (1639, 6.3),
            Self::Baumgarte => (2401, 10.7),
            Self::Penalty => (3769, 17.2),
            Self::AugmentedLagrangian => (3769, 17.6),
        };
        Published {
            evaluations,
            seconds,
        }
    }
}

/// The parameters of the simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The end of the simulation (s); it starts at zero.
    pub end: f64,
    /// The time between reports (s).
    pub reporting: f64,
    /// Relative tolerance of the integrator.
    pub relative: f64,
    /// Absolute tolerance of the integrator (m, m/s, rad/s, and the unit of Euler parameters, 1).
    pub absolute: f64,
    /// Baumgarte's `alpha` and `beta` (1/s).
    pub baumgarte: (f64, f64),
    /// Penalty and augmented Lagrangian: `alpha` (kg, kg m^2), `omega` (1/s), `mu` (1).
    pub penalty: (f64, f64, f64),
    /// Augmented Lagrangian: the iteration stops when the accelerations change by less than
    /// `tolerance (1 + |u'|)`. The chapter does not print its criterion.
    pub iteration_tolerance: f64,
    /// Augmented Lagrangian: the most iterations of one evaluation.
    pub iteration_cap: usize,
}

impl Settings {
    /// Table 15.2, with an iteration criterion of ours.
    pub const TABLE_15_2: Self = Self {
        end: 10.0,
        reporting: 0.02,
        relative: 1e-6,
        absolute: 1e-9,
        baumgarte: (5.0, 5.0),
        penalty: (1e7, 10.0, 1.0),
        iteration_tolerance: 1e-10,
        iteration_cap: 20,
    };
}
