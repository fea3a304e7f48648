//! A driven motion that is followed in steps.

use crate::assembly::assembled;
use crate::constraints::apart::{apart, counted_apart, reach};
use crate::constraints::newton::{FREE, free_share};
use crate::constraints::projection::Projection;
use crate::constraints::retract::advanced;
use crate::constraints::row_units::characteristic_length;
use crate::dynamics::{Dynamics, Problem, Solvable};
use crate::error::{AnalysisFault, Fault, StepFault};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::{Absolute, Evaluation};
use crate::mechanism::kernels::{Mechanism, Pivot, Terms};
use crate::mechanism::turns;
use crate::monitor::Passage;
use crate::state::vector::{Array, StateParts};

/// The largest turn (rad), or movement in lengths of the mechanism, of a step: velocities and
/// accelerations predict one to about a thousandth.
const TURN: f64 = 0.2;

/// The same near a singular configuration, where branches are near to each other: a step is half
/// as long as the way there, but no shorter than this.
const TURN_NEAR_SINGULAR: f64 = 0.02;

/// How far the pose of a step may be from the prediction: a part of its turn, and what a motion
/// that begins from rest may do (rad).
const OFF: [f64; 2] = [0.1, 0.01];

/// The same of its velocities, over the time of the step.
const OFF_BY_VELOCITY: [f64; 2] = [0.25, 0.02];

/// How often steps are halved below the longest: a pose that is not found from there is beyond a
/// limit of the motion.
const HALVINGS: i32 = 30;

/// A rest of the way of up to this many steps is gone in one, so that round-off leaves no sliver
/// of it; halfway between one and two.
const LAST_STEP: f64 = 1.5;

/// A pose that was found, with velocities, accelerations and multipliers.
pub(super) struct Found<S: Real, M: Mechanism> {
    pub(super) time: S,
    pub(super) state: M::State<S>,
    pub(super) accelerations: M::Velocities<S>,
    /// [`StepFault::Singular`] where the equations do not determine the motion.
    pub(super) evaluation: Result<Evaluation<S, M>, Fault>,
}

impl<S: Real, M: Mechanism> Clone for Found<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: Mechanism> Copy for Found<S, M> {}

/// The motion under way.
pub(super) struct Motion<P: Solvable> {
    pub(super) dynamics: Dynamics<P>,
    projection: Projection<P::Number>,
    pub(super) steps: usize,
    pub(super) shortened: usize,
    pub(super) iterations: usize,
    pub(super) passage: Passage<P::Number, P::Mechanism>,
    /// The length of the mechanism (m).
    length: P::Number,
    /// How long a step may be (s) as far as those before tell, and the longest so far.
    step: Option<P::Number>,
    longest: P::Number,
}

impl<M, F, S, A> Motion<Problem<M, F, S, Absolute, A>>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    A: AppliedForces<S, M>,
{
    pub(super) fn new(
        dynamics: Dynamics<Problem<M, F, S, Absolute, A>>,
        projection: Projection<S>,
        start: S,
        state: &M::State<S>,
    ) -> Self {
        let length = characteristic_length::<S, M>(dynamics.constants(), state);
        Self {
            dynamics,
            projection,
            steps: 0,
            shortened: 0,
            iterations: 0,
            passage: Passage::from(start),
            length,
            step: None,
            longest: S::zero(),
        }
    }

    /// The first pose, near a state.
    pub(super) fn begin(&mut self, time: S, near: M::State<S>) -> Result<Found<S, M>, Fault> {
        let mut state = near;
        let constants = self.dynamics.constants();
        let from = M::initial_state(constants);
        let correction = assembled::<S, M>(&self.projection, constants, time, &mut state, &from)?;
        self.iterations += correction.iterations;
        let found = self.find(time, state)?;
        self.take(&found, S::zero());
        Ok(found)
    }

    /// The pose at a time near a state, and all that follows from it.
    fn find(&mut self, time: S, near: M::State<S>) -> Result<Found<S, M>, Fault> {
        let constants = self.dynamics.constants();
        let mut state = near;
        let correction = self.projection.correct::<M>(constants, time, &mut state)?;
        let share = free_share::<S, M>(constants, time, &state);
        let determined = share < S::constant(FREE);
        if !determined {
            let share = share.to_f64();
            return Err(Fault::Analysis(AnalysisFault::MotionLeftFree { share }));
        }
        let (evaluation, _) = self.dynamics.evaluate(time, &state)?;
        self.iterations += correction.iterations;
        Ok(Found {
            time,
            state,
            accelerations: *evaluation.rates.velocities(),
            evaluation: Ok(evaluation),
        })
    }

    /// Counts a pose after so much motion (rad).
    fn take(&mut self, found: &Found<S, M>, motion: S) {
        let at = (found.time, &found.state);
        let pivot = self.pivot(found);
        self.passage
            .step(self.dynamics.constants(), at, pivot, motion);
    }

    /// The smallest pivot without a compliance; `None` where equations are kept that depend on
    /// others.
    pub(super) fn pivot(&self, found: &Found<S, M>) -> Option<Pivot<S>> {
        if M::REPORT.equations == 0 || M::REPORT.keeps_redundant() {
            None
        } else {
            match &found.evaluation {
                Ok(evaluation) if !F::Terms::COMPLIANT => Some(evaluation.pivot),
                _ => Some(self.dynamics.rigid_pivot(found.time, &found.state)),
            }
        }
    }

    /// The pose at a later time. Steps follow the motion: by how far it leads, and by how well it
    /// is predicted.
    pub(super) fn follow(
        &mut self,
        from: Found<S, M>,
        to: S,
        last_good: &mut (S, M::State<S>),
    ) -> Result<Found<S, M>, Fault> {
        let mut found = from;
        let mut has_failed = false;
        loop {
            let rest = to - found.time;
            let bound = self.bound(&found);
            let mut step = rest.min(bound);
            if let Some(last) = self.step {
                step = step.min(last);
            }
            let time = if rest <= step * S::constant(LAST_STEP) {
                to
            } else {
                found.time + step
            };
            let step = time - found.time;
            let mut stepped = self.step(&found, time);
            if let Err(fault) = &stepped
                && self.may_be_singular(fault)
                && let Some(across) = self.across(&found, time)
            {
                stepped = Ok(across);
            }
            match stepped {
                Ok((next, motion)) => {
                    if let Some(pivot) = self.pivot(&next)
                        && let Some(dip) = self.passage.dip(next.time, pivot)
                    {
                        self.look_into(&found, dip);
                    }
                    self.take(&next, motion);
                    self.steps += 1;
                    self.longest = self.longest.max(step);
                    // Where a step was too long, the next ones are no longer than this one.
                    if has_failed {
                        self.step = Some(step);
                    } else {
                        self.step = self.step.map(|last| last.max(step) * S::constant(2.0));
                    }
                    has_failed = false;
                    if time >= to {
                        return Ok(next);
                    }
                    found = next;
                    *last_good = (found.time, found.state);
                }
                Err(fault) => {
                    let least =
                        self.longest.max(step) * S::constant(2.0).powf(-f64::from(HALVINGS));
                    let least = least.max(S::constant(16.0) * found.time.ulp());
                    if step <= least || !retried(&fault) {
                        return Err(self.ended(&found, fault));
                    }
                    self.shortened += 1;
                    has_failed = true;
                    self.step = Some(step * S::constant(0.5));
                }
            }
        }
    }

    /// Whether the cause may be that the equations do not determine the motion at the end of a
    /// step.
    fn may_be_singular(&self, fault: &Fault) -> bool {
        match fault {
            Fault::Analysis(AnalysisFault::MotionLeftFree { .. })
            | Fault::Step(StepFault::Singular { .. }) => true,
            // Velocities are lost first.
            Fault::Step(StepFault::NotConverged { .. })
            | Fault::Analysis(AnalysisFault::Jump { .. }) => {
                self.passage.distance() < S::constant(TURN)
            }
            _ => false,
        }
    }

    /// How long a step may be (s) for its turn, by velocities and accelerations.
    fn bound(&self, from: &Found<S, M>) -> S {
        let near = S::constant(0.5) * self.passage.distance();
        let turn = near
            .min(S::constant(TURN))
            .max(S::constant(TURN_NEAR_SINGULAR));
        self.duration(from, turn)
    }

    /// How long (s) so much motion (rad) takes.
    pub(super) fn duration(&self, from: &Found<S, M>, turn: S) -> S {
        let speed = reach::<S, M>(from.state.velocities(), self.length).size;
        let acceleration = reach::<S, M>(&from.accelerations, self.length).size;
        // speed t + acceleration t^2 / 2 = turn.
        let root = (speed * speed + S::constant(2.0) * acceleration * turn).sqrt();
        let bound = (S::constant(2.0) * turn).quotient(speed + root);
        if bound.is_finite() {
            bound
        } else {
            S::constant(f64::INFINITY)
        }
    }

    /// The pose after a step, and how far (rad) it led.
    pub(super) fn step(&mut self, from: &Found<S, M>, time: S) -> Result<(Found<S, M>, S), Fault> {
        let constants = self.dynamics.constants();
        let step = time - from.time;
        let near = advanced::<S, M>(constants, &from.state, &from.accelerations, step);
        let mut found = self.find(time, near)?;
        turns::follow::<S, M>(
            self.dynamics.constants(),
            &from.state,
            step,
            &mut found.state,
        );
        let turn = apart::<S, M>(&from.state, &found.state, self.length).size;
        let mut off = apart::<S, M>(&near, &found.state, self.length);
        off.size = off.size.max(counted_apart::<S, M>(&near, &found.state));
        let mut change = *found.state.velocities();
        let places = change.as_mut_slice().iter_mut();
        for (change, &predicted) in places.zip(near.velocities().as_slice()) {
            *change = (*change - predicted) * step;
        }
        let change = reach::<S, M>(&change, self.length);
        for (off, [part, least]) in [(off, OFF), (change, OFF_BY_VELOCITY)] {
            let within = off.size <= turn * S::constant(part) + S::constant(least);
            if !within {
                return Err(self.jump(from, off.size, off.body));
            }
        }
        Ok((found, turn))
    }

    /// Why the motion does not go on from a pose. Equations that determined it so far and leave a
    /// motion free now depend on each other: a limit of the motion, which has a joint.
    #[cold]
    fn ended(&self, from: &Found<S, M>, fault: Fault) -> Fault {
        let pivot = self
            .pivot(from)
            .filter(|_| matches!(fault, Fault::Analysis(AnalysisFault::MotionLeftFree { .. })));
        let Some(pivot) = pivot else { return fault };
        let joint = pivot.joint.to_f64() as usize;
        let Some(info) = M::REPORT.joints.get(joint) else {
            return fault;
        };
        Fault::Step(StepFault::Singular {
            joint,
            name: info.name,
            relative_pivot: pivot.relative.to_f64(),
        })
    }

    /// No pose was found that goes on with the motion.
    #[cold]
    fn jump(&self, from: &Found<S, M>, size: S, body: usize) -> Fault {
        /// A pivot that has lost this part of its largest size.
        const NEARLY_VANISHED: f64 = 1e-4;
        let distance = self.passage.distance();
        let pivot = self.pivot(from);
        let is_singular = distance * distance < S::constant(NEARLY_VANISHED);
        let joint = pivot.filter(|_| is_singular);
        let joint = joint.and_then(|pivot| M::REPORT.joints.get(pivot.joint.to_f64() as usize));
        Fault::Analysis(AnalysisFault::Jump {
            body: M::REPORT.bodies.get(body).map_or("", |info| info.name),
            size: size.to_f64(),
            joint: joint.map(|info| info.name),
        })
    }
}

/// Whether a shorter step may help.
fn retried(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::Step(
            StepFault::NotConverged { .. } | StepFault::StateNotFinite | StepFault::Singular { .. }
        ) | Fault::Analysis(AnalysisFault::Jump { .. } | AnalysisFault::MotionLeftFree { .. })
    )
}
