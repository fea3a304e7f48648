//! Why a slider cannot be where it was moved to.

use std::{error, fmt};

use holonom::Fault;

/// Why a slider cannot be where it was moved to, or a run cannot begin.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refused {
    /// There is no start with the present values.
    Start(Fault),
    /// A parameter or an input.
    Value {
        /// The slider.
        name: String,
        /// Where it was moved to.
        value: f64,
        /// Why it cannot be there.
        fault: Fault,
    },
    /// A coordinate at the start is another one once the loops are closed.
    NotKept {
        /// The joint.
        joint: String,
        /// What it was set to (rad, m).
        set: f64,
        /// What it is (rad, m).
        found: f64,
    },
    /// The value is NaN or infinite.
    NotFinite {
        /// The slider.
        name: String,
    },
    /// There is no such slider.
    NoSlider {
        /// Its place.
        place: usize,
        /// How many there are.
        sliders: usize,
    },
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start(fault) => write!(f, "no start: {fault}"),
            Self::Value { name, value, fault } => write!(f, "{name} = {value}: {fault}"),
            Self::NotKept { joint, set, found } => write!(
                f,
                "joint `{joint}` was to start at {set}, and the closed loops have it at {found}"
            ),
            Self::NotFinite { name } => write!(f, "{name} must be finite"),
            Self::NoSlider { place, sliders } => {
                write!(f, "slider {place} was moved, of {sliders}, counted from 0")
            }
        }
    }
}

impl error::Error for Refused {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Start(fault) | Self::Value { fault, .. } => Some(fault),
            _ => None,
        }
    }
}

impl From<Fault> for Refused {
    fn from(fault: Fault) -> Self {
        Self::Start(fault)
    }
}
