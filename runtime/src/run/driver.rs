//! The integration of a run: from step to step, and from one end of its integration to the next.
//!
//! It knows nobody who looks on. A step is taken and looked into (`taken.rs`); then its end is
//! corrected, shown to the monitor and accepted (`commit.rs`). Between two integrations an instant
//! is handled (`events/handling.rs`). Three lead a driver: a run with observers (`observed.rs`), a
//! companion beside it (`companion.rs`), and a user's own loop (`led.rs`).

use crate::integrate::{Counts, Method};
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::monitor::Monitor;
use crate::run::events::list::{Happenings, Hybrid};
use crate::run::events::switching::Switching;
use crate::run::leg::Begun;
use crate::run::passing::Passing;
use crate::run::post_step::PostStabilisation;
use crate::run::report::RunReport;
use crate::stepping::marching::{Marching, Settings};

/// What a run moves, with what it remembers of the motion.
pub(crate) struct Driver<'r, S: Real, M: Mechanism> {
    /// What is integrated.
    pub(crate) march: &'r mut (dyn Marching<S, M> + 'r),
    /// Events and controllers.
    pub(crate) list: &'r mut (dyn Happenings<S, M> + 'r),
    /// Laws that switch, where there are any.
    pub(crate) switching: Option<&'r mut Switching<S, M>>,
    /// What is done to states after steps and before reports.
    pub(crate) stabilisation: Option<&'r dyn PostStabilisation<S, M>>,
    /// Instants (s) at which the integration begins anew, in any order, besides those of the
    /// description.
    pub(crate) breaks: &'r [S],
    pub(crate) course: &'r mut Course<S, M>,
}

/// What a driver remembers of the motion.
pub(crate) struct Course<S: Real, M: Mechanism> {
    pub(crate) settings: Settings<S>,
    pub(crate) monitor: Option<Monitor<S, M>>,
    pub(crate) hybrid: Hybrid<S, M>,
    /// Lengths that pass through zero.
    pub(crate) passing: Passing<S>,
    /// Steps so far, and those since a state was shown.
    pub(crate) steps: usize,
    pub(crate) unseen: usize,
    pub(crate) counts: Counts,
    /// How fast (rad/s) a state moved that no correction could bring back.
    pub(crate) gone: Option<S>,
}

impl<S: Real, M: Mechanism> Course<S, M> {
    /// Before a run by a method.
    pub(crate) fn new<I: Method<S>>(
        settings: Settings<S>,
        integrator: &I,
        hybrid: Hybrid<S, M>,
        monitor: Option<Monitor<S, M>>,
    ) -> Self {
        Self {
            settings,
            monitor,
            hybrid,
            passing: Passing::by(integrator),
            steps: 0,
            unseen: 0,
            counts: Counts::default(),
            gone: None,
        }
    }
}

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// What the run has cost so far, with the integration under way.
    pub(crate) fn counts_with(&self, begun: &Begun<S>) -> Counts {
        let under_way = self.march.counts().without(begun.of_monitor);
        self.course.counts.plus(under_way)
    }

    /// What a run has come to, up to a state, with an integration under way if there is one.
    pub(crate) fn report(
        &self,
        under_way: Option<&Begun<S>>,
        At { time, bodies }: StateAt<S, M>,
    ) -> RunReport<S, M> {
        let equations = self.march.equations();
        let counts = match under_way {
            Some(begun) => self.counts_with(begun),
            None => self.course.counts,
        };
        let mut monitor = self.course.monitor;
        if let Some(monitor) = &mut monitor {
            equations.name_smallest_pivot(monitor);
            monitor.end(equations.constants(), time, &bodies);
        }
        RunReport {
            evaluations: counts.evaluations,
            accepted: counts.accepted,
            rejected: counts.rejected,
            worst_violation: S::zero(),
            iterations: equations.iterations(),
            time,
            state: bodies,
            stopped: false,
            verification: None,
            monitor,
        }
    }
}
