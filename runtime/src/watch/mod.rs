//! The watch over a run: what tells whether its result can be trusted.
//!
//! After every step it looks at the violation of every row by position and velocity, the pivots,
//! the balance of energy and the length of the Euler parameters; at the end [`Doubts`] says what is
//! to be doubted. It costs some kernels a step: `Phi`, `Phi'`, the energies, and, for a formulation
//! with a compliance, a factorisation without it.
//!
//! `verdict.rs` makes warnings of it, with the limits of `limits.rs`.
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
//! by body (`pace.rs`), so that something far away makes nothing slow. Phase errors:
//! `docs/decisions/012-phase-of-order-2.md`. A formulation with a compliance has no pivots, so its
//! system is factorised once more per step, without the compliance.
//!
//! `passage.rs` follows pivots and gradients along assemblies and kinematic analyses.

mod doubt;
mod energy;
mod gradients;
mod lag;
mod limits;
mod pace;
mod passage;
mod rest;
mod seen;
mod singular;
mod verdict;
mod within;
mod worst;

use crate::constraints::row_units::{Meanings, characteristic_length};
pub use doubt::{Doubt, Doubts};
pub(crate) use passage::Passage;
pub(crate) use rest::Beginning;
pub(crate) use seen::Seen;
pub(crate) use within::Nearness;

use self::energy::Balance;
use self::gradients::Gradients;
use self::lag::Lag;
use self::pace::Pace;
use self::rest::Rest;
use self::singular::Approach;
use self::worst::Worst;
use crate::constraints::extent::resolution;
use crate::constraints::side::wrong;
use crate::integrate::Method;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::math::vec3::square;
use crate::mechanism::handle::JointHandle;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What the watch over a run saw: violations by joint, pivots, energy.
pub struct Watch<S: Scalar, M: Mechanism> {
    rows: Meanings<S, M>,
    pace: Pace<S, M>,
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
    /// The largest speed (m/s) and angular velocity (rad/s).
    speed: S,
    spin: S,
    /// Radians of motion: of the body that turns fastest, or moves by lengths of the mechanism.
    travel: S,
    /// What it was when a pivot was looked at last.
    looked: S,
    /// The time of the last step.
    time: S,
    /// The largest `| |p| - 1 |` of a step, and the sum of all.
    stretch: S,
    stretched: S,
    /// What an angle is off by for each of it.
    turning_error: S,
    turning_error_of_short_steps: S,
    lag: Lag<S, M>,
    /// What a phase is off by for the third power of a step (rad), of a method whose energy does
    /// not tell.
    silent_phase: S,
    /// By what part of a step velocities are ahead of coordinates.
    velocity_lead: S,
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
    /// Steps, and what was excused in them.
    excused: Excused<S>,
    /// The tolerance of a method that controls its steps: relative, absolute.
    tolerance: Option<(S, S)>,
    steps: usize,
    /// The largest acceleration that a penalty left of its constraints (m/s^2, angles by the length
    /// of the mechanism), and the largest of all.
    left: S,
    acceleration: S,
}

/// What was accepted although it did not converge, near a singular configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excused<S> {
    /// Corrections of a [`Projection`](crate::Projection), or of another
    /// [`Treatment`](crate::run::Treatment) that left more than its tolerance.
    pub corrections: usize,
    /// Evaluations of the augmented Lagrangian.
    pub evaluations: usize,
    /// The time (s) of the first.
    pub since: Option<S>,
}

/// The largest violation of a joint's equations over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<S> {
    /// Of equations between lengths (m; of their rates m/s): the distance by which the joint is
    /// open.
    pub length: S,
    /// Of equations between directions (rad; of their rates rad/s).
    pub angle: S,
    /// When it was largest (s), against lengths of the mechanism or radians.
    pub time: S,
}

/// The smallest relative pivot of a run, see [`Pivot`](crate::mechanism::Pivot).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallestPivot<S> {
    /// The pivot, met or found between two steps.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
}

/// The shortest gradient of an equation over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortestGradient<S> {
    /// Its length over its largest, by translations or by rotations, whichever is left more of; of
    /// a vector equation of all its rows, or what one has beside the others.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
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

/// A step, as the watch sees it.
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
    pub(crate) stretch: S,
    /// Whether it was mended, so that every step adds another.
    pub(crate) is_mended: bool,
}

impl<S: Real, M: Mechanism> Watch<S, M> {
    pub(crate) fn new(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        let kinetic = M::kinetic_energy(constants, state);
        let length = characteristic_length::<S, M>(constants, state);
        Self {
            rows: Meanings::at(constants, time, state),
            pace: Pace::at(constants, (time, state), length),
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
            speed: S::zero(),
            spin: S::zero(),
            travel: S::zero(),
            looked: S::zero(),
            time,
            stretch: S::zero(),
            stretched: S::zero(),
            turning_error: S::one(),
            turning_error_of_short_steps: S::zero(),
            lag: Lag::none(state),
            silent_phase: S::zero(),
            cubes: [S::zero(); 2],
            velocity_lead: S::zero(),
            longest: S::zero(),
            rate: S::zero(),
            fastest: S::zero(),
            changed: S::zero(),
            resolution: resolution::<S, M>(state),
            excused: Excused {
                corrections: 0,
                evaluations: 0,
                since: None,
            },
            tolerance: None,
            steps: 0,
            left: S::zero(),
            acceleration: S::zero(),
        }
    }

    /// The watch over a run with this method.
    pub(crate) fn over<I: Method<S>>(mut self, integrator: &I) -> Self {
        let tolerance = integrator.tolerance();
        self.tolerance = tolerance.map(|tolerance| (tolerance.relative, tolerance.absolute));
        self.turning_error = S::constant(integrator.turning_error());
        self.turning_error_of_short_steps = S::constant(integrator.turning_error_of_short_steps());
        self.silent_phase = S::constant(integrator.silent_phase());
        self.velocity_lead = S::constant(integrator.velocity_lead());
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
            stretch,
            is_mended,
        } = step;
        let factors = self.rows.factors();
        let phi = M::constraints(constants, time, state);
        self.position.take(phi.as_slice(), factors, time);
        let phi_rate = M::constraint_rates(constants, time, state);
        self.velocity.take(phi_rate.as_slice(), factors, time);
        self.motion(time, state);
        if let Some(pivot) = pivot {
            self.look_at_pivot((time, state), pivot, self.travel);
        }
        if self.gradients.are_due(self.travel) {
            let fall = self.gradients.measure(constants, (time, state));
            self.gradients.look(time, fall, self.travel);
        }
        let kinetic = M::kinetic_energy(constants, state);
        let potential = M::potential_energy(constants, time, state);
        if M::REPORT.time.potential {
            self.work_by_time(constants, time, state, potential);
        }
        self.balance.step(time, kinetic, potential, power);
        self.stretch = self.stretch.max(stretch);
        if is_mended {
            let round_off = S::constant(4.0) * S::EPSILON;
            self.stretched = self.stretched + (stretch - round_off).max(S::zero());
        }
        self.steps = self.steps.saturating_add(1);
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
    fn work_by_time(
        &mut self,
        constants: &M::Constants<S>,
        time: S,
        state: &M::State<S>,
        potential: S,
    ) {
        if let Some((then, before)) = self.before.replace((time, *state)) {
            let energy = |time, state| M::potential_energy(constants, time, state);
            let at_start = energy(time, &before) - energy(then, &before);
            self.balance
                .add([at_start, potential - energy(then, state)]);
        }
    }

    fn motion(&mut self, time: S, state: &M::State<S>) {
        let (speed, spin) = speeds::<S, M>(state);
        self.speed = self.speed.max(speed);
        self.spin = self.spin.max(spin);
        let rate = self.pace.of(state);
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
        if self.velocity_lead > S::zero() {
            self.changed = self.changed.max(self.pace.change(state));
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
        let rows = multipliers.as_slice().iter().zip(compliances.as_slice());
        let rows = rows.zip(self.rows.factors()).enumerate();
        for (row, ((&multiplier, &compliance), &factor)) in rows {
            let left = (compliance * multiplier * factor).abs();
            let length = if self.rows.is_length(row) {
                S::one()
            } else {
                self.length
            };
            self.left = self.left.max(left * length);
        }
        let elements = accelerations.as_slice();
        for body in M::REPORT.bodies {
            let linear = square(&read::<S, 3>(elements, body.velocity)).sqrt();
            self.acceleration = self.acceleration.max(linear);
            if body.kind == BodyKind::Rigid {
                let angular = square(&read::<S, 3>(elements, body.velocity + 3)).sqrt();
                self.acceleration = self.acceleration.max(angular * self.length);
            }
        }
    }

    /// What a penalty left of the accelerations, over the largest of them.
    fn bias(&self) -> S {
        if self.acceleration > S::zero() {
            self.left.quotient(self.acceleration)
        } else {
            S::zero()
        }
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
        let wrong = wrong::<S, M>(constants, state, 0);
        self.wrong = wrong.map(|joint| (joint, time));
    }

    /// Steps that were looked at.
    #[inline]
    pub(crate) fn steps(&self) -> usize {
        self.steps
    }

    /// Whether the next step is to be judged by a rule of higher order.
    pub(crate) fn judges(&self) -> bool {
        Lag::<S, M>::is_due(self.steps)
    }

    /// Takes where the next step has led to, and where a rule of higher order leads.
    pub(crate) fn judge(&mut self, ends: [&M::State<S>; 2]) {
        self.lag.take(&self.pace, ends);
    }

    /// Forces may jump here.
    pub(crate) fn restart(&mut self) {
        self.balance.restart();
    }

    /// Counts a correction that was accepted without convergence.
    pub(crate) fn excuse_correction(&mut self, time: S) {
        self.excused.corrections = self.excused.corrections.saturating_add(1);
        self.excused.since.get_or_insert(time);
    }

    /// Takes how many evaluations of the run were accepted without convergence up to a time.
    #[inline]
    pub(crate) fn excuse_evaluations(&mut self, evaluations: usize, time: S) {
        if evaluations > self.excused.evaluations {
            self.excused.evaluations = evaluations;
            self.excused.since.get_or_insert(time);
        }
    }

    /// By how much a joint was open, at the worst: over all steps, not at reporting times only.
    #[must_use]
    pub fn violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.of(&self.position, joint.index())
    }

    /// How fast the bodies of a joint moved against it, at the worst (m/s, rad/s).
    #[must_use]
    pub fn velocity_violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.of(&self.velocity, joint.index())
    }

    fn of(&self, worst: &Worst<S, M>, joint: usize) -> Violation<S> {
        match M::REPORT.joints.get(joint) {
            Some(info) => worst.of(&self.rows, info),
            None => Violation {
                length: S::zero(),
                angle: S::zero(),
                time: self.start,
            },
        }
    }

    /// The smallest relative pivot with its joint and its time; `None` without equations. Where
    /// equations are kept that depend on others it is their least eigenvalue beside zero.
    #[must_use]
    pub fn smallest_pivot(&self) -> Option<SmallestPivot<S>> {
        let nearest = self.approach.as_ref()?.least()?;
        let joint = M::REPORT.joints.get(self.joint);
        Some(SmallestPivot {
            relative: nearest.pivot,
            joint: joint.map_or("", |info| info.name),
            time: nearest.time,
        })
    }

    /// The gradient of an equation that was shortest beside its largest, with its joint and its
    /// time; `None` without equations.
    ///
    /// Where a gradient vanishes, its equation leaves open which way a motion goes on, whatever the
    /// pivots, which are compared with what an equation is without the others.
    #[must_use]
    pub fn shortest_gradient(&self) -> Option<ShortestGradient<S>> {
        let shortest = self.gradients.shortest(self.start)?;
        Some(ShortestGradient {
            relative: shortest.fall.sqrt(),
            joint: M::REPORT.joint_of(shortest.row)?,
            time: shortest.time,
        })
    }

    /// The change of energy that no force and no driver accounts for, over the energy that the
    /// mechanism exchanges; `None` where the work of forces, summed from step to step, is not known
    /// to a hundredth of that. What is not known of it is not counted.
    #[must_use]
    pub fn energy_drift(&self) -> Option<S> {
        let tells = self.balance.tells(limits::ENERGY);
        tells.then(|| self.balance.drift())
    }

    /// The change of energy (J) that no force and no driver accounts for, where it was largest, as
    /// the work of forces, summed from step to step, is known.
    #[must_use]
    pub fn unaccounted_energy(&self) -> S {
        self.balance.unaccounted()
    }

    /// The largest `| |p| - 1 |` of Euler parameters at the end of a step, before they were brought
    /// to length 1.
    #[must_use]
    pub fn orientation_drift(&self) -> S {
        self.stretch
    }

    /// What a body is off by at the worst because its coordinates lag behind (rad, or lengths of
    /// the mechanism; over what it has moved by where that is less than one), as far as single
    /// steps tell: they do not tell of a motion that takes errors apart. Estimated with methods of
    /// order 2, zero with others.
    #[must_use]
    pub fn lag(&self) -> S {
        self.lag.worst()
    }

    /// What was accepted without convergence.
    #[must_use]
    pub fn excused(&self) -> Excused<S> {
        self.excused
    }

    /// How far the mechanism moved, in radians of its fastest body.
    #[must_use]
    pub fn travel(&self) -> S {
        self.travel
    }
}

impl<S: Scalar, M: Mechanism> Clone for Watch<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Watch<S, M> {}
