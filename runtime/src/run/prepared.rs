//! What a run begins with: equations, a start that is accepted, and what is remembered.

use crate::assembly::assembled;
use crate::assembly::consistent_start::check_start;
use crate::constraints::row_units::characteristic_length;
use crate::dynamics::{Carrying, Dynamics, Posed, Solvable};
use crate::error::{Fault, StartFault};
use crate::formulation::Formulation;
use crate::integrate::{Integrator, Method};
use crate::math::scalar::Real;
use crate::measure::interacting::Heeding;
use crate::measure::load::AppliedForces;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::Several as _;
use crate::mechanism::orientations::check_state;
use crate::monitor::Monitor;
use crate::run::driver::Course;
use crate::run::events::list::{Happenings, Hybrid};
use crate::run::events::switching::Switching;
use crate::run::output::check_interval;
use crate::run::past::Past;
use crate::run::post_step::PostStabilisation;
use crate::run::remembered::take_values;
use crate::run::simulation::{Setup, Source};
use crate::stepping::march::settings;

/// A run that is about to begin.
pub(super) struct Prepared<P: Solvable, I> {
    pub(super) equations: Dynamics<P>,
    /// The method for the size of the mechanism.
    pub(super) integrator: I,
    pub(super) course: Course<P::Number, P::Mechanism>,
    /// Laws that switch, where there are any.
    pub(super) switching: Option<Switching<P::Number, P::Mechanism>>,
    /// The parameters at the start.
    pub(super) given: <P::Mechanism as Mechanism>::Parameters<P::Number>,
}

impl<P: Posed, I> Setup<'_, P, I> {
    /// What is done to states after steps and before reports.
    pub(super) fn stabilisation(&self) -> Option<&dyn PostStabilisation<P::Number, P::Mechanism>> {
        let projection = self.projection.as_ref();
        let projection = projection.map(|projection| projection as &dyn PostStabilisation<_, _>);
        self.stabilisation.or(projection)
    }
}

impl<P, S: Real, M: Mechanism, I> Setup<'_, P, I>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Method<S>,
{
    /// A run with forces and with what happens over an interval (s), from where it goes on, if it
    /// does. Whether nothing happens but what is of the mechanism itself is said beside the list.
    pub(super) fn prepared<B: AppliedForces<S, M>>(
        &self,
        forces: B,
        (list, is_bare): (&mut dyn Happenings<S, M>, bool),
        ((start, end), past): ((S, S), Option<&Past<'_, S, M>>),
        at: &mut StateAt<S, M>,
    ) -> Result<Prepared<Carrying<P, B>, I>, Fault>
    where
        I: Integrator<S, Dynamics<Carrying<P, B>>>,
    {
        let dynamics = match self.mechanism {
            Source::Mechanism(mechanism) => Dynamics::new(mechanism, self.formulation),
            Source::Parameters(given) => Dynamics::of_parameters(given, self.formulation),
        }?;
        let given = *dynamics.parameters();
        let forces = Heeding::new(forces, &given);
        let mut dynamics = dynamics.with_forces(forces).coordinates::<P::Coordinates>();
        let described = M::initial_state(dynamics.constants());
        let length = characteristic_length::<S, M>(dynamics.constants(), &described);
        let integrator = self.integrator.for_length(length);
        if let Some(past) = past {
            take_values(&mut dynamics, past)?;
        }
        let constants = *dynamics.constants();
        let described = || M::initial_state(&constants);
        *at = past.map_or_else(
            || At {
                time: start,
                bodies: self.initial.unwrap_or_else(described),
            },
            |past| past.at,
        );
        self.check_times([start, at.time, end])?;
        let mut hybrid = Hybrid::new(list, &given, self.accepts_any_start, (start, end))?;
        // Laws that switch and interactions make events of their own.
        let has_own = !M::SWITCHES.is_empty() || B::Tracked::COUNT > 0;
        hybrid.is_empty = is_bare && !has_own;
        if let Some(past) = past {
            hybrid = hybrid.resumed(past);
        }
        check_state::<S, M>(&at.bodies)?;
        if past.is_none() {
            at.bodies = self.start(&constants, (start, end), at.bodies, described)?;
        }
        let monitor = self.is_monitored.then(|| {
            Monitor::new(&constants, at.time, &at.bodies)
                .of_joints(P::Coordinates::keeps_equations)
                .over(&integrator)
                .decaying(self.formulation.decay_rate())
        });
        let settings = settings::<Carrying<P, B>, I>(&integrator);
        Ok(Prepared {
            course: Course::new(settings, &integrator, hybrid, monitor),
            equations: dynamics,
            switching: (!M::SWITCHES.is_empty()).then(Switching::new),
            given,
            integrator,
        })
    }

    /// Refuses times that are not in their order, and breaks that are no times.
    fn check_times(&self, [start, reached, end]: [S; 3]) -> Result<(), Fault> {
        check_interval(start, end)?;
        check_interval(reached, end)?;
        match self.breaks.iter().find(|instant| !instant.is_finite()) {
            None => Ok(()),
            Some(instant) => Err(Fault::Start(StartFault::BreakNotFinite {
                instant: instant.to_f64(),
            })),
        }
    }

    /// The start of a run over an interval (s) from a state, assembled where that is asked.
    fn start(
        &self,
        constants: &M::Constants<S>,
        (start, end): (S, S),
        mut state: M::State<S>,
        described: impl Fn() -> M::State<S>,
    ) -> Result<M::State<S>, Fault> {
        M::rewrap(constants, &mut state);
        if let Some(projection) = self.assemble {
            assembled::<S, M>(&projection, constants, start, &mut state, &described())?;
        }
        let is_relative = P::Coordinates::IS_RELATIVE;
        if !self.accepts_any_start || is_relative {
            let interval = (start, end - start);
            check_start::<S, M>(constants, interval, &state, is_relative)?;
        }
        Ok(state)
    }
}
