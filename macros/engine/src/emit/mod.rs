//! Kernels to Rust. Nothing here can fail: what could be wrong was refused before.
//!
//! A kernel neither branches on data nor returns a `Result`. Sizes are associated types, plain
//! arrays. The fused evaluation exists for three sets of terms (plain, stabilised, compliant).
//! Forces of closures, the augmented Lagrangian and projections use `factor` and `solve`, which
//! keeps the fused kernels free of them.
//!
//! `solver.rs` writes the solver once, for either kind of coordinates. `solution.rs` and
//! `joint_solution.rs` say in which of its words they differ, and choose among evaluations.
//!
//! Long kernels: `docs/decisions/008-long-kernels.md`. Where bodies are read and not run, kernels
//! that do the same for many joints are functions and tables (`repeated.rs`). The equations of the
//! bodies are solved by loops there (`by_rows.rs`): `docs/decisions/037-what-is-not-run.md`.
//!
//! Values. `parameters.rs` writes the checks of run-time values in `f64`. So `prepare`, which
//! computes with them in any scalar, cannot fail; `update` runs both again. An input is a
//! parameter that may not change what a mechanism is. `inputs.rs` writes a struct of inputs over
//! any scalar, and `take_inputs` computes what depends on them (`Store::write_inputs`). A
//! controller's loop touches no `f64`.
//!
//! `splines.rs` writes what kernels call of a spline, and puts the numbers of those that are given
//! at run time before the other constants.
//!
//! `likes.rs` writes the omitted equations as a kernel. `joint.rs` writes type, traits, carrier
//! and documentation of a definition.

pub mod assembly;
mod by_rows;
mod construction;
mod coordinates;
pub mod documentation;
pub mod fallback;
mod handles;
mod inputs;
pub mod joint;
mod joint_rates;
mod joint_report;
mod joint_solution;
mod likes;
mod limits;
pub mod mechanism;
mod nested;
pub mod parameters;
mod parts;
mod readouts;
mod repeated;
pub mod report;
mod rows;
mod separations;
mod solution;
mod solver;
mod splines;
mod states;
pub mod store;
pub mod straight_line;
mod switches;
mod writer;
