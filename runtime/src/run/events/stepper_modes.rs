//! Steps with interactions, for a loop that somebody else owns.

use crate::dynamics::Dynamics;
use crate::dynamics::evaluate::Evaluate;
use crate::error::{Fault, ModeFault, ReadingFault};
use crate::formulation::Formulation;
use crate::integrate::{Scheme, StepWithin, System as _};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::turns;
use crate::nonsmooth::handle::{InteractionHandle, engage, named};
use crate::nonsmooth::status::{Impact, InteractionMode};
use crate::run::stepper::{Stepper, Steps};
use crate::stepping::followed::bodies_by_halves;
use crate::stepping::interval::Interval;
use crate::stepping::modes::Modes;
use crate::stepping::root::first_root;

/// How often modes may change within a step, besides what each interaction may.
const CHANGES: usize = 8;
const OF_EACH: usize = 4;

impl<S, M, F, K, A, C> Stepper<S, M, F, K, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Scheme<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// The mode of an interaction; [`InteractionMode::Released`] or [`InteractionMode::Free`]
    /// before the first step.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn mode(&self, interaction: InteractionHandle<M>) -> Result<InteractionMode, ReadingFault> {
        Ok(named(self.dynamics.tracked(), interaction)?.told_mode())
    }

    /// The effort of an interaction (N m, N) in a state, at the time that was reached. One
    /// evaluation.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`], the fault of the
    /// evaluation.
    pub fn effort(
        &self,
        interaction: InteractionHandle<M>,
        state: &C::State<S>,
    ) -> Result<S, Fault> {
        let tracked = named(self.dynamics.tracked(), interaction)?;
        self.dynamics.efforts(self.time(), state)?;
        Ok(tracked.status.get().effort)
    }

    /// The last impulse of an interaction so far, if there was one.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn impact(
        &self,
        interaction: InteractionHandle<M>,
    ) -> Result<Option<Impact<S>>, ReadingFault> {
        Ok(named(self.dynamics.tracked(), interaction)?
            .status
            .get()
            .impact)
    }

    /// Engages dry friction, a brake or a clutch, from the next step on.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`];
    /// [`StartFault::MisplacedSetting`](crate::error::StartFault::MisplacedSetting) of limits.
    pub fn engage(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.dynamics.tracked(), interaction, true)
    }

    /// Releases it, from the next step on.
    ///
    /// # Errors
    /// As [`Stepper::engage`].
    pub fn release(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.dynamics.tracked(), interaction, false)
    }

    /// Accepts the settings, once.
    fn begin_modes(&mut self) -> Result<(), Fault> {
        if !self.has_begun {
            for tracked in self.dynamics.tracked() {
                tracked.interaction.check()?;
            }
            self.has_begun = true;
        }
        Ok(())
    }
}

impl<S, M, F, K, A, C> Stepper<S, M, F, K, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Steps<S, M, F, C, A>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// A step with the modes that begin and end within it.
    #[inline(never)]
    pub(crate) fn step_with_modes(&mut self, state: &mut C::State<S>, dt: S) -> Result<(), Fault> {
        self.checked(state, dt)?;
        self.begin_modes()?;
        let before = self.dynamics.applied_forces().list().clone();
        let moved = self.moved(state, dt);
        let ended = moved.and_then(|next| self.end_step(state, next, dt));
        if ended.is_err() {
            let now = self.dynamics.tracked().iter();
            for (now, before) in now.zip(before.as_ref()) {
                now.status.set(before.status.get());
            }
        }
        ended
    }

    /// The state after a step, by as many as there are modes that end.
    fn moved(&mut self, state: &C::State<S>, dt: S) -> Result<C::State<S>, Fault> {
        let start = self.time();
        let end = start + dt;
        let (mut time, mut left) = (start, dt);
        let scheme = self.scheme;
        let changes = CHANGES + OF_EACH * self.dynamics.tracked().len();
        let dynamics = &mut self.dynamics;
        let mut next = dynamics.switched(start, state, true)?;
        for _ in 0..changes {
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
            let mut modes = Modes::of(dynamics);
            let found = first_root(&mut within, &mut modes, (time, end), true)?;
            let (found, near) = (found.map(|found| found.time), within.near);
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
        Err(Fault::Mode(ModeFault::Endless {
            joint: list.first().map_or("", |first| first.interaction.name()),
            changes,
            time: time.to_f64(),
        }))
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

impl<S, M, F, A, C, G> Interval<S, M> for Within<'_, S, M, F, A, C, G>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    G: Fn(S) -> C::State<S>,
{
    fn equations(&self) -> &dyn Evaluate<S, M> {
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

    fn look_from(&mut self, time: S, bodies: M::State<S>) {
        (self.since, self.near) = (time, bodies);
    }
}
