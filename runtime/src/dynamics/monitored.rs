//! What the monitor asks for of a mechanism under way.

use super::evaluate::{Evaluate, Parts};
use super::{Dynamics, Evaluator, Solvable, vanishes};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::mechanism::at::At;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Mechanism, Orientation, Pivot, Plain, Terms};
use crate::mechanism::orientations::with_unit_orientations;
use crate::monitor::{Beginning, Monitor, MonitoredStep, Seen, Work};
use crate::state::vector::{Array, MovingState, StateParts, Vector as _};

/// Of how many steps one is evaluated again for the bias of a penalty, which changes as slowly as
/// the forces do.
const BIAS_EVERY: usize = 16;
/// Of how many steps one is factorised without its compliance: what is passed between two of them
/// is found all the same.
const PIVOT_EVERY: usize = 2;

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A, Coordinates = C>,
{
    /// Whether equations that depend on others are kept and not solved.
    const HAS_NO_RANK: bool = M::REPORT.keeps_redundant() && !F::Terms::COMPLIANT;

    /// Whether evaluations leave their pivots behind.
    const SEES_PIVOTS: bool = C::HAS_PIVOTS && !F::Terms::COMPLIANT;

    /// Whether accelerations are off by what a compliance leaves.
    const YIELDS: bool = F::Terms::COMPLIANT && !F::ITERATED;

    /// Sees the smallest relative pivot of an evaluation, as the square of a distance.
    #[inline(always)]
    pub(super) fn look(&mut self, pivot: S) {
        if const { Self::SEES_PIVOTS } {
            self.seen.pivot = Self::squared(pivot);
        }
    }

    #[inline(always)]
    pub(super) fn squared(pivot: S) -> S {
        if C::HAS_LINEAR_PIVOTS {
            pivot * pivot
        } else {
            pivot
        }
    }

    /// Counts an evaluation in parts.
    #[inline(always)]
    pub(super) fn count(&mut self, parts: &Parts<S>) {
        if F::ITERATED && parts.iterations > 1 {
            let unconverged = usize::from(parts.unconverged);
            self.iterations.unconverged = self.iterations.unconverged.saturating_add(unconverged);
            self.iterations.total = self.iterations.total.saturating_add(parts.iterations);
            self.iterations.largest = self.iterations.largest.max(parts.iterations);
        }
    }

    /// What was seen at the last evaluation.
    pub(crate) fn seen(&self) -> Seen<S> {
        self.seen
    }

    /// As if that had been the last evaluation.
    pub(crate) fn recall(&mut self, seen: Seen<S>) {
        self.seen = seen;
    }

    /// Shows the end of a step to the monitor: the bodies there, and the power of the forces, with
    /// their work where it was looked for.
    #[inline]
    pub(crate) fn monitor(
        &mut self,
        monitor: &mut Monitor<S, M>,
        At { time, bodies }: At<S, &M::State<S>>,
        estimate: Option<S>,
        (power, work): (Option<S>, Option<Work<S>>),
    ) {
        let constants = self.constants();
        let index = monitor.steps();
        let look = monitor.look_at(constants, time, bodies);
        let step = MonitoredStep {
            constants,
            start: monitor.time(),
            end: time,
            index,
            state: bodies,
            motion: monitor.motion(time, bodies),
            look: look.as_ref(),
            estimate,
            power,
            work,
            pivot: self.pivot(index, time, bodies),
            norm_drift: self.seen.drift,
            is_normalised: !C::Orientation::NORMALISED_RATES,
        };
        if Self::YIELDS && index.is_multiple_of(BIAS_EVERY) {
            self.show_bias(monitor, time, bodies);
        }
        monitor.step(&step);
    }

    /// Shows the monitor what acts at the start of a run, by two evaluations: whether anything
    /// moves, and what round-off there is.
    #[inline(never)]
    pub(crate) fn begin(&self, monitor: &mut Monitor<S, M>, time: S, state: &M::State<S>) {
        let there = self.evaluation(time, &monitor.shaken(state));
        let (Ok(here), Ok(there)) = (self.evaluation(time, state), there) else {
            return;
        };
        if Self::YIELDS {
            self.show_bias(monitor, time, state);
        }
        let bias = if F::Terms::COMPLIANT {
            self.inconsistency(time, state, &here).0
        } else {
            S::zero()
        };
        let beginning = Beginning {
            accelerations: [here.rates.velocities(), there.rates.velocities()],
            forces: &self.all_forces(time, &with_unit_orientations::<S, M>(state)),
            mass: &M::metric(self.constants()),
            bias,
        };
        monitor.begin(state, &beginning);
    }

    #[inline(never)]
    fn show_bias(&self, monitor: &mut Monitor<S, M>, time: S, state: &M::State<S>) {
        if let Ok(evaluation) = self.evaluation(time, state) {
            monitor.yielded(
                &self.absolute.compliances,
                &evaluation.multipliers,
                evaluation.rates.velocities(),
            );
        }
    }

    /// The power (W) of all forces without a potential, and of drivers; `None` where there are
    /// none, or it is not known.
    ///
    /// Where velocities are ahead of coordinates by some time (s) it is that at the coordinates and
    /// the time that they belong to, else the work of what goes with a coordinate adds up wrongly.
    #[inline]
    pub(crate) fn power_with(
        &self,
        lead: Option<S>,
        time: S,
        state: &C::State<S>,
        bodies: &M::State<S>,
    ) -> Option<S> {
        let Some(lead) = lead else {
            return self.power(time, state, bodies);
        };
        let constants = self.own_constants();
        let mut rates = C::State::zeros();
        C::with_new_velocities(constants, time, state, S::zero(), &mut rates);
        let state = state.plus([(-lead, &rates)]);
        let bodies = C::bodies_near(constants, &state, bodies);
        let bodies = with_unit_orientations::<S, M>(&bodies);
        self.power(time - lead, &state, &bodies)
    }

    #[inline]
    fn power(&self, time: S, state: &C::State<S>, bodies: &M::State<S>) -> Option<S> {
        if M::REPORT.time.constraints {
            return self.power_of_drivers(time, state, bodies);
        }
        if M::REPORT.forces.is_empty() && !A::PRESENT {
            return None;
        }
        let by_load = self.power_by_load(time, state, bodies)?;
        Some(self.power_of_forces(time, bodies) + by_load)
    }

    /// The power (W) of the forces of the description without a potential, and of a closure.
    #[inline]
    pub(crate) fn power_of_forces(&self, time: S, bodies: &M::State<S>) -> S {
        let power = M::power(self.constants(), time, bodies);
        if A::PRESENT {
            let applied = self.applied(time, &with_unit_orientations::<S, M>(bodies));
            return plus_dot(power, applied.as_slice(), bodies.velocities().as_slice());
        }
        power
    }

    /// The same with drivers, whose multipliers work against `Phi_t`: by an evaluation in its own
    /// coordinates, for the stages of a method may be anywhere in a step.
    #[inline(never)]
    fn power_of_drivers(&self, time: S, state: &C::State<S>, bodies: &M::State<S>) -> Option<S> {
        let constants = self.constants();
        let at_rest = M::State::from_parts(*bodies.coordinates(), M::Velocities::<S>::zeros());
        let mut by_time = M::constraint_rates(constants, time, &at_rest);
        let mut multipliers = Array::zeros();
        let by_load = self.power_by_load(time, state, bodies)?;
        let described = M::power(constants, time, bodies) + by_load;
        let mut power = described + self.multipliers(time, state, &mut multipliers)?;
        for (row, &multiplier) in multipliers.as_slice().iter().enumerate() {
            let row = C::row_of_all(row);
            if let Some(place) = row.and_then(|row| by_time.as_mut_slice().get_mut(row)) {
                power = place.fused(multiplier, power);
                *place = S::zero();
            }
        }
        if by_time.as_slice().iter().all(|&rate| rate == S::zero()) {
            return Some(power);
        }
        // A driver whose equation follows from others in these coordinates, and not in absolute
        // ones.
        let evaluation = self.evaluation(time, bodies).ok()?;
        let by_time = M::constraint_rates(constants, time, &at_rest);
        let multipliers = evaluation.multipliers.as_slice();
        Some(plus_dot(described, by_time.as_slice(), multipliers))
    }

    /// Writes the multipliers of a state, and returns the power (W) of the forces of a closure;
    /// `None` where there are none.
    fn multipliers(
        &self,
        time: S,
        state: &C::State<S>,
        multipliers: &mut C::Multipliers<S>,
    ) -> Option<S> {
        let mut rates = C::State::zeros();
        let evaluator = self.evaluator();
        if Evaluator::<S, M, F, A, C>::IN_PARTS {
            let parts = evaluator.in_parts(time, state, &mut rates, multipliers);
            return parts.ok().map(|parts| parts.applied_power);
        }
        let pivot = evaluator.straight(time, state, &mut rates, multipliers);
        (!vanishes::<S, F::Terms>(pivot.relative)).then(S::zero)
    }

    /// The smallest relative pivot at the end of a step; with a compliance, by a factorisation
    /// without it. Where equations that depend on others are kept, whose pivots tell nothing in
    /// absolute coordinates, it is their least eigenvalue; `None` where these have no solution
    /// anyway, and where no equation remains.
    #[inline]
    fn pivot(&self, step: usize, time: S, bodies: &M::State<S>) -> Option<S> {
        if !C::HAS_PIVOTS || Self::HAS_NO_RANK && !C::IS_RELATIVE {
            return None;
        }
        if F::Terms::COMPLIANT {
            let pivot = || self.rigid_pivot(time, bodies).relative;
            let asked = || step.is_multiple_of(PIVOT_EVERY).then(pivot);
            self.rigid.or_else(asked)
        } else {
            Some(self.seen.pivot)
        }
    }

    /// The smallest relative pivot of the last evaluation, which was at the end of a step or near
    /// to it; `None` where evaluations leave none.
    pub(crate) fn pivot_seen(&self) -> Option<S> {
        (Self::SEES_PIVOTS && (C::IS_RELATIVE || !Self::HAS_NO_RANK)).then_some(self.seen.pivot)
    }

    /// The smallest relative pivot between steps, as at their ends; `None` where none is there.
    pub(crate) fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        if !C::HAS_PIVOTS || Self::HAS_NO_RANK && !C::IS_RELATIVE {
            return None;
        }
        Some(self.pivot_of(time, bodies).relative)
    }

    /// As if the last evaluation had been where bodies stand so, for the monitor.
    pub(crate) fn see_pivot(&mut self, time: S, bodies: &M::State<S>) {
        if const { Self::SEES_PIVOTS }
            && let Some(pivot) = self.pivot_within(time, bodies)
        {
            self.seen.pivot = pivot;
        }
    }

    /// The smallest relative pivot where bodies stand so, as the square of a distance, without a
    /// compliance.
    pub(super) fn pivot_of(&self, time: S, bodies: &M::State<S>) -> Pivot<S> {
        if F::Terms::COMPLIANT {
            return self.rigid_pivot(time, bodies);
        }
        if !C::IS_RELATIVE {
            let (constants, coefficients) = (self.constants(), &self.absolute.coefficients);
            let read = &with_unit_orientations::<S, M>(bodies);
            return M::factor::<S, F::Terms>(constants, coefficients, time, read).1;
        }
        self.pivot_by_joints(time, &C::of_bodies(self.own_constants(), bodies))
    }

    /// The same of a state.
    pub(super) fn pivot_at(&self, time: S, state: &C::State<S>) -> Pivot<S> {
        if C::IS_RELATIVE && !F::Terms::COMPLIANT {
            self.pivot_by_joints(time, state)
        } else {
            self.pivot_of(time, &C::bodies(self.own_constants(), state))
        }
    }

    /// The same of a state in relative coordinates, by equations without a compliance.
    fn pivot_by_joints(&self, time: S, state: &C::State<S>) -> Pivot<S> {
        let (mut rates, mut multipliers) = (C::State::zeros(), Array::zeros());
        let evaluator = self.evaluator();
        let mut pivot = if Evaluator::<S, M, F, A, C>::IN_PARTS {
            evaluator.straight(time, state, &mut rates, &mut multipliers)
        } else {
            evaluator.slope(time, state, &mut rates, &mut multipliers)
        };
        pivot.relative = Self::squared(pivot.relative);
        pivot
    }

    /// The smallest relative pivot without a compliance.
    #[inline(never)]
    pub(crate) fn rigid_pivot(&self, time: S, bodies: &M::State<S>) -> Pivot<S> {
        if M::REPORT.keeps_redundant() {
            return self.kept_pivot(time, bodies);
        }
        if !C::IS_RELATIVE {
            let (constants, coefficients) = (self.constants(), &self.absolute.coefficients);
            return M::factor::<S, Plain>(constants, coefficients, time, bodies).1;
        }
        let state = &C::of_bodies(self.own_constants(), bodies);
        let (mut rates, mut multipliers) = (C::State::zeros(), Array::zeros());
        let equations = self.evaluator().equations;
        let mut pivot = C::evaluate_into::<S, Plain>(
            &equations.constants,
            &equations.coefficients,
            time,
            state,
            &mut rates,
            &mut multipliers,
        );
        pivot.relative = Self::squared(pivot.relative);
        pivot
    }

    /// Finds the joint of the smallest pivot of a run: once, at the end, so that no step has to
    /// know it.
    #[cold]
    pub(crate) fn name_smallest_pivot(&self, monitor: &mut Monitor<S, M>) {
        let Some((time, bodies)) = monitor.nearest() else {
            return;
        };
        let pivot = if !C::IS_RELATIVE && !F::Terms::COMPLIANT {
            let mut rates = M::State::zeros();
            let evaluator = self.of_bodies();
            evaluator.solved_again(time, &bodies, &mut rates)
        } else {
            self.pivot_of(time, &bodies)
        };
        monitor.name(pivot.joint.to_f64() as usize);
    }
}

/// `sum + a . b`.
fn plus_dot<S: Real>(sum: S, a: &[S], b: &[S]) -> S {
    let pairs = a.iter().zip(b);
    pairs.fold(sum, |sum, (&a, &b)| a.fused(b, sum))
}
