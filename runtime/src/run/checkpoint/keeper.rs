//! What is done with checkpoints.

use core::ops::ControlFlow;

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::run::checkpoint::Checkpoint;
use crate::run::events::list::Happening;
use crate::run::output::IntoFlow;

/// A closure for checkpoints, see [`Simulation::checkpoints`](crate::Simulation::checkpoints).
#[derive(Clone, Debug)]
pub struct Keeping<K> {
    /// After how many steps it is called.
    pub(crate) steps: usize,
    pub(crate) keep: K,
}

impl<S, M, K, R> Happening<S, M> for Keeping<K>
where
    S: Real,
    M: Mechanism,
    K: FnMut(&Checkpoint<M, S>) -> R,
    R: IntoFlow,
    R::Failure: Into<Fault>,
{
    fn steps_to_keep(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn keep(&mut self, checkpoint: &Checkpoint<M, S>) -> Result<ControlFlow<()>, Fault> {
        (self.keep)(checkpoint).into_flow().map_err(Into::into)
    }
}
