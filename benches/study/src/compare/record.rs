//! What was measured, as it stands in `compare.json`.

use serde::{Deserialize, Serialize};

use super::{Coordinates, Precision, REFERENCE_KERNEL};
use crate::chapter15::Method;
use crate::error::StudyError;

/// One right-hand side in `compare.json`. Times are those of the processor, the least of
/// interleaved rounds (ns).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The mechanism, `reference kernel` for the pendulum written by hand.
    pub scene: String,
    /// Links of a chain or windows of a row; 1 for all others.
    pub n: usize,
    /// `bodies` or `joints`.
    pub coordinates: String,
    /// `standard`, `baumgarte`, `penalty` or `augmented-lagrangian`.
    pub formulation: String,
    /// `f64` or `f32`.
    pub scalar: String,
    /// Operations of the whole right-hand side as runs call it by default, multipliers of the
    /// remaining equations included. Of the augmented Lagrangian, which solves as often as the
    /// state asks for, those at one state of the motion.
    pub operations: usize,
    /// The longest chain of dependent operations among them.
    pub path: usize,
    /// Operations of a stage of a step, which asks for no multipliers in joint coordinates.
    pub stage_operations: usize,
    /// An evaluation through the public interface, at states that do not depend on each other.
    pub nanoseconds_throughput: f64,
    /// Three quarters of its turns were at most as long as this.
    #[serde(default)]
    pub upper_quartile_nanoseconds: f64,
    /// The median of its turns over the least.
    #[serde(default = "quiet")]
    pub spread: f64,
    /// The same at states that the evaluation before has a part in.
    pub nanoseconds_dependent: f64,
    /// A whole step of Runge-Kutta, four evaluations, from states that do not depend on each other.
    pub rk4_step_nanoseconds: f64,
    /// The run-time assembler of the same mechanism by its bodies in the same formulation, in its
    /// cheapest form; `null` where there is none.
    pub assembler_nanoseconds: Option<f64>,
    /// The kernel alone, without what calls it; `null` where the right-hand side is made of
    /// several.
    pub kernel_nanoseconds: Option<f64>,
    /// `nanoseconds_throughput` over that of the reference kernel.
    pub reference_kernels: f64,
    /// What the program was compiled for.
    pub build: String,
    /// The part of the time in which the race had a processor.
    #[serde(default = "quiet")]
    pub processor_share: f64,
}

/// Of numbers that were written before a machine was asked whether it is quiet.
fn quiet() -> f64 {
    1.0
}

impl Row {
    /// Whether the row is of this description, formulation and number type.
    #[must_use]
    pub fn is(&self, coordinates: Coordinates, method: Method, precision: Precision) -> bool {
        self.coordinates == coordinates.key()
            && self.formulation == method.key()
            && self.scalar == precision.key()
    }

    /// Whether the row is the reference kernel.
    #[must_use]
    pub fn is_reference(&self) -> bool {
        self.scene == REFERENCE_KERNEL
    }

    /// The mechanism for a reader, with its size where it has one.
    #[must_use]
    pub fn name(&self) -> String {
        match self.n {
            1 => self.scene.clone(),
            n => format!("{} {n}", self.scene),
        }
    }
}

/// A build of a small crate in `compile.json`: a chain of rods on parallel hinges or a row of
/// four-bar windows, a derive and a loop of steps, its dependencies being there already.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compiled {
    /// The crate.
    pub name: String,
    /// The links of its chain, or the windows of its row.
    pub n: usize,
    /// `bodies`, or `joints` for both descriptions.
    pub coordinates: String,
    /// `debug` or `release`, as cargo has them by default.
    pub profile: String,
    /// From the start of cargo to its end (s).
    pub seconds: f64,
    /// The time of all processors together (s); `null` where the system does not tell.
    pub processor_seconds: Option<f64>,
}

/// The rows as a JSON array.
///
/// # Errors
/// [`StudyError::NotFinite`] with the number that JSON has no way to write.
pub fn json(rows: &[Row]) -> Result<String, StudyError> {
    for row in rows {
        let optional = [row.assembler_nanoseconds, row.kernel_nanoseconds];
        let times = [
            row.nanoseconds_throughput,
            row.upper_quartile_nanoseconds,
            row.spread,
            row.processor_share,
            row.nanoseconds_dependent,
            row.rk4_step_nanoseconds,
            row.reference_kernels,
        ];
        let mut all = times.into_iter().chain(optional.into_iter().flatten());
        if !all.all(f64::is_finite) {
            return Err(StudyError::NotFinite {
                what: format!("a time of {}, {}", row.name(), row.coordinates),
            });
        }
    }
    let mut text = serde_json::to_string_pretty(rows)?;
    text.push('\n');
    Ok(text)
}

/// Rows from a JSON array.
///
/// # Errors
/// [`StudyError::Json`] where the text is none.
pub fn from_json(text: &str) -> Result<Vec<Row>, StudyError> {
    Ok(serde_json::from_str(text)?)
}
