//! What the watch wants to know of a mechanism under way.

use super::evaluate::Evaluate;
use super::{Dynamics, Parts};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::kernels::{Mechanism, Orientation, Pivot, Plain, Terms};
use crate::state::vector::{Array, StateParts};
use crate::watch::{Beginning, Step, Watch};

/// Of how many steps one is evaluated again for the bias of a penalty, which changes as slowly as
/// the forces do.
const BIAS_EVERY: usize = 16;
/// Of how many steps one is factorised without its compliance: what is passed between two of them
/// is found all the same.
const PIVOT_EVERY: usize = 2;

impl<S, M, F, P, A> Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// Whether equations that depend on others are kept and not solved.
    const HAS_NO_RANK: bool = M::REPORT.keeps_redundant() && !F::Terms::COMPLIANT;

    /// Whether accelerations are off by what a compliance leaves.
    const YIELDS: bool = F::Terms::COMPLIANT && !F::ITERATED;

    #[inline(always)]
    pub(super) fn look(&mut self, pivot: S, multipliers: &M::Multipliers<S>) {
        if !F::Terms::COMPLIANT {
            self.seen.pivot = pivot;
        }
        if M::REPORT.time.constraints {
            self.seen.multipliers = *multipliers;
        }
    }

    /// Sees by how much Euler parameters were off their length at the end of a step.
    #[inline(always)]
    pub(crate) fn see_stretch(&mut self, stretch: S) {
        self.seen.stretch = stretch;
    }

    /// Counts and looks at an evaluation in parts.
    pub(super) fn gather(&mut self, parts: &Parts<S>, multipliers: &M::Multipliers<S>) {
        self.look(parts.pivot.relative, multipliers);
        self.seen.applied_power = parts.applied_power;
        if F::ITERATED {
            let excused = usize::from(parts.excused);
            self.iterations.excused = self.iterations.excused.saturating_add(excused);
            self.iterations.total = self.iterations.total.saturating_add(parts.iterations);
            self.iterations.largest = self.iterations.largest.max(parts.iterations);
        }
    }

    /// Shows the end of a step to the watch, with what was seen at the last evaluation, and with a
    /// relative pivot that counts beside it.
    #[inline]
    pub(crate) fn watch(
        &self,
        watch: &mut Watch<S, M>,
        (time, state): (S, &M::State<S>),
        beside: Option<S>,
    ) {
        let step = Step {
            constants: &self.constants,
            time,
            state,
            power: self.power(time, state),
            pivot: lesser(self.pivot(watch.steps(), time, state), beside),
            stretch: self.seen.stretch,
            is_mended: P::NORMALISED && !P::NORMALISED_RATES,
        };
        if Self::YIELDS && watch.steps().is_multiple_of(BIAS_EVERY) {
            self.show_bias(watch, time, state);
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
            forces: &self.all_forces(time, &Self::read(state)),
            mass: &M::mass(&self.constants),
            bias,
        };
        watch.begin(state, &beginning);
    }

    #[inline(never)]
    fn show_bias(&self, watch: &mut Watch<S, M>, time: S, state: &M::State<S>) {
        if let Ok(evaluation) = self.evaluation(time, state) {
            watch.yielded(
                &self.compliances,
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
        let mut power = M::power(&self.constants, time, state) + self.seen.applied_power;
        if is_driven {
            let at_rest = M::State::from_parts(*state.coordinates(), M::Velocities::<S>::zeros());
            let by_time = M::constraint_rates(&self.constants, time, &at_rest);
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

    /// The smallest relative pivot between steps; `None` as at their ends.
    pub(crate) fn pivot_within(&self, time: S, state: &M::State<S>) -> Option<S> {
        if M::REPORT.equations == 0 || Self::HAS_NO_RANK {
            return None;
        }
        if F::Terms::COMPLIANT {
            return Some(self.rigid_pivot(time, state).relative);
        }
        let (constants, coefficients) = (&self.constants, &self.coefficients);
        let read = &Self::read(state);
        let (_, pivot) = M::factor::<S, F::Terms>(constants, coefficients, time, read);
        Some(pivot.relative)
    }

    /// The smallest relative pivot without a compliance.
    #[inline]
    pub(crate) fn rigid_pivot(&self, time: S, state: &M::State<S>) -> Pivot<S> {
        if M::REPORT.keeps_redundant() {
            return self.kept_pivot(time, state);
        }
        M::factor::<S, Plain>(&self.constants, &self.coefficients, time, state).1
    }

    /// Finds the joint of the smallest pivot of a run: once, at the end, so that no step has to
    /// know it.
    #[cold]
    pub(crate) fn name_smallest_pivot(&self, watch: &mut Watch<S, M>) {
        if let Some((time, state)) = watch.nearest() {
            let pivot = if F::Terms::COMPLIANT {
                self.rigid_pivot(time, &state)
            } else {
                self.solved_again(time, &state).0
            };
            watch.name(pivot.joint.to_f64() as usize);
        }
    }
}

/// The lesser of what is known.
pub(crate) fn lesser<S: Real>(a: Option<S>, b: Option<S>) -> Option<S> {
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
