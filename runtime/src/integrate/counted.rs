//! What an integration costs.

/// What an integration has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Evaluations of the rates.
    pub evaluations: usize,
    /// Steps that were accepted.
    pub accepted: usize,
    /// Steps that were tried and rejected.
    pub rejected: usize,
}

impl Counts {
    /// These without so many evaluations.
    pub(crate) fn without(self, evaluations: usize) -> Self {
        Self {
            evaluations: self.evaluations.saturating_sub(evaluations),
            ..self
        }
    }

    /// These and those of an integration that went on.
    pub(crate) fn plus(self, more: Self) -> Self {
        Self {
            evaluations: self.evaluations.saturating_add(more.evaluations),
            accepted: self.accepted.saturating_add(more.accepted),
            rejected: self.rejected.saturating_add(more.rejected),
        }
    }
}
