//! From a model to expressions: vectors that know their frame above, a hash-consed arena of scalars
//! below.
//!
//! Vectors (`vector.rs`). A vector is one thing in whatever axes. Its components are computed on
//! demand, once per frame, from the frame where a counted trial finds them cheapest. Module
//! `turns` also turns them by the rotation between two bodies, where its entries are known.
//!
//! Derivatives (`differentiate.rs`) act on vectors, never on components of `p`. A virtual rotation
//! moves `A s` by `A (dw x s)`; time does the same with `w`. The gradient of a row is a force and
//! a moment on every body (reverse mode). The `bias` is the second derivative without
//! accelerations, so `gamma = -bias`. Equations of velocities (`velocities.rs`) are rates
//! themselves: they have no `Phi`, their rows of `D` are gradients by velocities, and `-gamma` is
//! their derivative without accelerations. Module `rows` has both for all constraints.
//!
//! The term `w x (w x s)` is made of the products `w_k w_l`, which all vectors of a body share.
//! Vectors of a body along one line have one `w x (w x e)`.
//!
//! Binding. `expression.rs` has the expressions that are bound to bodies. `bind.rs` replaces formal
//! bodies and numbers by those of a mechanism and expands laws. Later stages see expressions only.
//! `start.rs` evaluates `initial` and `fixed`. `fixed.rs` makes the copies of points and axes on
//! the bodies. An axis has two normals on every body, right-handed with that body's copy. All
//! bodies share them in the reference configuration if the copies of the axis agree there.
//! Otherwise the least rotation takes the normals of the first body to the others.
//!
//! Functions and forces. `functions.rs` has two derivatives of each function. The angle over many
//! turns is `atan2(s, c) + 2 pi round((x - atan2(s, c)) / 2 pi)`. The auxiliary variable `x` of
//! the state decides on the turn only. Derivatives are those of `atan2`. Forces (`force.rs`) pull
//! a potential back with -1 and an effort along a coordinate with itself, by the reverse mode of
//! `D`. Module `kept` leaves equations out. Module `left_out` writes the omitted equations as a
//! kernel, for a judgement at run time.
//!
//! Module `separation` finds the lengths at whose zero a force turns round, by numbers.
//!
//! Identities. `rotation.rs` declares that an entry of a rotation matrix is its own cofactor.
//! Kernels of motion use only what holds for any length of `p`. The forms of `A(p)`:
//! `docs/decisions/001-euler-parameters.md`.
//!
//! Scalars (`arena.rs`). Each node knows its stage: literal, parameter, input, coefficient, state,
//! right-hand side. Stages split the code into `prepare`, `take_inputs`, `coefficients`, the
//! kernels, `factor` and `solve`. What is known earlier is computed once, there. A product of
//! inputs and coefficients is left to the kernels (`Stage::with`), so either can change alone.
//! Module `repeated` finds what a kernel does for many joints or bodies in the same way.
//! Module `gather` goes through the outputs once more and takes common numbers out of sums.
//! Module `time` estimates what a call takes on a processor, of which `processor` has tables.

pub mod arena;
pub mod bind;
pub(crate) mod cotangent;
pub mod count;
pub mod differentiate;
pub mod equations;
pub mod evaluate;
pub mod expression;
pub mod fixed;
mod force;
pub mod functions;
mod gather;
mod index;
mod kept;
pub mod left_out;
mod line;
pub mod motion;
mod node;
pub mod processor;
pub mod repeated;
pub mod rotation;
mod rows;
pub mod scene;
pub mod separation;
pub(crate) mod start;
pub(crate) mod table;
pub(crate) mod tangent;
pub mod tape;
pub mod time;
pub(crate) mod uses;
pub mod vector;
mod velocities;
