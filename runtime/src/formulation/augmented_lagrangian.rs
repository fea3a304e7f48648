//! The augmented Lagrangian formulation.

use super::{Formulation, Saddle, Solution, faster_decay, penalty};
use crate::array::Array;
use crate::error::{Fault, NotFinite};
use crate::integrate::positive;
use crate::mechanism::{Compliant, Mechanism, Stabilisation};
use crate::scalar::Real;

/// The augmented Lagrangian formulation: the penalty with multipliers iterated until its bias is gone.
///
/// One factorisation serves all iterations. They start from `lambda = 0` at every evaluation, so that the rates are a
/// function of time and state alone, and end when the accelerations change by no more than `tolerance (1 + |u'|)`, Euclidean
/// norms over all velocities; the multipliers themselves have no limit where equations are redundant. Bayo, Garcia de Jalon and
/// Serna 1988 (see [`Penalty`](super::Penalty)); Flores 2015, chapter 14.
///
/// **Near singular configurations.** With `e = 1 / alpha`, an iteration leaves `e / (e + s)` of the bias, `s` the eigenvalues of
/// `D M^-1 D^T`: it is fast for independent equations, unnecessary for exactly dependent ones (`s = 0`, no bias), and slow
/// between, where a mechanism passes a singular configuration. There the iterate after `max_iterations` is taken, if what
/// still changes is nearly a state of self-stress: multipliers whose loads on every body cancel to a hundredth. In these
/// directions the formulation is then a penalty with the compliance `e / max_iterations`. Where the loads do not cancel,
/// slow convergence is [`Fault::NotConverged`]: `alpha` is too small for the masses.
///
/// A mechanism that passes a singular configuration with a violation `Phi` moves as one of other lengths would, which need not
/// be the way of the perfect one: it may leave that where `Phi`, in lengths of the mechanism, is not small against this
/// compliance times the masses. With a [`Projection`](crate::Projection) after every step it stays on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AugmentedLagrangian<S> {
    /// `alpha`, positive: kg for a constraint in metres.
    pub alpha: S,
    /// `omega` (rad/s), positive: the frequency of the violation.
    pub omega: S,
    /// `mu`, positive: the damping ratio of the violation, 1 for critical damping.
    pub mu: S,
    /// The change of the accelerations, relative to `1 + |u'|`, that ends the iteration; positive.
    pub tolerance: S,
    /// How often the system may be solved in one evaluation; at least 2. Near singular configurations it is solved as often.
    pub max_iterations: usize,
}

impl<S: Real> AugmentedLagrangian<S> {
    /// The formulation with its three coefficients, a tolerance of 1e-10 (at least `64 EPSILON` of the number type)
    /// and at most 20 iterations.
    #[must_use]
    pub fn new(alpha: S, omega: S, mu: S) -> Self {
        let tolerance = S::constant(1e-10).max(S::constant(64.0) * S::EPSILON);
        Self {
            alpha,
            omega,
            mu,
            tolerance,
            max_iterations: 20,
        }
    }
}

/// `alpha = 1e7`, `omega = 10 rad/s`, `mu = 1`, as in Flores 2015, chapter 15.
impl<S: Real> Default for AugmentedLagrangian<S> {
    fn default() -> Self {
        Self::new(S::constant(1e7), S::constant(10.0), S::one())
    }
}

impl<S: Real> Formulation<S> for AugmentedLagrangian<S> {
    type Terms = Compliant;

    const ITERATED: bool = true;

    fn decay_rate(&self) -> Option<S> {
        Some(faster_decay(self.omega * self.mu, self.omega))
    }

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        positive("tolerance of the augmented Lagrangian", self.tolerance)?;
        if self.max_iterations < 2 {
            let name = "max_iterations of the augmented Lagrangian, less 1";
            return Err(Fault::Setting {
                name,
                value: self.max_iterations as f64 - 1.0,
            });
        }
        penalty::stabilisation(self.alpha, self.omega, self.mu)
    }

    fn solve<M: Mechanism>(
        &self,
        saddle: &Saddle<'_, S, M, Compliant>,
    ) -> Result<Solution<S, M>, Fault> {
        let mut last = saddle.solve();
        let mut change = S::zero();
        let mut worst = 0;
        for iterations in 2..=self.max_iterations {
            let mut next = saddle.solve_after(&last.multipliers);
            next.iterations = iterations;
            let (mut changed, mut size) = (S::zero(), S::zero());
            let pairs = next
                .accelerations
                .as_slice()
                .iter()
                .zip(last.accelerations.as_slice());
            for (&new, &old) in pairs {
                let difference = new - old;
                changed = difference.fused(difference, changed);
                size = new.fused(new, size);
            }
            change = changed.sqrt();
            if change <= self.tolerance * (S::one() + size.sqrt()) {
                return Ok(next);
            }
            if !change.is_finite() {
                let origin = NotFinite::Unknown;
                return Err(Fault::RatesNotFinite { origin });
            }
            if iterations == self.max_iterations {
                if saddle.self_stressed(&next, &last) {
                    return Ok(next);
                }
                worst = saddle.least_satisfied(&next, &last);
            }
            last = next;
        }
        Err(Fault::NotConverged {
            iterations: self.max_iterations,
            residual: change.to_f64(),
            joint: M::REPORT.joint_of(worst),
            alpha: Some(self.alpha.to_f64()),
        })
    }
}
