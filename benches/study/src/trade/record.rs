//! What was measured, as it stands in the files of a trade.

use serde::{Deserialize, Serialize};

use super::observation::Observation;
use super::setting::Setting;
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;

/// A [`Setting`] as it stands in files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// `bodies` or `joints`.
    pub coordinates: String,
    /// `standard`, `baumgarte`, `penalty` or `augmented-lagrangian`.
    pub formulation: String,
    /// See [`Formulated::coefficients`](super::Formulated::coefficients).
    pub coefficients: Vec<f64>,
    /// `none` or `projection`.
    pub stabilisation: String,
    /// The method of integration.
    pub integrator: String,
    /// `f64` or `f32`.
    pub scalar: String,
    /// The step (s) of an integrator of fixed steps, else the relative tolerance.
    pub step_or_tolerance: f64,
}

impl From<&Setting> for Key {
    fn from(setting: &Setting) -> Self {
        Self {
            coordinates: setting.coordinates.key().into(),
            formulation: setting.formulation.method().key().into(),
            coefficients: setting.formulation.coefficients(),
            stabilisation: setting.stabilisation.key().into(),
            integrator: setting.integration.family.key().into(),
            scalar: setting.scalar.key().into(),
            step_or_tolerance: setting.integration.step_or_tolerance,
        }
    }
}

/// A run in `<problem>.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// With what it was run.
    #[serde(flatten)]
    pub setting: Key,
    /// The largest error at the reporting times, in the unit of the problem.
    pub error: f64,
    /// The whole run (s), without monitor and readings: the median of several.
    pub seconds: f64,
    /// `seconds` over the time of an evaluation of the reference kernel, measured in turn with the
    /// run; `null` where there is no reference kernel.
    pub reference_kernels: Option<f64>,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted, and that were tried.
    pub steps: [u64; 2],
    /// The largest `|Phi|` at the reporting times, all rows together.
    pub max_violation: f64,
    /// The largest change of energy (J) that no force accounts for.
    pub energy_drift_joule: f64,
    /// What the run's monitor warns of.
    pub warnings: Vec<String>,
}

/// A setting that does not come to its end, in `<problem>-stopped.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stopped {
    /// With what it was run.
    #[serde(flatten)]
    pub setting: Key,
    /// What was said, with its time.
    pub reason: String,
}

/// How a setting ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Entry {
    /// With numbers.
    Row(Row),
    /// With an error.
    Stopped(Stopped),
}

impl Row {
    /// The row of a run.
    #[must_use]
    pub fn new(setting: &Setting, run: &Observation, error: f64, time: Time) -> Self {
        Self {
            setting: setting.into(),
            error,
            seconds: time.seconds,
            reference_kernels: time.reference_kernels,
            evaluations: run.evaluations,
            steps: [run.accepted, run.accepted + run.rejected],
            max_violation: run.violations.iter().copied().fold(0.0, f64::max),
            energy_drift_joule: run.energy_drift,
            warnings: run.warnings.clone(),
        }
    }

    /// Whether the row is of this description and number type.
    #[must_use]
    pub fn is(&self, coordinates: Coordinates, scalar: Precision) -> bool {
        self.setting.coordinates == coordinates.key() && self.setting.scalar == scalar.key()
    }

    /// Whether there are no warnings.
    #[must_use]
    pub fn is_trusted(&self) -> bool {
        self.warnings.is_empty()
    }
}

/// What a run takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// See [`Row::seconds`].
    pub seconds: f64,
    /// See [`Row::reference kernels`].
    pub reference_kernels: Option<f64>,
}

impl Stopped {
    /// A setting that did not come to its end.
    #[must_use]
    pub fn new(setting: &Setting, reason: String) -> Self {
        Self {
            setting: setting.into(),
            reason,
        }
    }
}

impl Entry {
    /// With what it was run.
    #[must_use]
    pub fn setting(&self) -> &Key {
        match self {
            Self::Row(row) => &row.setting,
            Self::Stopped(stopped) => &stopped.setting,
        }
    }
}

/// Rows as a JSON array.
///
/// # Errors
/// [`StudyError::Json`].
pub fn json<T: Serialize>(rows: &[T]) -> Result<String, StudyError> {
    let mut text = serde_json::to_string_pretty(rows)?;
    text.push('\n');
    Ok(text)
}

/// Rows as CSV; warnings in one field, separated by semicolons.
///
/// # Errors
/// [`StudyError::Write`] where the rows cannot be written to memory.
pub fn csv(rows: &[Row]) -> Result<Vec<u8>, StudyError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| StudyError::Write {
        path: "the rows as CSV".into(),
        source: error.into(),
    };
    writer
        .write_record([
            "coordinates",
            "formulation",
            "coefficients",
            "stabilisation",
            "integrator",
            "scalar",
            "step_or_tolerance",
            "error",
            "seconds",
            "reference_kernels",
            "evaluations",
            "steps_accepted",
            "steps_tried",
            "max_violation",
            "energy_drift_joule",
            "warnings",
        ])
        .map_err(failed)?;
    for row in rows {
        let setting = &row.setting;
        let coefficients: Vec<_> = setting.coefficients.iter().map(f64::to_string).collect();
        let number = |x: f64| format!("{x:e}");
        writer
            .write_record([
                &setting.coordinates,
                &setting.formulation,
                &coefficients.join(" "),
                &setting.stabilisation,
                &setting.integrator,
                &setting.scalar,
                &number(setting.step_or_tolerance),
                &number(row.error),
                &number(row.seconds),
                &row.reference_kernels.map_or_else(String::new, number),
                &row.evaluations.to_string(),
                &row.steps[0].to_string(),
                &row.steps[1].to_string(),
                &number(row.max_violation),
                &number(row.energy_drift_joule),
                &row.warnings.join("; "),
            ])
            .map_err(failed)?;
    }
    writer.into_inner().map_err(|error| StudyError::Write {
        path: "the rows as CSV".into(),
        source: error.into_error(),
    })
}
