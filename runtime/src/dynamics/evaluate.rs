//! An evaluation by whatever formulation.

use super::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::kernels::{Evaluation, Mechanism, Orientation};

/// [`Dynamics`] without its formulation and forces in the type.
pub(crate) trait Evaluate<S: Real, M: Mechanism> {
    fn evaluation(&self, time: S, state: &M::State<S>) -> Result<Evaluation<S, M>, Fault>;
}

impl<S, M, F, P, A> Evaluate<S, M> for Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    #[inline(never)]
    fn evaluation(&self, time: S, state: &M::State<S>) -> Result<Evaluation<S, M>, Fault> {
        self.evaluate(time, state).map(|(evaluation, _)| evaluation)
    }
}
