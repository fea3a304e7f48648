//! Methods with control of their steps: what a user says of them.

use crate::math::scalar::Real;

/// The largest step by default, as a part of the interval.
pub(super) const OF_DURATION: f64 = 0.1;

/// What a step control is held to besides its tolerance. Nothing of it is set by default but the
/// budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits<S> {
    /// The first step (s), in the place of that of the control.
    pub first: Option<S>,
    /// The smallest step (s): where a smaller one would be needed, the integration ends with
    /// [`StepFault::SizeUnderflow`](crate::error::StepFault::SizeUnderflow). Never below the
    /// resolution of the time.
    pub least: Option<S>,
    /// The largest step (s), in the place of a tenth of the interval. What happens within a step
    /// and leaves no trace at its stages, such as a short pulse of a force, is not seen: a step
    /// must not be longer than that.
    pub largest: Option<S>,
    /// How many evaluations a run may take, [`StepLimits::EVALUATIONS`] by default: then it ends
    /// with [`StepFault::Budget`](crate::error::StepFault::Budget).
    pub evaluations: usize,
}

impl<S> StepLimits<S> {
    /// Ten million evaluations. What takes more is most often caught at a singular configuration,
    /// or stiff.
    pub const EVALUATIONS: usize = 10_000_000;

    /// No limits but the budget of evaluations.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            first: None,
            least: None,
            largest: None,
            evaluations: Self::EVALUATIONS,
        }
    }
}

impl<S: Real> StepLimits<S> {
    /// The parts of an interval that a companion looks into at least.
    const LOOKS: f64 = 256.0;

    /// Those over a part of an interval of so many seconds.
    pub(super) fn for_duration(self, duration: S) -> Self {
        Self {
            largest: self.largest.or(Some(S::constant(OF_DURATION) * duration)),
            ..self
        }
    }

    /// Those of a companion over an interval of so many seconds.
    pub(super) fn of_companion(self, duration: S) -> Self {
        let look = duration * S::constant(Self::LOOKS.recip());
        Self {
            first: None,
            largest: Some(self.largest.map_or(look, |largest| largest.min(look))),
            ..self
        }
    }
}

impl<S> Default for StepLimits<S> {
    fn default() -> Self {
        Self::new()
    }
}

/// What a user says of the steps of a method with [`StepLimits`].
macro_rules! step_limits {
    ($method:ident<$($parameter:ident),*>) => {
        impl<$($parameter),*> $method<$($parameter),*> {
            /// Begins with this step (s).
            #[must_use]
            pub fn first_step(mut self, step: S) -> Self {
                self.limits.first = Some(step);
                self
            }

            /// Takes no step shorter than this (s); see
            /// [`StepLimits::least`](crate::integrate::StepLimits::least).
            #[must_use]
            pub fn least_step(mut self, step: S) -> Self {
                self.limits.least = Some(step);
                self
            }

            /// Takes no step longer than this (s); see
            /// [`StepLimits::largest`](crate::integrate::StepLimits::largest).
            #[must_use]
            pub fn largest_step(mut self, step: S) -> Self {
                self.limits.largest = Some(step);
                self
            }

            /// Lets a run take so many evaluations; see
            /// [`StepLimits::evaluations`](crate::integrate::StepLimits::evaluations).
            #[must_use]
            pub fn budget(mut self, evaluations: usize) -> Self {
                self.limits.evaluations = evaluations;
                self
            }
        }
    };
}
pub(super) use step_limits;

/// What a [`Method`](crate::integrate::Method) with a tolerance and limits of steps tells of them.
macro_rules! hooks_of_control {
    ($S:ident) => {
        fn tolerance(&self) -> Option<$crate::Tolerance<$S>> {
            Some(self.tolerance)
        }

        fn for_length(&self, length: $S) -> Self {
            Self {
                tolerance: self.tolerance.for_length(length),
                ..*self
            }
        }

        fn for_duration(&self, duration: $S) -> Self {
            Self {
                limits: self.limits.for_duration(duration),
                ..*self
            }
        }
    };
}
pub(super) use hooks_of_control;

/// A method whose settings are a tolerance and limits of steps, with its integration.
macro_rules! controlled {
    ($(#[$attribute:meta])* $method:ident, $integration:ident $(, $estimate_power:expr)?) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $method<S> {
            /// The error to be allowed in a step.
            pub tolerance: $crate::Tolerance<S>,
            /// What steps are held to besides.
            pub limits: $crate::integrate::StepLimits<S>,
        }

        $crate::integrate::controlled::step_limits!($method<S>);

        impl<S> $method<S> {
            /// The method with a tolerance.
            #[must_use]
            pub const fn new(tolerance: $crate::Tolerance<S>) -> Self {
                Self {
                    tolerance,
                    limits: $crate::integrate::StepLimits::new(),
                }
            }
        }

        /// With the default [`Tolerance`](crate::Tolerance).
        impl<S: $crate::Real> Default for $method<S> {
            fn default() -> Self {
                Self::new($crate::Tolerance::default())
            }
        }

        impl<S: $crate::Real, Y: $crate::integrate::System<S>> $crate::integrate::Integrator<S, Y>
            for $method<S>
        {
            type Integration = $integration<S, Y::State>;

            fn start(
                &self,
                system: &mut Y,
                span: $crate::integrate::TimeSpan<S>,
                state: Y::State,
            ) -> Result<$integration<S, Y::State>, $crate::Fault> {
                $integration::start(self, system, span, state)
            }
        }

        impl<S: $crate::Real> $crate::integrate::Method<S> for $method<S> {
            fn budget(&self) -> Option<usize> {
                Some(self.limits.evaluations)
            }

            $(fn error_model(&self) -> $crate::integrate::ErrorModel {
                $crate::integrate::ErrorModel {
                    estimate_power: $estimate_power,
                    ..Default::default()
                }
            })?

            $crate::integrate::controlled::hooks_of_control!(S);

            fn companion(&self, duration: S) -> Option<Self> {
                Some(Self {
                    tolerance: self.tolerance.of_companion(),
                    limits: self.limits.of_companion(duration),
                })
            }
        }
    };
}
pub(super) use controlled;
