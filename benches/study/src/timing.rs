//! The processor's time per evaluation, of several candidates in turn.
//!
//! Candidates are interleaved: every round gives each of them a turn, and the order rotates from
//! round to round. A machine that slows down for a while slows all of them, so that ratios hold
//! where absolute times do not.
//!
//! A turn is measured by the time that the processor gave to this thread. What the thread waited
//! for its processor is left out, and told by [`busy`].

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

    /// Runs until the processor has worked for `least`, at least once.
    fn turn(&mut self, least: Duration) -> Result<Turn, StudyError> {
        let (start, processor) = (Instant::now(), processor_time());
        let (mut runs, mut evaluations) = (0, 0);
        // The clock of the processor is asked seldom: that takes longer than a short run.
        let mut next = least;
        loop {
            evaluations += (self.run)()?;
            runs += 1;
            let whole = start.elapsed();
            if whole < next {
                continue;
            }
            let worked = match (processor, processor_time()) {
                (Some(start), Some(end)) => end.saturating_sub(start),
                _ => whole,
            };
            if worked >= least {
                return Ok(Turn {
                    time: worked.as_secs_f64() * 1e9 / evaluations as f64,
                    evaluations: evaluations / runs,
                    worked,
                    whole,
                });
            }
            next = whole + (least - worked);
        }
    }
}

/// The time that the processor has given to this thread, where the system tells.
#[cfg(unix)]
fn processor_time() -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    Duration::try_from(clock_gettime(ClockId::ThreadCPUTime)).ok()
}

/// The time that the processor has given to this thread, where the system tells.
#[cfg(not(unix))]
fn processor_time() -> Option<Duration> {
    None
}

/// A turn of a candidate.
struct Turn {
    /// Per evaluation (ns).
    time: f64,
    /// Evaluations of one run.
    evaluations: u64,
    /// What the processor worked.
    worked: Duration,
    /// From the start to the end.
    whole: Duration,
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
    /// The part of the time in which this thread had a processor, over all turns of all candidates.
    pub share: f64,
}

/// A sentence where a machine was so busy that its times are to be doubted: the thread had to wait
/// for its processor, or half of the turns took far longer than the best. Nothing on a quiet one.
#[must_use]
pub fn busy<'t>(timings: impl IntoIterator<Item = &'t Timing>) -> Option<String> {
    let timings: Vec<&Timing> = timings.into_iter().collect();
    let share = timings
        .iter()
        .map(|timing| timing.share)
        .fold(1.0, f64::min);
    let spreads = timings
        .iter()
        .map(|timing| timing.time.median / timing.time.least);
    let spread = Quartiles::of(&spreads.collect::<Vec<_>>()).map_or(1.0, |spread| spread.median);
    busy_sentence(share, spread)
}

/// The same of the share of the processor, and of the median over the least of most candidates.
#[must_use]
pub fn busy_sentence(share: f64, spread: f64) -> Option<String> {
    /// Less of a processor than this is not that of a quiet machine.
    const QUIET_SHARE: f64 = 0.95;
    /// Turns that are longer by more than this are not those of a quiet machine.
    const QUIET_SPREAD: f64 = 1.15;
    (share < QUIET_SHARE || spread > QUIET_SPREAD).then(|| {
        format!(
            "This machine was busy: the thread had a processor for {:.0} % of the time, and half of the turns took {:.0} % longer than the best, or more. \
             Repeat this on a quiet one.",
            100.0 * share,
            100.0 * (spread - 1.0)
        )
    })
}

/// How often and how long to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schedule {
    /// Rounds; each gives one measurement per candidate. One more round warms up and is not
    /// counted.
    pub rounds: usize,
    /// A turn repeats its run until the processor has worked for this time.
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

/// A race that goes on round by round, so that something else may be done between two rounds.
#[derive(Debug)]
pub struct Race<'a, 'c> {
    candidates: &'c mut [Candidate<'a>],
    turn: Duration,
    rounds: usize,
    measurements: Vec<Vec<f64>>,
    evaluations: Vec<u64>,
    worked: Duration,
    whole: Duration,
}

impl<'a, 'c> Race<'a, 'c> {
    /// A round that warms up and is not counted.
    ///
    /// # Errors
    /// The first error of a candidate.
    pub fn new(candidates: &'c mut [Candidate<'a>], turn: Duration) -> Result<Self, StudyError> {
        let mut evaluations = Vec::with_capacity(candidates.len());
        for candidate in candidates.iter_mut() {
            evaluations.push(candidate.turn(turn)?.evaluations);
        }
        Ok(Self {
            measurements: vec![Vec::new(); candidates.len()],
            candidates,
            turn,
            rounds: 0,
            evaluations,
            worked: Duration::ZERO,
            whole: Duration::ZERO,
        })
    }

    /// A turn of every candidate.
    ///
    /// # Errors
    /// The first error of a candidate.
    pub fn round(&mut self) -> Result<(), StudyError> {
        for place in 0..self.candidates.len() {
            let which = (place + self.rounds) % self.candidates.len();
            let turn = self.candidates[which].turn(self.turn)?;
            self.measurements[which].push(turn.time);
            self.worked += turn.worked;
            self.whole += turn.whole;
        }
        self.rounds += 1;
        Ok(())
    }

    /// The time per evaluation of every candidate, in their order.
    ///
    /// # Errors
    /// [`StudyError::NotFinite`] where a candidate counts no evaluations or there was no round.
    pub fn timings(&self) -> Result<Vec<Timing>, StudyError> {
        let share = match self.whole.as_secs_f64() {
            0.0 => 1.0,
            whole => (self.worked.as_secs_f64() / whole).min(1.0),
        };
        let mut timings = Vec::with_capacity(self.candidates.len());
        let measured = self.candidates.iter().zip(&self.measurements);
        for ((candidate, measurements), evaluations) in measured.zip(&self.evaluations) {
            let name = candidate.name.clone();
            let time = Quartiles::of(measurements).filter(|time| time.median.is_finite());
            let time = time.ok_or_else(|| StudyError::NotFinite {
                what: format!("the time per evaluation of {name}"),
            })?;
            timings.push(Timing {
                name,
                time,
                evaluations: *evaluations,
                share,
            });
        }
        Ok(timings)
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
    let mut race = Race::new(candidates, schedule.turn)?;
    for round in 0..schedule.rounds {
        race.round()?;
        progress(round + 1);
    }
    race.timings()
}

#[cfg(test)]
mod tests {
    use super::{Candidate, Schedule, busy, busy_sentence, race};
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
        let work = || {
            let sum = (0..200_000_u64).fold(0, |sum, k| std::hint::black_box(sum ^ k));
            std::hint::black_box(sum);
        };
        let candidate = |name: &'static str, evaluations| {
            Candidate::new(name, move || {
                work();
                Ok(evaluations)
            })
        };
        let mut candidates = [candidate("one", 1), candidate("thousand", 1000)];
        let timings = race(&mut candidates, SHORT, |_| ()).unwrap();
        assert!(timings[0].time.least > 50.0 * timings[1].time.least);
        assert_eq!(timings[1].evaluations, 1000);
    }

    /// A thread that waits takes no time of the processor; that it waited is told.
    #[test]
    #[cfg(unix)]
    fn what_a_thread_waits_is_no_work() {
        let wait = || {
            std::thread::sleep(Duration::from_millis(20));
            Ok(1)
        };
        let mut candidates = [Candidate::new("waits", wait)];
        let timings = race(&mut candidates, SHORT, |_| ()).unwrap();
        assert!(timings[0].time.least < 10e6, "{:?}", timings[0]);
        assert!(timings[0].share < 0.5);
        let sentence = busy(&timings).expect("it was not quiet");
        assert!(sentence.contains("had a processor for"), "{sentence}");
    }

    #[test]
    fn a_quiet_machine_gets_no_word() {
        assert_eq!(busy_sentence(0.99, 1.05), None);
        assert!(busy_sentence(0.9, 1.0).is_some());
        assert!(busy_sentence(1.0, 1.3).is_some_and(|text| text.contains("30 % longer")));
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
