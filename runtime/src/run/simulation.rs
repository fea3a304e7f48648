//! A run of a mechanism over an interval of time.

use core::fmt::{self, Debug};

use crate::constraints::projection::Projection;
use crate::dynamics::{Bodies, Posed, Problem, Solvable, WithCoordinates, WithLaw};
use crate::formulation::Formulation;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{Mechanism, Orientation};
use crate::run::events::list::NothingHappens;
use crate::run::post_step::PostStabilisation;

/// A mechanism, a formulation and an integrator, ready to run over an interval of time.
///
/// ```
/// use holonom::prelude::*;
///
/// /// A rod of 1 m on a hinge about x.
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let (rod, handles) = (Rod::default(), Rod::HANDLES);
/// let mut start = rod.described_state()?;
/// rod.set_angle(&mut start, handles.hinge, 0.5)?;
/// let report = rod
///     .simulation(StandardLagrange, DormandPrince::default())
///     .initial_state(start)                            // else the one that is described
///     .run(0.0..=2.0, every(0.1), |sample| {           // from, to; when to report (s)
///         println!("{:.1} s: {:.4} rad", sample.time(), sample.angle(handles.hinge));
///     })?;
/// assert!(report.warnings().is_empty() && report.accepted > 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// An observer that can fail says so, `|sample| -> Result<(), Fault> { .. }`: then `?` works in it.
/// What a run returns, and why it may not, is at [`Simulation::run`]. For a loop of your own take
/// [`Simulation::begin`], or a [`Stepper`](crate::Stepper).
///
/// `P` is the [`Problem`] that is solved, `I` the method, and `H` is what happens in a run: events,
/// controllers, checkpoints, trajectories. What is said of a simulation may be said in any order.
pub struct Simulation<'a, P: Posed, I, H = NothingHappens> {
    pub(super) setup: Setup<'a, P, I>,
    pub(super) forces: P::Forces,
    pub(super) happenings: H,
}

/// All that is said of a simulation, but for forces and for what happens in it.
pub(super) struct Setup<'a, P: Posed, I> {
    pub(super) mechanism: Source<'a, P::Number, P::Mechanism>,
    pub(super) formulation: P::Formulation,
    pub(super) integrator: I,
    pub(super) initial: Option<Bodies<P>>,
    pub(super) assemble: Option<Projection<P::Number>>,
    pub(super) projection: Option<Projection<P::Number>>,
    pub(super) stabilisation: Option<&'a dyn PostStabilisation<P::Number, P::Mechanism>>,
    pub(super) breaks: &'a [P::Number],
    pub(super) accepts_any_start: bool,
    pub(super) is_monitored: bool,
    pub(super) is_verified: bool,
}

/// Where the numbers of a mechanism come from.
pub(super) enum Source<'a, S: Real, M: Mechanism> {
    Mechanism(&'a M),
    /// They were accepted before.
    Parameters(M::Parameters<S>),
}

impl<S: Real, M: Mechanism> Clone for Source<'_, S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: Mechanism> Copy for Source<'_, S, M> {}

impl<P: Posed<Formulation: Clone>, I: Clone> Clone for Setup<'_, P, I> {
    fn clone(&self) -> Self {
        Self {
            formulation: self.formulation.clone(),
            integrator: self.integrator.clone(),
            ..*self
        }
    }
}

impl<P, I, H> Clone for Simulation<'_, P, I, H>
where
    P: Posed<Formulation: Clone, Forces: Clone>,
    I: Clone,
    H: Clone,
{
    fn clone(&self) -> Self {
        Self {
            setup: self.setup.clone(),
            forces: self.forces.clone(),
            happenings: self.happenings.clone(),
        }
    }
}

/// The name of the mechanism, the formulation and the integrator.
impl<P: Posed<Formulation: Debug>, I: Debug, H> Debug for Simulation<'_, P, I, H> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("formulation", &self.setup.formulation)
            .field("integrator", &self.setup.integrator)
            .finish_non_exhaustive()
    }
}

impl<'a, M, F, S, I> Simulation<'a, Problem<M, F, S>, I>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    I: Method<S>,
{
    /// A simulation from the state that the attributes describe, in the coordinates that the
    /// attribute of the mechanism names, without further forces and without corrections.
    #[must_use]
    pub fn new(mechanism: &'a M, formulation: F, integrator: I) -> Self {
        Self::of(Source::Mechanism(mechanism), formulation, integrator)
    }

    /// A simulation with parameters that were accepted before.
    pub(crate) fn of_parameters(
        parameters: M::Parameters<S>,
        formulation: F,
        integrator: I,
    ) -> Self {
        Self::of(Source::Parameters(parameters), formulation, integrator)
    }

    fn of(mechanism: Source<'a, S, M>, formulation: F, integrator: I) -> Self {
        Self {
            setup: Setup {
                mechanism,
                formulation,
                integrator,
                initial: None,
                assemble: None,
                projection: None,
                stabilisation: None,
                breaks: &[],
                accepts_any_start: false,
                is_monitored: true,
                is_verified: false,
            },
            forces: NoForces,
            happenings: NothingHappens,
        }
    }
}

impl<'a, P, I, H> Simulation<'a, P, I, H>
where
    P: Solvable,
    I: Method<P::Number>,
{
    /// Starts from this state.
    #[must_use]
    pub fn initial_state(mut self, state: Bodies<P>) -> Self {
        self.setup.initial = Some(state);
        self
    }

    /// Corrects the initial state onto the constraints, see [`Projection`].
    #[must_use]
    pub fn assembled(mut self) -> Self {
        self.setup.assemble = Some(Projection::default());
        self
    }

    /// Corrects the state onto the constraints after every step, and every state that is reported.
    /// Without it a run does so on its way through a singular configuration alone.
    #[must_use]
    pub fn projection(mut self, projection: Projection<P::Number>) -> Self {
        self.setup.projection = Some(projection);
        self.setup.stabilisation = None;
        self
    }

    /// Treats the state after every step, and every state that is reported, in another way than by
    /// a [`Simulation::projection`], see [`PostStabilisation`].
    #[must_use]
    pub fn post_stabilisation(
        mut self,
        stabilisation: &'a dyn PostStabilisation<P::Number, P::Mechanism>,
    ) -> Self {
        self.setup.stabilisation = Some(stabilisation);
        self.setup.projection = None;
        self
    }

    /// Accepts a start that violates the constraints by more than four digits, in positions or
    /// velocities, which is refused with
    /// [`StartFault::Inconsistent`](crate::error::StartFault::Inconsistent) otherwise.
    #[must_use]
    pub fn inconsistent_start(mut self) -> Self {
        self.setup.accepts_any_start = true;
        self
    }

    /// Begins the integration anew at these instants (s), in any order: where a law or a closure
    /// jumps or has a short pulse, which a step would pass over otherwise. Those of a `smooth_step`
    /// of the time with literal numbers are known without
    /// ([`ExplicitTime::breaks`](crate::mechanism::ExplicitTime::breaks)).
    #[must_use]
    pub fn breaks(mut self, instants: &'a [P::Number]) -> Self {
        self.setup.breaks = instants;
        self
    }

    /// Runs without the monitor behind [`RunReport::warnings`](crate::RunReport::warnings): that
    /// saves a tenth to a third of the time, and more for runs of some ten steps.
    #[must_use]
    pub fn unmonitored(mut self) -> Self {
        self.setup.is_monitored = false;
        self
    }

    /// Runs a companion beside the run, with half the step or another tolerance, and compares both
    /// at the reporting times. [`RunReport::verification`](crate::RunReport::verification)
    /// estimates by how much every body is off, in m and rad, and from when on;
    /// [`Sample::error_of`](crate::Sample::error_of) estimates the error of whatever an observer
    /// reads. It finds what single steps do not tell: how errors grow in orbits, falls
    /// from the upright and chaos, closures that jump, pulses that steps pass over.
    ///
    /// It costs two to three times what the run does by itself, and at least 256 steps with a
    /// tolerance. With half the step of a method of order 1 the estimate is half of the error.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let report = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01))
    ///     .verified()
    ///     .run(0.0..=10.0, every(0.1), |sample| {
    ///         let error = sample.error_of(|view| view.angle(Rod::HANDLES.hinge));
    ///         assert!(error.expect("it is verified") < 1e-4);
    ///     })?;
    /// let worst = report.verification.and_then(|found| found.worst()).expect("one body");
    /// println!("{} is off by {:e} rad", worst.body, worst.rotation);
    /// # Ok::<(), SimulationError<_>>(())
    /// ```
    #[must_use]
    pub fn verified(mut self) -> Self {
        self.setup.is_verified = true;
        self
    }

    pub(super) fn exchange<Q>(
        self,
        forces: impl FnOnce(P::Forces) -> Q::Forces,
    ) -> Simulation<'a, Q, I, H>
    where
        Q: Posed<Mechanism = P::Mechanism, Formulation = P::Formulation, Number = P::Number>,
    {
        let setup = self.setup;
        Simulation {
            setup: Setup {
                mechanism: setup.mechanism,
                formulation: setup.formulation,
                integrator: setup.integrator,
                initial: setup.initial,
                assemble: setup.assemble,
                projection: setup.projection,
                stabilisation: setup.stabilisation,
                breaks: setup.breaks,
                accepts_any_start: setup.accepts_any_start,
                is_monitored: setup.is_monitored,
                is_verified: setup.is_verified,
            },
            forces: forces(self.forces),
            happenings: self.happenings,
        }
    }

    /// Applies forces as a function of time and state,
    /// `|time, state, loads| loads.force(body, ...)`.
    ///
    /// It is called at trial states, for times that go back and forth, and may remember nothing:
    /// what gives two answers for one time and state ends a run with
    /// [`StepFault::TwoAnswers`](crate::error::StepFault::TwoAnswers). A
    /// controller with memory is called by [`Simulation::every_period`].
    ///
    /// The evaluation is then done in its parts instead of fused, at a higher cost.
    #[must_use]
    pub fn forces<G>(self, law: G) -> Simulation<'a, WithLaw<P, G>, I, H>
    where
        G: Fn(P::Number, &Bodies<P>, &mut Loads<'_, P::Number, P::Mechanism>),
    {
        self.exchange(|forces| forces.with(ForceLaw(law)))
    }

    /// Solves the equations of motion in other coordinates: `.coordinates::<Relative>()`.
    #[must_use]
    pub fn coordinates<C>(self) -> Simulation<'a, WithCoordinates<P, C>, I, H>
    where
        C: Coordinates<P::Mechanism>,
    {
        self.exchange(|forces| forces)
    }

    /// Solves the equations of motion in relative (joint) coordinates, see [`JointCoordinates`]:
    /// bodies stand as the joints of a spanning tree let them at every step, to round-off, and an
    /// evaluation costs what the mechanism's freedom asks for.
    ///
    /// A start that opens a joint is refused, whatever [`Simulation::inconsistent_start`] says:
    /// those of the tree cannot open.
    ///
    /// States go in and come out as those of the bodies; reports, reactions, projection (of the
    /// joints that close loops) and monitor are the same. The monitor looks at the joints that
    /// close loops alone.
    #[must_use]
    pub fn joint_coordinates(self) -> Simulation<'a, WithCoordinates<P, Relative>, I, H>
    where
        P::Mechanism: JointCoordinates,
    {
        self.coordinates()
    }

    /// Solves the equations of motion in absolute coordinates: of every body position, Euler
    /// parameters and velocities.
    #[must_use]
    pub fn absolute_coordinates(self) -> Simulation<'a, WithCoordinates<P, Absolute>, I, H> {
        self.coordinates()
    }

    /// Absolute coordinates with other rates of Euler parameters.
    #[doc(hidden)]
    #[must_use]
    pub fn orientation<O: Orientation>(
        self,
    ) -> Simulation<'a, WithCoordinates<P, Absolute<O>>, I, H> {
        self.coordinates()
    }
}
