//! Wall-clock time per evaluation, of several candidates in turn.
//!
//! Candidates are interleaved: every round gives each of them a turn, and the order rotates from
//! round to round. A machine that slows down for a while slows all of them, so that ratios hold
//! where absolute times do not.

use std::time::{Duration, Instant};

use crate::error::StudyError;
use crate::statistics::Quartiles;

/// One thing to be timed.
pub struct Candidate<'a> {
    name: String,
    run: Run<'a>,
}

/// Does the work once and tells how many evaluations that were.
type Run<'a> = Box<dyn FnMut() -> Result<u64, StudyError> + 'a>;

impl std::fmt::Debug for Candidate<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Candidate")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl<'a> Candidate<'a> {
    /// A candidate that does its work once per call and returns the number of evaluations.
    pub fn new(name: impl Into<String>, run: impl FnMut() -> Result<u64, StudyError> + 'a) -> Self {
        Self {
            name: name.into(),
            run: Box::new(run),
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Runs until `least` is over, at least once; nanoseconds per evaluation, and the evaluations
    /// of one run.
    fn turn(&mut self, least: Duration) -> Result<(f64, u64), StudyError> {
        let start = Instant::now();
        let (mut runs, mut evaluations) = (0, 0);
        loop {
            evaluations += (self.run)()?;
            runs += 1;
            let elapsed = start.elapsed();
            if elapsed >= least {
                let time = elapsed.as_secs_f64() * 1e9 / evaluations as f64;
                return Ok((time, evaluations / runs));
            }
        }
    }
}

/// What an evaluation costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// What was timed.
    pub name: String,
    /// The time of a whole run over its evaluations (ns).
    pub time: Quartiles,
    /// The evaluations of one run.
    pub evaluations: u64,
}

/// How often and how long to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// Rounds; each gives one measurement per candidate. One more round warms up and is not
    /// counted.
    pub rounds: usize,
    /// A turn repeats its run until this time is over.
    pub turn: Duration,
}

impl Default for Schedule {
    fn default() -> Self {
        Self {
            rounds: 41,
            turn: Duration::from_millis(2),
        }
    }
}

/// The time per evaluation of every candidate, in their order.
///
/// `progress` is called after every round with the rounds done.
///
/// # Errors
/// The first error of a candidate; [`StudyError::NotFinite`] where a candidate counts no
/// evaluations or there are no rounds.
pub fn race(
    candidates: &mut [Candidate<'_>],
    schedule: Schedule,
    mut progress: impl FnMut(usize),
) -> Result<Vec<Timing>, StudyError> {
    let mut measurements = vec![Vec::with_capacity(schedule.rounds); candidates.len()];
    let mut evaluations = Vec::with_capacity(candidates.len());
    for candidate in candidates.iter_mut() {
        evaluations.push(candidate.turn(schedule.turn)?.1);
    }
    for round in 0..schedule.rounds {
        for place in 0..candidates.len() {
            let which = (place + round) % candidates.len();
            measurements[which].push(candidates[which].turn(schedule.turn)?.0);
        }
        progress(round + 1);
    }
    let mut timings = Vec::with_capacity(candidates.len());
    for ((candidate, measurements), evaluations) in
        candidates.iter().zip(measurements).zip(evaluations)
    {
        let name = candidate.name.clone();
        let time = Quartiles::of(&measurements).filter(|time| time.median.is_finite());
        let time = time.ok_or_else(|| StudyError::NotFinite {
            what: format!("the time per evaluation of {name}"),
        })?;
        timings.push(Timing {
            name,
            time,
            evaluations,
        });
    }
    Ok(timings)
}

#[cfg(test)]
mod tests {
    use super::{Candidate, Schedule, race};
    use crate::error::StudyError;
    use std::cell::RefCell;
    use std::time::Duration;

    const SHORT: Schedule = Schedule {
        rounds: 4,
        turn: Duration::ZERO,
    };

    #[test]
    fn candidates_take_turns_and_the_order_rotates() {
        let order = RefCell::new(String::new());
        let candidate = |name: &'static str| {
            let order = &order;
            Candidate::new(name, move || {
                order.borrow_mut().push_str(name);
                Ok(1)
            })
        };
        let mut candidates = [candidate("a"), candidate("b"), candidate("c")];
        let mut rounds = Vec::new();
        let timings = race(&mut candidates, SHORT, |round| rounds.push(round)).unwrap();
        assert_eq!(*order.borrow(), "abcabcbcacababc");
        assert_eq!(rounds, [1, 2, 3, 4]);
        assert!(
            timings
                .iter()
                .all(|t| t.time.count == 4 && t.time.median > 0.0)
        );
        assert!(timings.iter().all(|t| t.evaluations == 1));
    }

    #[test]
    fn time_is_divided_by_the_evaluations() {
        let spin = |_| std::thread::sleep(Duration::from_millis(1));
        let mut candidates = [
            Candidate::new("one", || {
                Ok({
                    spin(());
                    1
                })
            }),
            Candidate::new("thousand", || {
                Ok({
                    spin(());
                    1000
                })
            }),
        ];
        let timings = race(&mut candidates, SHORT, |_| ()).unwrap();
        assert!(timings[0].time.median > 1e6);
        assert!(timings[0].time.median > 50.0 * timings[1].time.median);
        assert_eq!(timings[1].evaluations, 1000);
    }

    #[test]
    fn nothing_evaluated_is_an_error() {
        let mut candidates = [Candidate::new("idle", || Ok(0))];
        let error = race(&mut candidates, SHORT, |_| ()).unwrap_err();
        assert!(matches!(&error, StudyError::NotFinite { what } if what.contains("idle")));
    }

    #[test]
    fn an_error_of_a_candidate_ends_the_race() {
        let mut candidates = [Candidate::new("broken", || {
            Err(StudyError::Run {
                name: "broken".into(),
                reason: "no fuel".into(),
            })
        })];
        assert!(race(&mut candidates, SHORT, |_| ()).is_err());
    }
}
