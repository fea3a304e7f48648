//! What formulations without a compliance solve on their way through a singular configuration.

use super::{AugmentedLagrangian, Formulation, Saddle, Solution};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Compliant, Mechanism, Stabilisation};

/// The compliance of a row over what it yields by its own bodies. Twenty solutions leave nothing of
/// it where the rows together yield ten times as much, and a twentieth of it where they yield
/// nothing.
pub(crate) const COMPLIANCE: f64 = 1e-6;

/// Another formulation where equations nearly depend on each other: an augmented Lagrangian with
/// the terms of `Phi` and `Phi'` of that formulation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StraightOn<S> {
    stabilisation: Stabilisation<S>,
    iterated: AugmentedLagrangian<S>,
}

impl<S: Real> StraightOn<S> {
    /// With the coefficients of a formulation without a compliance.
    pub(crate) fn of(stabilisation: &Stabilisation<S>) -> Self {
        let compliance = S::constant(COMPLIANCE);
        Self {
            stabilisation: Stabilisation {
                compliance,
                ..*stabilisation
            },
            iterated: AugmentedLagrangian::new(compliance.reciprocal(), S::one(), S::one()),
        }
    }

    /// The coefficients of the saddle system.
    pub(crate) fn coefficients(&self) -> &Stabilisation<S> {
        &self.stabilisation
    }
}

impl<S: Real> Formulation<S> for StraightOn<S> {
    type Terms = Compliant;

    const ITERATED: bool = true;

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        Ok(self.stabilisation)
    }

    fn refine<M: Mechanism, C: Coordinates<M>>(
        &self,
        saddle: &Saddle<'_, S, M, C, Compliant>,
        solution: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        self.iterated.straight_on(saddle, solution)
    }
}
