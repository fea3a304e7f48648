//! A mechanism in both descriptions, all formulations and both number types, as candidates of a
//! race.

use std::cell::RefCell;
use std::hint::black_box;
use std::rc::Rc;
use std::time::Instant;

use holonom::{
    AugmentedLagrangian, Baumgarte, Fault, Formulation, JointCoordinates, Mechanism, Penalty, Real,
    Rk4, Scalar as _, StandardLagrange, StateParts as _,
    dynamics::{Dynamics, Problem},
    integrate::{OneStep as _, System},
    mechanism::{Absolute, Coordinates as Kernels, Evaluation, Kernel, Operations, Relative},
    state::{Array as _, Vector as _},
};

use super::{Coordinates, Precision};
use crate::chapter15::Method;
use crate::counted::{Counted, counted};
use crate::error::StudyError;
use crate::timing::Candidate;

/// The most states that are evaluated in turn.
const STATES: usize = 64;
/// What these may take (bytes), so that they stay near the processor.
const MEMORY: usize = 1 << 14;
/// How long a candidate works between two looks at the clock (s).
const UNINTERRUPTED: f64 = 2e-5;

/// A right-hand side as it is called through the public interface, and what runs below it. Times
/// are taken at time zero.
pub trait Subject<S: Real> {
    /// What integrators move.
    type System: System<S>;
    /// What an evaluation computes: rates and multipliers.
    type Evaluation;

    /// Whether one kernel is the whole right-hand side.
    const IS_ONE_KERNEL: bool = true;

    /// The system.
    fn system(&mut self) -> &mut Self::System;

    /// A place for an evaluation.
    fn place(&self) -> Self::Evaluation;

    /// The evaluation that users call.
    ///
    /// # Errors
    /// Those of the evaluation.
    fn evaluate(&self, state: &StateOf<S, Self>, place: &mut Self::Evaluation)
    -> Result<(), Fault>;

    /// The rates of an evaluation.
    fn rates(evaluation: &Self::Evaluation) -> &StateOf<S, Self>;

    /// The kernel alone.
    fn kernel(&mut self, state: &StateOf<S, Self>, rates: &mut StateOf<S, Self>);
}

/// The state of a subject.
pub type StateOf<S, Y> = <<Y as Subject<S>>::System as System<S>>::State;

/// A mechanism in some coordinates.
struct Solved<S: Real, M: Mechanism, F: Formulation<S>, C: Kernels<M>> {
    dynamics: Dynamics<Problem<M, F, S, C>>,
    multipliers: C::Multipliers<S>,
}

impl<S: Real, M: Mechanism + Default, F: Formulation<S>, C: Kernels<M>> Solved<S, M, F, C> {
    fn new(formulation: F) -> Result<Self, Fault> {
        Ok(Self {
            dynamics: Dynamics::new(&M::default(), formulation)?.coordinates(),
            multipliers: holonom::state::Array::zeros(),
        })
    }
}

impl<S: Real, M: Mechanism, F: Formulation<S>, C: Kernels<M>> Subject<S> for Solved<S, M, F, C> {
    type System = Dynamics<Problem<M, F, S, C>>;
    type Evaluation = Evaluation<S, M, C>;

    const IS_ONE_KERNEL: bool = !F::ITERATED;

    #[inline(always)]
    fn system(&mut self) -> &mut Self::System {
        &mut self.dynamics
    }

    fn place(&self) -> Self::Evaluation {
        Evaluation::zeros()
    }

    #[inline(always)]
    fn evaluate(&self, state: &C::State<S>, place: &mut Self::Evaluation) -> Result<(), Fault> {
        let outcome = self.dynamics.evaluate_into(S::zero(), state, place);
        outcome.map(|_| ())
    }

    #[inline(always)]
    fn rates(evaluation: &Self::Evaluation) -> &C::State<S> {
        &evaluation.rates
    }

    #[inline(always)]
    fn kernel(&mut self, state: &C::State<S>, rates: &mut C::State<S>) {
        let multipliers = &mut self.multipliers;
        let pivot = self.dynamics.kernel(S::zero(), state, rates, multipliers);
        black_box((&pivot, &self.multipliers));
    }
}

/// One right-hand side: which it is, what it computes, and what can be timed of it.
#[derive(Debug)]
pub struct Case {
    /// The mechanism.
    pub scene: &'static str,
    /// Links of a chain or windows of a row; 1 for all others.
    pub n: usize,
    /// The description.
    pub coordinates: Coordinates,
    /// The formulation.
    pub method: Method,
    /// The numbers.
    pub precision: Precision,
    /// The operations of a whole evaluation, multipliers of the remaining equations included; their
    /// `depth` is the longest path.
    pub operations: Operations,
    /// Those of a stage of a step, which asks for no multipliers in joint coordinates.
    pub stage: Operations,
    /// What can be timed.
    pub candidates: Candidates,
}

/// What can be timed of one right-hand side.
#[derive(Debug)]
pub struct Candidates {
    /// Evaluations that do not depend on each other.
    pub throughput: Candidate<'static>,
    /// Evaluations at states that the one before has a part in.
    pub dependent: Candidate<'static>,
    /// Steps of Runge-Kutta from states that do not depend on each other.
    pub step: Candidate<'static>,
    /// The kernel alone, at states that do not depend on each other, where one kernel is the whole
    /// right-hand side.
    pub kernel: Option<Candidate<'static>>,
}

/// The cases of one mechanism.
#[derive(Debug, Default)]
pub struct Scene {
    /// What can be timed.
    pub cases: Vec<Case>,
    /// What was refused, and why.
    pub refused: Vec<Refused>,
    /// The states that bodies are timed at, in `f64`: all coordinates, then all velocities.
    pub states: Vec<Vec<f64>>,
    /// Their rates with standard multipliers.
    pub rates: Vec<Vec<f64>>,
}

/// A case that cannot be timed.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The mechanism.
    pub scene: &'static str,
    /// As in [`Case`].
    pub n: usize,
    /// The description.
    pub coordinates: Coordinates,
    /// The formulation.
    pub method: Method,
    /// The numbers.
    pub precision: Precision,
    /// What the run time said.
    pub fault: Fault,
}

impl Scene {
    /// All cases of a mechanism: its name and its `n` as in [`Case`], and the step (s) of
    /// Runge-Kutta, which also lies between the states.
    ///
    /// # Errors
    /// A fault of the mechanism by its bodies with standard multipliers: nothing can be said of it
    /// then.
    pub fn of<M: JointCoordinates + Default>(
        name: &'static str,
        n: usize,
        step: f64,
    ) -> Result<Self, Fault> {
        let mut dynamics =
            Dynamics::<Problem<M, _>>::new(&M::default(), StandardLagrange)?.absolute_coordinates();
        let start = M::initial_state(dynamics.constants());
        let states = states(&mut dynamics, start, step)?;
        let rates = states.iter().map(|state| dynamics.rates(0.0, state));
        let rates: Result<Vec<_>, Fault> = rates.collect();
        let mut scene = Self {
            rates: rates?.iter().map(flat::<M>).collect(),
            states: states.iter().map(flat::<M>).collect(),
            ..Self::default()
        };
        scene.formulations::<f64, M>((name, n, Precision::Double), step);
        scene.formulations::<f32, M>((name, n, Precision::Single), step);
        Ok(scene)
    }

    fn formulations<S: Real, M: JointCoordinates + Default>(
        &mut self,
        which: (&'static str, usize, Precision),
        step: f64,
    ) {
        self.both::<S, M, _>(which, Method::Standard, StandardLagrange, step);
        self.both::<S, M, _>(which, Method::Baumgarte, Baumgarte::default(), step);
        self.both::<S, M, _>(which, Method::Penalty, Penalty::default(), step);
        let iterated = AugmentedLagrangian::default();
        self.both::<S, M, _>(which, Method::AugmentedLagrangian, iterated, step);
    }

    fn both<S: Real, M: JointCoordinates + Default, F: Formulation<S> + 'static>(
        &mut self,
        which: (&'static str, usize, Precision),
        method: Method,
        formulation: F,
        step: f64,
    ) {
        let bodies = Solved::<S, M, F, Absolute>::new(formulation).and_then(|bodies| {
            let start = M::initial_state(bodies.dynamics.constants());
            let operations = match reported(M::REPORT.kernels, method) {
                Some(operations) => operations,
                None => counted_by_bodies::<M>(method, &self.states)?,
            };
            Ok(([operations; 2], candidates(bodies, start, step)?))
        });
        self.take(which, Coordinates::Bodies, method, bodies);
        let joints = Solved::<S, M, F, Relative>::new(formulation).and_then(|joints| {
            let start = joints.dynamics.initial_state()?;
            let kernels = M::JOINT_REPORT.kernels;
            let operations = match reported(kernels, method) {
                Some(operations) => operations,
                None => iterated_by_joints::<M>(&self.states)?,
            };
            let rates = format!("rates {}", method.key());
            let stage = kernels.iter().find(|kernel| kernel.name == rates);
            let stage = stage.map_or(operations, |kernel| kernel.operations);
            Ok(([operations, stage], candidates(joints, start, step)?))
        });
        self.take(which, Coordinates::Joints, method, joints);
    }

    fn take(
        &mut self,
        (scene, n, precision): (&'static str, usize, Precision),
        coordinates: Coordinates,
        method: Method,
        outcome: Result<([Operations; 2], Candidates), Fault>,
    ) {
        match outcome {
            Ok(([operations, stage], candidates)) => self.cases.push(Case {
                scene,
                n,
                coordinates,
                method,
                precision,
                operations,
                stage,
                candidates,
            }),
            Err(fault) => self.refused.push(Refused {
                scene,
                n,
                coordinates,
                method,
                precision,
                fault,
            }),
        }
    }
}

/// What a report says of the evaluation. Without equations all formulations are one.
///
/// Nothing of a formulation that iterates: the report knows the pieces only.
pub(crate) fn reported(kernels: &[Kernel], method: Method) -> Option<Operations> {
    if method == Method::AugmentedLagrangian {
        return None;
    }
    let name = format!("evaluate {}", method.key());
    let found = kernels.iter().find(|kernel| kernel.name == name);
    let only = match kernels {
        [only] => Some(only),
        _ => None,
    };
    found.or(only).map(|kernel| kernel.operations)
}

/// The operations of an evaluation that iterates, or that is put together from its parts, counted
/// at the last of some states.
fn counted_by_bodies<M: Mechanism + Default>(
    method: Method,
    states: &[Vec<f64>],
) -> Result<Operations, Fault> {
    fn of<M: Mechanism + Default, F: Formulation<Counted>>(
        formulation: F,
        states: &[Vec<f64>],
    ) -> Result<Operations, Fault> {
        let dynamics = Dynamics::<Problem<M, _, Counted>>::new(&M::default(), formulation)?
            .absolute_coordinates();
        let state = counted_state::<M>(dynamics.constants(), states);
        let (operations, outcome) =
            counted(|| dynamics.evaluate(Counted::zero(), &state).map(|_| ()));
        outcome.map(|()| operations)
    }
    match method {
        Method::Standard => of::<M, _>(StandardLagrange, states),
        Method::Baumgarte => of::<M, _>(Baumgarte::default(), states),
        Method::Penalty => of::<M, _>(Penalty::default(), states),
        Method::AugmentedLagrangian => of::<M, _>(AugmentedLagrangian::default(), states),
    }
}

/// The same in joint coordinates.
fn iterated_by_joints<M: JointCoordinates + Default>(
    states: &[Vec<f64>],
) -> Result<Operations, Fault> {
    let formulation = AugmentedLagrangian::<Counted>::default();
    let dynamics =
        Dynamics::<Problem<M, _, Counted>>::new(&M::default(), formulation)?.joint_coordinates();
    let state = counted_state::<M>(dynamics.constants(), states);
    let state = dynamics.state_of(&state)?;
    let (operations, outcome) = counted(|| dynamics.evaluate(Counted::zero(), &state).map(|_| ()));
    outcome.map(|()| operations)
}

fn counted_state<M: Mechanism>(
    constants: &M::Constants<Counted>,
    states: &[Vec<f64>],
) -> M::State<Counted> {
    let mut state = M::initial_state(constants);
    let mut values = states.last().into_iter().flatten();
    let mut fill = |elements: &mut [Counted]| {
        for (element, &value) in elements.iter_mut().zip(&mut values) {
            *element = Counted::constant(value);
        }
    };
    fill(state.coordinates_mut().as_mut_slice());
    fill(state.velocities_mut().as_mut_slice());
    state
}

/// A state as all coordinates, then all velocities.
fn flat<M: Mechanism>(state: &M::State<f64>) -> Vec<f64> {
    let parts = [
        state.coordinates().as_slice(),
        state.velocities().as_slice(),
    ];
    parts.concat()
}

/// States along a motion from a start, the start not among them: as many as a case is evaluated at.
fn states<S: Real, Y: System<S>>(
    system: &mut Y,
    mut state: Y::State,
    step: f64,
) -> Result<Vec<Y::State>, Fault> {
    let count = (MEMORY / size_of::<Y::State>()).clamp(4, STATES);
    let mut states = Vec::with_capacity(count);
    for _ in 0..count {
        advance(system, &mut state, S::constant(step))?;
        states.push(state.clone());
    }
    Ok(states)
}

/// A step of Runge-Kutta, in one place, because it is compiled for every right-hand side.
#[inline(never)]
fn advance<S: Real, Y: System<S>>(
    system: &mut Y,
    state: &mut Y::State,
    step: S,
) -> Result<(), Fault> {
    Rk4.step(system, S::zero(), state, step)
}

/// What can be timed of a right-hand side: along its motion from a start, in steps of Runge-Kutta
/// (s).
///
/// # Errors
/// A fault on this way, or of an evaluation.
pub fn candidates<S: Real, Y: Subject<S> + 'static>(
    mut subject: Y,
    start: StateOf<S, Y>,
    step: f64,
) -> Result<Candidates, Fault> {
    let states: Rc<[StateOf<S, Y>]> = states(subject.system(), start, step)?.into();
    let count = states.len() as u64;
    let step = S::constant(step);
    let subject = Rc::new(RefCell::new(subject));

    let (shared, places) = (subject.clone(), states.clone());
    let throughput = candidate(count, move || {
        let subject = shared.borrow();
        let mut evaluation = subject.place();
        for state in &*places {
            subject.evaluate(black_box(state), &mut evaluation)?;
            black_box(&evaluation);
        }
        Ok(())
    })?;

    let (shared, places) = (subject.clone(), states.clone());
    let dependent = candidate(count, move || {
        let subject = shared.borrow();
        // Nothing is added, but the next evaluation waits for this one.
        let nothing = black_box(S::zero());
        let mut last = subject.place();
        subject.evaluate(&places[0], &mut last)?;
        for state in &*places {
            let at = state.zip(Y::rates(&last), |x, rate| rate.fused(nothing, x));
            subject.evaluate(&at, &mut last)?;
        }
        black_box(&last);
        Ok(())
    })?;

    let (shared, places) = (subject.clone(), states.clone());
    let steps = candidate(count, move || {
        let mut subject = shared.borrow_mut();
        let system = subject.system();
        for state in &*places {
            let mut place = black_box(state).clone();
            advance(system, &mut place, step)?;
            black_box(&place);
        }
        Ok(())
    })?;

    let kernel = Y::IS_ONE_KERNEL.then(|| {
        let mut rates = states[0].clone();
        candidate(count, move || {
            let mut subject = subject.borrow_mut();
            for state in &*states {
                subject.kernel(black_box(state), &mut rates);
                black_box(&rates);
            }
            Ok(())
        })
    });
    Ok(Candidates {
        throughput,
        dependent,
        step: steps,
        kernel: kernel.transpose()?,
    })
}

/// Work of `count` evaluations, repeated so often that looking at the clock takes no time beside
/// it.
///
/// # Errors
/// A fault of the work, which is done twice.
pub fn candidate(
    count: u64,
    mut work: impl FnMut() -> Result<(), Fault> + 'static,
) -> Result<Candidate<'static>, Fault> {
    work()?;
    let start = Instant::now();
    work()?;
    let once = start.elapsed().as_secs_f64().max(1e-9);
    let repetitions = (UNINTERRUPTED / once).ceil().clamp(1.0, 1e4) as u64;
    Ok(Candidate::new("evaluation", move || {
        for _ in 0..repetitions {
            work().map_err(|fault| StudyError::Run {
                name: "evaluation".into(),
                reason: fault.to_string(),
            })?;
        }
        Ok(repetitions * count)
    }))
}
