//! What a generated mechanism is: its kernels, its report, its handles.
//!
//! `Mechanism` (`kernels.rs`) is the interface of generated code in absolute coordinates,
//! `JointCoordinates` (`joint_kernels.rs`) in joint coordinates. Compliances are one per row; the
//! three rows of a vector equation share one, so that the axes of a plan do not matter.

pub(crate) mod blocks;
pub(crate) mod body;
pub(crate) mod handle;
pub(crate) mod joint_kernels;
pub(crate) mod joint_report;
pub(crate) mod kernels;
pub(crate) mod orientations;
pub(crate) mod readout;
pub(crate) mod report;

pub use handle::{CountsTurns, Driven, Force, HasAngle, HasDisplacement, Joint};
pub use joint_kernels::{
    Freedom, JointCounter, JointEvaluation, JointMotion, JointParts, JointReport,
};
pub use kernels::{
    Chapter15, Compliant, Evaluation, Normalised, Orientation, Pivot, Plain, Raw, Stabilisation,
    Stabilised, Terms,
};
pub use readout::{AngleParts, DisplacementParts, ForceParts};
pub use report::{
    Block, BodyInfo, BodyKind, Carrier, ExplicitTime, ForceInfo, JointInfo, Kernel, Operations,
    Rank, RedundantRow,
};
