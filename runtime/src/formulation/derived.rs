//! Coefficients that follow from the scales of a scene.

use super::{AugmentedLagrangian, Baumgarte, Penalty};
use crate::constraints::compliance::RESOLVED;
use crate::constraints::scales::Scales;
use crate::error::{Fault, StartFault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// The frequency of violations over the rate of the motion, `1 / time`, of a penalty: what a steady
/// reaction leaves of violation goes with its square. Without such a bias, one.
const FASTER: f64 = 2.0;

/// `alpha` of a penalty over the mass that the constraints may have to carry: one over the bias of
/// accelerations.
const STIFFER: f64 = 1e6;

/// What `alpha` keeps away from where its compliance is lost in round-off.
const MARGIN: f64 = 4.0;

/// A penalty of less than so many masses yields by more than a hundredth.
const LEAST: f64 = 100.0;

/// The largest decay rate times a fixed step.
const OF_STEP: f64 = 0.1;

impl<S: Real> Baumgarte<S> {
    /// The coefficients for a mechanism as its attributes describe it: `alpha = beta = 1 / time`,
    /// see [`Scales::time`].
    ///
    /// # Errors
    /// As [`Scales::of`].
    pub fn of<M: Mechanism>(mechanism: &M) -> Result<Self, Fault> {
        Ok(Self::with_scales(&Scales::of(mechanism)?))
    }

    /// The same for scales that are known otherwise.
    #[must_use]
    pub fn with_scales(scales: &Scales<S>) -> Self {
        let rate = scales.time.reciprocal();
        Self::new(rate, rate)
    }

    /// The same, at most a tenth over a fixed step (s): what decays faster costs the accuracy of
    /// the step. For [`SemiImplicitEuler`](crate::SemiImplicitEuler), too.
    #[must_use]
    pub fn at_step(self, step: S) -> Self {
        let most = most(step);
        Self::new(self.alpha.min(most), self.beta.min(most))
    }
}

impl<S: Real> Penalty<S> {
    /// The coefficients for a mechanism as its attributes describe it: `alpha` is a million times
    /// the mass that the constraints may have to carry ([`Scales::mass`]), a radian counts as
    /// [`Scales::length`], `omega = 2 / time` ([`Scales::time`]), `mu = 1`.
    ///
    /// Where equations are kept that depend on others, `alpha` stays below a quarter of where its
    /// compliance is lost in round-off, `1 / (64 EPSILON s)`.
    ///
    /// # Errors
    /// As [`Scales::of`]; [`StartFault::PenaltyFactor`] where that is less than a hundred times the
    /// mass: ratios of masses for which the number type has no penalty.
    pub fn of<M: Mechanism>(mechanism: &M) -> Result<Self, Fault> {
        let scales = Scales::of(mechanism)?;
        let alpha = alpha::<S, M>(&scales)?;
        Ok(Self {
            alpha,
            ..Self::with_scales(&scales)
        })
    }

    /// The same for scales that are known otherwise, wherever round-off begins.
    #[must_use]
    pub fn with_scales(scales: &Scales<S>) -> Self {
        Self {
            alpha: S::constant(STIFFER) * scales.mass,
            omega: S::constant(FASTER).quotient(scales.time),
            mu: S::one(),
            radian: Some(scales.length),
        }
    }

    /// The same with `omega` at most a tenth over a fixed step (s).
    #[must_use]
    pub fn at_step(self, step: S) -> Self {
        let omega = self.omega.min(most(step));
        Self { omega, ..self }
    }
}

impl<S: Real> AugmentedLagrangian<S> {
    /// The coefficients for a mechanism as its attributes describe it: those of [`Penalty::of`],
    /// but for `omega = 1 / time`, since no bias is to be held down.
    ///
    /// # Errors
    /// As [`Penalty::of`].
    pub fn of<M: Mechanism>(mechanism: &M) -> Result<Self, Fault> {
        Ok(Self::like(&Penalty::of(mechanism)?))
    }

    /// The same for scales that are known otherwise, wherever round-off begins.
    #[must_use]
    pub fn with_scales(scales: &Scales<S>) -> Self {
        Self::like(&Penalty::with_scales(scales))
    }

    fn like(penalty: &Penalty<S>) -> Self {
        let omega = penalty.omega.quotient(S::constant(FASTER));
        Self {
            radian: penalty.radian,
            ..Self::new(penalty.alpha, omega, penalty.mu)
        }
    }

    /// The same with `omega` at most a tenth over a fixed step (s).
    #[must_use]
    pub fn at_step(self, step: S) -> Self {
        let omega = self.omega.min(most(step));
        Self { omega, ..self }
    }
}

fn most<S: Real>(step: S) -> S {
    S::constant(OF_STEP).quotient(step)
}

/// The factor of a penalty.
fn alpha<S: Real, M: Mechanism>(scales: &Scales<S>) -> Result<S, Fault> {
    let alpha = S::constant(STIFFER) * scales.mass;
    if !M::REPORT.keeps_redundant() {
        return Ok(alpha);
    }
    let lost = S::constant(RESOLVED) * S::EPSILON;
    let largest = scales.lightest.quotient(lost);
    let most = largest.quotient(S::constant(MARGIN));
    if most < S::constant(LEAST) * scales.mass {
        return Err(Fault::Start(StartFault::PenaltyFactor {
            alpha: alpha.to_f64(),
            largest: largest.to_f64(),
        }));
    }
    Ok(alpha.min(most))
}
