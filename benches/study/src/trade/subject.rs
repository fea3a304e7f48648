//! A problem without its mechanism in the type: what all the rest of the study is about.

use holonom::{
    AugmentedLagrangian, Fault, Mechanism, Projection, Real, StateParts,
    dynamics::Dynamics,
    integrate::Span,
    mechanism::{BodyInfo, BodyKind},
    state::Array as _,
};

use super::dispatch::{JointsOf, Observe, Time, WithJoints, WithoutJoints, with_formulation};
use super::integration::Integration;
use super::problem::{BodiesAlone, Both, InBoth, Problem, Quantity};
use super::setting::{Formulated, Setting, Treatment};
use crate::chapter15::Method;
use crate::compare::measure::reported;
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;
use crate::timing::Contestant;

/// What is known of a problem before anything runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Its name, see [`Problem::name`].
    pub name: String,
    /// A sentence for the reader.
    pub title: String,
    /// From when to when, and the reports (s).
    pub span: Span<f64>,
    /// See [`Problem::time_scale`] (s).
    pub time_scale: f64,
    /// What an error is of.
    pub quantity: Quantity,
    /// Equations of the joints, by the bodies.
    pub equations: usize,
    /// Equations that remain in joint coordinates; `None` where the mechanism has none.
    pub closing: Option<usize>,
}

impl Facts {
    /// Refuses what no study can be made of.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        /// Reports of a run: what is kept of each is read again and again.
        const REPORTS: f64 = 1e6;
        let refused = |reason: String| StudyError::Run {
            name: self.name.clone(),
            reason,
        };
        let is_word = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        if self.name.is_empty() || !self.name.chars().all(is_word) {
            return Err(refused(format!(
                "the name `{}` is no name of a file: letters, digits, `-` and `_`",
                self.name.escape_debug()
            )));
        }
        let Span {
            start,
            end,
            first_output,
        } = self.span;
        let reports = (end - start) / first_output;
        if !(start.is_finite() && end.is_finite() && end > start) {
            return Err(refused(format!(
                "no interval of time: from {start} s to {end} s"
            )));
        }
        if !(first_output > 0.0 && reports <= REPORTS) {
            return Err(refused(format!(
                "reports every {first_output} s from {start} s to {end} s: up to {REPORTS} are kept"
            )));
        }
        if !(self.time_scale > 0.0 && self.time_scale < f64::INFINITY) {
            return Err(refused(format!("the time scale is {} s", self.time_scale)));
        }
        Ok(())
    }
}

/// A state in `f64`: coordinates, then velocities, as [`Mechanism::State`] has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Start(pub Vec<f64>);

/// What was read of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// The reporting times (s).
    pub times: Vec<f64>,
    /// What [`Problem::read`] says at these.
    pub values: Vec<Vec<f64>>,
    /// `|Phi|` at these, all rows together, in m and rad.
    pub violations: Vec<f64>,
    /// Kinetic and potential energy (J) at these.
    pub energies: Vec<f64>,
    /// The largest change of energy (J) that no force accounts for.
    pub energy_drift: f64,
    /// What the run's watch doubts, in words.
    pub doubts: Vec<String>,
}

/// A problem without its mechanism in the type.
pub trait Subject {
    /// What is known of it.
    fn facts(&self) -> Facts;

    /// See [`Problem::reference`].
    fn reference(&self, time: f64) -> Option<Vec<f64>>;

    /// See [`Problem::difference`].
    fn difference(&self, read: &[f64], reference: &[f64]) -> f64;

    /// Where it starts.
    ///
    /// # Errors
    /// Why the mechanism does not stand.
    fn start(&self) -> Result<Start, StudyError>;

    /// A start nearby, corrected onto the constraints: positions are moved by up to `size` times
    /// the largest of them, orientations by so many radians, velocities by that part of the largest
    /// or of what the lengths and the time scale give; by a tenth or a hundredth of that where the
    /// mechanism cannot be put together there. The same number gives the same start.
    ///
    /// # Errors
    /// Why the mechanism does not stand there.
    fn start_near(&self, size: f64, number: u64) -> Result<Start, StudyError>;

    /// A formulation with the coefficients that follow from the mechanism, see [`Formulated::of`].
    ///
    /// # Errors
    /// Why none follow.
    fn derived(
        &self,
        method: Method,
        scalar: Precision,
        integration: Integration,
    ) -> Result<Formulated, StudyError>;

    /// Operations of a stage of a step; `None` where they depend on the state, or where states are
    /// corrected after steps.
    fn operations(&self, setting: &Setting) -> Option<usize>;

    /// One run with the watch, read at the reporting times.
    ///
    /// # Errors
    /// [`StudyError::Run`] with what stopped it.
    fn observe(&self, setting: &Setting, start: &Start) -> Result<Observation, StudyError>;

    /// The same run bare, to be timed: without watch and readings, its dense output at the
    /// reporting times included.
    ///
    /// # Errors
    /// [`StudyError::Run`] with why it cannot start.
    fn contestant(&self, setting: &Setting, start: &Start) -> Result<Contestant<'_>, StudyError>;
}

macro_rules! subject {
    ($([$($bound:tt)*] $own:ident => $joints:ident;)*) => {$(
        impl<P: $($bound)*> Subject for $own<P> {
            fn facts(&self) -> Facts {
                facts::<P, $joints>(&self.0)
            }

            fn reference(&self, time: f64) -> Option<Vec<f64>> {
                self.0.reference(time)
            }

            fn difference(&self, read: &[f64], reference: &[f64]) -> f64 {
                self.0.difference(read, reference)
            }

            fn start(&self) -> Result<Start, StudyError> {
                let named = |fault: Fault| stopped(&self.0, &fault);
                Ok(flat::<P::Mechanism>(&self.0.start().map_err(named)?))
            }

            fn start_near(&self, size: f64, number: u64) -> Result<Start, StudyError> {
                let at = |size| start_near(&self.0, size, number);
                // Where a mechanism cannot be put together so far away, nearer by.
                let nearer = |fault| at(0.1 * size).or_else(|_| at(0.01 * size)).map_err(|_| fault);
                let found = at(size).or_else(nearer);
                found.map_err(|fault| stopped(&self.0, &fault))
            }

            fn derived(
                &self,
                method: Method,
                scalar: Precision,
                integration: Integration,
            ) -> Result<Formulated, StudyError> {
                let derived = Formulated::of(method, self.0.mechanism(), scalar, integration);
                derived.map_err(|fault| stopped(&self.0, &fault))
            }

            fn operations(&self, setting: &Setting) -> Option<usize> {
                operations::<P, $joints>(setting)
            }

            fn observe(&self, setting: &Setting, start: &Start) -> Result<Observation, StudyError> {
                let observe = Observe { problem: &self.0, setting, start };
                with_formulation::<$joints, P, _>(&self.0, observe, setting)
            }

            fn contestant(&self, setting: &Setting, start: &Start) -> Result<Contestant<'_>, StudyError> {
                let time = Time { problem: &self.0, setting: *setting, start };
                with_formulation::<$joints, P, _>(&self.0, time, setting)
            }
        }
    )*};
}

subject! {
    [InBoth] Both => WithJoints;
    [Problem] BodiesAlone => WithoutJoints;
}

pub(super) fn stopped<P: Problem>(problem: &P, reason: &dyn std::fmt::Display) -> StudyError {
    StudyError::Run {
        name: problem.name().into(),
        reason: reason.to_string(),
    }
}

fn facts<P: Problem, J: JointsOf<P>>(problem: &P) -> Facts {
    Facts {
        name: problem.name().into(),
        title: problem.title(),
        span: problem.span(),
        time_scale: problem.time_scale(),
        quantity: problem.quantity(),
        equations: P::Mechanism::REPORT.equations,
        closing: J::CLOSING,
    }
}

fn operations<P: Problem, J: JointsOf<P>>(setting: &Setting) -> Option<usize> {
    if setting.treatment != Treatment::None {
        return None;
    }
    let method = setting.formulation.method();
    let kernels = match setting.coordinates {
        Coordinates::Bodies => P::Mechanism::REPORT.kernels,
        Coordinates::Joints => J::KERNELS,
    };
    let stage = format!("rates {}", method.key());
    let stage = kernels.iter().find(|kernel| kernel.name == stage);
    let operations = stage.map(|kernel| kernel.operations);
    let operations = operations.or_else(|| reported(kernels, method));
    operations.map(|operations| operations.total())
}

fn flat<M: Mechanism>(state: &M::State<f64>) -> Start {
    let (q, u) = (state.coordinates(), state.velocities());
    Start(q.as_slice().iter().chain(u.as_slice()).copied().collect())
}

pub(super) fn state<S: Real, M: Mechanism>(start: &Start) -> M::State<S> {
    let mut state = M::State::<S>::from_parts(
        holonom::state::Array::zeros(),
        holonom::state::Array::zeros(),
    );
    let mut numbers = start.0.iter();
    for place in state.coordinates_mut().as_mut_slice() {
        *place = S::constant(numbers.next().copied().unwrap_or(f64::NAN));
    }
    for place in state.velocities_mut().as_mut_slice() {
        *place = S::constant(numbers.next().copied().unwrap_or(f64::NAN));
    }
    state
}

fn start_near<P: Problem>(problem: &P, size: f64, number: u64) -> Result<Start, Fault> {
    /// Of what the motion to come may reach: where the mechanism starts in the origin there is no
    /// other length.
    const PART: f64 = 0.01;
    // SplitMix64 (Steele, Lea and Flood 2014).
    let mut random = number;
    let mut next = || {
        random = random.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (random ^ (random >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mechanism = problem.mechanism();
    let bodies = P::Mechanism::REPORT.bodies;
    let is_rigid = |body: &&BodyInfo| body.kind == BodyKind::Rigid;
    let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let linear = |u: &[f64]| {
        let sizes = bodies.iter().map(|body| largest(&u[body.velocity..][..3]));
        sizes.fold(0.0, f64::max)
    };
    let (time, scale) = (problem.span().start, problem.time_scale());
    let mut state = problem.start()?;

    let (q, u) = (
        state.coordinates().as_slice(),
        state.velocities().as_slice(),
    );
    let places = bodies
        .iter()
        .map(|body| largest(&q[body.coordinate..][..3]));
    let spins = bodies.iter().filter(is_rigid);
    let spins = spins.map(|body| largest(&u[body.velocity + 3..][..3]));
    let (length, speed) = (places.fold(0.0, f64::max), linear(u));
    let spin = spins.fold(1.0 / scale, f64::max);
    let formulation = AugmentedLagrangian::of(mechanism);
    let dynamics =
        formulation.and_then(|formulation| Dynamics::<f64, _, _>::new(mechanism, formulation));
    let evaluation = dynamics.and_then(|dynamics| dynamics.evaluate(time, &state));
    let gained = evaluation.map_or(0.0, |(evaluation, _)| {
        linear(evaluation.rates.velocities().as_slice())
    });
    let length = length.max(PART * scale * (speed + scale * gained));
    let length = if length > 0.0 { length } else { 1.0 };
    let speed = speed.max(length / scale);

    let mut move_by = |numbers: &mut [f64], most: f64| {
        numbers.iter_mut().for_each(|x| *x += size * most * next());
    };
    for body in bodies {
        let q = &mut state.coordinates_mut().as_mut_slice()[body.coordinate..];
        move_by(&mut q[..3], length);
        if is_rigid(&body) {
            move_by(&mut q[3..7], 0.5);
        }
        let u = &mut state.velocities_mut().as_mut_slice()[body.velocity..];
        move_by(&mut u[..3], speed);
        if is_rigid(&body) {
            move_by(&mut u[3..6], spin);
        }
    }
    let constants = P::Mechanism::prepare(&mechanism.parameters()?);
    Projection::default().correct::<P::Mechanism>(&constants, time, &mut state)?;
    Ok(flat::<P::Mechanism>(&state))
}
