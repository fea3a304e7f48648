//! Which settings a problem is run with.

use super::integration::{Family, IntegratorSetting};
use super::setting::{Choice, Formulated, PostStabilisation, Setting};
use super::subject::{Facts, Subject};
use crate::chapter15::Method;
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;
use crate::format::{digits, two_digits};

/// Which settings: every combination of these, but those that are the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Descriptions.
    pub coordinates: Vec<Coordinates>,
    /// Formulations, and where their coefficients come from.
    pub formulations: Vec<Choice>,
    /// What is done after steps.
    pub stabilisations: Vec<PostStabilisation>,
    /// Methods of integration.
    pub families: Vec<Family>,
    /// Number types.
    pub scalars: Vec<Precision>,
    /// Fixed steps begin with a quarter of [`Facts::time_scale`]; two of them make a half, as long
    /// as a run has no more steps than this. They have two digits, or three, if reports then come
    /// at ends of steps.
    pub most_steps: f64,
    /// Relative tolerances, of two digits, begin with a hundredth; two of them make a tenth, down
    /// to this.
    pub least_tolerance: f64,
}

impl Default for Grid {
    fn default() -> Self {
        Self {
            coordinates: vec![Coordinates::Bodies, Coordinates::Joints],
            formulations: Method::ALL.map(Choice::Derived).into(),
            stabilisations: PostStabilisation::ALL.into(),
            families: Family::ALL.into(),
            scalars: vec![Precision::Double, Precision::Single],
            most_steps: 50_000.0,
            least_tolerance: 1e-13,
        }
    }
}

/// A setting of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The setting.
    pub setting: Setting,
    /// Why it cannot be run: no coefficients follow from the mechanism.
    pub refused: Option<String>,
}

impl Choice {
    /// Which formulation it is.
    #[must_use]
    pub const fn method(&self) -> Method {
        match self {
            Self::Derived(method) => *method,
            Self::Given(formulation) => formulation.method(),
        }
    }

    /// The coefficients for a mechanism, its numbers and an integrator, whether they follow from
    /// the mechanism, and why not, if they were to.
    #[must_use]
    pub fn made(
        self,
        subject: &dyn Subject,
        scalar: Precision,
        integration: IntegratorSetting,
    ) -> (Formulated, bool, Option<String>) {
        match self {
            Self::Given(formulation) => (formulation, false, None),
            Self::Derived(method) => match subject.derived(method, scalar, integration) {
                Ok(formulation) => (formulation, true, None),
                Err(error) => (
                    Formulated::default_of(method),
                    false,
                    Some(error.to_string()),
                ),
            },
        }
    }
}

/// Below it, a relative tolerance asks for more than the numbers have.
const LEAST_OF_SINGLE: f64 = 1e-5;

impl Grid {
    /// Refuses limits without an end.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        let refused = |reason: &str| StudyError::Run {
            name: "the grid".into(),
            reason: reason.into(),
        };
        if !(self.most_steps > 0.0 && self.most_steps < f64::INFINITY) {
            return Err(refused("most_steps is not a positive number"));
        }
        if !(self.least_tolerance > 0.0 && self.least_tolerance < f64::INFINITY) {
            return Err(refused("least_tolerance is not a positive number"));
        }
        Ok(())
    }

    /// The settings for a problem, those that are cheap first where they differ in step or
    /// tolerance alone.
    ///
    /// Where no equations remain in joint coordinates, all formulations are the same and there is
    /// nothing to correct: one stands for all. Without joint coordinates there are no settings by
    /// joints, and no recovery along the tree, which joint coordinates have done anyway.
    #[must_use]
    pub fn settings(&self, subject: &dyn Subject) -> Vec<Planned> {
        let facts = &subject.facts();
        let mut settings = Vec::new();
        for &scalar in &self.scalars {
            for &coordinates in &self.coordinates {
                let equations = match coordinates {
                    Coordinates::Bodies => Some(facts.equations),
                    Coordinates::Joints => facts.closing,
                };
                let Some(equations) = equations else { continue };
                let different = if equations == 0 { 1 } else { usize::MAX };
                for &choice in self.formulations.iter().take(different) {
                    let stabilisations = self.stabilisations.iter().filter(|&&stabilisation| {
                        stabilisation != PostStabilisation::TreeRecovery
                            || (coordinates == Coordinates::Bodies && facts.closing.is_some())
                    });
                    for &stabilisation in stabilisations.take(different) {
                        for integration in self.integrations(facts, scalar) {
                            let (formulation, is_derived, refused) =
                                choice.made(subject, scalar, integration);
                            if !integration.family.moves(coordinates, formulation.method()) {
                                continue;
                            }
                            let setting = Setting {
                                coordinates,
                                formulation,
                                is_derived,
                                stabilisation,
                                integration,
                                scalar,
                            };
                            settings.push(Planned { setting, refused });
                        }
                    }
                }
            }
        }
        settings
    }

    fn integrations(&self, facts: &Facts, scalar: Precision) -> Vec<IntegratorSetting> {
        let duration = facts.span.end - facts.span.start;
        let mut integrations = Vec::new();
        for &family in &self.families {
            let with = |step_or_tolerance| IntegratorSetting {
                family,
                step_or_tolerance,
            };
            if family.is_adaptive() {
                let least = match scalar {
                    Precision::Double => self.least_tolerance,
                    Precision::Single => self.least_tolerance.max(LEAST_OF_SINGLE),
                };
                let tolerances =
                    (4..).map(|half_digits| 10.0_f64.powf(-0.5 * f64::from(half_digits)));
                let tolerances = tolerances.map(two_digits);
                let enough = tolerances.take_while(|&tolerance| tolerance >= 0.99 * least);
                integrations.extend(enough.map(with));
            } else {
                let first = 0.25 * facts.time_scale;
                let steps = (0..).map(|k| two_digits(first * 2.0_f64.powf(-0.5 * f64::from(k))));
                let few = steps.take_while(|&step| duration <= self.most_steps * step);
                let mut few: Vec<_> = few
                    .map(|step| dividing(facts.span.first_output, step))
                    .collect();
                few.dedup();
                integrations.extend(few.into_iter().map(with));
            }
        }
        integrations
    }
}

/// The step of three digits nearest to this one of which a time between reports is a multiple, so
/// that no state within a step is asked for; the same step, if none is near.
fn dividing(reporting: f64, step: f64) -> f64 {
    /// A quarter of the way to twice as much: half of that from a step of the grid to the next.
    const NEAR: f64 = 1.189_207;
    let least = (reporting / (step * NEAR)).ceil().max(1.0) as u32;
    let most = (reporting / step * NEAR).floor() as u32;
    let parts = (least..=most).map(|parts| reporting / f64::from(parts));
    let written = parts.filter(|&part| (digits(part, 3) / part - 1.0).abs() < 1e-12);
    let distance = |part: &f64| (part / step).ln().abs();
    written
        .map(|part| digits(part, 3))
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(step)
}

#[cfg(test)]
mod tests {
    use super::dividing;

    #[test]
    fn steps_end_where_reports_are_wanted_if_such_a_step_is_near() {
        assert_eq!(dividing(0.5, 0.24), 0.25);
        assert_eq!(dividing(0.5, 0.12), 0.125);
        assert_eq!(dividing(0.5, 0.0021), 0.002);
        // Thirds are not written with three digits, and a step may be longer than what is asked
        // for.
        assert_eq!(dividing(0.5, 0.17), 0.17);
        assert_eq!(dividing(0.1, 0.25), 0.25);
    }
}
