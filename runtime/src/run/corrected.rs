//! What is done to the end of a step before anybody sees it.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::fastest;
use crate::run::driver::Driver;
use crate::run::post_step::PostStabilisation;
use crate::stepping::branching::closed;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Whether the last step has ended near to a singular configuration that the motion passes.
    #[inline]
    pub(crate) fn is_near_to_branches(&self) -> bool {
        self.course.settings.may_branch && self.march.is_near_to_branches()
    }

    /// Whether the end of the last step is corrected.
    #[inline]
    pub(crate) fn corrects(&self) -> bool {
        self.stabilisation.is_some() || self.is_near_to_branches()
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
                let constants = self.march.equations().constants();
                Ok(closed::<S, M>(constants, time, &reached))
            }
        }
    }

    /// A state within a step, after its stabilisation if there is one.
    pub(crate) fn stabilised_if(
        &mut self,
        time: S,
        reached: M::State<S>,
    ) -> Result<M::State<S>, Fault> {
        match self.stabilisation {
            Some(stabilisation) => self.stabilised(stabilisation, time, reached),
            None => Ok(reached),
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
        let constants = self.march.equations().constants();
        let mut state = reached;
        let residual = match stabilisation.stabilise(constants, time, &mut state) {
            Ok(residual) => residual,
            Err(fault) => {
                // A correction that fails may leave any velocities.
                self.course.gone = Some(fastest::<S, M>(constants, &reached));
                return Err(fault);
            }
        };
        if let Some(monitor) = &mut self.course.monitor
            && residual > S::zero()
        {
            monitor.accept_unconverged_correction(time);
        }
        Ok(state)
    }
}
