//! What a run asks of the equations of motion, whatever the formulation, the forces and the
//! coordinates: all in states of the bodies.
//!
//! A run is compiled once for a mechanism and a number type. So it has the equations behind a
//! pointer, and what costs little goes by none: constants and lists are borrowed once.

#[cfg(feature = "std")]
use core::fmt::Debug;

use super::evaluate::Evaluate;
use super::{Dynamics, Iterations, Solvable};
use crate::error::{Fault, ParameterError};
use crate::formulation::Formulation;
use crate::integrate::{OneStep as _, Rk4, System as _};
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::switch::Switch;
use crate::monitor::{Monitor, Seen, Work};
use crate::nonsmooth::status::Tracked;

/// How often what is held is brought back before the impulses of an instant: what moves by the
/// first time has other rates.
const BROUGHT_BACK: usize = 2;

/// The power (W) of forces and drivers where a step ends, and their work over it where it was
/// looked for; `None` where it is not known.
pub(crate) type Exchanged<S> = (Option<S>, Option<Work<S>>);

/// What changes interactions, with the equations beside them.
pub(crate) type Change<'c, S, M> =
    dyn FnMut(&dyn Equations<S, M>, &mut [Tracked<S, M>]) -> Result<(), Fault> + 'c;

/// The equations of motion of a run.
pub(crate) trait Equations<S: Real, M: Mechanism>: Evaluate<S, M> {
    /// See [`Dynamics::parameters`].
    fn parameters(&self) -> &M::Parameters<S>;

    /// The formulation, with its coefficients.
    #[cfg(feature = "std")]
    fn formulation(&self) -> &dyn Debug;

    /// The rate (1/s) at which violations decay by the formulation.
    fn decay_rate(&self) -> Option<S>;

    /// Whether joints of a tree cannot open.
    fn is_relative(&self) -> bool;

    /// See [`Dynamics::iterations`].
    fn iterations(&self) -> Iterations;

    /// As if evaluations so far had taken these iterations.
    fn recall_iterations(&mut self, iterations: Iterations);

    /// See [`Dynamics::seen`].
    fn seen(&self) -> Seen<S>;

    /// See [`Dynamics::recall`].
    fn recall(&mut self, seen: Seen<S>);

    /// See [`Dynamics::take_parameters`].
    ///
    /// # Errors
    /// Those of that function.
    fn take_parameters(&mut self, parameters: M::Parameters<S>) -> Result<(), Fault>;

    /// See [`Dynamics::renew_limits`].
    ///
    /// # Errors
    /// Those of that function.
    fn renew_limits(&mut self) -> Result<(), Fault>;

    /// See [`Dynamics::set_inputs`].
    ///
    /// # Errors
    /// Those of that function.
    fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), ParameterError>;

    /// See [`Dynamics::hold`].
    fn hold(&mut self, switch: &Switch, side: S);

    /// Evaluates the rates once, in the coordinates of the run.
    ///
    /// # Errors
    /// Why there are none.
    fn evaluate_once(&mut self, time: S, bodies: &M::State<S>) -> Result<(), Fault>;

    /// Where a step (s) leads to, by a method that needs no other.
    ///
    /// # Errors
    /// Why it leads nowhere.
    fn trial(&mut self, time: S, bodies: &M::State<S>, step: S) -> Result<M::State<S>, Fault>;

    /// The bodies after the impulses of an instant, see [`Dynamics::switched`]. What is held is
    /// brought back before, unless a handler may have moved it.
    ///
    /// # Errors
    /// Those of that function.
    fn strike(
        &mut self,
        time: S,
        bodies: &M::State<S>,
        is_moved: bool,
    ) -> Result<M::State<S>, Fault>;

    /// Calls with the interactions, to be changed, and with the equations, where they are as they
    /// were until then.
    ///
    /// # Errors
    /// That of the call; the interactions are then as before.
    fn change_interactions(&mut self, change: &mut Change<'_, S, M>) -> Result<(), Fault>;

    /// See [`Dynamics::begin`].
    fn begin(&self, monitor: &mut Monitor<S, M>, time: S, bodies: &M::State<S>);

    /// See [`Dynamics::ask_twice`].
    ///
    /// # Errors
    /// Those of that function.
    fn ask_twice(&self, at: (S, &M::State<S>), between: (S, &M::State<S>)) -> Result<(), Fault>;

    /// See [`Dynamics::pivot_seen`].
    fn pivot_seen(&self) -> Option<S>;

    /// See [`Dynamics::pivot_within`].
    fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S>;

    /// See [`Dynamics::see_pivot`].
    fn see_pivot(&mut self, time: S, bodies: &M::State<S>);

    /// See [`Dynamics::name_smallest_pivot`].
    fn name_smallest_pivot(&self, monitor: &mut Monitor<S, M>);

    /// See [`Dynamics::power_of_forces`].
    fn power_of_forces(&self, time: S, bodies: &M::State<S>) -> S;

    /// See [`Dynamics::monitor`].
    fn monitor(
        &mut self,
        monitor: &mut Monitor<S, M>,
        at: At<S, &M::State<S>>,
        estimate: Option<S>,
        exchanged: Exchanged<S>,
    );

    /// See [`Dynamics::explained`].
    fn explained(&self, fault: Fault, absolute: Option<S>, at: StateAt<S, M>) -> Fault;
}

impl<P, S: Real, M: Mechanism, C: Coordinates<M>> Equations<S, M> for Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Coordinates = C>,
{
    fn parameters(&self) -> &M::Parameters<S> {
        Self::parameters(self)
    }

    #[cfg(feature = "std")]
    fn formulation(&self) -> &dyn Debug {
        Self::formulation(self)
    }

    fn decay_rate(&self) -> Option<S> {
        Self::formulation(self).decay_rate()
    }

    fn is_relative(&self) -> bool {
        C::IS_RELATIVE
    }

    fn iterations(&self) -> Iterations {
        self.iterations
    }

    fn recall_iterations(&mut self, iterations: Iterations) {
        self.iterations = iterations;
    }

    fn seen(&self) -> Seen<S> {
        Self::seen(self)
    }

    fn recall(&mut self, seen: Seen<S>) {
        Self::recall(self, seen);
    }

    fn take_parameters(&mut self, parameters: M::Parameters<S>) -> Result<(), Fault> {
        Self::take_parameters(self, parameters)
    }

    fn renew_limits(&mut self) -> Result<(), Fault> {
        Self::renew_limits(self)
    }

    fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), ParameterError> {
        Self::set_inputs(self, inputs)
    }

    fn hold(&mut self, switch: &Switch, side: S) {
        Self::hold(self, switch, side);
    }

    fn evaluate_once(&mut self, time: S, bodies: &M::State<S>) -> Result<(), Fault> {
        let state = self.nearest(bodies);
        self.rates(time, &state).map(drop)
    }

    fn trial(&mut self, time: S, bodies: &M::State<S>, step: S) -> Result<M::State<S>, Fault> {
        let mut moved = self.nearest(bodies);
        Rk4.step(self, time, &mut moved, step)?;
        Ok(self.bodies_near(&moved, bodies))
    }

    fn strike(
        &mut self,
        time: S,
        bodies: &M::State<S>,
        is_moved: bool,
    ) -> Result<M::State<S>, Fault> {
        let mut state = self.nearest(bodies);
        for _ in 0..if is_moved { 0 } else { BROUGHT_BACK } {
            match self.held(time, &state)? {
                Some(held) => state = held,
                None => break,
            }
        }
        let next = self.switched(time, &state, is_moved)?;
        Ok(self.bodies_near(&next, bodies))
    }

    fn change_interactions(&mut self, change: &mut Change<'_, S, M>) -> Result<(), Fault> {
        let changed = self.change_list(|equations, list| change(equations, list.as_mut()))?;
        changed.map_or_else(|| change(self, &mut []), Ok)
    }

    fn begin(&self, monitor: &mut Monitor<S, M>, time: S, bodies: &M::State<S>) {
        Self::begin(self, monitor, time, bodies);
    }

    fn ask_twice(&self, at: (S, &M::State<S>), between: (S, &M::State<S>)) -> Result<(), Fault> {
        Self::ask_twice(self, at, between)
    }

    fn pivot_seen(&self) -> Option<S> {
        Self::pivot_seen(self)
    }

    fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        Self::pivot_within(self, time, bodies)
    }

    fn see_pivot(&mut self, time: S, bodies: &M::State<S>) {
        Self::see_pivot(self, time, bodies);
    }

    fn name_smallest_pivot(&self, monitor: &mut Monitor<S, M>) {
        Self::name_smallest_pivot(self, monitor);
    }

    fn power_of_forces(&self, time: S, bodies: &M::State<S>) -> S {
        Self::power_of_forces(self, time, bodies)
    }

    fn monitor(
        &mut self,
        monitor: &mut Monitor<S, M>,
        at: At<S, &M::State<S>>,
        estimate: Option<S>,
        exchanged: Exchanged<S>,
    ) {
        Self::monitor(self, monitor, at, estimate, exchanged);
    }

    fn explained(&self, fault: Fault, absolute: Option<S>, at: StateAt<S, M>) -> Fault {
        Self::explained(self, fault, absolute, at)
    }
}
