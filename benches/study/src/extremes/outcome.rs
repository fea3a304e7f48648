//! What became of a run at an extreme.

use serde::{Deserialize, Serialize};

use super::thresholds::{HOLDS, Motion, WRONG, promised};
use crate::error::StudyError;
use crate::trade::{Observation, Reference, Setting, Subject};

/// What became of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// The error is within [`HOLDS`] times of what is promised, and below [`WRONG`].
    Holds,
    /// It is larger, and the run's monitor says so; or it is below [`WRONG`], but not what is
    /// promised.
    Drifts,
    /// The run ended with an error that says why.
    Fails,
    /// The error is above [`WRONG`] and nothing tells, be it promised or not.
    Wrong,
}

impl Outcome {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Holds, Self::Drifts, Self::Fails, Self::Wrong];

    /// The name in JSON, and for a reader.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Drifts => "drifts",
            Self::Fails => "fails",
            Self::Wrong => "wrong",
        }
    }

    /// A sign for maps.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Holds => "●",
            Self::Drifts => "◐",
            Self::Fails => "×",
            Self::Wrong => "WRONG",
        }
    }
}

/// A run with what it was judged by.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What became of it.
    pub outcome: Outcome,
    /// The error relative to the motion's scale; `None` where the run failed.
    pub error: Option<f64>,
    /// What was promised.
    pub promised: f64,
    /// Why, where it does not hold.
    pub reason: String,
}

/// Runs and judges. `scale` is that of the motion, in the unit of the problem.
///
/// # Errors
/// [`StudyError`] of other kinds than a run that stops.
pub fn judge(
    subject: &dyn Subject,
    setting: &Setting,
    motion: &Motion,
    scale: f64,
) -> Result<Verdict, StudyError> {
    let promised = promised(setting, motion);
    let fails = |reason: String| Verdict {
        outcome: Outcome::Fails,
        error: None,
        promised,
        reason,
    };
    let run = subject.start().and_then(|start| {
        let run = subject.observe(setting, &start)?;
        Ok((Reference::of(subject, None)?, run))
    });
    match run {
        Ok((reference, run)) => {
            let error = reference.error_of(subject, &run) / scale;
            Ok(judged(error, promised, &run))
        }
        Err(StudyError::Run { reason, .. }) => Ok(fails(reason)),
        Err(error) => Err(error),
    }
}

fn judged(error: f64, promised: f64, run: &Observation) -> Verdict {
    let (outcome, reason) = if error <= (HOLDS * promised).min(WRONG) {
        (Outcome::Holds, String::new())
    } else if let Some(warning) = run.warnings.first() {
        (Outcome::Drifts, warning.clone())
    } else if error <= WRONG {
        let reason = format!("the error is {error:.1e}, of {promised:.1e} that is promised");
        (Outcome::Drifts, reason)
    } else {
        // NaN is here, too.
        let reason = format!("the error is {error:.1e}, and nothing tells");
        (Outcome::Wrong, reason)
    };
    Verdict {
        outcome,
        error: error.is_finite().then_some(error),
        promised,
        reason,
    }
}

#[cfg(test)]
mod tests {
    use super::{Outcome, judged};
    use crate::trade::Observation;

    #[test]
    fn silence_is_wrong_above_a_hundredth() {
        let silent = Observation::default();
        let warned = Observation {
            warnings: vec!["a joint was open".into()],
            ..Observation::default()
        };
        let outcome = |error, run| judged(error, 1e-4, run).outcome;
        assert_eq!(outcome(9e-4, &silent), Outcome::Holds);
        assert_eq!(outcome(5e-3, &silent), Outcome::Drifts);
        assert_eq!(outcome(5e-2, &silent), Outcome::Wrong);
        assert_eq!(outcome(5e-2, &warned), Outcome::Drifts);
        assert_eq!(outcome(f64::NAN, &silent), Outcome::Wrong);
        assert_eq!(outcome(9e-4, &warned), Outcome::Holds);
    }
}
