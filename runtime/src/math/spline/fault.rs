//! Why a table makes no spline.

/// Why a table makes no spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SplineFault {
    /// Fewer than two points, or fewer than three of a periodic spline.
    TooFewPoints,
    /// A knot, a value or a slope that is NaN or infinite.
    NotFinite,
    /// A knot that is not above the one before it.
    KnotsNotIncreasing,
    /// A periodic spline whose last value is not its first.
    EndsDiffer,
    /// Knots so close, or values so far apart, that slopes are beyond the range of numbers.
    OutOfRange,
}

impl SplineFault {
    /// What it is not, and what must be.
    #[doc(hidden)]
    #[must_use]
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::TooFewPoints => "no spline: it needs two points, three if it is periodic",
            Self::NotFinite => "no spline: its knots, values and slopes must be finite",
            Self::KnotsNotIncreasing => "no spline: each knot must be above the one before it",
            Self::EndsDiffer => "no spline: the last value of a periodic one must be its first",
            Self::OutOfRange => "no spline: its slopes must be within the range of numbers",
        }
    }
}
