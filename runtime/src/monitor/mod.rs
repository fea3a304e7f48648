//! The monitor of a run: what tells whether its result can be trusted.
//!
//! The run shows it a record of every step (`MonitoredStep`), which it hands to every indicator.
//! An indicator is a value in a file of its own, with its state, its limit and its verdict. The
//! head of the file says what it costs and what nothing else finds. `verdict.rs` lists the
//! verdicts, the gravest first; limits that several share are in `limits.rs`.
//!
//! | indicator | file | looks at |
//! |---|---|---|
//! | violation | `violations.rs` | every sixteenth step, or as often as it may decay |
//! | pivot and rank | `pivots.rs`, over `singular.rs` | every step, and within long ones |
//! | gradient | `gradients.rs`, over `singular.rs` | as often as one may vanish |
//! | energy | `energy.rs`, over `balance.rs` | power every step, energies every sixteenth |
//! | phase | `phase_error.rs` | every fourth step of a method of order 2 |
//! | orientation | `norm_drift.rs` | every step |
//! | round-off | `round_off.rs` | the start |
//! | compliance | `compliance.rs` | every sixteenth step of a penalty |
//! | unconverged | `unconverged.rs` | every step |
//! | tolerance and size | `control.rs` | every step |
//! | derivatives | `growth.rs` | every step that carries some |
//! | the user's states | `states.rs` | every step, where there are some |
//!
//! Four values judge nothing. They tell the others what counts: how far the mechanism has moved
//! (`travel.rs`), how far it went round (`turning.rs`), how long the motion remembers its errors
//! (`memory.rs`), and whether it is at rest (`rest.rs`).
//!
//! It looks at the coordinates that run: in relative ones at the joints that close loops, by the
//! pivots that the steps leave. `passage.rs` follows pivots and gradients along assemblies and
//! kinematic analyses.
//!
//! A further indicator is a field of [`Monitor`] that `Monitor::step` hands the record to, a line
//! of `verdict.rs`, and a warning of `warning.rs`. What every step has to be asked for is a field
//! of the record, which `dynamics/monitored.rs` fills. Tests: what it finds, in `tests/tests/sound`
//! or `sweeps`; right runs it is silent of, in `alarms.rs`. Costs:
//! `benches/src/bin/monitor-cost.rs`.

mod balance;
mod beginning;
mod compliance;
mod control;
mod energy;
mod events;
mod found;
mod gradients;
mod growth;
mod limits;
mod memory;
mod motion;
mod norm_drift;
mod passage;
mod phase_error;
mod pivots;
mod record;
mod rest;
mod round_off;
mod seen;
mod singular;
mod states;
mod travel;
mod turning;
mod unconverged;
mod verdict;
mod violations;
mod warning;
mod within;
#[cfg(feature = "serde")]
mod written;

pub(crate) use beginning::Beginning;
pub use gradients::ShortestGradient;
pub(crate) use motion::fastest;
pub(crate) use passage::Passage;
pub use pivots::SmallestPivot;
pub(crate) use record::{Look, MonitoredStep, Work};
pub(crate) use seen::Seen;
pub use unconverged::Unconverged;
pub use violations::Violation;
pub use warning::{Warning, Warnings};
pub(crate) use within::{Asked, Nearness};

use self::compliance::Compliance;
use self::control::Control;
use self::energy::Energy;
use self::gradients::Gradients;
use self::growth::Growth;
use self::memory::Memory;
use self::motion::{Motion, MotionMeasure};
use self::norm_drift::NormDrift;
use self::phase_error::PhaseError;
use self::pivots::Pivots;
use self::rest::{Rest, hardly};
use self::round_off::RoundOff;
use self::states::States;
use self::travel::Travel;
use self::turning::Turning;
use self::violations::Violations;
use crate::constraints::row_units::characteristic_length;
use crate::constraints::rows::Rows;
use crate::integrate::Method;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::{copied, opaque};
use crate::mechanism::kernels::Mechanism;

/// Of how many steps the violations and energies of one are taken at least. Violations that nothing
/// takes away change over many steps, and so do energies. Where a formulation takes them away, they
/// are taken as often as one may fall by `e`.
const EVERY: usize = 16;

/// How many steps at the start of a run are all looked at.
const EACH: usize = 64;

/// What the monitor of a run saw: violations by joint, pivots, energy.
pub struct Monitor<S: Scalar, M: Mechanism> {
    /// The length of the mechanism (m) at the start.
    length: S,
    measure: MotionMeasure<S, M>,
    travel: Travel<S>,
    turning: Turning<S, M>,
    memory: Memory<S, M>,
    rest: Rest<S, M>,
    violations: Violations<S, M>,
    pivots: Pivots<S, M>,
    gradients: Gradients<S, M>,
    energy: Energy<S, M>,
    phase_error: PhaseError<S, M>,
    norm_drift: NormDrift<S>,
    round_off: RoundOff<S>,
    compliance: Compliance<S>,
    unconverged: Unconverged<S>,
    control: Control<S>,
    growth: Growth<S>,
    states: States<S, M>,
    /// The rate (1/s) at which the formulation takes violations away; zero where they stay.
    decay: S,
    /// The time of the step whose violations and energies were taken last.
    looked: S,
}

opaque!([S: Scalar, M: Mechanism] Monitor<S, M>, "Monitor");

impl<S: Real, M: Mechanism> Monitor<S, M> {
    pub(crate) fn new(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let kinetic = M::kinetic_energy(constants, state);
        let length = characteristic_length::<S, M>(constants, state);
        let rows = &Rows::at(constants, time, state);
        Self {
            length,
            measure: MotionMeasure::at(rows, state, length),
            travel: Travel::from(time),
            turning: Turning::from(state),
            memory: Memory::whole(time, state, kinetic),
            rest: Rest::unknown(state),
            violations: Violations::none(time, rows),
            pivots: Pivots::none(time, state),
            gradients: Gradients::none(),
            energy: Energy::from(kinetic, M::potential_energy(constants, time, state)),
            phase_error: PhaseError::none(state),
            norm_drift: NormDrift::none(),
            round_off: RoundOff::of::<M>(state),
            compliance: Compliance::none(),
            unconverged: Unconverged::none(),
            control: Control::none(),
            growth: Growth::from(time),
            states: States::none(),
            decay: S::zero(),
            looked: time,
        }
    }

    /// The monitor of a run in coordinates in which those joints alone keep equations.
    pub(crate) fn of_joints(mut self, keeps_equations: fn(&str) -> bool) -> Self {
        self.gradients = self.gradients.of_joints(keeps_equations);
        self
    }

    /// The monitor of a run with this method.
    pub(crate) fn over<I: Method<S>>(mut self, integrator: &I) -> Self {
        let model = integrator.error_model();
        self.control = self.control.over(integrator);
        self.phase_error = self.phase_error.over(model);
        self.norm_drift = self.norm_drift.over(model);
        self.growth = self.growth.over(integrator);
        self
    }

    /// The monitor of a run by a formulation that takes violations away at this rate (1/s).
    pub(crate) fn decaying(mut self, rate: Option<S>) -> Self {
        self.decay = rate.unwrap_or(S::zero());
        self
    }

    /// How the bodies move in a state at the end of a step.
    #[inline]
    pub(crate) fn motion(&self, end: S, state: &M::State<S>) -> Motion<S> {
        self.travel.motion(&self.measure, end, state)
    }

    /// Violations and energies at the end of a step, where these are to be taken.
    #[inline]
    pub(crate) fn look_at(
        &self,
        constants: &M::Constants<S>,
        end: S,
        state: &M::State<S>,
    ) -> Option<Look<S, M>> {
        let has_decayed = (end - self.looked) * self.decay >= S::one();
        let steps = self.travel.steps;
        // What stands still may sag by what joints are open by.
        let is_due =
            steps < EACH || steps.is_multiple_of(EVERY) || has_decayed || self.rest.lasts();
        is_due.then(|| Look::at(constants, end, state))
    }

    /// Takes the end of a step, or the start of a run.
    #[inline]
    pub(crate) fn step(&mut self, step: &MonitoredStep<'_, S, M>) {
        self.control.step(step);
        self.energy.step(step);
        self.memory.step(step);
        if let Some(look) = step.look {
            self.violations.look(step.end, look);
            self.looked = step.end;
        }
        self.travel.step(step);
        self.turning.step(step.state, &step.motion);
        self.phase_error.step(&self.measure, step);
        if self.rest.lasts() {
            let hardly = self.hardly();
            self.rest.step(step, self.length, hardly);
        }
        self.pivots.step(step);
        self.gradients.step(step);
        self.norm_drift.step(step);
        self.growth.step(step, self.travel.radians);
        self.states.step(step, self.control.is_there());
    }

    /// A way (m) that says of no motion so far.
    fn hardly(&self) -> S {
        let reach = self.round_off.reach(self.length);
        let duration = self.travel.time - self.travel.start;
        let round_off = self.round_off.way(duration, reach);
        let open = self.violations.largest(self.length);
        hardly(round_off, self.control.allowed(reach), open, self.length)
    }

    /// Takes the end of the last step of a run, where it was not looked at.
    pub(crate) fn end_of_steps(
        &mut self,
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
    ) {
        if self.looked < self.travel.time && self.travel.time == time {
            let look = &Look::at(constants, time, state);
            self.violations.look(time, look);
            self.energy.look(time, look);
            self.memory.look(constants, (time, state), look, None);
            self.looked = time;
        }
    }
}

copied!([S: Scalar, M: Mechanism] Monitor<S, M>);
