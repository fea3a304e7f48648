//! Why a mechanism is not exported.

use std::error::Error;
use std::path::Path;
use std::{fmt, io};

use holonom::Fault;
use holonom::error::StartFault;

/// Why a mechanism, or a function of it, is not exported.
#[derive(Debug)]
#[non_exhaustive]
pub enum ExportError {
    /// The mechanism or its start was refused.
    Mechanism(Fault),
    /// A joint is open at the start, or its bodies move against it: a run would refuse that.
    /// [`Export::assembled`](crate::Export::assembled) corrects a described start,
    /// [`Export::starting_from`](crate::Export::starting_from) sets another one.
    Open(StartFault),
    /// The formulation iterates: [`AugmentedLagrangian`](holonom::AugmentedLagrangian) solves its
    /// system as often as the numbers ask for, the others once.
    Formulation,
    /// What a metre or a radian is in an equation depends on a parameter or an input, and with it
    /// the compliance of a [`Penalty`](holonom::Penalty).
    Compliance,
    /// Limits of an angle that are a turn or more apart: a state in C counts no turns, so a step
    /// cannot heed them. [`Export::without_limits`](crate::Export::without_limits) passes them.
    Limits {
        /// The field of the joint.
        joint: &'static str,
    },
    /// A kernel that the mechanism was not asked for.
    Kernel {
        /// Its word in `kernels = [..]`.
        kernel: &'static str,
    },
    /// Two numbers were compared in the function of this name, so that what it computes depends on
    /// what they are.
    Comparison {
        /// The function.
        function: String,
    },
    /// Nothing of the mechanism moves, in the coordinates that were asked for.
    Still,
    /// Two functions, or a function and a struct, of one name.
    Name {
        /// The name.
        name: String,
    },
    /// [`Export::about`](crate::Export::about) names neither a parameter nor an input.
    Member {
        /// The name.
        name: String,
    },
    /// A projection in joint coordinates that keep an equation which the bodies leave out: its
    /// violation is not known. `redundant = "drop"` may drop other rows of a joint in each of the
    /// coordinates. `project` is there in absolute coordinates.
    Projection,
    /// A rollout of a program without a step: see [`Export::step`](crate::Export::step).
    Step,
    /// A file or folder that cannot be written: its path and why.
    File(io::Error),
}

impl fmt::Display for ExportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mechanism(fault) => fault.fmt(f),
            Self::Open(fault) => {
                // What corrects it is another method than that of a run.
                let text = fault.to_string();
                let open = text.split_once(" at the start").map_or(&*text, |(open, _)| open);
                write!(
                    f,
                    "{open} at the start: `.assembled(&mechanism)` corrects the described start, `.starting_from(&mechanism, &state)` sets another one"
                )
            }
            Self::Formulation => f.write_str(
                "this formulation iterates: export with `StandardLagrange`, `Baumgarte` or `Penalty`",
            ),
            Self::Compliance => f.write_str(
                "compliances of equations follow from lengths, and a parameter or an input is one of these: export with `StandardLagrange` or `Baumgarte`, or write lengths as numbers",
            ),
            Self::Limits { joint } => write!(
                f,
                "the limits of joint `{joint}` are a turn or more apart, and states in C count no turns: say `.without_limits()` to pass them"
            ),
            Self::Kernel { kernel } => write!(
                f,
                "the mechanism has no kernel `{kernel}`: write `kernels = [{kernel}]` above the struct, beside the kernels that are there"
            ),
            Self::Comparison { function } => write!(
                f,
                "`{function}` compares numbers: what is exported has no branch on them; use `select` in the place of a comparison"
            ),
            Self::Still => f.write_str("nothing of the mechanism moves: there are no rates to write"),
            Self::Name { name } => write!(f, "the name `{name}` is given twice"),
            Self::Member { name } => {
                write!(f, "there is no parameter and no input `{name}`")
            }
            Self::Projection => f.write_str(
                "an equation of these coordinates is none of the bodies: `project` is there in absolute coordinates",
            ),
            Self::Step => f.write_str("a rollout takes steps: say `.step(Rk4)` before `.cuda()`"),
            Self::File(error) => error.fmt(f),
        }
    }
}

impl Error for ExportError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Mechanism(fault) => Some(fault),
            Self::Open(fault) => Some(fault),
            Self::File(error) => Some(error),
            _ => None,
        }
    }
}

impl ExportError {
    /// Why a start is refused.
    pub(crate) fn of_start(fault: Fault) -> Self {
        match fault {
            Fault::Start(open @ StartFault::Inconsistent { .. }) => Self::Open(open),
            other => Self::Mechanism(other),
        }
    }
}

impl ExportError {
    /// A file or folder that cannot be written, with its path.
    pub(crate) fn of_file(path: &Path, error: &io::Error) -> Self {
        let text = format!("`{}`: {error}", path.display());
        Self::File(io::Error::new(error.kind(), text))
    }
}

impl From<Fault> for ExportError {
    fn from(fault: Fault) -> Self {
        Self::Mechanism(fault)
    }
}

impl From<holonom::ParameterError> for ExportError {
    fn from(fault: holonom::ParameterError) -> Self {
        Self::Mechanism(fault.into())
    }
}

impl From<io::Error> for ExportError {
    fn from(error: io::Error) -> Self {
        Self::File(error)
    }
}
