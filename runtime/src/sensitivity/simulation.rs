//! A simulation that carries derivatives.

use core::fmt::{self, Debug};
use core::ops::RangeInclusive;

use super::Sensitivities;
use super::start::check_derivatives;
use crate::dynamics::{Bodies, Posed, Problem, Solvable, WithCoordinates, WithLaw};
use crate::error::{Fault, SimulationError, StartFault, Unheeding};
use crate::formulation::Formulation;
use crate::forward::Forward;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::interacting::Unlimited;
use crate::measure::load::{Loads, NoForces};
use crate::mechanism::coordinates::{Absolute, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::refuse_limits;
use crate::run::output::{IntoFlow, Reporting};
use crate::run::report::RunResult;
use crate::run::runs::Runs;
use crate::run::sample::Sample;
use crate::run::simulation::Simulation;

/// What a mechanism is along `K` directions, before more is said of it.
pub(super) type Lifted<M, F, S, const K: usize> =
    Problem<M, F, Forward<S, K>, <M as Mechanism>::Coordinates, Unlimited<NoForces>>;

/// A mechanism along some directions, a formulation and an explicit method, ready to run: by
/// [`Sensitivities::simulation`].
///
/// `P` is the [`Problem`] that is solved, over [`Forward`] numbers, `I` the method. A step control
/// holds values and derivatives to its tolerance, see [`Sensitivities::scales`].
pub struct SensitivitySimulation<P: Posed, I> {
    parameters: <P::Mechanism as Mechanism>::Parameters<P::Number>,
    start: Bodies<P>,
    passes_limits: bool,
    simulation: Simulation<'static, P, I>,
}

impl<P, I, const K: usize, S: Real> Debug for SensitivitySimulation<P, I>
where
    P: Posed<Number = Forward<S, K>, Formulation: Debug>,
    I: Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SensitivitySimulation")
            .field("simulation", &self.simulation)
            .field("directions", &K)
            .finish()
    }
}

impl<M, F, I, const K: usize, S> SensitivitySimulation<Lifted<M, F, S, K>, I>
where
    M: Mechanism,
    F: Formulation<Forward<S, K>>,
    I: Method<Forward<S, K>>,
    S: Real,
{
    pub(super) fn new(along: &Sensitivities<M, K, S>, formulation: F, integrator: I) -> Self {
        let start = along.start();
        let simulation = Simulation::of_parameters(along.parameters, formulation, integrator);
        Self {
            parameters: along.parameters,
            start,
            passes_limits: along.passes_limits,
            simulation: simulation.initial_state(start).without_limits(),
        }
    }
}

impl<P: Solvable, I: Method<P::Number>> SensitivitySimulation<P, I> {
    /// Passes the limits of the description, which are refused otherwise.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.passes_limits = true;
        self
    }

    /// Runs without the monitor, see [`Simulation::unmonitored`].
    #[must_use]
    pub fn unmonitored(mut self) -> Self {
        self.simulation = self.simulation.unmonitored();
        self
    }

    fn exchange<Q>(
        self,
        exchange: impl FnOnce(Simulation<'static, P, I>) -> Simulation<'static, Q, I>,
    ) -> SensitivitySimulation<Q, I>
    where
        Q: Posed<Mechanism = P::Mechanism, Number = P::Number>,
    {
        SensitivitySimulation {
            parameters: self.parameters,
            start: self.start,
            passes_limits: self.passes_limits,
            simulation: exchange(self.simulation),
        }
    }

    /// Applies forces as a function of time and state, over numbers that carry derivatives, see
    /// [`Simulation::forces`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> SensitivitySimulation<WithLaw<P, G>, I>
    where
        G: Fn(P::Number, &Bodies<P>, &mut Loads<'_, P::Number, P::Mechanism>),
    {
        self.exchange(|simulation| simulation.forces(law))
    }

    /// Solves the equations of motion in relative (joint) coordinates.
    #[must_use]
    pub fn joint_coordinates(self) -> SensitivitySimulation<WithCoordinates<P, Relative>, I>
    where
        P::Mechanism: JointCoordinates,
    {
        self.exchange(Simulation::joint_coordinates)
    }

    /// Solves the equations of motion in absolute coordinates.
    #[must_use]
    pub fn absolute_coordinates(self) -> SensitivitySimulation<WithCoordinates<P, Absolute>, I> {
        self.exchange(Simulation::absolute_coordinates)
    }
}

impl<P, M: Mechanism, S: Real, I, const K: usize> SensitivitySimulation<P, I>
where
    P: Solvable<Number = Forward<S, K>, Mechanism = M>,
    I: Runs<P>,
{
    /// Runs over an interval of time (s), see [`Simulation::run`]. The sample's readings carry
    /// derivatives.
    ///
    /// # Errors
    /// As [`Simulation::run`];
    /// [`StartFault::DirectionOpens`] where the derivatives of the start violate those of the
    /// constraints; [`StartFault::SwitchLeftOut`] where a law switches;
    /// [`StartFault::LimitsLeftOut`] of limits in the description, unless
    /// [`SensitivitySimulation::without_limits`] is said.
    pub fn run<O, R>(
        &self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        observe: O,
    ) -> RunResult<Forward<S, K>, M, R::Error<Bodies<P>>>
    where
        O: FnMut(&Sample<'_, Forward<S, K>, M>) -> R,
        R: IntoFlow,
    {
        let (from, to) = interval.into_inner();
        let [start, end] = [from, to].map(Forward::fixed);
        let constants = M::prepare(&self.parameters);
        let state = self.start;
        let time = from.to_f64();
        let refused = |fault: Fault| R::Error::from(SimulationError { time, fault, state });
        if let Some(switch) = M::SWITCHES.first() {
            let fault = StartFault::SwitchLeftOut { law: switch.law };
            return Err(refused(fault.into()));
        }
        if !self.passes_limits {
            refuse_limits::<M>(Unheeding::Derivatives).map_err(|fault| refused(fault.into()))?;
        }
        check_derivatives::<M, K, S>(&constants, start, &state).map_err(refused)?;
        let reporting = match reporting {
            Reporting::Every(interval) => Reporting::Every(Forward::fixed(interval)),
            Reporting::EveryStep => Reporting::EveryStep,
            Reporting::EveryOrSteps { interval, steps } => Reporting::EveryOrSteps {
                interval: Forward::fixed(interval),
                steps,
            },
        };
        self.simulation.run(start..=end, reporting, observe)
    }
}
