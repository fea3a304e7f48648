//! Baumgarte's stabilisation.

use super::{Formulation, faster_decay};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Stabilisation, Stabilised};

/// Baumgarte's stabilisation: `Phi'' + 2 alpha Phi' + beta^2 Phi = 0`.
///
/// A violation decays with `alpha = beta` as a critically damped oscillator of the time constant
/// `1 / alpha`; explicit steps must be shorter than about `2 / alpha`; beyond that violations grow,
/// at once or after some time. Baumgarte, *Stabilization of constraints and integrals of motion in
/// dynamical systems*, Comput. Methods Appl. Mech. Eng. 1 (1972), 1-16; Flores 2015, chapter 12.
///
/// On its way through a singular configuration a run solves an
/// [`AugmentedLagrangian`](super::AugmentedLagrangian) with these terms, and goes straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baumgarte<S> {
    /// `alpha` (1/s), positive.
    pub alpha: S,
    /// `beta` (1/s), positive.
    pub beta: S,
}

impl<S> Baumgarte<S> {
    /// The formulation with its two coefficients (1/s).
    #[must_use]
    pub const fn new(alpha: S, beta: S) -> Self {
        Self { alpha, beta }
    }
}

/// `alpha = beta = 5 / s`, as in Flores 2015, chapter 15: for a pendulum of a metre.
/// [`Baumgarte::of`] is for any mechanism.
impl<S: Real> Default for Baumgarte<S> {
    fn default() -> Self {
        Self::new(S::constant(5.0), S::constant(5.0))
    }
}

impl<S: Real> Formulation<S> for Baumgarte<S> {
    type Terms = Stabilised;

    fn decay_rate(&self) -> Option<S> {
        Some(faster_decay(self.alpha, self.beta))
    }

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        let alpha = positive("alpha of Baumgarte", self.alpha)?;
        let beta = positive("beta of Baumgarte", self.beta)?;
        Ok(Stabilisation {
            rate: alpha + alpha,
            position: beta * beta,
            compliance: S::zero(),
        })
    }
}
