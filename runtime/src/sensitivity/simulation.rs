//! A simulation that carries derivatives.

use core::fmt::{self, Debug};
use core::ops::RangeInclusive;

use super::Sensitivities;
use super::start::check_derivatives;
use crate::error::{Fault, SimulationError, StartFault, Unheeding};
use crate::formulation::Formulation;
use crate::forward::Forward;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::interacting::Unlimited;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::refuse_limits;
use crate::run::output::{IntoFlow, Reporting};
use crate::run::report::RunResult;
use crate::run::runs::Runs;
use crate::run::sample::Sample;
use crate::run::simulation::{Simulation, Solving};

/// A state whose numbers carry derivatives.
type State<M, const K: usize, S> = <M as Mechanism>::State<Forward<S, K>>;

/// A mechanism along `K` directions, a formulation and an explicit method, ready to run: by
/// [`Sensitivities::simulation`].
///
/// A step control holds values and derivatives to its tolerance, see [`Sensitivities::scales`].
pub struct SensitivitySimulation<
    M: Mechanism,
    F,
    I,
    const K: usize,
    S: Real = f64,
    A = NoForces,
    C = <M as Mechanism>::Coordinates,
> {
    along: Sensitivities<M, K, S>,
    simulation: Solving<'static, Forward<S, K>, M, F, I, Unlimited<A>, C>,
}

impl<M: Mechanism, F: Debug, I: Debug, const K: usize, S: Real, A, C> Debug
    for SensitivitySimulation<M, F, I, K, S, A, C>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SensitivitySimulation")
            .field("simulation", &self.simulation)
            .field("directions", &K)
            .finish()
    }
}

impl<M, F, I, const K: usize, S> SensitivitySimulation<M, F, I, K, S>
where
    M: Mechanism,
    F: Formulation<Forward<S, K>>,
    I: Method<Forward<S, K>>,
    S: Real,
{
    pub(super) fn new(along: Sensitivities<M, K, S>, formulation: F, integrator: I) -> Self {
        let simulation = Simulation::of_parameters(along.parameters, formulation, integrator);
        Self {
            along,
            simulation: simulation.initial_state(along.start()).without_limits(),
        }
    }
}

impl<M, F, I, const K: usize, S, A, C> SensitivitySimulation<M, F, I, K, S, A, C>
where
    M: Mechanism,
    F: Formulation<Forward<S, K>>,
    I: Method<Forward<S, K>>,
    S: Real,
    A: AppliedForces<Forward<S, K>, M>,
    C: Coordinates<M>,
{
    /// Passes the limits of the description, which are refused otherwise.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.along.passes_limits = true;
        self
    }

    /// Applies forces as a function of time and state, over numbers that carry derivatives, see
    /// [`Simulation::forces`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> SensitivitySimulation<M, F, I, K, S, A::With<ForceLaw<G>>, C>
    where
        G: Fn(Forward<S, K>, &M::State<Forward<S, K>>, &mut Loads<'_, Forward<S, K>, M>),
    {
        SensitivitySimulation {
            along: self.along,
            simulation: self.simulation.forces(law),
        }
    }

    /// Runs without the monitor, see [`Simulation::unmonitored`].
    #[must_use]
    pub fn unmonitored(mut self) -> Self {
        self.simulation = self.simulation.unmonitored();
        self
    }

    /// Solves the equations of motion in relative (joint) coordinates.
    #[must_use]
    pub fn joint_coordinates(self) -> SensitivitySimulation<M, F, I, K, S, A, Relative>
    where
        M: JointCoordinates,
    {
        SensitivitySimulation {
            along: self.along,
            simulation: self.simulation.joint_coordinates(),
        }
    }

    /// Solves the equations of motion in absolute coordinates.
    #[must_use]
    pub fn absolute_coordinates(self) -> SensitivitySimulation<M, F, I, K, S, A, Absolute> {
        SensitivitySimulation {
            along: self.along,
            simulation: self.simulation.absolute_coordinates(),
        }
    }
}

impl<M, F, I, const K: usize, S, A, C> SensitivitySimulation<M, F, I, K, S, A, C>
where
    M: Mechanism,
    F: Formulation<Forward<S, K>>,
    I: Runs<Forward<S, K>, M, F, C, Unlimited<A>>,
    S: Real,
    A: AppliedForces<Forward<S, K>, M>,
    C: Coordinates<M>,
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
    ) -> RunResult<Forward<S, K>, M, R::Error<State<M, K, S>>>
    where
        O: FnMut(&Sample<'_, Forward<S, K>, M>) -> R,
        R: IntoFlow,
    {
        let (from, to) = interval.into_inner();
        let [start, end] = [from, to].map(Forward::fixed);
        let constants = M::prepare(&self.along.parameters);
        let state = self.along.start();
        let time = from.to_f64();
        let refused = |fault: Fault| R::Error::from(SimulationError { time, fault, state });
        if let Some(switch) = M::SWITCHES.first() {
            let fault = StartFault::SwitchLeftOut { law: switch.law };
            return Err(refused(fault.into()));
        }
        if !self.along.passes_limits {
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
