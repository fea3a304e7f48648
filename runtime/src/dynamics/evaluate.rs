//! An evaluation of the equations of motion, in one straight line or from its parts.

use core::marker::PhantomData;

use super::{Dynamics, Solvable};
use crate::error::{Fault, StepFault};
use crate::formulation::{Formulation, Saddle, Solution};
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, Loads};
use crate::measure::view::View;
use crate::mechanism::coordinates::{
    Absolute, AbsoluteEquations, Coordinates, EquationsIn, Evaluation, First, Prepared,
};
use crate::mechanism::kernels::{Mechanism, Pivot, Stabilisation, Terms, have_equations};
use crate::mechanism::limits::Several;
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::status::{Show, Tracked};
use crate::nonsmooth::task::{Task, perform};
use crate::state::vector::{Array, MovingState, StateParts};

/// The equations of motion in some coordinates, with a formulation and forces of a closure.
pub(crate) struct Evaluator<'d, S: Real, M: Mechanism, F, A, C: Coordinates<M>> {
    pub(super) equations: &'d EquationsIn<S, M, C>,
    /// The same in absolute coordinates.
    pub(super) absolute: &'d AbsoluteEquations<S, M>,
    pub(super) stabilisation: &'d Stabilisation<S>,
    pub(super) formulation: &'d F,
    pub(super) forces: &'d A,
}

/// What an evaluation from its parts tells besides rates and multipliers.
pub(super) struct Parts<S> {
    pub(super) pivot: Pivot<S>,
    pub(super) iterations: usize,
    /// Whether the iteration was ended before its tolerance.
    pub(super) unconverged: bool,
    /// The power (W) of the forces of a closure.
    pub(super) applied_power: S,
}

impl<S, M, F, A, C> Evaluator<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Whether an evaluation is done in its parts: applied forces enter there, and a formulation
    /// may iterate.
    pub(super) const IN_PARTS: bool = A::PRESENT || F::ITERATED;

    /// See [`Dynamics::evaluate_into`].
    #[inline(always)]
    pub(super) fn evaluate_into(
        &self,
        time: S,
        state: &C::State<S>,
        evaluation: &mut Evaluation<S, M, C>,
    ) -> Result<usize, Fault> {
        let Evaluation {
            rates,
            multipliers,
            pivot,
        } = evaluation;
        let mut iterations = 1;
        if Self::IN_PARTS {
            match self.in_parts(time, state, rates, multipliers) {
                Ok(parts) => (*pivot, iterations) = (parts.pivot, parts.iterations),
                Err(Fault::Step(StepFault::StateNotFinite)) => return Err(self.fault(time, state)),
                Err(fault) => return Err(fault),
            }
        } else {
            *pivot = self.straight(time, state, rates, multipliers);
        }
        if sound::<S, C::State<S>, F::Terms>(rates, pivot) {
            Ok(iterations)
        } else {
            Err(self.fault(time, state))
        }
    }

    /// The evaluation in one straight line.
    #[inline(always)]
    pub(super) fn straight(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
    ) -> Pivot<S> {
        C::evaluate_into::<S, F::Terms>(
            &self.equations.constants,
            &self.equations.coefficients,
            time,
            state,
            rates,
            multipliers,
        )
    }

    /// The same for a step, which may leave multipliers as they are.
    #[inline(always)]
    pub(super) fn slope(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
    ) -> Pivot<S> {
        C::rates_into::<S, F::Terms>(
            &self.equations.constants,
            &self.equations.coefficients,
            time,
            state,
            rates,
            multipliers,
        )
    }

    /// Calls with the first solution from parts; the power (W) of the closure's forces beside it.
    #[inline(always)]
    pub(super) fn begin<R>(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        then: impl FnOnce(&First<'_, S, M, C>, &mut C::State<S>) -> R,
    ) -> (R, S) {
        let constants = &self.equations.constants;
        let Stabilisation { rate, position, .. } = *self.stabilisation;
        let prepared = Prepared {
            constants,
            coefficients: &self.equations.coefficients,
            gains: [rate, position],
        };
        let mut power = S::zero();
        let law = |read: &C::State<S>, forces: &mut M::Velocities<S>| {
            C::with_bodies(constants, read, |bodies| {
                let described = *forces;
                let view = View::new(&self.absolute.constants, time, bodies);
                self.forces
                    .apply(time, bodies, &mut Loads::new(view, forces));
                let velocities = bodies.velocities().as_slice();
                let loads = forces.as_slice().iter().zip(described.as_slice());
                for ((&whole, &own), &u) in loads.zip(velocities) {
                    power = (whole - own).fused(u, power);
                }
            });
        };
        let law = A::PRESENT.then_some(law);
        let result = C::begin::<S, F::Terms, R>(prepared, time, state, rates, law, then);
        (result, power)
    }

    /// The evaluation from its parts: applied forces enter, and a formulation may iterate.
    ///
    /// # Errors
    /// [`StepFault::StateNotFinite`] where a pivot vanishes or something is not finite:
    /// [`Evaluator::fault`] says what, once this has given its stack back.
    pub(super) fn in_parts(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
    ) -> Result<Parts<S>, Fault> {
        self.parts(time, state, rates, multipliers, None)
    }

    /// The same; shows what interactions exert where that is wanted.
    pub(super) fn parts(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
        show: Option<&mut Show<'_, S>>,
    ) -> Result<Parts<S>, Fault> {
        let (parts, applied_power) = self.begin(time, state, rates, |first, rates| {
            self.finish((time, state), first, rates, multipliers, show)
        });
        let parts = parts?;
        Ok(Parts {
            applied_power,
            ..parts
        })
    }

    /// Calls with the factorised equations, and with the solution that the forces of the
    /// description and of closures give.
    pub(super) fn set_up(
        &self,
        time: S,
        state: &C::State<S>,
        then: impl FnOnce(&Setting<'_, S, M, F, C>, &Solution<S, M, C>) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let mut place = C::State::zeros();
        let (result, _) = self.begin(time, state, &mut place, |first, rates| {
            let mut solution = begun::<S, M, F, C>(first)?;
            let saddle = self.refined((time, state), first, rates, &mut solution)?;
            then(&self.setting(saddle, rates), &solution)
        });
        match result {
            Err(Fault::Step(StepFault::StateNotFinite)) => Err(self.fault(time, state)),
            result => result,
        }
    }

    /// What follows a first solution: the formulation's own, efforts of interactions, rates and
    /// multipliers.
    #[inline(always)]
    fn finish(
        &self,
        (time, state): (S, &C::State<S>),
        first: &First<'_, S, M, C>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
        show: Option<&mut Show<'_, S>>,
    ) -> Result<Parts<S>, Fault> {
        let mut solution = begun::<S, M, F, C>(first)?;
        let saddle = self.refined((time, state), first, rates, &mut solution)?;
        if A::INTERACTS {
            let completed = self.complete(&self.setting(saddle, rates), &mut solution, show);
            completed.map_err(explained_later)?;
        }
        let constants = &self.equations.constants;
        C::finish(constants, time, state, rates, &solution.accelerations);
        *multipliers = solution.multipliers;
        Ok(Parts {
            pivot: first.pivot,
            iterations: solution.iterations,
            unconverged: solution.unconverged,
            applied_power: S::zero(),
        })
    }

    /// Goes on from a first solution to that of the formulation; the system that it solves.
    #[inline(always)]
    fn refined<'s>(
        &'s self,
        (time, state): (S, &'s C::State<S>),
        first: &First<'s, S, M, C>,
        rates: &'s C::State<S>,
        solution: &mut Solution<S, M, C>,
    ) -> Result<Saddle<'s, S, M, C, F::Terms>, Fault> {
        let saddle = Saddle::<S, M, C, F::Terms> {
            constants: &self.equations.constants,
            absolute: &self.absolute.constants,
            coefficients: &self.equations.coefficients,
            compliances: &self.equations.compliances,
            factors: first.factors,
            right: first.right,
            time,
            state: C::as_read(state, rates),
            terms: PhantomData,
        };
        let refined = self.formulation.refine(&saddle, solution);
        refined.map_err(explained_later)?;
        Ok(saddle)
    }

    /// What interactions ask for.
    fn setting<'s>(
        &'s self,
        saddle: Saddle<'s, S, M, C, F::Terms>,
        rates: &'s C::State<S>,
    ) -> Setting<'s, S, M, F, C> {
        Setting {
            saddle,
            rates,
            absolute: self.absolute,
            formulation: self.formulation,
        }
    }

    /// Completes a solution by the efforts of interactions, with the reactions of joints where
    /// these are asked for.
    fn complete(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        solution: &mut Solution<S, M, C>,
        show: Option<&mut Show<'_, S>>,
    ) -> Result<(), Fault> {
        let mut list = self.forces.interactions().iter();
        if C::IS_RELATIVE && list.any(|tracked| tracked.asks_for_load(show.is_some())) {
            self.with_reactions(setting, |reactions| {
                let reactions = Some(reactions);
                self.forces.complete(setting, reactions, solution, show)
            })
        } else {
            self.forces.complete(setting, None, solution, show)
        }
    }

    /// Changes interactions between two steps, with the reactions of joints where these are asked
    /// for.
    pub(super) fn interact<L: Several<Tracked<S, M>>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        list: &mut L,
        task: Task<'_, S, M, C>,
    ) -> Result<(), Fault> {
        if A::SCALES {
            setting.here(|scene| {
                let view = View::new(scene.constants, scene.time, scene.bodies);
                self.forces.scale_now(&view, list.as_mut())
            })?;
        }
        if C::IS_RELATIVE && task.asks_for_loads(list.as_ref()) {
            self.with_reactions(setting, |reactions| {
                perform(setting, Some(reactions), list, task)
            })
        } else {
            perform(setting, None, list, task)
        }
    }

    /// Calls with the equations in absolute coordinates, too: joints of a tree have no multipliers
    /// in relative ones.
    #[inline(never)]
    fn with_reactions(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        then: impl FnOnce(Reactions<'_, S, M, F>) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        have_equations::<M>()?;
        let of_bodies = Evaluator::<S, M, F, A, Absolute> {
            equations: self.absolute,
            absolute: self.absolute,
            stabilisation: self.stabilisation,
            formulation: self.formulation,
            forces: self.forces,
        };
        let saddle = &setting.saddle;
        C::with_bodies(saddle.constants, saddle.state, |bodies| {
            of_bodies.set_up(saddle.time, bodies, |absolute, solution| {
                then((absolute, &solution.multipliers))
            })
        })
    }

    /// Forces and moments of the closure alone on bodies whose Euler parameters have length 1.
    pub(super) fn applied(&self, time: S, bodies: &M::State<S>) -> M::Velocities<S> {
        let mut forces = M::Velocities::<S>::zeros();
        let view = View::new(&self.absolute.constants, time, bodies);
        self.forces
            .apply(time, bodies, &mut Loads::new(view, &mut forces));
        forces
    }
}

impl<S, M, F, A, P> Evaluator<'_, S, M, F, A, Absolute<P>>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    Absolute<P>: Coordinates<M, Constants<S> = M::Constants<S>>,
{
    /// Forces and moments of the description and of a closure.
    pub(super) fn all_forces(&self, time: S, bodies: &M::State<S>) -> M::Velocities<S> {
        let mut forces = M::forces(&self.equations.constants, time, bodies);
        if A::PRESENT {
            let view = View::new(&self.absolute.constants, time, bodies);
            self.forces
                .apply(time, bodies, &mut Loads::new(view, &mut forces));
        }
        forces
    }
}

/// The first solution, where no pivot vanishes.
#[inline(always)]
fn begun<S: Real, M: Mechanism, F: Formulation<S>, C: Coordinates<M>>(
    first: &First<'_, S, M, C>,
) -> Result<Solution<S, M, C>, Fault> {
    if vanishes::<S, F::Terms>(first.pivot.relative) {
        return Err(Fault::Step(StepFault::StateNotFinite));
    }
    Ok(Solution {
        accelerations: *first.accelerations,
        multipliers: *first.multipliers,
        iterations: 1,
        unconverged: false,
    })
}

/// Why rates are not finite is found once the evaluation has given its stack back.
fn explained_later(fault: Fault) -> Fault {
    match fault {
        Fault::Step(StepFault::RatesNotFinite { .. }) => Fault::Step(StepFault::StateNotFinite),
        fault => fault,
    }
}

/// The relative pivot, in `EPSILON`, below which no digit of a multiplier is left.
pub(super) const VANISHED: f64 = 64.0;

#[inline(always)]
pub(crate) fn vanishes<S: Real, T: Terms>(relative_pivot: S) -> bool {
    !T::COMPLIANT && relative_pivot < S::constant(VANISHED) * S::EPSILON
}

/// Whether the rates are finite and no pivot vanishes: below `64 EPSILON`, relative, no digit of
/// the multiplier is left.
///
/// With a compliance the system is solvable whatever the constraints are. A pivot of NaN shows in
/// the rates.
#[inline(always)]
fn sound<S: Real, X: MovingState<S>, T: Terms>(rates: &X, pivot: &Pivot<S>) -> bool {
    rates.is_finite() && !vanishes::<S, T>(pivot.relative)
}

/// [`Dynamics`] without its formulation, forces and coordinates in the type.
pub(crate) trait Evaluate<S: Real, M: Mechanism> {
    /// See [`Dynamics::constants`].
    fn constants(&self) -> &M::Constants<S>;

    fn evaluation(&self, time: S, bodies: &M::State<S>) -> Result<Evaluation<S, M>, Fault>;

    /// The interactions, with their statuses.
    fn interactions(&self) -> &[Tracked<S, M>];

    /// Whether functions scale their capacities.
    fn scales_capacities(&self) -> bool;

    /// The same, to be changed.
    fn interactions_mut(&mut self) -> &mut [Tracked<S, M>];

    /// Shows what all interactions exert.
    fn find_efforts(
        &self,
        time: S,
        bodies: &M::State<S>,
        show: &mut Show<'_, S>,
    ) -> Result<(), Fault>;

    /// Leaves it in their statuses.
    fn keep_efforts(&mut self, time: S, bodies: &M::State<S>) -> Result<(), Fault>;
}

impl<P, S: Real, M: Mechanism> Evaluate<S, M> for Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M>,
{
    fn constants(&self) -> &M::Constants<S> {
        Self::constants(self)
    }

    #[inline(never)]
    fn evaluation(&self, time: S, bodies: &M::State<S>) -> Result<Evaluation<S, M>, Fault> {
        self.evaluate_bodies(time, bodies)
    }

    fn interactions(&self) -> &[Tracked<S, M>] {
        self.forces.interactions()
    }

    fn scales_capacities(&self) -> bool {
        P::Forces::SCALES
    }

    fn interactions_mut(&mut self) -> &mut [Tracked<S, M>] {
        self.tracked_mut()
    }

    #[inline(never)]
    fn find_efforts(
        &self,
        time: S,
        bodies: &M::State<S>,
        show: &mut Show<'_, S>,
    ) -> Result<(), Fault> {
        self.efforts(time, &self.nearest(bodies), show)
    }

    #[inline(never)]
    fn keep_efforts(&mut self, time: S, bodies: &M::State<S>) -> Result<(), Fault> {
        let state = self.nearest(bodies);
        Self::keep_efforts(self, time, &state)
    }
}
