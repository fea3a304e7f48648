//! The mechanism that a robot is: bodies and joints in global axes, with names for Rust.

use crate::document::{JointKind, Limits};
use crate::faults::Note;

/// How a robot becomes a mechanism.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Options {
    /// The root link is a free body. Otherwise it is the ground.
    pub floating: bool,
    /// Joints have no motors: no inputs and no efforts but damping.
    pub passive: bool,
    /// Masses and inertias that no body has are taken as the file gives them, where the robot as a
    /// whole has inertia. Each is named among [`Mechanism::notes`].
    pub accept_inertia: bool,
    /// The name of the struct, in place of the robot's. What is no name of a type is made one.
    pub name: Option<String>,
    /// The file, to be named in a comment.
    pub source: Option<String>,
}

/// A robot as bodies and joints. It prints itself as an annotated struct.
///
/// The reference configuration has all joints at zero and the frame of the root link as global
/// axes. Units are SI, angles are in radians.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Mechanism {
    /// The name of the struct.
    pub name: String,
    /// The robot's name in the file.
    pub robot: String,
    /// The file, where [`Options::source`] named it.
    pub source: Option<String>,
    /// The links that are the ground: the root and what is fixed to it. None if the root floats.
    pub ground: Vec<String>,
    /// The mass of the ground (kg), which has no effect.
    pub ground_mass: f64,
    /// The bodies from the root outwards.
    pub bodies: Vec<Body>,
    /// The joints that move, from the root outwards.
    pub joints: Vec<Joint>,
    /// The frames of all links, in the order of the file.
    pub frames: Vec<LinkFrame>,
    /// The meshes of all links, in the order of the file, for whoever draws them.
    pub meshes: Vec<Mesh>,
    /// What is no fault of the file, and yet worth knowing, and what was taken as it is given.
    pub notes: Vec<Note>,
}

/// A body: links that joints of the type `fixed` hold together.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Body {
    /// The name of the field.
    pub field: String,
    /// Names in the file: the link that the body's joint carries, then those that are fixed to it.
    pub links: Vec<String>,
    /// In kg.
    pub mass: f64,
    /// The centre of mass (m), global axes.
    pub position: [f64; 3],
    /// From body axes, which are those of the first link, to global axes: Euler parameters, scalar
    /// first.
    pub orientation: [f64; 4],
    /// About the centre of mass, body axes (kg m^2).
    pub inertia: [[f64; 3]; 3],
    /// Boxes, cylinders and spheres that the file gives for its links. They are drawn, and have no
    /// mass.
    pub shapes: Vec<Shape>,
    /// Files of meshes, and other geometries, that the file gives for its links. They are no shapes
    /// of the body.
    pub visuals: Vec<String>,
    /// No joint of the mechanism names the body.
    pub is_free: bool,
    /// Mass and inertia are those of no body: none at all, or such that
    /// [`Options::accept_inertia`] was said.
    pub is_as_given: bool,
}

/// A shape of a body: sizes in m, points in global axes (m).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A box along the axes of its body.
    Block {
        /// Lengths along x, y and z.
        size: [f64; 3],
        /// Its centre.
        at: [f64; 3],
    },
    /// Any other box.
    Bar {
        /// Its size across `up`.
        width: f64,
        /// Its size along `up`.
        height: f64,
        /// The centre of one end.
        from: [f64; 3],
        /// The centre of the other end.
        to: [f64; 3],
        /// A direction across the bar, of length 1.
        up: [f64; 3],
    },
    /// A cylinder.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// The centre of one end.
        from: [f64; 3],
        /// The centre of the other end.
        to: [f64; 3],
    },
    /// A sphere.
    Ball {
        /// Its radius.
        radius: f64,
        /// Its centre.
        at: [f64; 3],
    },
}

/// A mesh that the file gives for a link.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mesh {
    /// As it is named in the file: a path, or an address such as `package://robot/link.stl`.
    pub file: String,
    /// Factors of the mesh's coordinates.
    pub scale: [f64; 3],
    /// The place in [`Mechanism::bodies`] of the body that it is on. The ground has none.
    pub body: Option<usize>,
    /// The origin of the mesh's frame (m) from the centre of mass of the body, body axes; on the
    /// ground global.
    pub origin: [f64; 3],
    /// From axes of the mesh to body axes: Euler parameters, scalar first.
    pub orientation: [f64; 4],
    /// The colour of its material: shares of red, green, blue and opacity. None where the file
    /// gives none.
    pub colour: Option<[f64; 4]>,
}

/// A joint that moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Joint {
    /// The name of the field.
    pub field: String,
    /// The name in the file.
    pub name: String,
    /// Its type in the file; never [`JointKind::Fixed`].
    pub kind: JointKind,
    /// Places in [`Mechanism::bodies`] of parent and child; the ground has none.
    pub between: [Option<usize>; 2],
    /// The origin of the joint's frame (m), global axes.
    pub point: [f64; 3],
    /// The axis, of a plane its normal: global axes, of the length that the file gives.
    pub axis: [f64; 3],
    /// Positions become `limits` of the joint; nothing in the mechanism enforces the rest.
    pub limits: Limits,
    /// In N m s/rad, of a slide N s/m.
    pub damping: f64,
    /// Dry friction (N m, of a slide N), which the mechanism does not have.
    pub friction: f64,
    /// The joint whose position this one follows.
    pub mimic: Option<Mimic>,
    /// The motor; a joint that mimics has none.
    pub motor: Option<Motor>,
}

/// The position of a joint is `multiplier` times that of another one, plus `offset`.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Mimic {
    /// The name of the field.
    pub field: String,
    /// The place in [`Mechanism::joints`] of the other joint.
    pub leader: usize,
    /// In units of this joint's position by that of the other one.
    pub multiplier: f64,
    /// In rad, of a slide m.
    pub offset: f64,
}

/// What acts along the coordinate of a joint: an input, and damping.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Motor {
    /// The name of the field.
    pub field: String,
    /// The name of the input: an effort (N m, of a slide N) on the child. None without one.
    pub input: Option<String>,
}

/// The frame of a link at the zero configuration.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct LinkFrame {
    /// The name in the file.
    pub link: String,
    /// The beginning of the names of constants.
    pub constant: String,
    /// The field of its origin as a point, where the link is fixed to another one of a body.
    pub(crate) point: Option<String>,
    /// The place in [`Mechanism::bodies`] of the body that the frame moves
    /// with. The ground has none.
    pub body: Option<usize>,
    /// From the centre of mass of the body, body axes (m); on the ground global.
    pub origin: [f64; 3],
    /// From axes of the frame to body axes: Euler parameters, scalar first.
    pub orientation: [f64; 4],
    /// The origin in global axes (m).
    pub global_origin: [f64; 3],
    /// From axes of the frame to global axes: Euler parameters, scalar first.
    pub global_orientation: [f64; 4],
}
