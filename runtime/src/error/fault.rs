//! What can go wrong at run time: a family of faults for each operation. Small enums, no strings;
//! the last good state travels with them.

use core::fmt;

use crate::error::analysis::AnalysisFault;
use crate::error::assembly::AssemblyFault;
use crate::error::checkpoint::CheckpointFault;
use crate::error::mode::ModeFault;
use crate::error::parameter::ParameterError;
use crate::error::reading::ReadingFault;
use crate::error::start::StartFault;
use crate::error::step::StepFault;

/// Why something could not be done, by what was done: each variant holds a family of faults.
///
/// What can fail for one reason alone returns the family, and `?` makes a `Fault` of it.
///
/// `{:?}` is the sentence of `Display`, for a `main` that returns the error. `{:#?}` has the
/// fields.
///
/// ```
/// use holonom::{Fault, error::StepFault};
///
/// fn depends(fault: Fault) -> Option<&'static str> {
///     match fault {
///         Fault::Step(StepFault::Singular { name, .. }) => Some(name),
///         _ => None,
///     }
/// }
/// let fault = StepFault::Singular { joint: 0, name: "crank", relative_pivot: 0.0 };
/// assert_eq!(depends(fault.into()), Some("crank"));
/// ```
#[derive(Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// A run, a step or an analysis cannot be done as it was asked for.
    Start(StartFault),
    /// An evaluation, a correction or a step could not be done.
    Step(StepFault),
    /// An interaction has no mode at an instant, or a law that switches no side.
    Mode(ModeFault),
    /// A joint cannot be set as it was asked for, or a configuration is none of the mechanism.
    Assembly(AssemblyFault),
    /// A reading has no value.
    Reading(ReadingFault),
    /// Coordinates cannot be chosen, or have no such equations or equilibrium; a kinematic analysis
    /// does not go on.
    Analysis(AnalysisFault),
    /// A checkpoint cannot be made, or a run cannot go on from it.
    Checkpoint(CheckpointFault),
    /// A parameter of the mechanism is not acceptable.
    Parameter(ParameterError),
}

macro_rules! families {
    ($($variant:ident($family:ty)),+ $(,)?) => {
        impl Fault {
            /// The family, with the name of its variant.
            fn family(&self) -> (&'static str, &(dyn core::error::Error + 'static)) {
                match self {
                    $(Self::$variant(family) => (stringify!($variant), family),)+
                }
            }
        }

        $(
            impl From<$family> for Fault {
                fn from(family: $family) -> Self {
                    Self::$variant(family)
                }
            }
        )+
    };
}

families! {
    Start(StartFault),
    Step(StepFault),
    Mode(ModeFault),
    Assembly(AssemblyFault),
    Reading(ReadingFault),
    Analysis(AnalysisFault),
    Checkpoint(CheckpointFault),
    Parameter(ParameterError),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self.family().1, f)
    }
}

impl fmt::Debug for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, family) = self.family();
        if f.alternate() {
            f.debug_tuple(name).field(&family).finish()
        } else {
            fmt::Display::fmt(family, f)
        }
    }
}

/// No source: the sentence is that of the family, and a chain of sources would say it twice.
impl core::error::Error for Fault {}
