//! A step of a [`Stepper`] that can be asked at any time within it.

use core::fmt::{self, Debug};

use crate::dynamics::{Bodies, Solvable, State};
use crate::error::{Fault, ReadingFault, StartFault, Unheeding};
use crate::integrate::{Scheme, StepWithin, System as _};
use crate::math::scalar::{Real as _, Scalar as _};
use crate::mechanism::orientations::with_unit_orientations;
use crate::run::stepper::{Stepper, Steps};
use crate::stepping::followed::bodies_by_halves;

/// A step that was taken by [`Stepper::step_dense`], for [`Stepper::within`].
pub struct DenseStep<P: Solvable, K: Scheme<P::Number>> {
    step: StepWithin<P::Number, State<P>, K>,
    start: P::Number,
    end: P::Number,
    near: Bodies<P>,
}

impl<P: Solvable, K: Scheme<P::Number>> DenseStep<P, K> {
    /// The state after a part of the step; its end as the step has it.
    pub(super) fn at(&self, part: P::Number) -> State<P> {
        if part == P::Number::one() {
            *self.step.end()
        } else {
            self.step.at(part)
        }
    }
}

/// The interval.
impl<P: Solvable, K: Scheme<P::Number>> Debug for DenseStep<P, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DenseStep")
            .field("start", &self.start)
            .field("end", &self.end)
            .finish_non_exhaustive()
    }
}

impl<P: Solvable, K: Steps<P>> Stepper<P, K> {
    /// Moves the state by one step of `dt` (s), and hands over the step, to be asked by
    /// [`Stepper::within`]. It needs no heap.
    ///
    /// It costs one evaluation more than [`Stepper::step`]
    /// ([`DormandPrince8`](crate::integrate::DormandPrince8) four).
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
    /// let mut stepper = rod.stepper(StandardLagrange, Rk4)?;
    /// let mut state = stepper.initial_state()?;
    /// let step = stepper.step_dense(&mut state, 0.01)?;
    /// let [early, late] = [stepper.within(&step, 0.002)?, stepper.within(&step, 0.008)?];
    /// let velocity = |bodies| Rod::velocity(bodies, Rod::HANDLES.rod).z;
    /// assert!(velocity(&late) < velocity(&early) && velocity(&early) < 0.0);
    /// assert!(stepper.within(&step, 0.02).is_err());
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step`], and [`StartFault::LimitsLeftOut`] of limits and other interactions.
    /// State and time are then as before.
    pub fn step_dense(
        &mut self,
        state: &mut State<P>,
        dt: P::Number,
    ) -> Result<DenseStep<P, K>, Fault> {
        let mut step = self.ahead(state, dt)?;
        let mut next = step.at(P::Number::one());
        self.dynamics.follow(state, dt, &mut next);
        self.end_step(state, next, dt)?;
        step.end = self.time();
        Ok(step)
    }

    /// A step of `dt` (s) from a state, which stays where it is.
    pub(super) fn ahead(
        &mut self,
        state: &State<P>,
        dt: P::Number,
    ) -> Result<DenseStep<P, K>, Fault> {
        if let Some(first) = self.dynamics.tracked().first() {
            return Err(Fault::Start(StartFault::LimitsLeftOut {
                joint: first.interaction.name(),
                by: Unheeding::DenseStep,
            }));
        }
        let start = self.time();
        self.checked(state, dt)?;
        let step = StepWithin::take(self.scheme, &mut self.dynamics, (start, state), dt)?;
        Ok(DenseStep {
            step,
            start,
            end: start + dt,
            near: self.dynamics.bodies(state),
        })
    }

    /// The bodies after a part of a step, with Euler parameters of length 1.
    pub(super) fn bodies_within(
        &self,
        step: &DenseStep<P, K>,
        part: P::Number,
    ) -> Result<Bodies<P>, Fault> {
        let time = part * (step.end - step.start);
        let (state, near) = (step.at(part), &step.near);
        let (mut bodies, is_known) = self.dynamics.bodies_after(&state, (time, near));
        if !is_known {
            let at =
                |_: &mut &_, time: P::Number| Ok(step.at(time.quotient(step.end - step.start)));
            bodies = bodies_by_halves(&self.dynamics, (P::Number::zero(), near), time, at)?;
        }
        Ok(with_unit_orientations::<P::Number, P::Mechanism>(&bodies))
    }

    /// The bodies at a time (s) within a step of this stepper, by the interpolant of the method:
    /// before a projection, which the end of the step has.
    ///
    /// # Errors
    /// [`ReadingFault::OutsideTrajectory`].
    pub fn within(&self, step: &DenseStep<P, K>, time: P::Number) -> Result<Bodies<P>, Fault> {
        if !(step.start <= time && time <= step.end) {
            return Err(Fault::Reading(ReadingFault::OutsideTrajectory {
                time: time.to_f64(),
                start: step.start.to_f64(),
                end: step.end.to_f64(),
            }));
        }
        let part = if time == step.end {
            P::Number::one()
        } else {
            (time - step.start).quotient(step.end - step.start)
        };
        self.bodies_within(step, part)
    }
}
