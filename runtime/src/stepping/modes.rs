//! The modes of interactions as guards: the condition under which a mode ends.

use super::guard::{Guard, Guards, Visit};
use crate::dynamics::evaluate::Evaluate;
use crate::error::{Fault, StepFault};
use crate::integrate::Tolerance;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::jam::jammed;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Status;

/// The modes of all interactions.
pub(crate) struct Modes<S> {
    /// That of the method, where it has one.
    tolerance: Option<Tolerance<S>>,
    /// Within how long (s) the direction of slip that is led follows what drives it.
    moment: S,
    /// How many interactions there are.
    count: usize,
    /// When (s) the efforts were found that the statuses have.
    efforts_at: Option<S>,
}

/// When a step ends at the latest by the slip of one, as it was known at the last look; or where
/// slip is beyond its beginning, from which on it gives its direction itself.
struct Ahead<S> {
    number: usize,
    tolerance: Option<Tolerance<S>>,
}

/// The mode of one.
struct Mode<'m, S> {
    number: usize,
    moment: S,
    status: Option<Status<S>>,
    efforts_at: &'m mut Option<S>,
}

/// The instant at which friction on contacts jams: the run does not go on from there.
struct Jam<'m, S> {
    efforts_at: &'m mut Option<S>,
}

impl<S: Real> Modes<S> {
    pub(crate) fn of<M: Mechanism>(
        equations: &dyn Evaluate<S, M>,
        tolerance: Option<Tolerance<S>>,
        moment: S,
    ) -> Self {
        Self {
            tolerance,
            moment,
            count: equations.interactions().len(),
            efforts_at: None,
        }
    }
}

impl<S: Real, M: Mechanism> Guards<S, M> for Modes<S> {
    fn each(&mut self, visit: &mut Visit<'_, S, M>) -> Result<(), Fault> {
        // Others may have asked for efforts at other times since.
        self.efforts_at = None;
        visit(&mut Jam {
            efforts_at: &mut self.efforts_at,
        })?;
        for number in 0..self.count {
            visit(&mut Mode {
                number,
                moment: self.moment,
                status: None,
                efforts_at: &mut self.efforts_at,
            })?;
            visit(&mut Ahead {
                number,
                tolerance: self.tolerance,
            })?;
        }
        Ok(())
    }
}

impl<S: Real, M: Mechanism> Guard<S, M> for Mode<'_, S> {
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        know_efforts(self.efforts_at, equations, time, bodies)?;
        let Some(tracked) = equations.interactions().get(self.number) else {
            return Ok(S::one());
        };
        self.status = Some(tracked.status);
        let scene = Scene::<S, M> {
            constants: equations.constants(),
            time,
            bodies,
        };
        let value = tracked.reading(&scene);
        if let Some(status) = &mut self.status {
            let slip = tracked.slip_at(&scene, self.moment);
            (status.last_slip, status.last_pace) = (slip.direction, slip.pace);
            status.last_led = slip.led;
        }
        if value.to_f64().is_nan() {
            return Err(Fault::Step(StepFault::EventNotANumber {
                event: tracked.interaction.name(),
                time: time.to_f64(),
            }));
        }
        Ok(value)
    }

    fn is_passed(&self, value: S) -> bool {
        self.status.is_some_and(|status| status.is_met(value))
    }

    fn beyond(&self, value: S) -> S {
        self.status.map_or(value, |status| status.upwards(value))
    }

    fn keep(&mut self, equations: &mut dyn Evaluate<S, M>, value: S, _root: Option<S>) {
        if let Some(tracked) = equations.interactions_mut().get_mut(self.number) {
            tracked.status.reading = value;
            if let Some(status) = &self.status {
                tracked.status.last_slip = status.last_slip;
                tracked.status.last_pace = status.last_pace;
                tracked.status.last_led = status.last_led;
            }
        }
    }

    fn go_on(&mut self, equations: &mut dyn Evaluate<S, M>) {
        if let Some(tracked) = equations.interactions_mut().get_mut(self.number) {
            tracked.status.go_on();
        }
    }

    fn take(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        _time: S,
        value: S,
    ) -> Result<(), Fault> {
        let is_found = self.status.is_some_and(|status| status.is_met(value));
        if let Some(tracked) = equations.interactions_mut().get_mut(self.number) {
            tracked.status.is_found = is_found;
        }
        Ok(())
    }
}

/// Leaves efforts in the statuses, if they are not those of this time already. Of a time at which
/// the bodies were others they are old: it is then asked anew.
fn know_efforts<S: Real, M: Mechanism>(
    known_at: &mut Option<S>,
    equations: &mut dyn Evaluate<S, M>,
    time: S,
    bodies: &M::State<S>,
) -> Result<(), Fault> {
    let mut list = equations.interactions().iter();
    if *known_at != Some(time) && list.any(|tracked| tracked.mode().holds()) {
        equations.keep_efforts(time, bodies)?;
    }
    *known_at = Some(time);
    Ok(())
}

impl<S: Real, M: Mechanism> Guard<S, M> for Jam<'_, S> {
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        know_efforts(self.efforts_at, equations, time, bodies)?;
        let first = equations.interactions().first();
        Ok(first.map_or(S::one(), |first| first.status.before_jam()))
    }

    fn is_passed(&self, value: S) -> bool {
        value <= S::zero()
    }

    fn beyond(&self, value: S) -> S {
        -value
    }

    fn take(&mut self, equations: &mut dyn Evaluate<S, M>, time: S, value: S) -> Result<(), Fault> {
        if value <= S::zero() {
            return Err(jammed(equations.interactions(), time));
        }
        Ok(())
    }
}

impl<S: Real, M: Mechanism> Guard<S, M> for Ahead<S> {
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        let Some(tracked) = equations.interactions().get(self.number) else {
            return Ok(-S::one());
        };
        let scene = Scene::<S, M> {
            constants: equations.constants(),
            time,
            bodies,
        };
        let pace = tracked.status.known_pace;
        let until = pace.and_then(|pace| pace.end_of_step(self.tolerance));
        let beyond = until.map_or(-S::one(), |until| time - until);
        Ok(tracked.begun(&scene).unwrap_or(beyond))
    }

    fn is_passed(&self, value: S) -> bool {
        value >= S::zero()
    }

    fn beyond(&self, value: S) -> S {
        value
    }
}
