//! Lagrange multipliers without correction.

use super::Formulation;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Plain, Stabilisation};

/// Standard Lagrange multipliers: `D u' = gamma`, nothing else.
///
/// The violation of the constraints grows with the error of the integration: linearly in `Phi'` and
/// quadratically in `Phi`, without bound. Flores 2015, chapter 11.
///
/// On its way through a singular configuration a run solves an
/// [`AugmentedLagrangian`](super::AugmentedLagrangian) in its place, and goes straight on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StandardLagrange;

impl<S: Real> Formulation<S> for StandardLagrange {
    type Terms = Plain;

    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault> {
        Ok(Stabilisation {
            rate: S::zero(),
            position: S::zero(),
            compliance: S::zero(),
        })
    }
}
