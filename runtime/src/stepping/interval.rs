//! A step that was taken, with the bodies at any time in it.

use crate::dynamics::evaluate::Evaluate;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::stepping::marching::Marching;

/// A step that is looked into, from its start on: each look is near to the one before.
pub(crate) trait Interval<S: Real, M: Mechanism> {
    /// The equations that were integrated.
    fn equations(&mut self) -> &mut dyn Evaluate<S, M>;

    /// The bodies at a time (s), with Euler parameters of length 1 and turns counted from the last
    /// look on.
    ///
    /// # Errors
    /// Those of an interpolant.
    fn bodies_at(&mut self, time: S) -> Result<M::State<S>, Fault>;

    /// Later looks are near to these bodies at a time (s).
    fn look_from(&mut self, time: S, bodies: M::State<S>);
}

/// The last step of a run.
pub(crate) struct LastStep<'s, S: Real, M: Mechanism> {
    pub(crate) march: &'s mut (dyn Marching<S, M> + 's),
    /// The last look (s), and the bodies there.
    pub(crate) since: S,
    pub(crate) near: M::State<S>,
}

impl<S: Real, M: Mechanism> Interval<S, M> for LastStep<'_, S, M> {
    fn equations(&mut self) -> &mut dyn Evaluate<S, M> {
        self.march.equations_mut()
    }

    fn bodies_at(&mut self, time: S) -> Result<M::State<S>, Fault> {
        let bodies = self.march.within((self.since, &self.near), time)?;
        Ok(with_unit_orientations::<S, M>(&bodies))
    }

    fn look_from(&mut self, time: S, bodies: M::State<S>) {
        (self.since, self.near) = (time, bodies);
    }
}
