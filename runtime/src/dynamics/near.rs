//! The bodies of a state that stood near by a moment ago: the signs of Euler parameters and the
//! turns of angles go on from there.

use core::mem::replace;

use super::{Dynamics, Solvable};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::turns;
use crate::state::vector::Vector as _;

impl<P, S: Real, M: Mechanism, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Coordinates = C>,
{
    /// The bodies of a state, when they stood near by a moment ago: Euler parameters keep their
    /// signs as far as they can.
    #[inline(always)]
    pub(crate) fn bodies_near(&self, state: &C::State<S>, near: &M::State<S>) -> M::State<S> {
        let mut bodies = C::bodies_near(self.own_constants(), state, near);
        turns::copy(near, &mut bodies);
        bodies
    }

    /// The bodies of a state in which turns are counted, see [`Self::knows_turns`].
    #[inline(always)]
    pub(crate) fn bodies_counted(&self, state: &C::State<S>, near: &M::State<S>) -> M::State<S> {
        C::bodies_near(self.own_constants(), state, near)
    }

    /// Whether an integration has counted turns through the step that led to a state, and knows
    /// them. It is asked once for a step.
    #[inline(always)]
    pub(crate) fn knows_turns(&mut self, state: &C::State<S>) -> bool {
        let is_known = |&since: &S| replace(&mut self.has_counted, false) && turns::is_known(since);
        state.turns().last().is_none_or(is_known)
    }

    /// The bodies of a state when they stood near by some time (s) ago, with their angles counted
    /// on. Whether the turns are known.
    #[inline]
    pub(crate) fn bodies_after(
        &self,
        state: &C::State<S>,
        (time, near): (S, &M::State<S>),
    ) -> (M::State<S>, bool) {
        let mut bodies = C::bodies_near(self.own_constants(), state, near);
        let is_known = turns::follow::<S, M>(self.constants(), near, time, &mut bodies);
        (bodies, is_known)
    }

    /// Brings a state into its normal form that was reached from another one in some time (s), and
    /// counts all angles.
    #[cold]
    #[inline(never)]
    pub(crate) fn count_from(&self, from: &C::State<S>, time: S, to: &mut C::State<S>) {
        C::normalise(&self.absolute, self.own_constants(), to, None);
        self.count_turns(from, time, to);
    }

    /// Counts all angles of a state that was reached from another one in some time (s).
    #[cold]
    #[inline(never)]
    pub(crate) fn count_turns(&self, from: &C::State<S>, time: S, to: &mut C::State<S>) {
        let (from, mut bodies) = (self.bodies(from), self.bodies(to));
        turns::count::<S, M>(self.constants(), &from, time, &mut bodies);
        turns::copy(&bodies, to);
    }
}
