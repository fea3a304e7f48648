//! The integration of a run: from step to step, and from one end of its integration to the next.
//!
//! It knows nobody who looks on. A step is taken and looked into (`taken.rs`); then its end is
//! corrected, shown to the monitor and accepted (`commit.rs`).

use crate::integrate::{Counts, Method};
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::Monitor;
use crate::run::events::list::Hybrid;
use crate::run::passing::Passing;
use crate::run::post_step::PostStabilisation;
use crate::run::within::Looks;
use crate::stepping::marching::{Marching, Settings};

/// What a run moves, and what it remembers of the motion.
pub(crate) struct Driver<'r, S: Real, M: Mechanism> {
    /// What is integrated.
    pub(crate) march: &'r mut (dyn Marching<S, M> + 'r),
    pub(crate) settings: Settings<S>,
    /// What is done to states after steps and before reports.
    pub(crate) stabilisation: Option<&'r dyn PostStabilisation<S, M>>,
    /// Instants (s) at which the integration begins anew, in any order, besides those of the
    /// description.
    pub(crate) breaks: &'r [S],
    pub(crate) monitor: Option<Monitor<S, M>>,
    /// Events and controllers.
    pub(crate) hybrid: Hybrid<'r, S, M>,
    /// Lengths that pass through zero.
    pub(crate) passing: Passing<S>,
    /// Steps so far, and those since a state was shown.
    pub(crate) steps: usize,
    pub(crate) unseen: usize,
    pub(crate) counts: Counts,
    /// How fast (rad/s) a state moved that no correction could bring back.
    pub(crate) gone: Option<S>,
}

/// A step that was taken, and looked into for the monitor. In a place of its own over all steps, as
/// it is long and mostly empty.
pub(crate) struct Taken<S: Real, M: Mechanism> {
    /// When it ends (s).
    pub(crate) end: S,
    /// The first event within it.
    pub(crate) event: Option<StateAt<S, M>>,
    /// Where a rule of higher order would have led, where that is asked.
    pub(crate) better: Option<M::State<S>>,
    /// What has looked into it.
    pub(crate) looks: Looks,
}

impl<S: Real, M: Mechanism> Taken<S, M> {
    pub(crate) fn none() -> Self {
        Self {
            end: S::zero(),
            event: None,
            better: None,
            looks: Looks::NONE,
        }
    }
}

/// An integration that was begun.
#[derive(Clone, Copy)]
pub(crate) struct Begun<S> {
    /// When (s).
    pub(crate) start: S,
    /// What interpolants have evaluated for the monitor, which is no part of the run.
    pub(crate) of_monitor: usize,
}

impl<'r, S: Real, M: Mechanism> Driver<'r, S, M> {
    /// Before a run by a method, without a monitor.
    pub(crate) fn new<I: Method<S>>(
        march: &'r mut (dyn Marching<S, M> + 'r),
        integrator: &I,
        hybrid: Hybrid<'r, S, M>,
    ) -> Self {
        Self {
            settings: march.settings(),
            march,
            stabilisation: None,
            breaks: &[],
            monitor: None,
            hybrid,
            passing: Passing::by(integrator),
            steps: 0,
            unseen: 0,
            counts: Counts::default(),
            gone: None,
        }
    }

    /// With what is done to states after steps, and instants (s) at which integrations begin anew.
    pub(crate) fn stabilised_by(
        mut self,
        stabilisation: Option<&'r dyn PostStabilisation<S, M>>,
        breaks: &'r [S],
    ) -> Self {
        (self.stabilisation, self.breaks) = (stabilisation, breaks);
        self
    }
}
