//! A relay with hysteresis: a reading with two thresholds, and which of them it has passed last.

use core::ops::ControlFlow;

use crate::error::Fault;
use crate::error::setting::positive;
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::run::events::context::Event;
use crate::run::events::list::{Happening, Phase};
use crate::run::output::IntoFlow;
use crate::run::sample::Sample;
use crate::stepping::watch::{Crossing, Watch};

/// A relay with its handler, see [`Simulation::relay`](crate::Simulation::relay).
///
/// Its watch looks at the distance from the threshold that is next. The sign of that is the side of
/// the relay, before and behind an event, although the distance jumps there.
#[derive(Clone, Debug)]
pub struct Relay<S, G, H> {
    watch: Watch<S>,
    thresholds: [S; 2],
    reading: G,
    handler: H,
    is_high: bool,
    /// Whether the handler was told on which side the run begins.
    has_begun: bool,
    /// Whether its event is handled now.
    is_event: bool,
}

impl<S: Real, G, H> Relay<S, G, H> {
    pub(super) fn new(name: &'static str, thresholds: [S; 2], reading: G, handler: H) -> Self {
        Self {
            watch: Watch::new(name, Crossing::Either),
            thresholds,
            reading,
            handler,
            is_high: false,
            has_begun: false,
            is_event: false,
        }
    }

    /// The threshold that is next.
    fn next(&self) -> S {
        let [low, high] = self.thresholds;
        if self.is_high { low } else { high }
    }
}

impl<S, M, G, H, R> Happening<S, M> for Relay<S, G, H>
where
    S: Real,
    M: Mechanism,
    G: Fn(&Sample<'_, S, M>) -> S,
    H: FnMut(&mut Event<'_, S, M>, bool) -> R,
    R: IntoFlow,
    R::Failure: Into<Fault>,
{
    fn begin(&mut self, _start: S) -> Result<(), Fault> {
        let [low, high] = self.thresholds.map(Real::to_f64);
        positive("upper less lower threshold of a relay", high - low)?;
        (self.is_high, self.has_begun) = (false, false);
        Ok(())
    }

    fn due(&mut self, _time: S, phase: Phase<S>) -> Option<&'static str> {
        let root = self.watch.root();
        self.is_event = root.is_some_and(|root| phase == Phase::Handlers(root));
        let is_due = self.is_event || phase == Phase::Relays;
        is_due.then(|| self.watch.name())
    }

    fn watch(&mut self) -> Option<&mut Watch<S>> {
        Some(&mut self.watch)
    }

    fn read(&self, sample: &Sample<'_, S, M>) -> S {
        (self.reading)(sample) - self.next()
    }

    fn act(&mut self, event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> {
        // Of an event the last digits say nothing.
        let is_high = if self.is_event {
            !self.is_high
        } else {
            let beyond = (self.reading)(event) - self.next();
            let beyond = self.watch.checked(event.time(), beyond)?;
            beyond > S::zero() || !self.is_high && beyond == S::zero()
        };
        if is_high == self.is_high && self.has_begun {
            return Ok(ControlFlow::Continue(()));
        }
        (self.is_high, self.has_begun) = (is_high, true);
        (self.handler)(event, is_high)
            .into_flow()
            .map_err(Into::into)
    }

    fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let [low, high] = self.thresholds;
        memory.same(low);
        memory.same(high);
        memory.flag(&mut self.is_high);
        memory.flag(&mut self.has_begun);
    }
}
