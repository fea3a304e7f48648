//! What is done to the end of a step before anybody sees it.

use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::fastest;
use crate::run::branching::Branching;
use crate::run::post_step::PostStabilisation;
use crate::run::segments::Run;

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Whether the end of the last step is corrected.
    #[inline]
    pub(crate) fn corrects(&self) -> bool {
        self.stabilisation.is_some() || self.branching.is_near()
    }

    /// A state after its stabilisation, or with its joints closed.
    pub(crate) fn corrected(
        &mut self,
        time: S,
        reached: M::State<S>,
    ) -> Result<M::State<S>, Fault> {
        match self.stabilisation {
            Some(stabilisation) => self.stabilised(stabilisation, time, reached),
            None => {
                let constants = self.dynamics.constants();
                Ok(Branching::closed::<M>(constants, time, &reached))
            }
        }
    }

    /// A state after its stabilisation.
    #[inline(never)]
    pub(crate) fn stabilised(
        &mut self,
        stabilisation: &dyn PostStabilisation<S, M>,
        time: S,
        reached: M::State<S>,
    ) -> Result<M::State<S>, Fault> {
        let constants = self.dynamics.constants();
        let mut state = reached;
        let residual = match stabilisation.stabilise(constants, time, &mut state) {
            Ok(residual) => residual,
            Err(fault) => {
                // A correction that fails may leave any velocities.
                self.gone = Some(fastest::<S, M>(constants, &reached));
                return Err(fault);
            }
        };
        if let Some(monitor) = &mut self.monitor
            && residual > S::zero()
        {
            monitor.accept_unconverged_correction(time);
        }
        Ok(state)
    }
}
