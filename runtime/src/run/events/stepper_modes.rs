//! Steps with interactions, for a loop that somebody else owns.

use crate::dynamics::evaluate::Evaluate;
use crate::dynamics::{Bodies, Dynamics, Solvable, State};
use crate::error::{Fault, ModeFault, ReadingFault};
use crate::integrate::{Scheme, StepWithin, System as _};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::turns;
use crate::nonsmooth::checked::check_all;
use crate::nonsmooth::handle::{InteractionHandle, effort_of, engage, named};
use crate::nonsmooth::jam::{begin_step, end_step, may_be_beyond};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::paced::{end_of_step, moment};
use crate::nonsmooth::status::Impact;
use crate::run::stepper::{Stepper, Steps};
use crate::stepping::followed::bodies_by_halves;
use crate::stepping::interval::Interval;
use crate::stepping::modes::Modes;
use crate::stepping::root::first_root;

/// How often modes may change within a step, besides what each interaction may.
const CHANGES: usize = 8;
const OF_EACH: usize = 4;

/// The same with contacts: a corner that lifts off without an acceleration lands again and again,
/// by the error of a step.
const OF_CONTACTS: usize = 16;

/// How often a step may be shortened at once by slip that turns.
const PACES: usize = 4096;

/// The shortest part of a step that is halved, in units in the last place of the time.
const LEAST_HALVED: f64 = 64.0;

impl<P, S: Real, M: Mechanism, K> Stepper<P, K>
where
    P: Solvable<Number = S, Mechanism = M>,
    K: Scheme<S>,
{
    /// The mode of an interaction; [`InteractionMode::Released`] or [`InteractionMode::Free`]
    /// before the first step.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn mode(&self, interaction: InteractionHandle<M>) -> Result<InteractionMode, ReadingFault> {
        let (_, tracked) = named(self.dynamics.tracked(), interaction)?;
        Ok(tracked.told_mode())
    }

    /// The effort of an interaction (N m, N) in a state, at the time that was reached. One
    /// evaluation.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`], the fault of the
    /// evaluation.
    pub fn effort(&self, interaction: InteractionHandle<M>, state: &State<P>) -> Result<S, Fault> {
        let time = self.time();
        effort_of(self.dynamics.tracked(), interaction, |show| {
            self.dynamics.efforts(time, state, show)
        })
    }

    /// The last impulse of an interaction so far, if there was one.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn impact(
        &self,
        interaction: InteractionHandle<M>,
    ) -> Result<Option<Impact<S>>, ReadingFault> {
        let (_, tracked) = named(self.dynamics.tracked(), interaction)?;
        Ok(tracked.status.impact)
    }

    /// Engages dry friction, a brake or a clutch, from the next step on.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`];
    /// [`StartFault::MisplacedSetting`](crate::error::StartFault::MisplacedSetting) of limits.
    pub fn engage(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.dynamics.tracked_mut(), interaction, true)
    }

    /// Releases it, from the next step on.
    ///
    /// # Errors
    /// As [`Stepper::engage`].
    pub fn release(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.dynamics.tracked_mut(), interaction, false)
    }

    /// Accepts the settings, once.
    fn begin_modes(&mut self) -> Result<(), Fault> {
        if !self.has_begun {
            check_all(self.dynamics.tracked())?;
            self.has_begun = true;
        }
        Ok(())
    }
}

impl<P, S: Real, M: Mechanism, K> Stepper<P, K>
where
    P: Solvable<Number = S, Mechanism = M>,
    K: Steps<P>,
{
    /// A step with the modes that begin and end within it.
    #[inline(never)]
    pub(crate) fn step_with_modes(&mut self, state: &mut State<P>, dt: S) -> Result<(), Fault> {
        self.checked(state, dt)?;
        self.begin_modes()?;
        let before = self.dynamics.applied_forces().list().clone();
        let moved = self.moved(state, dt);
        let ended = moved.and_then(|next| self.end_step(state, next, dt));
        if ended.is_err() {
            self.dynamics.tracked_mut().copy_from_slice(before.as_ref());
        } else if self.has_contacts() {
            self.left = Some(*state);
        }
        ended
    }

    fn has_contacts(&self) -> bool {
        let mut list = self.dynamics.tracked().iter();
        list.any(|tracked| tracked.tangent().is_some())
    }

    /// Whether an interaction was engaged or released since the last step.
    fn is_asked(&self) -> bool {
        let mut list = self.dynamics.tracked().iter();
        list.any(|tracked| tracked.status.is_asked)
    }

    /// The state after a step, by as many as there are modes that end.
    fn moved(&mut self, state: &State<P>, dt: S) -> Result<State<P>, Fault> {
        let start = self.time();
        let end = start + dt;
        let mut time = start;
        let scheme = self.scheme;
        let of_each = if self.has_contacts() {
            OF_CONTACTS
        } else {
            OF_EACH
        };
        let changes = CHANGES + of_each * self.dynamics.tracked().len();
        let (mut changed, mut paced) = (0, 0);
        let mut limit = None;
        // What is held has rates of round-off, which are none unless somebody has moved it.
        let goes_on = self.has_contacts() && self.left == Some(*state) && !self.is_asked();
        let dynamics = &mut self.dynamics;
        let mut next = dynamics.switched(start, state, !goes_on)?;
        while changed < changes && paced < PACES {
            let stop = end_of_step(dynamics.tracked(), (time, end), None);
            let stop = limit.map_or(stop, |limit| stop.min(time + limit));
            let length = if time == start && stop == end {
                dt
            } else {
                stop - time
            };
            let mut modes = Modes::of(dynamics, None, moment(Some(dt), dt, dt));
            begin_step(dynamics.tracked_mut());
            let step = StepWithin::take(scheme, dynamics, (time, &next), length);
            end_step(dynamics.tracked_mut());
            let step = match step {
                Err(fault)
                    if may_be_beyond(&fault) && length > S::constant(LEAST_HALVED) * time.ulp() =>
                {
                    (limit, paced) = (Some(S::constant(0.5) * length), paced + 1);
                    continue;
                }
                step => step?,
            };
            limit = limit.map(|limit| S::constant(2.0) * limit);
            let near = dynamics.bodies(&next);
            let mut within = Within {
                dynamics: &mut *dynamics,
                state_at: |at: S| {
                    if at == stop {
                        *step.end()
                    } else {
                        step.at((at - time).quotient(length))
                    }
                },
                since: time,
                near,
            };
            let found = first_root(&mut within, &mut modes, (time, stop), true)?;
            let (found, near) = (found.map(|found| found.time), within.near);
            let reached = found.unwrap_or(stop);
            next = if found.is_some() {
                step.at((reached - time).quotient(length))
            } else {
                *step.end()
            };
            dynamics.renormalise(&mut next, None);
            turns::copy(&near, &mut next);
            if let Some(held) = dynamics.held(reached, &next)? {
                next = held;
            }
            if found.is_none() && stop == end {
                return Ok(next);
            }
            let ends = dynamics
                .tracked()
                .iter()
                .any(|tracked| tracked.status.is_found);
            (changed, paced) = if ends {
                (changed + 1, 0)
            } else {
                (changed, paced + 1)
            };
            next = dynamics.switched(reached, &next, false)?;
            time = reached;
            if end - time <= time.ulp() {
                return Ok(next);
            }
        }
        let list = dynamics.tracked();
        Err(Fault::Mode(ModeFault::Endless {
            joint: list.first().map_or("", |first| first.interaction.name()),
            changes: changed,
            time: time.to_f64(),
        }))
    }
}

/// A step that is looked into.
struct Within<'s, P: Solvable, G> {
    dynamics: &'s mut Dynamics<P>,
    state_at: G,
    /// The last look (s), and the bodies there.
    since: P::Number,
    near: Bodies<P>,
}

impl<P, G> Interval<P::Number, P::Mechanism> for Within<'_, P, G>
where
    P: Solvable,
    G: Fn(P::Number) -> State<P>,
{
    fn equations(&mut self) -> &mut dyn Evaluate<P::Number, P::Mechanism> {
        self.dynamics
    }

    fn bodies_at(&mut self, time: P::Number) -> Result<Bodies<P>, Fault> {
        let (start, near) = (self.since, &self.near);
        let state = (self.state_at)(time);
        let (mut bodies, is_known) = self.dynamics.bodies_after(&state, (time - start, near));
        if !is_known {
            let at = |_: &mut &_, time| Ok((self.state_at)(time));
            bodies = bodies_by_halves(&*self.dynamics, (start, near), time, at)?;
        }
        Ok(with_unit_orientations::<P::Number, P::Mechanism>(&bodies))
    }

    fn look_from(&mut self, time: P::Number, bodies: Bodies<P>) {
        (self.since, self.near) = (time, bodies);
    }
}
