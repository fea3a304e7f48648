//! Joints, written with [`joint!`](crate::joint!) as a user would write them.
//!
//! | joint | bodies | equations | what is left |
//! |---|---|---|---|
//! | [`Spherical`] | i, j | 3 | three rotations about a point |
//! | [`Revolute`] | i, j | 5 | a rotation about an axis |
//! | [`Universal`] | i, j | 4 | two rotations about the arms of a cross |
//! | [`Cylindrical`] | i, j | 4 | rotation about and translation along an axis |
//! | [`Prismatic`] | i, j | 5 | a translation along an axis |
//! | [`Fixed`] | i, j | 6 | nothing |
//! | [`Planar`] | i, j | 3 | motion in a plane |
//! | [`Distance`] | i, j | 1 | all but the distance of two points |
//! | [`RevoluteSpherical`] | i, j | 2 | a massless link, hinge and ball |
//! | [`RevoluteRevolute`] | i, j | 4 | a massless link, two parallel hinges |
//! | [`PointOnLine`] | i, j | 2 | a point runs along a line |
//! | [`PointOnPlane`] | i, j | 1 | a point moves in a plane |
//! | [`ConstantVelocity`] | i, j | 4 | two rotations; shafts turn alike |
//! | [`Screw`] | i, j | 5 | rotation and translation in proportion |
//! | [`Gear`] | i, j, carrier k | 1 | two angles in proportion |
//! | [`RackAndPinion`] | pinion i, rack j, carrier k | 1 | an angle and a displacement in proportion |
//! | [`RollingWheel`] | plane i, wheel j | 3, of which 2 of velocities | leaning, steering and rolling |
//! | [`RollingBall`] | plane i, ball j | 3, of which 2 of velocities | rolling and spinning |
//! | [`RollingBallInBowl`] | bowl i, ball j | 3, of which 2 of velocities | rolling and spinning |
//! | [`WheelPair`] | plane i, wheels j, k | 5, of which 3 of velocities | driving and turning |
//! | [`RollingPair`] | i, j, carrier k | 1 of velocities | two rates in proportion |
//! | [`KnifeEdge`] | i, j | 1 of velocities | all but a movement sideways |
//! | [`Perpendicular1`], [`Perpendicular2`] | i, j | 1 | constraints between two vectors |
//! | [`Parallel1`], [`Parallel2`] | i, j | 2 | constraints between two vectors |
//! | [`AngleDriver`], [`DistanceDriver`], [`DisplacementDriver`] | i, j | 1 | a coordinate as a function of time |
//! | [`OrientationDriver`] | i, j | 3 | an orientation as a function of time |
//!
//! Axes, parameters, zeros and signs of all of them stand on one page of the guide,
//! [`guide::reference`](mod@crate::guide::reference). Equations say what two bodies may do against
//! each other; joints on top of a chain that forbids it already are redundant, see
//! [`guide::redundant`](crate::guide::redundant). Reactions are reduced to the first point of the
//! joint, on either body.
//!
//! All of them are in the prelude.

mod constant_velocity;
mod cylindrical;
mod distance;
mod drivers;
mod fixed;
mod gears;
mod links;
mod planar;
mod points;
mod prismatic;
mod revolute;
mod rolling;
mod screw;
mod spherical;
mod universal;
mod vectors;

pub use constant_velocity::*;
pub use cylindrical::*;
pub use distance::*;
pub use drivers::*;
pub use fixed::*;
pub use gears::*;
pub use links::*;
pub use planar::*;
pub use points::*;
pub use prismatic::*;
pub use revolute::*;
pub use rolling::*;
pub use screw::*;
pub use spherical::*;
pub use universal::*;
pub use vectors::*;
