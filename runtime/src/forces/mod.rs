//! Forces, written with [`force!`](crate::force!) as a user would write them.
//!
//! | force | bodies | what it does |
//! |---|---|---|
//! | [`SpringDamper`] | i, j | spring and damper between two points |
//! | [`TorsionalSpringDamper`] | i, j | spring and damper on an angle |
//! | [`RotationalDamper`] | i, j | a damper against all rotation, as in a ball joint |
//! | [`Actuator`] | i, j | a force along the line of two points, any function of length, rate and time |
//! | [`TorsionalActuator`] | i, j | a moment about an axis, any function of angle, rate and time |
//! | [`PointForce`] | i, j | a force at a point of `j`, fixed in the axes of `i` |
//! | [`FollowerForce`] | j | a force at a point of `j`, fixed in its own axes |
//! | [`ConstantMoment`] | i, j | a moment on `j`, fixed in the axes of `i` |
//! | [`FollowerMoment`] | j | a moment on `j`, fixed in its own axes |
//!
//! Gravity is an attribute of the mechanism; forces that cannot be said in the language come from a
//! closure, see [`Simulation::forces`](crate::Simulation::forces). Springs have a potential energy,
//! which is part of [`View::potential_energy`](crate::View::potential_energy); what dampers,
//! actuators and given forces do is the power of [`View::power`](crate::View::power).
//!
//! Parameters, units and signs of all of them are in
//! [`guide::reference`](mod@crate::guide::reference), examples in
//! [`guide::forces`](crate::guide::forces).
//!
//! All of them are in the prelude.

mod actuators;
mod given;
mod springs;

pub use actuators::*;
pub use given::*;
pub use springs::*;
