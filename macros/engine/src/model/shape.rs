//! What a body looks like.

use super::number::Number;

/// What a shape is, with its sizes (m) along its own axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    /// Length, radius.
    Cylinder,
    /// Length, outer radius, inner radius.
    Tube,
    /// Length, radius of the base.
    Cone,
    /// Lengths along x, y, z.
    Block,
    /// Radius.
    Ball,
    /// A unit of its file along x, y, z; negative where it is mirrored.
    Mesh,
}

/// A shape of a body.
#[derive(Clone, Debug)]
pub struct Shape {
    /// What it is.
    pub kind: ShapeKind,
    /// Its sizes; zero where its kind has fewer than three.
    pub sizes: [Number; 3],
    /// Its centre of mass, or the origin of its file, from the centre of mass of the body (m), in
    /// the user's axes.
    pub centre: [f64; 3],
    /// Euler parameters from its axes to the user's, its length along x.
    pub axes: [f64; 4],
    /// Whether it is taken away.
    pub is_hole: bool,
    /// The whole path of the file of a mesh, as far as it is text.
    pub file: Option<String>,
}
