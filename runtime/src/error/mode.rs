//! Why no mode of an interaction is found, and no side of a law that switches.

use core::fmt;

use crate::error::readable::Given;

/// Why an interaction has no mode at an instant, or a law that switches no side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModeFault {
    /// No modes of interactions fit together at an instant.
    NoMode {
        /// The field of the joint or the point of one of them.
        joint: &'static str,
        /// The time (s).
        time: f64,
    },
    /// The modes of interactions change again and again at once.
    Endless {
        /// The field of the joint or the point of the last one.
        joint: &'static str,
        /// How often at once.
        changes: usize,
        /// The time (s).
        time: f64,
    },
    /// A driver moves a joint against its limit.
    DrivenAgainst {
        /// The field of the joint or the point with the limit.
        joint: &'static str,
        /// The field of the driver that moves now.
        driver: &'static str,
        /// Whether it is the upper one of its two limits.
        is_upper: bool,
        /// The time (s).
        time: f64,
    },
    /// Friction by the load of its joint has no effort while it slides, or several: what it adds to
    /// its own load, times its coefficient, reaches 1 (Painleve's paradox). Of a contact: no
    /// efforts fit all contacts that are closed, several do with different motions, or those of
    /// what slips go to infinity.
    NoUniqueFriction {
        /// The field of the joint or the point.
        joint: &'static str,
        /// The time (s).
        time: f64,
    },
    /// More contacts with friction are closed at once than all choices of their modes can be tried
    /// for: nine at rest in space, seven in a plane, fewer beside other interactions.
    TooManyContacts {
        /// The field of the body or the point of one of them.
        joint: &'static str,
        /// The time (s).
        time: f64,
    },
    /// Impulses with friction and a restitution would bring energy to the mechanism, as those of
    /// Newton's may (Kane's paradox).
    GainsEnergy {
        /// The field of the body or the point of one of the contacts.
        joint: &'static str,
        /// How much (J).
        gained: f64,
        /// The time (s).
        time: f64,
    },
    /// The factor of a capacity
    /// ([`Simulation::capacity_factor`](crate::Simulation::capacity_factor)) is negative or not
    /// finite.
    CapacityFactor {
        /// The field of the joint.
        joint: &'static str,
        /// The factor.
        factor: f64,
        /// The time (s).
        time: f64,
    },
    /// The load of a joint with friction by it is not determined. Equations of the joint depend on
    /// others, or what is held shares its efforts in a way that nothing decides.
    LoadNotUnique {
        /// The field of the joint.
        joint: &'static str,
    },
    /// A law slides along its switch: on both sides the motion leads back to it.
    SlidingLaw {
        /// The field of the force or state.
        law: &'static str,
        /// The expression whose sign decides.
        expression: &'static str,
        /// When (s).
        time: f64,
    },
    /// The expression whose sign decides in a law is not a number, or changes its sign too often to
    /// be followed.
    SwitchUndecided {
        /// The field of the force or state.
        law: &'static str,
        /// The expression.
        expression: &'static str,
        /// When (s).
        time: f64,
    },
}

impl fmt::Display for ModeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoMode { joint, time } => write!(
                f,
                "at {} s no choice of modes satisfies all interactions, that on `{joint}` among them: a stop or an engaged dog may hold what is driven, \
                 or numbers are out of range",
                Given(time)
            ),
            Self::Endless {
                joint,
                changes,
                time,
            } => write!(
                f,
                "the modes of interactions changed {changes} times within a moment at {} s, last on `{joint}`: take a stiction that is nearer \
                 to the capacity, a smoother curve, or a tighter tolerance",
                Given(time)
            ),
            Self::DrivenAgainst {
                joint,
                driver,
                is_upper,
                time,
            } => {
                let limit = if is_upper { "upper" } else { "lower" };
                write!(
                    f,
                    "at {} s driver `{driver}` moves `{joint}` on against its {limit} limit: no stop holds what is prescribed; end that motion before, drive by a force, or say `.without_limits()`",
                    Given(time)
                )
            }
            Self::NoUniqueFriction { joint, time } => write!(
                f,
                "at {} s the friction of `{joint}` by its load has no effort, or several (Painleve's paradox): what it adds to its own load, times its coefficient, \
                 reaches 1; take a smaller coefficient, a longer guide, or a spring and a damper that bear the load; of contacts that are closed at once, \
                 leave out those that others replace",
                Given(time)
            ),
            Self::TooManyContacts { joint, time } => write!(
                f,
                "at {} s too many contacts with friction are closed at once, that of `{joint}` among them: nine at rest are the most, seven in a plane; \
                 leave out contacts that bear nothing",
                Given(time)
            ),
            Self::GainsEnergy {
                joint,
                gained,
                time,
            } => write!(
                f,
                "at {} s the impact of `{joint}` would bring {} J to the mechanism: Newton's restitution may do so with friction (Kane's paradox); \
                 take `restitution_of_impulses`, or a smaller one",
                Given(time),
                Given(gained)
            ),
            Self::CapacityFactor {
                joint,
                factor,
                time,
            } => write!(
                f,
                "the factor of the capacity of the friction on `{joint}` is {} at {} s: it must be finite and not negative",
                Given(factor),
                Given(time)
            ),
            Self::LoadNotUnique { joint } => write!(
                f,
                "the load of `{joint}` is not determined, as friction by load asks for: its equations depend on others, or stops share what they hold; \
                 take joints whose equations are independent (`guide::redundant`), or `Interaction::friction` with a known capacity"
            ),
            Self::SlidingLaw {
                law,
                expression,
                time,
            } => write!(
                f,
                "the law of `{law}` holds `{expression}` at its zero from {} s on: on both sides the motion leads back to it, and a law has no value between; \
                 dry friction is `Interaction::friction`, a stop `Interaction::limits`, and a controller takes a `smooth_step` or its period",
                Given(time)
            ),
            Self::SwitchUndecided {
                law,
                expression,
                time,
            } => write!(
                f,
                "`{expression}` in the law of `{law}` is not a number at {} s, or changes its sign there more often than can be followed: use a smaller step, or a method that controls its steps",
                Given(time)
            ),
        }
    }
}

impl core::error::Error for ModeFault {}
