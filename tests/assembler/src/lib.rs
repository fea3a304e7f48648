//! The generic run-time assembler that judges the generated kernels.
//!
//! [`assembler`] takes bodies and joints at run time, as an engineer would who had no generator:
//! heap, dense matrices of run-time size, textbook equations derived by hand. It shares no code
//! with the generator or with the kernels of the run time, so that agreement between the two means
//! something, and its speed is what the generated code is compared with. [`smatrix`] is the same
//! for the pendulum of chapter 15 with sizes known to the compiler.

#![forbid(unsafe_code)]

pub mod accuracy;
pub mod angles;
pub mod assembler;
pub mod bodies;
mod couplings;
pub mod drivers;
#[cfg(feature = "dual")]
pub mod dual;
pub mod forces;
pub mod formulation;
pub mod jacobi;
pub mod joints;
mod kernels;
pub mod kinematics;
pub mod laws;
pub mod library;
pub mod lu;
mod rows;
pub mod saddle;
pub mod scalars;
pub mod scenes;
pub mod schur;
pub mod smatrix;
#[cfg(feature = "random")]
pub mod states;
mod symmetric;
mod writers;

#[cfg(all(test, feature = "dual", feature = "random"))]
mod tests;
