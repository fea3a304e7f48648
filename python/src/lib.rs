//! Mechanisms of [`holonom`] as classes of a Python module, over NumPy arrays.
//!
//! ```ignore
//! use holonom::prelude::*;
//!
//! /// A rod on a hinge, which a motor turns.
//! #[derive(Mechanism)]
//! #[mechanism(
//!     gravity = [0.0, 0.0, -9.81],
//!     coordinates = "joints",
//!     kernels = [mass, inverse, jacobian]
//! )]
//! struct Rod {
//!     /// The length (m).
//!     #[param]
//!     length: f64,
//!     /// The moment of the motor (N m).
//!     #[input]
//!     torque: f64,
//!     #[body(mass = 1.0, inertia = [0.1, 1e-3, 0.1], position = [0.0, 0.5 * length, 0.0])]
//!     rod: Body,
//!     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
//!     hinge: Revolute,
//!     #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = torque)]
//!     motor: TorsionalActuator,
//! }
//!
//! holonom_python::module! {
//!     mod rods;
//!     Rod;
//! }
//! ```
//!
//! With `crate-type = ["cdylib"]`, `maturin develop` makes a module of it:
//!
//! ```python
//! from rods import Rod
//! run = Rod(length=0.8, torque=2.0).simulate(10.0)
//! run["hinge.angle"], run.to_pandas()
//! ```
//!
//! The README is the guide: what a class has, and how it is built. [`module!`] has the language.
//!
//! # How it is made
//!
//! [`module!`] writes a class of `pyo3` for each mechanism, with a line for each method. What the
//! methods do is ordinary generic code of this crate. Names, units and comments are those of the
//! mechanism's reports; nothing is registered twice.
//!
//! This crate has no unsafe code of its own. That which `pyo3`'s macros write, here and in the
//! crate that calls [`module!`], is allowed by them: such a crate can deny `unsafe_code`, and not
//! forbid it.

mod arrays;
mod batch;
mod described;
mod exposed;
mod faults;
mod object;
mod register;
mod results;
mod rollouts;
mod run;
mod start;
mod stubs;
mod threads;

#[macro_use]
mod module;

pub use results::{Linearised, Rollouts, Run};

/// What the macro writes names of.
#[doc(hidden)]
pub mod __private {
    pub use holonom;
    pub use pyo3;

    pub use crate::described::{check_coordinates, inputs, is_coordinate};
    pub use crate::exposed::Valued;
    pub use crate::exposed::{
        Analysed, Construct, Exposed, Fallback, Matrices, NotTypical, Numbers, Reading, Typical,
    };
    pub use crate::object::{Array, Given, Object};
    pub use crate::register::{begin, coordinate_names, end, joint_names, register};
    pub use crate::rollouts::Many;
    pub use crate::run::Setting;
    pub use crate::start::{Start, by_joints, in_coordinates};
}
