//! What a generated mechanism is: its kernels, its report, its handles.
//!
//! `Mechanism` (`kernels.rs`) is the interface of generated code in absolute coordinates,
//! `JointCoordinates` (`joint_kernels.rs`) in joint coordinates. `Coordinates` (`coordinates.rs`)
//! is one interface to both, for all that solves, steps and runs. Compliances are one per row; the
//! three rows of a vector equation share one, so that the axes of a plan do not matter.

pub(crate) mod absolute;
pub(crate) mod at;
pub(crate) mod blocks;
pub(crate) mod bodies;
pub(crate) mod body;
pub(crate) mod by_rows;
pub(crate) mod coordinates;
pub(crate) mod handle;
mod joint_columns;
pub(crate) mod joint_kernels;
pub(crate) mod joint_rates;
pub(crate) mod joint_report;
pub(crate) mod kernels;
pub(crate) mod limits;
pub(crate) mod orientations;
pub(crate) mod pivot;
pub(crate) mod point;
pub(crate) mod readout;
pub(crate) mod relative;
pub(crate) mod report;
pub(crate) mod setpoint;
pub(crate) mod switch;
pub(crate) mod table;
pub(crate) mod terms;
pub(crate) mod traced;
pub(crate) mod turns;

pub use bodies::{Bodies, Joints};
pub use coordinates::{
    Absolute, ByAllRows, Coordinates, Equations, Evaluation, First, Prepared, Relative, RightSide,
};
pub use handle::{
    CountsTurns, Driven, Force, HasAngle, HasContact, HasDisplacement, HasTwoAngles, Joint,
    PointHandle, StateHandle, ValueHandle,
};
/// Makes a struct a part that mechanisms may have, once or several times, mirrored or turned:
/// [`guide::parts`](crate::guide::parts).
pub use holonom_macros::Assembly;
pub use joint_kernels::{Freedom, JointCounter, JointMotion, JointParts, JointReport};
pub use joint_rates::{
    HasCoriolis, HasGravity, HasInverse, HasJacobian, HasMassMatrix, JointRates,
};
pub use kernels::{
    Compliant, InputsOf, Pivot, Plain, Rigid, Stabilisation, Stabilised, StateOf, Terms,
};
#[doc(hidden)]
pub use kernels::{Normalised, Orientation};
#[doc(hidden)]
pub use limits::{JointLimits, Nothing, Several, Visit};
#[doc(hidden)]
pub use point::Place;
pub use point::{Located, Point};
pub use readout::{AngleParts, DisplacementParts, ForceParts};
pub use report::{
    Block, BodyInfo, BodyKind, Carrier, Comment, ElementPlace, ExplicitTime, ForceInfo, JointInfo,
    Kernel, Marker, MarkerKind, Operations, PointInfo, Rank, RedundantRow, Shape, ShapeKind,
    StateInfo, ValueInfo,
};
pub use setpoint::Setpoint;
pub use switch::Switch;
#[doc(hidden)]
pub use traced::{
    AtTime, QUARTER_OF_DOUBLE, QUARTER_OF_SINGLE, TURN_OF_DOUBLE, TURN_OF_SINGLE, TracedCoordinates,
};
