//! Rates on the way through a singular configuration, by formulations without a compliance:
//! `docs/decisions/034-straight-on.md`.

use super::evaluate::Parts;
use super::{Dynamics, Evaluator, Solvable, VANISHED, vanishes};
use crate::constraints::rows::{Speeds, compliances_at};
use crate::error::{Fault, StepFault};
use crate::formulation::{Formulation, StraightOn};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::{Coordinates, Equations};
use crate::mechanism::kernels::{Mechanism, Terms};
use crate::mechanism::orientations::with_unit_orientations;
use crate::state::vector::{Array, MovingState, Vector as _};

/// A relative pivot, as the square of a distance, from which on equations are nearly dependent. The
/// compliance that is added there leaves no trace at this pivot, so that nothing jumps.
const NEAR: f64 = 1e-5;

/// The same as a distance.
const NEAR_LINEAR: f64 = 3e-3;

/// How far ahead a pivot is looked at, in radians or parts of the extent of the mechanism.
const FURTHER: f64 = 1e-2;

/// The same from the end of a step.
const AROUND: f64 = 0.1;

/// How many times larger a pivot is there on the way through a singular configuration.
const GROWN: f64 = 3.0;

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A, Coordinates = C>,
{
    /// Whether joints are closed on the way through a singular configuration: in runs, whose
    /// equations have pivots.
    pub(crate) const CLOSES: bool = A::OF_RUN
        && C::HAS_PIVOTS
        && (!M::REPORT.keeps_redundant() || C::IS_RELATIVE && !F::Terms::COMPLIANT);

    /// Whether it goes straight on through one without a compliance of its own. A stepper stops,
    /// since the code for this is as long as that of an evaluation.
    pub(super) const GOES_ON: bool = Self::CLOSES && !F::Terms::COMPLIANT;

    /// The relative pivot of an evaluation that is near to none.
    const NEAR: f64 = if C::HAS_LINEAR_PIVOTS {
        NEAR_LINEAR
    } else {
        NEAR
    };

    /// Whether a relative pivot of an evaluation is near to none; where nothing goes straight on,
    /// whether it vanishes.
    #[inline(always)]
    pub(super) fn is_near(&self, pivot: S) -> bool {
        if Self::GOES_ON {
            pivot < self.near
        } else {
            vanishes::<S, F::Terms>(pivot)
        }
    }

    /// Asks again from all pivots that are near to none.
    #[inline]
    pub(crate) fn be_near(&mut self) {
        if Self::GOES_ON {
            self.near = S::constant(Self::NEAR);
        }
    }

    /// Begins a run. Where it controls its steps, all pivots that are near to none are asked about.
    pub(crate) fn begin_near(&mut self, is_controlled: bool) {
        if is_controlled {
            self.be_near();
        }
    }

    /// The rates at a state near to a singular configuration that the motion passes; `None` where
    /// it stays there, and where no rates go straight on.
    ///
    /// Of a mechanism that stays there it is asked again where the pivot has halved.
    #[cold]
    #[inline(never)]
    pub(super) fn straight_on(
        &mut self,
        time: S,
        state: C::State<S>,
        pivot: S,
    ) -> Option<C::State<S>> {
        let bodies = self.bodies_as_read(&state);
        let squared = Self::squared(pivot);
        if self.grows(time, (&state, &bodies), (squared, S::constant(FURTHER))) {
            self.be_near();
            return self.yielding(time, (&state, &bodies));
        }
        self.near = (S::constant(0.5) * pivot).max(S::constant(VANISHED) * S::EPSILON);
        None
    }

    /// The rates with a compliance where equations nearly depend on each other.
    #[inline(never)]
    fn yielding(
        &self,
        time: S,
        (state, bodies): (&C::State<S>, &M::State<S>),
    ) -> Option<C::State<S>> {
        let formulation = StraightOn::of(&self.stabilisation);
        let constants = &self.absolute.constants;
        let stabilisation = formulation.coefficients();
        let part = stabilisation.compliance;
        let compliances = compliances_at::<S, M>(constants, time, bodies, part);
        let absolute = Equations {
            constants: *constants,
            coefficients: M::coefficients_by_row(constants, stabilisation, &compliances),
            compliances,
        };
        let own = C::own(&self.parameters, stabilisation, &absolute);
        let evaluator = Evaluator::<S, M, StraightOn<S>, A, C> {
            equations: C::equations(&absolute, &own),
            absolute: &absolute,
            stabilisation,
            formulation: &formulation,
            forces: &self.forces,
        };
        let mut rates = C::State::zeros();
        let parts = evaluator.in_parts(time, state, &mut rates, &mut Array::zeros());
        (parts.is_ok() && rates.is_finite()).then_some(rates)
    }

    /// The pivot at the end of a step, as the square of a distance, without a compliance; with one,
    /// only if it `is_asked`, because that takes an evaluation.
    #[inline]
    pub(crate) fn pivot_at_end(
        &mut self,
        time: S,
        state: &C::State<S>,
        is_asked: bool,
    ) -> Option<S> {
        if !F::Terms::COMPLIANT {
            return self.pivot_seen();
        }
        let bodies = || C::bodies(self.own_constants(), state);
        self.rigid = is_asked.then(|| self.rigid_pivot(time, &bodies()).relative);
        self.rigid
    }

    /// Whether the motion passes a singular configuration near to a state with this pivot.
    #[cold]
    #[inline(never)]
    pub(crate) fn is_crossing(&self, time: S, state: C::State<S>, pivot: S) -> bool {
        let (around, bodies) = (S::constant(AROUND), self.bodies_as_read(&state));
        let grows = |way| self.grows(time, (&state, &bodies), (pivot, way));
        grows(around) || grows(-around)
    }

    /// Whether a pivot is larger a short way further along the motion, or back.
    fn grows(
        &self,
        time: S,
        (state, bodies): (&C::State<S>, &M::State<S>),
        (pivot, way): (S, S),
    ) -> bool {
        let constants = &self.absolute.constants;
        let duration = Speeds::at::<M>(constants, bodies).time_for(way);
        let Some(duration) = duration.filter(|duration| duration.is_finite()) else {
            return false;
        };
        let own = self.own_constants();
        let mut velocities = C::Velocities::<S>::zeros();
        let places = velocities.as_mut_slice().iter_mut();
        places
            .zip(state.rates_slice())
            .for_each(|(place, &velocity)| *place = velocity);
        let way = C::way(own, time, state, &velocities);
        let mut further = state.plus([(duration, &way)]);
        C::normalise(&self.absolute, own, &mut further, None);
        let there = self.pivot_at(time, &further).relative;
        // Pivots that are round-off everywhere tell of equations that follow from others.
        there > S::constant(GROWN) * pivot.max(S::constant(VANISHED) * S::EPSILON)
    }

    /// The bodies of a state, with Euler parameters as kernels read them.
    fn bodies_as_read(&self, state: &C::State<S>) -> M::State<S> {
        C::with_bodies(self.own_constants(), state, with_unit_orientations::<S, M>)
    }

    /// What becomes of an evaluation in parts that may be near to a singular configuration.
    #[cold]
    #[inline(never)]
    pub(super) fn stage_nearby(
        &mut self,
        parts: Result<Parts<S>, Fault>,
        (time, state): (S, &C::State<S>),
        rates: &mut C::State<S>,
    ) -> Result<(), Fault> {
        let pivot = match &parts {
            Ok(parts) => parts.pivot.relative,
            Err(Fault::Step(StepFault::StateNotFinite)) => {
                let pivot = self.evaluator().solved_again(time, state, rates);
                pivot.relative
            }
            Err(_) => return parts.map(drop),
        };
        if self.is_near(pivot)
            && let Some(straight_on) = self.straight_on(time, *state, pivot)
        {
            *rates = straight_on;
            self.look(pivot);
            return Ok(());
        }
        let parts = parts?;
        self.count(&parts);
        self.look(pivot);
        Ok(())
    }

    /// Whether the last evaluation was near to a singular configuration.
    pub(super) fn was_near(&self) -> bool {
        Self::GOES_ON && self.seen.pivot < S::constant(NEAR)
    }
}
