//! Joint coordinates: bodies move by what the joints of a spanning tree leave free, and only joints
//! that close loops stay as equations.
//!
//! `#[mechanism(coordinates = "joints")]` adds this description over the same arena, scene and
//! elimination. The bodies' own equations are then put together from factors, solution and
//! right-hand sides (`private::evaluate_in_parts`), because reactions and the monitor need them
//! once a step. `"both"` has them fused.
//!
//! Tree and links. The joints that declare `motion ..` form a tree (`spanning.rs`). Module `links`
//! makes one link of every motion: a turn about a coordinate axis, a slide, a screw, or a ball.
//! Links on the way to a body have no mass. A free body is three slides and a ball about its centre
//! of mass.
//!
//! Frames (`frames.rs`) are a tree of axes that turn against each other. In a run of parallel
//! axes, all frames may be based on the frame that carries the run. A ball's frame is based on the
//! ground. So *forces are summed from link to link, moments from frame to frame* (`wrenches.rs`).
//! A turn moves what is fixed in frames that follow its own, vectors between origins as well as
//! moments. A link that is carried without being turned hands on its force and the moment of that
//! force.
//!
//! Equations. The mass matrix (`mass.rs`) projects momenta of unit velocities. For relative angles
//! this is the composite-rigid-body algorithm. Module `kinematics` has velocity terms and gravity
//! in one recursion from a ground that accelerates by minus gravity.
//!
//! Constants. `align.rs` turns frames so that fixed vectors lie on coordinate axes. `regroup.rs`
//! moves origins along axes and hands inertia that motion cannot distinguish to the carrier. From
//! a turn it takes mass, first moment along the axis and an equal share of transverse moments;
//! from a screw that share alone; from a ball the mass; from a slide the inertia. Run-time
//! parameters go the same way, in `prepare`.
//!
//! Choice (`candidates.rs`) by operations and path: `L D L^T` from the leaves; articulated
//! inertias, whose cost is proportional to the length of a chain; rows that determine velocities,
//! in closed loops (`dependent.rs`). The last are used only where their determinant stands out all
//! along a sweep, and where motion that changes it most does not make it vanish (`descent.rs`).
//! With a compliance rows stay behind. Pivots of other rows compare with free bodies
//! (`reference.rs`), since their value on links vanishes where these are in line.
//!
//! Loops. `handover.rs` counts a mass on either side of a closing point, with `D = P - Q`:
//! `M + P^T m P` and `M + Q^T m Q` differ by `D^T X + X^T D`. Terms of stabilisation let the
//! points differ, which is put back on the right. That rows hold exactly two points together is
//! found by numbers, off the constraints. Rows with zero gradient are left out. With `"drop"`,
//! `rank/closing.rs` finds the rest. `angles.rs` knows angles about one axis without rotation
//! matrices.
//!
//! Kernels that are asked for (`joint_rates.rs`): mass matrix, efforts and axes in the rates of the
//! joints themselves. `derivatives.rs`: the accelerations with their derivatives.
//!
//! Bodies. `Scene::on` binds what is left of the joints to bodies whose states are expressions of
//! joint coordinates. `from_bodies.rs` is the way back. Forces of closures and the augmented
//! Lagrangian use `factor_joints` and `solve_joints`, which contain no velocities and no described
//! forces. A tree has one such pair; loops have one with and one without a compliance.

pub mod adjoint;
mod algebra;
mod align;
mod angles;
mod articulated;
pub mod beginning;
pub mod candidates;
mod carried;
mod certain;
mod dependent;
pub mod derivatives;
mod descent;
pub mod elimination;
pub mod frames;
pub mod freedom;
pub mod from_bodies;
mod handover;
pub mod joint_rates;
pub mod kernels;
mod kinematics;
pub mod links;
mod mass;
mod motions;
mod origins;
mod rates;
mod reference;
mod regroup;
pub mod spanning;
mod stops;
pub mod system;
mod wrenches;
