//! What the watch wants to know of a mechanism under way.

use super::evaluate::{Evaluate, Parts};
use super::{Dynamics, Evaluator, vanishes};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::absolute::as_read;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Mechanism, Orientation, Pivot, Plain, Terms};
use crate::state::vector::{Array, MovingState, StateParts};
use crate::watch::{Beginning, Seen, Step, Watch};

/// Of how many steps one is evaluated again for the bias of a penalty, which changes as slowly as
/// the forces do.
const BIAS_EVERY: usize = 16;
/// Of how many steps one is factorised without its compliance: what is passed between two of them
/// is found all the same.
const PIVOT_EVERY: usize = 2;

impl<S, M, F, A, C> Dynamics<S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Whether equations that depend on others are kept and not solved.
    const HAS_NO_RANK: bool = M::REPORT.keeps_redundant() && !F::Terms::COMPLIANT;

    /// Whether accelerations are off by what a compliance leaves.
    const YIELDS: bool = F::Terms::COMPLIANT && !F::ITERATED;

    /// Sees an evaluation, if it is one by the rows of all joints. In relative coordinates the
    /// watch has the bodies evaluated at the end of a step.
    #[inline(always)]
    pub(super) fn look(&mut self, pivot: S, multipliers: &C::Multipliers<S>) {
        let Some(multipliers) = C::of_all_rows(multipliers) else {
            return;
        };
        if !F::Terms::COMPLIANT {
            self.seen.pivot = pivot;
        }
        if M::REPORT.time.constraints {
            self.seen.multipliers = *multipliers;
        }
    }

    /// Sees an evaluation in parts, likewise.
    #[inline(always)]
    pub(super) fn look_in_parts(&mut self, parts: &Parts<S>, multipliers: &C::Multipliers<S>) {
        self.look(parts.pivot.relative, multipliers);
        if !C::IS_RELATIVE {
            self.seen.applied_power = parts.applied_power;
        }
    }

    /// Counts an evaluation in parts.
    #[inline(always)]
    pub(super) fn count(&mut self, parts: &Parts<S>) {
        if F::ITERATED && parts.iterations > 1 {
            let excused = usize::from(parts.excused);
            self.iterations.excused = self.iterations.excused.saturating_add(excused);
            self.iterations.total = self.iterations.total.saturating_add(parts.iterations);
            self.iterations.largest = self.iterations.largest.max(parts.iterations);
        }
    }

    /// What was seen at the last evaluation.
    pub(crate) fn seen(&self) -> Seen<S, M> {
        self.seen
    }

    /// As if that had been the last evaluation. In relative coordinates no evaluation is seen.
    pub(crate) fn recall(&mut self, seen: Seen<S, M>) {
        if !C::IS_RELATIVE {
            self.seen = seen;
        }
    }

    /// Sees an evaluation of the bodies. Where they have none, its pivot says why.
    fn see_bodies(&mut self, time: S, bodies: &M::State<S>) {
        let (mut rates, mut multipliers) = (M::State::zeros(), Array::zeros());
        let evaluator = self.of_bodies();
        let (pivot, applied_power) = if Evaluator::<S, M, F, A, C>::IN_PARTS {
            match evaluator.in_parts(time, bodies, &mut rates, &mut multipliers) {
                Ok(parts) => (parts.pivot.relative, parts.applied_power),
                Err(_) => return,
            }
        } else {
            let pivot = evaluator.slope(time, bodies, &mut rates, &mut multipliers);
            if vanishes::<S, F::Terms>(pivot.relative) {
                return;
            }
            (pivot.relative, S::zero())
        };
        if !F::Terms::COMPLIANT {
            self.seen.pivot = pivot;
        }
        self.seen.multipliers = multipliers;
        self.seen.applied_power = applied_power;
    }

    /// Shows the end of a step to the watch. In relative coordinates it wants to know of all
    /// joints, by one evaluation of the bodies, and what the velocities that rows determine lose
    /// counts as well: there, and not where a method evaluated last.
    #[inline]
    pub(crate) fn watch(&mut self, watch: &mut Watch<S, M>, time: S, bodies: &M::State<S>) {
        let beside = if C::IS_RELATIVE {
            self.see_bodies(time, bodies);
            self.own_pivot(time, bodies).map(|pivot| pivot.relative)
        } else {
            None
        };
        let step = Step {
            constants: self.constants(),
            time,
            state: bodies,
            power: self.power(time, bodies),
            pivot: lesser(self.pivot(watch.steps(), time, bodies), beside),
            stretch: self.seen.stretch,
            is_mended: C::Orientation::NORMALISED && !C::Orientation::NORMALISED_RATES,
        };
        if Self::YIELDS && watch.steps().is_multiple_of(BIAS_EVERY) {
            self.show_bias(watch, time, bodies);
        }
        watch.step(step);
    }

    /// Shows the watch what acts at the start of a run, by two evaluations: whether anything moves,
    /// and what round-off there is.
    #[inline(never)]
    pub(crate) fn begin(&self, watch: &mut Watch<S, M>, time: S, state: &M::State<S>) {
        let there = self.evaluation(time, &watch.shaken(state));
        let (Ok(here), Ok(there)) = (self.evaluation(time, state), there) else {
            return;
        };
        if Self::YIELDS {
            self.show_bias(watch, time, state);
        }
        let bias = if F::Terms::COMPLIANT {
            self.inconsistency(time, state, &here).0
        } else {
            S::zero()
        };
        let beginning = Beginning {
            accelerations: [here.rates.velocities(), there.rates.velocities()],
            forces: &self.all_forces(time, &as_read::<S, M, C::Orientation>(state)),
            mass: &M::mass(self.constants()),
            bias,
        };
        watch.begin(state, &beginning);
    }

    #[inline(never)]
    fn show_bias(&self, watch: &mut Watch<S, M>, time: S, state: &M::State<S>) {
        if let Ok(evaluation) = self.evaluation(time, state) {
            watch.yielded(
                &self.absolute.compliances,
                &evaluation.multipliers,
                evaluation.rates.velocities(),
            );
        }
    }

    /// The power (W) of all forces without a potential, and of drivers, whose multipliers work
    /// against `Phi_t`.
    fn power(&self, time: S, state: &M::State<S>) -> Option<S> {
        let is_driven = M::REPORT.time.constraints;
        if M::REPORT.forces.is_empty() && !is_driven && !A::PRESENT {
            return None;
        }
        let mut power = M::power(self.constants(), time, state) + self.seen.applied_power;
        if is_driven {
            let at_rest = M::State::from_parts(*state.coordinates(), M::Velocities::<S>::zeros());
            let by_time = M::constraint_rates(self.constants(), time, &at_rest);
            power = plus_dot(power, by_time.as_slice(), self.seen.multipliers.as_slice());
        }
        Some(power)
    }

    /// The smallest relative pivot at the end of a step; with a compliance, by a factorisation
    /// without it. Where equations that depend on others are kept, whose pivots tell nothing, it is
    /// their least eigenvalue; `None` where these have no solution anyway.
    #[inline]
    fn pivot(&self, step: usize, time: S, state: &M::State<S>) -> Option<S> {
        if M::REPORT.equations == 0 || Self::HAS_NO_RANK {
            return None;
        }
        if F::Terms::COMPLIANT {
            let pivot = || self.rigid_pivot(time, state).relative;
            step.is_multiple_of(PIVOT_EVERY).then(pivot)
        } else {
            Some(self.seen.pivot)
        }
    }

    /// The smallest relative pivot between steps, as at their ends; `None` where none is there.
    pub(crate) fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        let beside = if C::IS_RELATIVE {
            self.own_pivot(time, bodies).map(|pivot| pivot.relative)
        } else {
            None
        };
        lesser(self.pivot_of_bodies(time, bodies), beside)
    }

    fn pivot_of_bodies(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        if M::REPORT.equations == 0 || Self::HAS_NO_RANK {
            return None;
        }
        if F::Terms::COMPLIANT {
            return Some(self.rigid_pivot(time, bodies).relative);
        }
        let (constants, coefficients) = (self.constants(), &self.absolute.coefficients);
        let read = &as_read::<S, M, C::Orientation>(bodies);
        let (_, pivot) = M::factor::<S, F::Terms>(constants, coefficients, time, read);
        Some(pivot.relative)
    }

    /// The smallest relative pivot in its own coordinates, where bodies stand so, as the square of
    /// a distance; `None` where none is recorded.
    fn own_pivot(&self, time: S, bodies: &M::State<S>) -> Option<Pivot<S>> {
        if F::Terms::COMPLIANT || !C::HAS_PIVOTS {
            return None;
        }
        let (mut rates, mut multipliers) = (C::State::zeros(), Array::zeros());
        let state = C::of_bodies(self.own_constants(), bodies);
        let evaluator = self.evaluator();
        let mut pivot = if Evaluator::<S, M, F, A, C>::IN_PARTS {
            evaluator.straight(time, &state, &mut rates, &mut multipliers)
        } else {
            evaluator.slope(time, &state, &mut rates, &mut multipliers)
        };
        if C::HAS_LINEAR_PIVOTS {
            pivot.relative = pivot.relative * pivot.relative;
        }
        Some(pivot)
    }

    /// The smallest relative pivot without a compliance.
    #[inline]
    pub(crate) fn rigid_pivot(&self, time: S, state: &M::State<S>) -> Pivot<S> {
        if M::REPORT.keeps_redundant() {
            return self.kept_pivot(time, state);
        }
        M::factor::<S, Plain>(self.constants(), &self.absolute.coefficients, time, state).1
    }

    /// Finds the joint of the smallest pivot of a run: once, at the end, so that no step has to
    /// know it.
    #[cold]
    pub(crate) fn name_smallest_pivot(&self, watch: &mut Watch<S, M>) {
        let Some((time, bodies)) = watch.nearest() else {
            return;
        };
        let pivot = if C::IS_RELATIVE && Self::HAS_NO_RANK {
            // Those of the bodies tell nothing, and the tree has taken what follows from others.
            self.own_pivot(time, &bodies)
        } else if F::Terms::COMPLIANT {
            Some(self.rigid_pivot(time, &bodies))
        } else {
            let mut rates = M::State::zeros();
            let evaluator = self.of_bodies();
            Some(evaluator.solved_again(time, &bodies, &mut rates))
        };
        if let Some(pivot) = pivot {
            watch.name(pivot.joint.to_f64() as usize);
        }
    }
}

/// The lesser of what is known.
fn lesser<S: Real>(a: Option<S>, b: Option<S>) -> Option<S> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// `sum + a . b`.
fn plus_dot<S: Real>(sum: S, a: &[S], b: &[S]) -> S {
    let pairs = a.iter().zip(b);
    pairs.fold(sum, |sum, (&a, &b)| a.fused(b, sum))
}
