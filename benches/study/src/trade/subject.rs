//! A problem without its mechanism in the type: what all the rest of the study is about.

use std::marker::PhantomData;

use holonom::{
    AugmentedLagrangian, Fault, JointCoordinates, Mechanism, Projection, StateParts,
    dynamics::{self, Dynamics},
    integrate::TimeSpan,
    mechanism::{Absolute, BodyInfo, BodyKind, Relative},
    state::Array as _,
};

use super::dispatch::{Observe, Offered, Time, with_formulation};
use super::integration::IntegratorSetting;
use super::observation::{Observation, Start, flat, stopped};
use super::problem::{Problem, Quantity};
use super::setting::{Formulated, PostStabilisation, Setting};
use crate::chapter15::Method;
use crate::compare::measure::reported;
use crate::compare::{Coordinates, Precision};
use crate::error::StudyError;
use crate::timing::Candidate;

/// What is known of a problem before anything runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Its name, see [`Problem::name`].
    pub name: String,
    /// A sentence for the reader.
    pub title: String,
    /// From when to when, and the reports (s).
    pub span: TimeSpan<f64>,
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
        let TimeSpan {
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
        integration: IntegratorSetting,
    ) -> Result<Formulated, StudyError>;

    /// Operations of a stage of a step; `None` where they depend on the state, or where states are
    /// corrected after steps.
    fn operations(&self, setting: &Setting) -> Option<usize>;

    /// One run with the monitor, read at the reporting times.
    ///
    /// # Errors
    /// [`StudyError::Run`] with what stopped it.
    fn observe(&self, setting: &Setting, start: &Start) -> Result<Observation, StudyError>;

    /// The same run bare, to be timed: without monitor and readings, its dense output at the
    /// reporting times included.
    ///
    /// # Errors
    /// [`StudyError::Run`] with why it cannot start.
    fn candidate(&self, setting: &Setting, start: &Start) -> Result<Candidate<'_>, StudyError>;
}

/// A problem in the coordinates of its mechanism: in absolute and in joint coordinates, if `C` is
/// [`Relative`], else in absolute ones alone.
#[derive(Clone, Copy, Debug)]
pub struct Posed<P, C = Relative> {
    problem: P,
    coordinates: PhantomData<C>,
}

impl<P: Problem<Mechanism: JointCoordinates>> Posed<P> {
    /// In absolute and in joint coordinates.
    pub const fn in_both(problem: P) -> Self {
        Self {
            problem,
            coordinates: PhantomData,
        }
    }
}

impl<P: Problem> Posed<P, Absolute> {
    /// In absolute coordinates alone, for a mechanism that has no others.
    pub const fn in_absolute(problem: P) -> Self {
        Self {
            problem,
            coordinates: PhantomData,
        }
    }
}

impl<P: Problem, C: Offered<P>> Subject for Posed<P, C> {
    fn facts(&self) -> Facts {
        facts::<P, C>(&self.problem)
    }

    fn reference(&self, time: f64) -> Option<Vec<f64>> {
        self.problem.reference(time)
    }

    fn difference(&self, read: &[f64], reference: &[f64]) -> f64 {
        self.problem.difference(read, reference)
    }

    fn start(&self) -> Result<Start, StudyError> {
        let named = |fault: Fault| stopped(&self.problem, &fault);
        Ok(flat::<P::Mechanism>(&self.problem.start().map_err(named)?))
    }

    fn start_near(&self, size: f64, number: u64) -> Result<Start, StudyError> {
        let at = |size| start_near(&self.problem, size, number);
        // Where a mechanism cannot be put together so far away, nearer by.
        let nearer = |fault| {
            at(0.1 * size)
                .or_else(|_| at(0.01 * size))
                .map_err(|_| fault)
        };
        let found = at(size).or_else(nearer);
        found.map_err(|fault| stopped(&self.problem, &fault))
    }

    fn derived(
        &self,
        method: Method,
        scalar: Precision,
        integration: IntegratorSetting,
    ) -> Result<Formulated, StudyError> {
        let derived = Formulated::of(method, self.problem.mechanism(), scalar, integration);
        derived.map_err(|fault| stopped(&self.problem, &fault))
    }

    fn operations(&self, setting: &Setting) -> Option<usize> {
        operations::<P, C>(setting)
    }

    fn observe(&self, setting: &Setting, start: &Start) -> Result<Observation, StudyError> {
        let observe = Observe {
            problem: &self.problem,
            setting,
            start,
        };
        with_formulation::<C, P, _>(&self.problem, observe, setting)
    }

    fn candidate(&self, setting: &Setting, start: &Start) -> Result<Candidate<'_>, StudyError> {
        let time = Time {
            problem: &self.problem,
            setting: *setting,
            start,
        };
        with_formulation::<C, P, _>(&self.problem, time, setting)
    }
}

fn facts<P: Problem, C: Offered<P>>(problem: &P) -> Facts {
    Facts {
        name: problem.name().into(),
        title: problem.title(),
        span: problem.span(),
        time_scale: problem.time_scale(),
        quantity: problem.quantity(),
        equations: P::Mechanism::REPORT.equations,
        closing: C::CLOSING,
    }
}

fn operations<P: Problem, C: Offered<P>>(setting: &Setting) -> Option<usize> {
    if setting.stabilisation != PostStabilisation::None {
        return None;
    }
    let method = setting.formulation.method();
    let kernels = match setting.coordinates {
        Coordinates::Bodies => P::Mechanism::REPORT.kernels,
        Coordinates::Joints => C::KERNELS,
    };
    let stage = format!("rates {}", method.key());
    let stage = kernels.iter().find(|kernel| kernel.name == stage);
    let operations = stage.map(|kernel| kernel.operations);
    let operations = operations.or_else(|| reported(kernels, method));
    operations.map(|operations| operations.total())
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
    let dynamics = formulation
        .and_then(|formulation| Dynamics::<dynamics::Problem<_, _>>::new(mechanism, formulation))
        .map(Dynamics::absolute_coordinates);
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
