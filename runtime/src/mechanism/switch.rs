//! Where laws of a mechanism switch.

/// An expression in laws whose sign decides: of `sign`, `abs`, `min`, `max` or `if`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Switch {
    /// The force or the state whose law it stands in, the first one of several.
    pub law: &'static str,
    /// The expression, as it was written.
    pub expression: &'static str,
    /// Whether it depends on the time alone, besides parameters and inputs.
    pub is_of_time: bool,
    /// Whether every law that it stands in is continuous there, as those of `abs`, `min` and `max`
    /// are: such a law holds no mechanism at its switch.
    pub is_continuous: bool,
    /// The place of its side among the parameters.
    #[doc(hidden)]
    pub place: usize,
}
