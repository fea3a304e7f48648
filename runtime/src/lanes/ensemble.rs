//! Several mechanisms of one type, moved by steps that are taken in all lanes at once.

use core::array::from_fn;
use core::fmt::{self, Debug};

use super::equations::{LaneEquations, StateOfAll};
use super::exchange::{put_state, state_of};
use crate::dynamics::{Bodies, Dynamics, Problem, Solvable, State, WithCoordinates};
use crate::error::{Fault, ParameterError, SimulationError, StepFault};
use crate::formulation::Formulation;
use crate::integrate::Scheme;
use crate::math::clock::Clock;
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{InputsOf, Mechanism};
use crate::state::vector::MovingState;

/// Several mechanisms of one type, each with its own parameters, inputs and start: a step moves
/// all of them at once, a lane of [`Lanes`](super::Lanes) for each.
///
/// The numbers are those of a [`Stepper`](crate::Stepper) for each mechanism, bit for bit on one
/// machine. The time is common to all. A step allocates nothing and does not panic.
///
/// A lane **stops** where a step cannot be done: a pivot vanishes, or a number is not finite. The
/// others go on. [`Ensemble::stopped`] has the time of its last good state, the fault that a
/// [`Stepper`](crate::Stepper) gives, and the state itself.
///
/// `P` is the [`Problem`] that is solved in each lane, `K` the method. Any explicit scheme will do
/// ([`Rk4`](crate::Rk4), [`Heun`](crate::Heun),
/// [`DormandPrince5`](crate::integrate::DormandPrince5)), and any formulation without an iteration:
/// an [`AugmentedLagrangian`](crate::AugmentedLagrangian) does not compile.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::lanes::Ensemble;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[param]
///     length: f64,
///     #[body(
///         mass = 1.0,
///         inertia = [length * length / 12.0, 1e-3, length * length / 12.0],
///         position = [0.0, length / 2.0, 0.0]
///     )]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let mut rods = Vec::new();
/// for k in 1..=8 {
///     rods.push(Rod::new(0.25 * f64::from(k))?);
/// }
/// let rods: [Rod; 8] = rods.try_into().ok().expect("there are eight");
/// let mut ensemble = Ensemble::<Problem<_, _>, _, 8>::new(&rods, StandardLagrange, Rk4)?;
/// for _ in 0..100 {
///     ensemble.step(1e-3)?;
/// }
/// let mut angles = [0.0; 8];
/// ensemble.each(|lane, rod| angles[lane] = rod.angle(Rod::HANDLES.hinge));
/// assert!(angles[0] < angles[7] && angles[7] < -0.03); // a short rod falls faster
/// # Ok::<(), Fault>(())
/// ```
pub struct Ensemble<P: Solvable, K, const L: usize> {
    /// Each lane by itself.
    pub(super) dynamics: [Dynamics<P>; L],
    pub(super) equations: LaneEquations<P, L>,
    pub(super) state: StateOfAll<P, L>,
    pub(super) stopped: [Option<SimulationError<State<P>>>; L],
    /// How many lanes go on.
    pub(super) going: usize,
    pub(super) scheme: K,
    pub(super) clock: Clock<P::Number>,
    pub(super) passes_limits: bool,
}

impl<M, F, S, K, const L: usize> Ensemble<Problem<M, F, S>, K, L>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    K: Scheme<S>,
{
    /// Prepares all mechanisms in the coordinates that the attribute of their type names, at their
    /// described states and at time zero. A described state that cannot be a start stops its lane,
    /// until [`Ensemble::start`] gives another one.
    ///
    /// # Errors
    /// A parameter of a mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanisms: &[M; L], formulation: F, scheme: K) -> Result<Self, Fault> {
        const { assert!(L > 0, "an ensemble has one lane at least") };
        const {
            assert!(
                !F::ITERATED,
                "an ensemble takes formulations without an iteration"
            )
        };
        let first = Dynamics::new(&mechanisms[0], formulation)?;
        let mut dynamics = from_fn(|_| first.clone());
        for (dynamics, mechanism) in dynamics.iter_mut().zip(mechanisms).skip(1) {
            dynamics.update(mechanism)?;
        }
        Ok(Self::described(dynamics, scheme, Clock::at(S::zero())))
    }
}

impl<P: Solvable, K: Scheme<P::Number>, const L: usize> Ensemble<P, K, L> {
    /// All lanes at their described states.
    fn described(dynamics: [Dynamics<P>; L], scheme: K, clock: Clock<P::Number>) -> Self {
        let mut ensemble = Self {
            dynamics,
            equations: LaneEquations::zeros(),
            state: MovingState::zeros(),
            stopped: [None; L],
            going: L,
            scheme,
            clock,
            passes_limits: false,
        };
        ensemble.begin(Dynamics::initial_state);
        ensemble
    }

    /// Begins all lanes anew.
    fn begin(&mut self, mut start: impl FnMut(&Dynamics<P>) -> Result<State<P>, Fault>) {
        let time = self.clock.time().to_f64();
        let lanes = self.dynamics.iter().zip(&mut self.stopped);
        for (lane, (dynamics, stopped)) in lanes.enumerate() {
            *stopped = match start(dynamics) {
                Ok(state) => {
                    put_state(&mut self.state, lane, &state);
                    None
                }
                Err(fault) => Some(SimulationError {
                    time,
                    fault,
                    state: MovingState::zeros(),
                }),
            };
        }
        self.going = self.stopped.iter().filter(|lane| lane.is_none()).count();
        self.take_equations();
    }

    /// Puts the equations of all mechanisms into their lanes; those that have stopped compute along
    /// as copies of the first that goes on.
    pub(super) fn take_equations(&mut self) {
        for (lane, dynamics) in self.dynamics.iter().enumerate() {
            self.equations.put(lane, dynamics);
        }
        let Some(going) = self.stopped.iter().position(Option::is_none) else {
            return;
        };
        if self.going < L {
            let state: State<P> = state_of(&self.state, going);
            for (lane, _) in self.stopped.iter().enumerate().filter(|(_, s)| s.is_some()) {
                put_state(&mut self.state, lane, &state);
                self.equations.put(lane, &self.dynamics[going]);
            }
        }
    }

    /// Begins at a time (s).
    #[must_use]
    pub fn starting_at(mut self, time: P::Number) -> Self {
        self.clock = Clock::at(time);
        self
    }

    /// Passes the limits of the description. An ensemble does not heed them, and refuses its steps
    /// otherwise.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.passes_limits = true;
        self
    }

    /// Solves the equations of motion in other coordinates, from the described states:
    /// `.coordinates::<Relative>()`.
    #[must_use]
    pub fn coordinates<C>(self) -> Ensemble<WithCoordinates<P, C>, K, L>
    where
        C: Coordinates<P::Mechanism>,
    {
        let dynamics = self.dynamics.map(Dynamics::coordinates);
        Ensemble {
            passes_limits: self.passes_limits,
            ..Ensemble::described(dynamics, self.scheme, self.clock)
        }
    }

    /// Solves the equations of motion in relative (joint) coordinates, from the described states.
    #[must_use]
    pub fn joint_coordinates(self) -> Ensemble<WithCoordinates<P, Relative>, K, L>
    where
        P::Mechanism: JointCoordinates,
    {
        self.coordinates()
    }

    /// Solves the equations of motion in absolute coordinates, from the described states.
    #[must_use]
    pub fn absolute_coordinates(self) -> Ensemble<WithCoordinates<P, Absolute>, K, L> {
        self.coordinates()
    }

    /// Starts every lane from a state of its bodies, at the time that was reached. A start that is
    /// refused ([`Dynamics::state_of`]) stops its lane; one that had stopped goes on.
    pub fn start(&mut self, bodies: &[Bodies<P>; L]) {
        let mut bodies = bodies.iter();
        self.begin(|dynamics| match bodies.next() {
            Some(bodies) => dynamics.state_of(bodies),
            None => Err(Fault::Step(StepFault::StateNotFinite)),
        });
    }

    /// Takes the present parameters and inputs of all mechanisms, to be called between steps.
    ///
    /// # Errors
    /// A parameter that is not acceptable. Its lane and those behind it then keep the former ones.
    pub fn update(&mut self, mechanisms: &[P::Mechanism; L]) -> Result<(), Fault> {
        let mut lanes = self.dynamics.iter_mut().zip(mechanisms);
        let outcome = lanes.try_for_each(|(dynamics, mechanism)| dynamics.update(mechanism));
        self.take_equations();
        outcome
    }

    /// Takes inputs for every lane, to be called between steps.
    ///
    /// # Errors
    /// An input that is not finite. Its lane and those behind it then keep the former ones.
    pub fn set_inputs(
        &mut self,
        inputs: &[InputsOf<P::Mechanism, P::Number>; L],
    ) -> Result<(), ParameterError> {
        let mut lanes = self.dynamics.iter_mut().zip(inputs);
        let outcome = lanes.try_for_each(|(dynamics, inputs)| dynamics.set_inputs(inputs));
        for (lane, stopped) in self.stopped.iter().enumerate() {
            if stopped.is_none() {
                self.equations.put_inputs(lane, &self.dynamics[lane]);
            }
        }
        outcome
    }

    /// The time that was reached (s), that of all lanes that go on.
    #[must_use]
    pub fn time(&self) -> P::Number {
        self.clock.time()
    }

    /// How many lanes go on.
    #[must_use]
    pub fn going(&self) -> usize {
        self.going
    }

    /// Why and when lanes have stopped, with their last good states: `None` of a lane that goes on.
    /// The state of a lane whose start was refused is zero.
    #[must_use]
    pub fn stopped(&self) -> &[Option<SimulationError<State<P>>>; L] {
        &self.stopped
    }

    /// The state of every lane, the last good one where it has stopped.
    #[must_use]
    pub fn states(&self) -> [State<P>; L] {
        from_fn(|lane| match &self.stopped[lane] {
            Some(stopped) => stopped.state,
            None => state_of(&self.state, lane),
        })
    }

    /// Calls with the number of every lane that goes on and readable access to its bodies.
    pub fn each(&self, mut read: impl FnMut(usize, View<'_, P::Number, P::Mechanism>)) {
        let time = self.time();
        let lanes = self.dynamics.iter().zip(&self.stopped);
        for (lane, (dynamics, stopped)) in lanes.enumerate() {
            if stopped.is_none() {
                let bodies = dynamics.bodies(&state_of(&self.state, lane));
                read(lane, dynamics.view(time, &bodies));
            }
        }
    }

    /// The prepared dynamics of every lane, for evaluations outside a step.
    #[must_use]
    pub fn dynamics(&self) -> &[Dynamics<P>; L] {
        &self.dynamics
    }
}

impl<P: Solvable<Forces: Clone>, K: Copy, const L: usize> Clone for Ensemble<P, K, L> {
    fn clone(&self) -> Self {
        Self {
            dynamics: self.dynamics.clone(),
            equations: self.equations,
            state: self.state,
            stopped: self.stopped,
            going: self.going,
            scheme: self.scheme,
            clock: self.clock,
            passes_limits: self.passes_limits,
        }
    }
}

/// The name of the mechanism, the method, and how many lanes there are and go on.
impl<P: Solvable, K: Debug, const L: usize> Debug for Ensemble<P, K, L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("method", &self.scheme)
            .field("lanes", &L)
            .field("going", &self.going)
            .finish_non_exhaustive()
    }
}
