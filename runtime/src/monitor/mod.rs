//! The monitor of a run: what tells whether its result can be trusted.
//!
//! The run shows it a record of every step. Every indicator is a value in a file of its own, whose
//! head says what it costs and what nothing else finds; `verdict.rs` makes warnings of them, with
//! the limits of `limits.rs`, and [`Warnings`] lists these at the end.
//!
//! | indicator | file | looks at |
//! |---|---|---|
//! | violation | `worst.rs` | every sixteenth step, or as often as it may decay |
//! | pivot and rank | `singular.rs` | every step, and within long ones |
//! | gradient | `gradients.rs` | as often as one may vanish |
//! | energy | `energy.rs` | the power in every step, energies in every sixteenth |
//! | compliance | `compliance.rs` | every sixteenth step of a penalty |
//! | memory | `memory.rs` | every sixteenth step |
//! | phase | `phase_error.rs` | every fourth step of a method of order 2 |
//! | orientation | `norm_drift.rs` | every step |
//! | rest | `rest.rs` | every step while it lasts |
//!
//! It looks at the coordinates that run: in relative ones at the joints that close loops, by the
//! pivots that the steps leave.
//!
//! Singular configurations. A step may pass over one. So three pivots around a least one are
//! judged by their parabola and by the sign of their root (`singular.rs`). The fall of a pivot
//! counts, because unequal masses make it small all along. Its joint is found at the end, from a
//! kept state. Where motion and two ends do not exclude a singular configuration, the step is
//! divided by its interpolant until no root can have changed its sign (`run/within.rs`).
//!
//! Gradients (`gradients.rs`). A pivot is compared with its own row, so it does not tell where the
//! row itself vanishes. Lengths of gradients are followed for that. Translational and rotational
//! parts must vanish together, since arms may grow; of a vector equation, what its rows span
//! counts. Such looks are not part of a run's count.
//!
//! Branches. A mechanism that is open by `d` keeps a pivot of about `2 d` where an equation
//! becomes a product of two distances, and goes on along either branch. So the limit grows with
//! the largest violation.
//!
//! Energy. The work of forces is summed by a parabola through three steps. Its difference from the
//! trapezoid counts as unknown; a smaller change of energy counts as none. Motion is measured body
//! by body (`motion.rs`), so that something far away makes nothing slow. Phase errors:
//! `docs/decisions/012-phase-of-order-2.md`. A formulation with a compliance has no pivots, so its
//! system is factorised once more per step, without the compliance.
//!
//! `passage.rs` follows pivots and gradients along assemblies and kinematic analyses.

mod compliance;
mod energy;
mod found;
mod gradients;
mod limits;
mod memory;
mod motion;
mod norm_drift;
mod passage;
mod phase_error;
mod rest;
mod seen;
mod singular;
mod verdict;
mod warning;
mod within;
mod worst;

use crate::constraints::row_units::{RowUnits, characteristic_length};
use crate::constraints::rows::Rows;
pub use found::{ShortestGradient, SmallestPivot, Unconverged, Violation};
pub(crate) use passage::Passage;
pub(crate) use rest::Beginning;
pub(crate) use seen::Seen;
pub use warning::{Warning, Warnings};
pub(crate) use within::{Asked, Nearness};

use self::compliance::Compliance;
use self::energy::Balance;
use self::gradients::Gradients;
use self::memory::Memory;
use self::motion::{Motion, MotionMeasure};
use self::norm_drift::NormDrift;
use self::phase_error::PhaseError;
use self::rest::Rest;
use self::singular::Approach;
use self::worst::Worst;
use crate::constraints::extent::resolution;
use crate::constraints::side::wrong;
use crate::integrate::{ErrorModel, Method};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::math::vec3::square;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// Of how many steps the violations and energies of one are taken at least. Violations that nothing
/// takes away change over many steps, and so do energies. Where a formulation takes them away, they
/// are taken as often as one may fall by `e`.
const EVERY: usize = 16;

/// How many steps at the start of a run are all looked at.
const EACH: usize = 4;

/// What the monitor of a run saw: violations by joint, pivots, energy.
pub struct Monitor<S: Scalar, M: Mechanism> {
    rows: RowUnits<S, M>,
    measure: MotionMeasure<S, M>,
    /// The length of the mechanism (m) at the start.
    length: S,
    start: S,
    position: Worst<S, M>,
    velocity: Worst<S, M>,
    approach: Option<Approach<S>>,
    gradients: Gradients<S, M>,
    /// The end of the step of the smallest pivot.
    nearest: (S, M::State<S>),
    /// A joint that was upside down at the end, and when.
    wrong: Option<(usize, S)>,
    /// The index of the joint of the smallest pivot, which is found at the end of a run.
    joint: usize,
    balance: Balance<S>,
    rest: Rest<S>,
    /// The end of the last step, where potentials change with time by themselves.
    before: Option<(S, M::State<S>)>,
    /// The squares of the largest speed (m^2/s^2) and angular velocity (rad^2/s^2).
    speeds: [S; 2],
    /// Radians of motion: of the body that turns fastest, or moves by lengths of the mechanism.
    travel: S,
    /// What it was when a pivot was looked at last.
    looked: S,
    /// The time of the last step, and of that whose violations and energies were taken last.
    time: S,
    taken: S,
    /// The largest `| |p| - 1 |` of a step, and the sums of all.
    largest_drift: S,
    norm_drift: NormDrift<S>,
    /// The rate (1/s) at which the formulation takes violations away; zero where they stay.
    decay: S,
    /// How the errors of the method grow.
    model: ErrorModel,
    /// The sum of the errors that the control estimated, relative to the state.
    estimated: S,
    phase_error: PhaseError<S, M>,
    memory: Memory<S, M>,
    /// The longest step (s).
    longest: S,
    /// The last rate of motion (rad/s) and the largest; sums over the steps of the third powers of
    /// what was turned (rad), and of what the rate changed by.
    rate: S,
    fastest: S,
    cubes: [S; 2],
    /// The largest change of the rate of a body (rad/s), for methods whose velocities are ahead.
    changed: S,
    /// What the digits of the positions resolve at the start (m).
    resolution: S,
    /// Steps, and what was unconverged in them.
    unconverged: Unconverged<S>,
    /// The tolerance of a method that controls its steps: relative, absolute.
    tolerance: Option<(S, S)>,
    steps: usize,
    compliance: Compliance<S>,
}

/// The largest speed (m/s) and angular velocity (rad/s) of a body.
fn speeds<S: Real, M: Mechanism>(state: &M::State<S>) -> (S, S) {
    let velocities = state.velocities().as_slice();
    let (mut speed, mut spin) = (S::zero(), S::zero());
    for body in M::REPORT.bodies {
        speed = speed.max(square(&read::<S, 3>(velocities, body.velocity)));
        if body.kind == BodyKind::Rigid {
            spin = spin.max(square(&read::<S, 3>(velocities, body.velocity + 3)));
        }
    }
    (speed.sqrt(), spin.sqrt())
}

/// How fast something turns at the most, or moves by lengths of the mechanism (rad/s).
pub(crate) fn fastest<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
) -> S {
    let (speed, spin) = speeds::<S, M>(state);
    // Lengths of the description: bodies may be anywhere by now.
    let described = M::initial_state(constants);
    spin.max(speed.quotient(characteristic_length::<S, M>(constants, &described)))
}

/// Whether a value is above a bound; NaN is above every bound.
fn exceeds<S: Real>(value: S, bound: S) -> bool {
    let within = value <= bound;
    !within
}

/// A step, as the monitor sees it.
pub(crate) struct Step<'a, S: Scalar, M: Mechanism> {
    pub(crate) constants: &'a M::Constants<S>,
    pub(crate) time: S,
    pub(crate) state: &'a M::State<S>,
    /// The power (W) of all forces without a potential, drivers included; `None` where there are
    /// none.
    pub(crate) power: Option<S>,
    /// The relative pivot at this state; `None` where it was not looked at.
    pub(crate) pivot: Option<S>,
    /// The largest `| |p| - 1 |` of a body at the end of the step.
    pub(crate) drift: S,
    /// Whether it was mended, so that every step adds another.
    pub(crate) is_mended: bool,
    /// The error of the step as its control estimated it, relative to the state.
    pub(crate) estimate: Option<S>,
}

impl<S: Real, M: Mechanism> Monitor<S, M> {
    pub(crate) fn new(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let kinetic = M::kinetic_energy(constants, state);
        let length = characteristic_length::<S, M>(constants, state);
        let rows = &Rows::at(constants, time, state);
        Self {
            rows: RowUnits::of(rows),
            measure: MotionMeasure::at(rows, state, length),
            length,
            start: time,
            position: Worst::none(time),
            velocity: Worst::none(time),
            approach: None,
            gradients: Gradients::none(),
            nearest: (time, *state),
            joint: 0,
            wrong: None,
            balance: Balance::new(kinetic, M::potential_energy(constants, time, state)),
            rest: Rest::unknown(),
            before: None,
            speeds: [S::zero(); 2],
            travel: S::zero(),
            looked: S::zero(),
            time,
            taken: time,
            largest_drift: S::zero(),
            norm_drift: NormDrift::none(),
            decay: S::zero(),
            model: ErrorModel::default(),
            estimated: S::zero(),
            phase_error: PhaseError::none(state),
            memory: Memory::whole(time, state, kinetic),
            cubes: [S::zero(); 2],
            longest: S::zero(),
            rate: S::zero(),
            fastest: S::zero(),
            changed: S::zero(),
            resolution: resolution::<S, M>(state),
            unconverged: Unconverged {
                corrections: 0,
                evaluations: 0,
                since: None,
            },
            tolerance: None,
            steps: 0,
            compliance: Compliance::none(),
        }
    }

    /// The monitor of a run in coordinates in which those joints alone keep equations.
    pub(crate) fn of_joints(mut self, keeps_equations: fn(&str) -> bool) -> Self {
        self.gradients = self.gradients.of_joints(keeps_equations);
        self
    }

    /// The largest speed (m/s) and angular velocity (rad/s).
    fn speeds(&self) -> [S; 2] {
        self.speeds.map(S::sqrt)
    }

    /// The monitor of a run with this method.
    pub(crate) fn over<I: Method<S>>(mut self, integrator: &I) -> Self {
        let tolerance = integrator.tolerance();
        self.tolerance = tolerance.map(|tolerance| (tolerance.relative, tolerance.absolute));
        self.model = integrator.error_model();
        self
    }

    /// The monitor of a run by a formulation that takes violations away at this rate (1/s).
    pub(crate) fn decaying(mut self, rate: Option<S>) -> Self {
        self.decay = rate.unwrap_or(S::zero());
        self
    }

    /// Takes the end of a step, or the start of a run.
    #[inline]
    pub(crate) fn step(&mut self, step: Step<'_, S, M>) {
        let Step {
            constants,
            time,
            state,
            power,
            pivot,
            drift,
            is_mended,
            estimate,
        } = step;
        if let Some(estimate) = estimate {
            self.estimated = self.estimated + estimate;
        }
        if let Some(power) = power {
            self.balance.add_work(time, power);
        }
        if M::REPORT.time.potential {
            self.work_by_time(constants, time, state);
        }
        let has_decayed = (time - self.taken) * self.decay >= S::one();
        // What stands still may sag by what joints are open by.
        if self.steps < EACH || self.steps.is_multiple_of(EVERY) || has_decayed || self.rests() {
            self.take(constants, time, state);
        }
        self.motion(time, state);
        if let Some(pivot) = pivot {
            self.look_at_pivot((time, state), pivot, self.travel);
        }
        if self.gradients.are_due(self.travel) {
            let fall = self.gradients.measure(constants, (time, state));
            self.gradients.look(time, fall, self.travel);
        }
        self.largest_drift = self.largest_drift.max(drift);
        if is_mended {
            self.norm_drift.add::<M>(state, drift);
        }
        self.steps = self.steps.saturating_add(1);
    }

    /// Takes violations and energies.
    #[inline(never)]
    fn take(&mut self, constants: &M::Constants<S>, time: S, state: &M::State<S>) {
        let factors = self.rows.factors();
        let phi = M::constraints(constants, time, state);
        self.position.take(phi.as_slice(), factors, time);
        let phi_rate = M::constraint_rates(constants, time, state);
        self.velocity.take(phi_rate.as_slice(), factors, time);
        let kinetic = M::kinetic_energy(constants, state);
        let potential = M::potential_energy(constants, time, state);
        self.balance.level(time, kinetic, potential);
        self.memory.take(constants, (time, state), kinetic);
        self.taken = time;
    }

    /// Looks at a relative pivot after so much motion (rad).
    fn look_at_pivot(&mut self, (time, state): (S, &M::State<S>), pivot: S, travel: S) {
        let motion = (travel - self.looked).max(S::zero());
        self.looked = travel;
        let approach = self.approach.get_or_insert_with(Approach::new);
        if approach.step(time, pivot, motion) {
            self.nearest = (time, *state);
        }
    }

    /// What a potential gains by the time alone, at either end of a step.
    fn work_by_time(&mut self, constants: &M::Constants<S>, time: S, state: &M::State<S>) {
        if let Some((then, before)) = self.before.replace((time, *state)) {
            let energy = |time, state| M::potential_energy(constants, time, state);
            let at_start = energy(time, &before) - energy(then, &before);
            let at_end = energy(time, state) - energy(then, state);
            self.balance.add([at_start, at_end]);
        }
    }

    fn motion(&mut self, time: S, state: &M::State<S>) {
        let Motion { rate, speed, spin } = self.measure.motion(state);
        let [fastest, widest] = self.speeds;
        self.speeds = [fastest.max(speed), widest.max(spin)];
        let turned = rate * (time - self.time);
        self.travel = self.travel + turned;
        let change = if self.steps > 0 {
            (rate - self.rate).abs()
        } else {
            S::zero()
        };
        for (sum, x) in self.cubes.iter_mut().zip([turned, change]) {
            *sum = (x * x).fused(x, *sum);
        }
        self.rate = rate;
        self.fastest = self.fastest.max(rate);
        if self.model.stagger > 0.0 {
            self.changed = self.changed.max(self.measure.change(state));
        }
        self.longest = self.longest.max(time - self.time);
        self.time = time;
        self.look_at_rest(state, turned);
    }

    /// With a compliance `e` accelerations satisfy `D u' - gamma* = e lambda`.
    pub(crate) fn yielded(
        &mut self,
        compliances: &M::Multipliers<S>,
        multipliers: &M::Multipliers<S>,
        accelerations: &M::Velocities<S>,
    ) {
        let rows = (&self.rows, self.length);
        self.compliance
            .take(rows, (compliances, multipliers), accelerations);
    }

    /// Time and state of the smallest pivot, or right after it; `None` where there are no pivots.
    pub(crate) fn nearest(&self) -> Option<(S, M::State<S>)> {
        self.approach.is_some().then_some(self.nearest)
    }

    /// Takes the joint of the smallest pivot.
    pub(crate) fn name(&mut self, joint: usize) {
        self.joint = joint;
    }

    /// Looks at the end of a run, on which side of its equations every joint is: none gets to
    /// another one without being wide open on the way.
    pub(crate) fn end(&mut self, constants: &M::Constants<S>, time: S, state: &M::State<S>) {
        if self.taken < self.time && self.time == time {
            self.take(constants, time, state);
        }
        let wrong = wrong::<S, M>(constants, state, 0);
        self.wrong = wrong.map(|joint| (joint, time));
    }

    /// By how much time (s) velocities at the end of a step are ahead of coordinates; `None` where
    /// they are not.
    #[inline]
    pub(crate) fn stagger(&self, end: S) -> Option<S> {
        let lead = self.model.stagger;
        (lead > 0.0).then(|| S::constant(lead) * (end - self.time))
    }

    /// Steps that were looked at.
    #[inline]
    pub(crate) fn steps(&self) -> usize {
        self.steps
    }

    /// Whether the next step is to be judged by a rule of higher order.
    pub(crate) fn judges(&self) -> bool {
        PhaseError::<S, M>::is_due(self.steps)
    }

    /// Takes where the next step has led to, and where a rule of higher order leads.
    pub(crate) fn judge(&mut self, ends: [&M::State<S>; 2]) {
        self.phase_error.take(&self.measure, ends);
    }

    /// Forces may jump here.
    pub(crate) fn restart(&mut self) {
        self.balance.restart();
    }

    /// Counts a correction that was accepted without convergence.
    pub(crate) fn accept_unconverged_correction(&mut self, time: S) {
        self.unconverged.corrections = self.unconverged.corrections.saturating_add(1);
        self.unconverged.since.get_or_insert(time);
    }

    /// Takes how many evaluations of the run were accepted without convergence up to a time.
    #[inline]
    pub(crate) fn accept_unconverged_evaluations(&mut self, evaluations: usize, time: S) {
        if evaluations > self.unconverged.evaluations {
            self.unconverged.evaluations = evaluations;
            self.unconverged.since.get_or_insert(time);
        }
    }
}

impl<S: Scalar, M: Mechanism> Clone for Monitor<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Monitor<S, M> {}
