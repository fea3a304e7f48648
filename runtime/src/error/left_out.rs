//! What leaves out a part of a mechanism.

/// What knows the motion of bodies alone, and no states of the user's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LeavesOut {
    /// A method that moves bodies alone: [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    StepMethod,
    /// A [`KinematicAnalysis`](crate::KinematicAnalysis), which integrates nothing.
    Kinematics,
    /// A linearisation, an equilibrium, a trim or a continuation in chosen coordinates.
    Linearisation,
}

/// What does not heed limits and other interactions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unheeding {
    /// A step that is looked into, by [`Stepper::step_dense`](crate::Stepper::step_dense) or
    /// [`Stepper::step_until`](crate::Stepper::step_until).
    DenseStep,
    /// An [`Ensemble`](crate::lanes::Ensemble).
    Ensemble,
    /// Runs that carry derivatives, and gradients.
    Derivatives,
}
