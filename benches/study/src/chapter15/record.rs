//! The outcomes as JSON, for programs that read them.

use serde::ser::{Serialize, SerializeStruct as _, Serializer};

use super::outcome::Outcome;
use crate::error::StudyError;

/// One formulation in `chapter15.json`.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// `standard`, `baumgarte`, `penalty` or `augmented-lagrangian`.
    pub formulation: &'static str,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were rejected.
    pub rejected: u64,
    /// Evaluations in table 15.3.
    pub published_evaluations: u64,
    /// The angle at the end less that of the closed form (rad), from the Euler parameters.
    pub final_angle_error_rad: f64,
    /// The largest `Phi^T Phi` at the reporting times, Euler parameters as integrated.
    pub max_violation: f64,
    /// `Phi^T Phi` at the end.
    pub final_violation: f64,
    /// The largest difference of the energy from that at the start (J), at the reporting times.
    pub energy_drift_joule: f64,
    /// The time of a whole run over its evaluations (ns), median of many runs.
    pub nanoseconds_per_evaluation: f64,
    /// The same for the run-time assembler, in its cheapest form.
    pub assembler_nanoseconds_per_evaluation: f64,
}

impl Record {
    /// The record of an outcome.
    ///
    /// # Errors
    /// [`StudyError::NotFinite`] with the field that JSON has no number for.
    pub fn of(outcome: &Outcome) -> Result<Self, StudyError> {
        let formulation = outcome.method.key();
        let finite = |value: f64, field: &str| {
            let what = || format!("`{field}` of `{formulation}`");
            if value.is_finite() {
                Ok(value)
            } else {
                Err(StudyError::NotFinite { what: what() })
            }
        };
        Ok(Self {
            formulation,
            evaluations: outcome.evaluations,
            accepted: outcome.accepted,
            rejected: outcome.rejected,
            published_evaluations: outcome.method.published().evaluations,
            final_angle_error_rad: finite(outcome.final_angle_error(), "final_angle_error_rad")?,
            max_violation: finite(
                outcome.largest_violation(f64::NEG_INFINITY..f64::INFINITY),
                "max_violation",
            )?,
            final_violation: finite(outcome.final_violation(), "final_violation")?,
            energy_drift_joule: finite(outcome.energy_drift(), "energy_drift_joule")?,
            nanoseconds_per_evaluation: finite(
                outcome.prices.generated.time.median,
                "nanoseconds_per_evaluation",
            )?,
            assembler_nanoseconds_per_evaluation: finite(
                outcome.assembler_time(),
                "assembler_nanoseconds_per_evaluation",
            )?,
        })
    }
}

// By hand: the derive is a procedural macro more, which takes longer to compile than all of this.
impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        macro_rules! fields {
            ($($field:ident),*) => {{
                const FIELDS: &[&str] = &[$(stringify!($field)),*];
                let mut record = serializer.serialize_struct("Record", FIELDS.len())?;
                $(record.serialize_field(stringify!($field), &self.$field)?;)*
                record.end()
            }};
        }
        fields!(
            formulation,
            evaluations,
            accepted,
            rejected,
            published_evaluations,
            final_angle_error_rad,
            max_violation,
            final_violation,
            energy_drift_joule,
            nanoseconds_per_evaluation,
            assembler_nanoseconds_per_evaluation
        )
    }
}

/// All outcomes as a JSON array, one object per formulation.
///
/// # Errors
/// [`StudyError::NotFinite`] with the field that JSON has no number for.
pub fn json(outcomes: &[Outcome]) -> Result<String, StudyError> {
    let records = outcomes
        .iter()
        .map(Record::of)
        .collect::<Result<Vec<_>, _>>()?;
    let mut text = serde_json::to_string_pretty(&records)?;
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::json;
    use crate::chapter15::Method;
    use crate::chapter15::outcome::tests::made_up;
    use crate::error::StudyError;

    #[test]
    fn the_array_has_one_object_per_formulation_with_all_fields() {
        let outcomes = Method::ALL.map(made_up);
        let value: serde_json::Value = serde_json::from_str(&json(&outcomes).unwrap()).unwrap();
        let array = value.as_array().unwrap();
        let names: Vec<_> = array
            .iter()
            .map(|o| o["formulation"].as_str().unwrap())
            .collect();
        assert_eq!(
            names,
            ["standard", "baumgarte", "penalty", "augmented-lagrangian"]
        );
        let published: Vec<_> = array
            .iter()
            .map(|o| o["published_evaluations"].as_u64().unwrap())
            .collect();
        assert_eq!(published, [1639, 2401, 3769, 3769]);
        for object in array {
            let object = object.as_object().unwrap();
            assert_eq!(object.len(), 11);
            for count in ["evaluations", "accepted", "rejected"] {
                assert!(object[count].is_u64());
            }
            for number in [
                "final_angle_error_rad",
                "max_violation",
                "final_violation",
                "energy_drift_joule",
                "nanoseconds_per_evaluation",
                "assembler_nanoseconds_per_evaluation",
            ] {
                assert!(object[number].is_f64(), "{number}");
            }
        }
    }

    #[test]
    fn what_is_no_number_is_refused_by_name() {
        let mut outcome = made_up(Method::Baumgarte);
        outcome.instants[7].energy = f64::NAN;
        let error = json(&[outcome]).unwrap_err();
        assert!(
            matches!(&error, StudyError::NotFinite { what }
            if what == "`energy_drift_joule` of `baumgarte`"),
            "{error}"
        );
    }
}
