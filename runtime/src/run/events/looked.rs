//! A step that is looked into for the ends of modes of interactions.

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::status::Status;
use crate::run::events::root::{MOST, locate};

/// A step, with the bodies at any time within it.
pub(crate) trait Looked<S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// What is moved.
    fn looked(&self) -> &Dynamics<S, M, F, A, C>;

    /// The bodies at a time (s).
    fn bodies_at(&mut self, time: S) -> Result<M::State<S>, Fault>;

    /// Where the first mode of an interaction ends between two times, of which the bodies at the
    /// second are known.
    fn first_end_of_a_mode(
        &mut self,
        before: S,
        (time, bodies): (S, &M::State<S>),
    ) -> Result<Option<S>, Fault> {
        let mut first: Option<S> = None;
        self.looked().look_at_modes(time, bodies)?;
        let mut readings_are_old = false;
        for number in 0..self.looked().tracked().len() {
            if core::mem::take(&mut readings_are_old) {
                self.looked().look_at_modes(time, bodies)?;
            }
            let reading = self.looked().reading_of_mode(number, time, bodies)?;
            let Some(tracked) = self.looked().tracked().get(number) else {
                continue;
            };
            tracked.update(|status| status.reading = reading);
            let status = tracked.status.get();
            if !status.is_met(reading) {
                continue;
            }
            let read = |time: S| {
                let bodies = self.bodies_at(time)?;
                self.looked().look_at_modes(time, &bodies)?;
                let reading = self.looked().reading_of_mode(number, time, &bodies)?;
                Ok::<S, Fault>(status.upwards(reading))
            };
            readings_are_old = true;
            let root = locate((before, time), status.upwards(reading), read, MOST)?.plain();
            first = Some(first.map_or(root, |first| first.min(root)));
        }
        Ok(first)
    }

    /// No mode has ended up to the last look.
    fn modes_go_on(&mut self) {
        for tracked in self.looked().tracked() {
            tracked.update(Status::go_on);
        }
    }

    /// Marks the modes that end at a time.
    fn take_ends_of_modes(&mut self, time: S, bodies: &M::State<S>) -> Result<(), Fault> {
        self.looked().look_at_modes(time, bodies)?;
        for number in 0..self.looked().tracked().len() {
            let reading = self.looked().reading_of_mode(number, time, bodies)?;
            if let Some(tracked) = self.looked().tracked().get(number) {
                tracked.update(|status| status.is_found = status.is_met(reading));
            }
        }
        Ok(())
    }
}
