//! The first event within a step of a [`Stepper`].

use crate::dynamics::{Solvable, State};
use crate::error::Fault;
use crate::math::scalar::{Real as _, Scalar as _};
use crate::measure::view::View;
use crate::mechanism::turns;
use crate::run::events::sizes::{round_off, shaken};
use crate::run::stepper::{Stepper, Steps};
use crate::stepping::locate::locate;
use crate::stepping::watch::{Crossing, Reading, Watch, looks};

/// The part of a step after which the motion says on which side of zero a reading is.
const FIRST_LOOK: f64 = 1.0 / 1_048_576.0;

/// How often a bracket is divided at the most: some eight times would do.
const MOST: usize = 48;

impl<P: Solvable, K: Steps<P>> Stepper<P, K> {
    /// Moves the state by one step of `dt` (s), or to where a reading first passes zero within it.
    /// The time (s) of that, which [`Stepper::time`] then is; `None` after a whole step.
    ///
    /// The zero is located on the interpolant of the method, to some units in the last place of the
    /// time. The step costs one evaluation more than [`Stepper::step`]
    /// ([`DormandPrince8`](crate::integrate::DormandPrince8) four), and at most 66 interpolations
    /// with a reading each. Two zeros within a sixth of the step may be missed.
    ///
    /// A step that begins at a zero, to round-off, does not end there: the motion says on which
    /// side the reading is. So after an event you change the state and go on.
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
    /// let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    /// let mut stepper = rod.stepper(StandardLagrange, Rk4)?;
    /// let mut state = stepper.initial_state()?;
    /// for period in 1..=100 {
    ///     let end = 0.01 * f64::from(period);
    ///     let stop = |view: &View<'_, f64, Rod>| view.angle(hinge) + 1.0;
    ///     let left = end - stepper.time();
    ///     if stepper.step_until(&mut state, left, Crossing::Falling, stop)?.is_some() {
    ///         let mut bodies = stepper.bodies(&state);
    ///         let rate = stepper.view(&bodies).angle_rate(hinge);
    ///         rod.set_angle_rate(&mut bodies, hinge, 0.5 * rate.abs())?;
    ///         state = stepper.state_of(&bodies)?;
    ///         stepper.step(&mut state, end - stepper.time())?;
    ///     }
    /// }
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step_dense`], and
    /// [`StepFault::EventNotANumber`](crate::error::StepFault::EventNotANumber) of a reading. State
    /// and time are then as before.
    pub fn step_until(
        &mut self,
        state: &mut State<P>,
        dt: P::Number,
        crossing: Crossing,
        reading: impl Fn(&View<'_, P::Number, P::Mechanism>) -> P::Number,
    ) -> Result<Option<P::Number>, Fault> {
        let time = self.time();
        let step = self.ahead(state, dt)?;
        let watch = Watch::new("the end of a step", crossing);
        let read = |part: P::Number| {
            let bodies = self.bodies_within(&step, part)?;
            let time = part.fused(dt, time);
            watch.checked(time, reading(&self.dynamics.view(time, &bodies)))
        };
        let mut sign = watch;
        let (zero, one) = (P::Number::zero(), P::Number::one());
        let first = P::Number::constant(FIRST_LOOK);
        let here = read(zero)?;
        let start = self.bodies_within(&step, zero)?;
        let beside = [1.0, -1.0].map(|way| {
            let constants = self.dynamics.constants();
            let (time, bodies) = shaken::<P::Number, P::Mechanism>(constants, time, &start, way);
            reading(&self.dynamics.view(time, &bodies))
        });
        sign.begin(Reading {
            here,
            ahead: read(first)?,
            round_off: round_off(here, beside),
        });
        let mut before = zero;
        let mut found = None;
        for part in looks(zero, one, true) {
            let now = read(part)?;
            if sign.is_met(now) {
                let upwards = |part: P::Number| Ok::<_, Fault>(sign.upwards(read(part)?));
                let root = locate((before, part), sign.upwards(now), upwards, MOST)?;
                found = Some(root.plain());
                break;
            }
            sign.pass(now);
            before = part;
        }
        let part = found.unwrap_or(one);
        let mut next = step.at(part);
        turns::copy(&self.bodies_within(&step, part)?, &mut next);
        self.end_step(state, next, part * dt)?;
        Ok(found.map(|_| self.time()))
    }
}
