//! Steps with interactions, for a loop that somebody else owns.

use core::fmt::{self, Debug};
use core::ops::Deref;

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{OneStep, Scheme, StepWithin, System as _};
use crate::math::scalar::Real;
use crate::measure::interacting::Interacting;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::turns;
use crate::nonsmooth::described::Limited;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::status::{Impact, InteractionMode, Status, Tracked};
use crate::run::events::looked::Looked;
use crate::run::events::watch::looks;
use crate::run::followed::bodies_by_halves;
use crate::run::stepper::Stepper;

/// How often modes may change within a step, besides what each interaction may.
const CHANGES: usize = 8;
const OF_EACH: usize = 4;

/// A [`Stepper`] with limits, dry friction, brakes and clutches, by [`Stepper::interactions`].
pub struct InteractingStepper<
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K,
    A,
    C: Coordinates<M>,
    const N: usize,
> {
    stepper: Stepper<S, M, F, K, Interacting<S, M, A, N>, C>,
    has_begun: bool,
}

/// As the stepper.
impl<S, M, F, K, A, C, const N: usize> Debug for InteractingStepper<S, M, F, K, A, C, N>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Debug,
    C: Coordinates<M>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.stepper.fmt(f)
    }
}

/// What is read of the stepper.
impl<S, M, F, K, A, C, const N: usize> Deref for InteractingStepper<S, M, F, K, A, C, N>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    type Target = Stepper<S, M, F, K, Interacting<S, M, A, N>, C>;

    fn deref(&self) -> &Self::Target {
        &self.stepper
    }
}

impl<S, M, F, K, A, C> Stepper<S, M, F, K, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Scheme<S>,
    C: Coordinates<M>,
{
    /// Adds limits, dry friction, brakes and clutches, see
    /// [`guide::contact`](mod@crate::guide::contact). Say it after everything else that is said of
    /// the stepper.
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
    /// let (rod, h) = (Rod::default(), Rod::HANDLES);
    /// let limits = Interaction::limits(h.hinge.angle(), [-1.0, 1.0]).restitution(0.5);
    /// let mut stepper = Stepper::<f64, _, _, _>::new(&rod, StandardLagrange, Rk4)?
    ///     .interactions([limits]);
    /// let mut state = stepper.initial_state()?;
    /// for _ in 0..4000 {
    ///     stepper.step(&mut state, 1e-3)?;
    /// }
    /// let bodies = stepper.bodies(&state);
    /// assert!((stepper.view(&bodies).angle(h.hinge) + 1.0).abs() < 1e-9); // it rests there
    /// # Ok::<(), Fault>(())
    /// ```
    #[must_use]
    pub fn interactions<const N: usize>(
        self,
        interactions: [Interaction<S, M>; N],
    ) -> InteractingStepper<S, M, F, K, A, C, N> {
        let exchange = |dynamics: Dynamics<S, M, F, A, C>| {
            dynamics.exchange_forces(|forces| Interacting::new(forces, interactions))
        };
        InteractingStepper {
            stepper: self.exchange(exchange),
            has_begun: false,
        }
    }

    /// Heeds the limits of the description as [`Stepper::interactions`], in the order of the
    /// fields, with the parameters that it has now.
    #[must_use]
    pub fn limits<const N: usize>(self) -> InteractingStepper<S, M, F, K, A, C, N>
    where
        M: Limited<N>,
    {
        let limits = M::limits_of(self.dynamics.parameters());
        self.interactions(limits)
    }
}

impl<S, M, F, K, A, C, const N: usize> InteractingStepper<S, M, F, K, A, C, N>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: OneStep<S, Dynamics<S, M, F, Interacting<S, M, A, N>, C>>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Takes these inputs, as [`Stepper::set_inputs`].
    ///
    /// # Errors
    /// As there.
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), Fault> {
        self.stepper.set_inputs(inputs)
    }

    /// Takes the present inputs and parameters, as [`Stepper::update`].
    ///
    /// # Errors
    /// As there.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        self.stepper.update(mechanism)
    }

    /// The mode of an interaction by its place in the list; [`InteractionMode::Released`] or
    /// [`InteractionMode::Free`] before the first step.
    ///
    /// # Errors
    /// [`Fault::NoSuchInteraction`].
    pub fn mode(&self, number: usize) -> Result<InteractionMode, Fault> {
        Ok(self.tracked(number)?.mode())
    }

    /// The effort of an interaction (N m, N) in a state, at the time that was reached. One
    /// evaluation.
    ///
    /// # Errors
    /// [`Fault::NoSuchInteraction`], the fault of the evaluation.
    pub fn effort(&self, number: usize, state: &C::State<S>) -> Result<S, Fault> {
        let tracked = self.tracked(number)?;
        self.stepper.dynamics.efforts(self.stepper.time(), state)?;
        Ok(tracked.status.get().effort)
    }

    /// The last impulse of an interaction so far, if there was one.
    ///
    /// # Errors
    /// [`Fault::NoSuchInteraction`].
    pub fn impact(&self, number: usize) -> Result<Option<Impact<S>>, Fault> {
        Ok(self.tracked(number)?.status.get().impact)
    }

    /// Engages a brake or a clutch, from the next step on.
    ///
    /// # Errors
    /// [`Fault::NoSuchInteraction`].
    pub fn engage(&mut self, number: usize) -> Result<(), Fault> {
        let tracked = self.tracked(number)?;
        tracked.update(|status| status.engage(true));
        Ok(())
    }

    /// Releases it, from the next step on.
    ///
    /// # Errors
    /// [`Fault::NoSuchInteraction`].
    pub fn release(&mut self, number: usize) -> Result<(), Fault> {
        let tracked = self.tracked(number)?;
        tracked.update(|status| status.engage(false));
        Ok(())
    }

    fn tracked(&self, number: usize) -> Result<&Tracked<S, M>, Fault> {
        let list = self.stepper.dynamics.tracked();
        list.get(number).ok_or(Fault::NoSuchInteraction {
            number,
            interactions: list.len(),
        })
    }

    /// Moves the state by one step of `dt` (s), as [`Stepper::step`], with the modes that begin and
    /// end within it. The modes are found anew at its start, so inputs may jump there.
    ///
    /// A step is looked into at 18 instants. Each mode that ends begins a further step over the
    /// rest, of which there are at most `8 + 4 N`. So the cost is bounded.
    ///
    /// # Errors
    /// Those of [`Stepper::step`] and of
    /// [`Simulation::interactions`](crate::Simulation::interactions). State, time and modes are
    /// then as before.
    pub fn step(&mut self, state: &mut C::State<S>, dt: S) -> Result<(), Fault> {
        self.stepper.checked(state, dt)?;
        if !self.has_begun {
            self.begin()?;
        }
        let list = self.stepper.dynamics.tracked();
        let mut before = [None; N];
        for (before, tracked) in before.iter_mut().zip(list) {
            *before = Some(tracked.status.get());
        }
        let moved = self.moved(state, dt);
        let ended = moved.and_then(|next| self.stepper.end_step(state, next, dt));
        if ended.is_err() {
            let list = self.stepper.dynamics.tracked().iter();
            for (tracked, before) in list.zip(before) {
                let _: Option<()> = before.map(|before: Status<S>| tracked.status.set(before));
            }
        }
        ended
    }

    /// Accepts the settings.
    fn begin(&mut self) -> Result<(), Fault> {
        let dynamics = &self.stepper.dynamics;
        for tracked in dynamics.tracked() {
            tracked.interaction.check()?;
        }
        self.has_begun = true;
        Ok(())
    }

    /// The state after a step, by as many as there are modes that end.
    fn moved(&mut self, state: &C::State<S>, dt: S) -> Result<C::State<S>, Fault> {
        let start = self.stepper.time();
        let end = start + dt;
        let (mut time, mut left) = (start, dt);
        let scheme = self.stepper.scheme;
        let dynamics = &mut self.stepper.dynamics;
        let mut next = dynamics.switched(start, state, true)?;
        for _ in 0..CHANGES + OF_EACH * N {
            let step = StepWithin::take(scheme, dynamics, (time, &next), left)?;
            let near = dynamics.bodies(&next);
            let mut within = Within {
                dynamics: &*dynamics,
                state_at: |at: S| {
                    if at == end {
                        *step.end()
                    } else {
                        step.at((at - time).quotient(left))
                    }
                },
                since: time,
                near,
            };
            let found = within.first_end(time, end)?;
            let near = within.near;
            let reached = found.unwrap_or(end);
            next = if found.is_some() {
                step.at((reached - time).quotient(left))
            } else {
                *step.end()
            };
            dynamics.renormalise(&mut next, None);
            turns::copy(&near, &mut next);
            if let Some(held) = dynamics.held(reached, &next)? {
                next = held;
            }
            if found.is_none() {
                return Ok(next);
            }
            next = dynamics.switched(reached, &next, false)?;
            (time, left) = (reached, end - reached);
            if left <= time.ulp() {
                return Ok(next);
            }
        }
        let list = dynamics.tracked();
        Err(Fault::EndlessModes {
            joint: list.first().map_or("", |first| first.interaction.name()),
            changes: CHANGES + OF_EACH * N,
            time: time.to_f64(),
        })
    }
}

/// A step that is looked into.
struct Within<'s, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>, G> {
    dynamics: &'s Dynamics<S, M, F, A, C>,
    state_at: G,
    /// The last look (s), and the bodies there.
    since: S,
    near: M::State<S>,
}

impl<S, M, F, A, C, G> Within<'_, S, M, F, A, C, G>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    G: Fn(S) -> C::State<S>,
{
    /// Where the first mode ends, which is then marked.
    fn first_end(&mut self, start: S, end: S) -> Result<Option<S>, Fault> {
        let mut before = start;
        for time in looks(start, end, true) {
            let bodies = self.bodies_at(time)?;
            if let Some(root) = self.first_end_of_a_mode(before, (time, &bodies))? {
                let bodies = self.bodies_at(root)?;
                self.take_ends_of_modes(root, &bodies)?;
                (self.since, self.near) = (root, bodies);
                return Ok(Some(root));
            }
            self.modes_go_on();
            (before, self.since, self.near) = (time, time, bodies);
        }
        Ok(None)
    }
}

impl<S, M, F, A, C, G> Looked<S, M, F, A, C> for Within<'_, S, M, F, A, C, G>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    G: Fn(S) -> C::State<S>,
{
    fn looked(&self) -> &Dynamics<S, M, F, A, C> {
        self.dynamics
    }

    fn bodies_at(&mut self, time: S) -> Result<M::State<S>, Fault> {
        let (start, near) = (self.since, &self.near);
        let state = (self.state_at)(time);
        let (mut bodies, is_known) = self.dynamics.bodies_after(&state, (time - start, near));
        if !is_known {
            let at = |_: &mut &_, time| Ok((self.state_at)(time));
            bodies = bodies_by_halves(self.dynamics, (start, near), time, at)?;
        }
        Ok(with_unit_orientations::<S, M>(&bodies))
    }
}
