//! A run with observers: a driver, and whom its states are shown to.

use core::ops::ControlFlow;

use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::kernels::Mechanism;
use crate::run::companion::Companion;
use crate::run::driver::Driver;
use crate::run::output::Schedule;
use crate::run::sample::Sample;

/// A run under way.
pub(crate) struct Observed<'r, S: Real, M: Mechanism> {
    pub(crate) driver: Driver<'r, S, M>,
    pub(crate) schedule: Schedule<S>,
    /// A second run beside it.
    pub(crate) companion: Option<Companion<'r, S, M>>,
    pub(crate) log: Log<'r, S, M>,
}

/// Whom states are shown to. Behind a pointer, so that a run is compiled once for all observers.
pub(crate) type Observer<'o, S, M> = dyn FnMut(&Sample<'_, S, M>) -> ControlFlow<()> + 'o;

/// Shows states to the observer.
pub(crate) struct Log<'r, S: Real, M: Mechanism> {
    observe: &'r mut Observer<'r, S, M>,
    pub(crate) worst_violation: S,
    pub(crate) flow: ControlFlow<()>,
}

impl<'r, S: Real, M: Mechanism> Log<'r, S, M> {
    pub(crate) fn new(observe: &'r mut Observer<'r, S, M>) -> Self {
        Self {
            observe,
            worst_violation: S::zero(),
            flow: ControlFlow::Continue(()),
        }
    }

    /// Stops the run.
    pub(crate) fn stop(&mut self) {
        self.flow = ControlFlow::Break(());
    }
}

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
    /// Shows a state at a time (s) to the observer, beside that of the companion.
    pub(crate) fn show(&mut self, time: S, state: &M::State<S>) {
        let companion = self.companion.as_mut();
        let beside = companion.and_then(|companion| companion.compare(time, state));
        let equations = self.driver.march.equations();
        let view = View::new(equations.constants(), time, state);
        let log = &mut self.log;
        log.worst_violation = log.worst_violation.max(view.violation());
        log.flow = (log.observe)(&Sample::new(view, equations).beside(beside));
        self.driver.course.unseen = 0;
    }
}
