//! A checkpoint in a file.
//!
//! The file says first of what it is, so that another program refuses it with a sentence before it
//! reads numbers that it does not understand.

use core::any::type_name;
use core::fmt::Write as _;
use core::marker::PhantomData;
use std::format;
use std::string::String;
use std::vec::Vec;

use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Checkpoint, Kept, Segment};
use crate::dynamics::Iterations;
use crate::integrate::Counts;
use crate::math::scalar::Real;
use crate::measure::NamedState;
use crate::mechanism::kernels::Mechanism;
use crate::run::output::Reporting;
use crate::run::past::Progress;
use crate::state::vector::Array;

/// The format of files. A change of what is written, or of its meaning, makes it another one.
const FORMAT: u32 = 2;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// No count is as large: one more is a count as well.
const TOO_MANY: usize = usize::MAX / 2;

/// Of what a checkpoint is.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Of", deny_unknown_fields)]
struct Written {
    format: u32,
    holonom: String,
    mechanism: String,
    structure: String,
    numbers: String,
}

impl Written {
    fn of<M: Mechanism, S>() -> Self {
        Self {
            format: FORMAT,
            holonom: VERSION.into(),
            mechanism: M::REPORT.name.into(),
            structure: structure::<M>(),
            numbers: type_name::<S>().into(),
        }
    }

    /// In what it is of something else.
    fn differs(&self, meant: &Self) -> Option<String> {
        let name = &meant.mechanism;
        if self.format != meant.format {
            let [found, known] = [self.format, meant.format];
            Some(format!(
                "this is a checkpoint in the format {found}, and this program reads the format \
                 {known}"
            ))
        } else if self.mechanism != meant.mechanism {
            let found = &self.mechanism;
            Some(format!(
                "this is a checkpoint of `{found}`, and not of `{name}`"
            ))
        } else if self.holonom != meant.holonom {
            let [found, known] = [&self.holonom, &meant.holonom];
            Some(format!(
                "this is a checkpoint of holonom {found}, and not of {known}, whose numbers may be \
                 others"
            ))
        } else if self.numbers != meant.numbers {
            let [found, known] = [&self.numbers, &meant.numbers];
            Some(format!(
                "this checkpoint has numbers of type {found}, and not of type {known}"
            ))
        } else if self.structure != meant.structure {
            Some(format!(
                "`{name}` has other fields than at the time of this checkpoint, or they are in \
                 another order"
            ))
        } else {
            None
        }
    }
}

/// A hash of everything that the description of a mechanism has but its numbers.
fn structure<M: Mechanism>() -> String {
    /// That of Fowler, Noll and Vo.
    struct Hash(u64);
    impl core::fmt::Write for Hash {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            for byte in text.bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
            Ok(())
        }
    }
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    let report = M::REPORT;
    let described = (report.bodies, report.joints, report.forces);
    let numbers = (report.values, report.states);
    let layout = (report.carriers, report.redundant, report.equations);
    let sizes = (report.coordinates, report.auxiliaries, report.velocities);
    let _ = write!(hash, "{described:?} {numbers:?} {layout:?} {sizes:?}");
    format!("{:016x}", hash.0)
}

/// Of what a file is, which must be what is meant.
struct Of<M, S>(PhantomData<fn() -> (M, S)>);

impl<M: Mechanism, S> Serialize for Of<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        Written::of::<M, S>().serialize(serializer)
    }
}

impl<'de, M: Mechanism, S> Deserialize<'de> for Of<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = Written::deserialize(deserializer)?;
        match found.differs(&Written::of::<M, S>()) {
            Some(sentence) => Err(D::Error::custom(sentence)),
            None => Ok(Self(PhantomData)),
        }
    }
}

/// What is written.
#[derive(Serialize, Deserialize)]
#[serde(
    rename = "Checkpoint",
    deny_unknown_fields,
    bound(serialize = "S: Serialize", deserialize = "S: Deserialize<'de>")
)]
struct Parts<M: Mechanism, S: Real> {
    of: Of<M, S>,
    method: String,
    formulation: String,
    joints: bool,
    interval: [S; 2],
    reporting: Reporting<S>,
    state: NamedState<M, S>,
    given: Vec<S>,
    taken: Option<Vec<S>>,
    present: Vec<S>,
    steps: usize,
    reports: usize,
    unseen: usize,
    counts: [usize; 3],
    iterations: [usize; 3],
    worst_violation: S,
    rates: Vec<S>,
    segment: Option<WrittenSegment<S>>,
    events: WrittenNumbers<S>,
    warnings: Vec<String>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Segment", deny_unknown_fields)]
struct WrittenSegment<S> {
    start: S,
    state: Vec<S>,
    of_monitor: usize,
    memory: WrittenNumbers<S>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Numbers", deny_unknown_fields)]
struct WrittenNumbers<S> {
    numbers: Vec<S>,
    counts: Vec<usize>,
}

impl<S: Real> WrittenNumbers<S> {
    fn of(kept: &Kept<S>) -> Self {
        Self {
            numbers: kept.numbers.clone(),
            counts: kept.counts.clone(),
        }
    }

    fn kept(self) -> Option<Kept<S>> {
        let Self { numbers, counts } = self;
        let is_sound = are_finite(&numbers) && are_counts(&counts);
        is_sound.then_some(Kept { numbers, counts })
    }
}

impl<S: Real> WrittenSegment<S> {
    fn of(segment: &Segment<S>) -> Self {
        Self {
            start: segment.start,
            state: segment.state.clone(),
            of_monitor: segment.of_monitor,
            memory: WrittenNumbers::of(&segment.memory),
        }
    }

    fn segment(self) -> Option<Segment<S>> {
        let is_sound = are_finite(&[self.start]) && are_finite(&self.state);
        let is_sound = is_sound && are_counts(&[self.of_monitor]);
        let memory = self.memory.kept().filter(|_| is_sound)?;
        Some(Segment {
            start: self.start,
            state: self.state,
            of_monitor: self.of_monitor,
            memory,
        })
    }
}

fn are_finite<S: Real>(numbers: &[S]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}

fn are_counts(counts: &[usize]) -> bool {
    counts.iter().all(|&count| count < TOO_MANY)
}

/// An array of as many numbers as it has.
fn array<S: Real, A: Array<S>>(numbers: &[S]) -> Option<A> {
    let mut array = A::zeros();
    let places = array.as_mut_slice();
    if places.len() != numbers.len() || !are_finite(numbers) {
        return None;
    }
    places.copy_from_slice(numbers);
    Some(array)
}

impl<M: Mechanism, S: Real> Parts<M, S> {
    fn of(checkpoint: &Checkpoint<M, S>) -> Self {
        let progress = &checkpoint.progress;
        let Counts {
            evaluations,
            accepted,
            rejected,
        } = progress.counts;
        let Iterations {
            total,
            largest,
            unconverged,
        } = progress.iterations;
        Self {
            of: Of(PhantomData),
            method: checkpoint.method.clone(),
            formulation: checkpoint.formulation.clone(),
            joints: checkpoint.joints,
            interval: checkpoint.interval.into(),
            reporting: checkpoint.reporting,
            state: NamedState::new(checkpoint.time, checkpoint.state),
            given: checkpoint.given.as_slice().into(),
            taken: checkpoint.taken.map(|taken| taken.as_slice().into()),
            present: checkpoint.present.as_slice().into(),
            steps: progress.steps,
            reports: progress.reports,
            unseen: progress.unseen,
            counts: [evaluations, accepted, rejected],
            iterations: [total, largest, unconverged],
            worst_violation: progress.worst_violation,
            rates: checkpoint.rates.clone(),
            segment: checkpoint.segment.as_ref().map(WrittenSegment::of),
            events: WrittenNumbers::of(&checkpoint.events),
            warnings: checkpoint.warnings.clone(),
        }
    }

    /// `None` where numbers are missing, not finite or beyond all counts.
    fn checkpoint(self) -> Option<Checkpoint<M, S>> {
        let counts = [self.steps, self.reports, self.unseen];
        let is_counted = are_counts(&counts) && are_counts(&self.counts);
        let is_counted = is_counted && are_counts(&self.iterations);
        let [start, end] = self.interval;
        let is_finite = are_finite(&[start, end, self.worst_violation]) && are_finite(&self.rates);
        if !(is_counted && is_finite) {
            return None;
        }
        let [evaluations, accepted, rejected] = self.counts;
        let [total, largest, unconverged] = self.iterations;
        let taken = match &self.taken {
            Some(taken) => Some(array(taken)?),
            None => None,
        };
        let segment = match self.segment {
            Some(segment) => Some(segment.segment()?),
            None => None,
        };
        Some(Checkpoint {
            method: self.method,
            formulation: self.formulation,
            joints: self.joints,
            interval: (start, end),
            reporting: self.reporting,
            time: self.state.time,
            state: self.state.state,
            given: array(&self.given)?,
            taken,
            present: array(&self.present)?,
            progress: Progress {
                steps: self.steps,
                reports: self.reports,
                unseen: self.unseen,
                counts: Counts {
                    evaluations,
                    accepted,
                    rejected,
                },
                iterations: Iterations {
                    total,
                    largest,
                    unconverged,
                },
                worst_violation: self.worst_violation,
            },
            rates: self.rates,
            segment,
            events: self.events.kept()?,
            monitor: None,
            warnings: self.warnings,
        })
    }
}

const DAMAGED: &str =
    "this checkpoint is damaged: numbers are missing, not finite or beyond all counts";

/// # Errors
/// That of the format; a number that is not finite, which not every format can hold.
impl<M: Mechanism, S: Real + Serialize> Serialize for Checkpoint<M, S> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let segment = self.segment.as_ref();
        let memory = segment.map_or(&[][..], |segment| &segment.memory.numbers);
        if !(are_finite(memory) && are_finite(&self.events.numbers)) {
            return Err(W::Error::custom(DAMAGED));
        }
        Parts::of(self).serialize(serializer)
    }
}

/// # Errors
/// That of the format; a checkpoint in another format, of another version of this crate, of another
/// mechanism or one with other fields, with numbers of another type; numbers that are missing or
/// not finite.
impl<'de, M: Mechanism, S: Real + Deserialize<'de>> Deserialize<'de> for Checkpoint<M, S> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let parts = Parts::<M, S>::deserialize(deserializer)?;
        parts.checkpoint().ok_or_else(|| D::Error::custom(DAMAGED))
    }
}
