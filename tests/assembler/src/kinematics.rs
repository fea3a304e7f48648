//! The kinematics of all bodies at one instant, and what is fixed on them.

use nalgebra::Vector3;

use crate::bodies::{BodyId, Frame};

/// Everything that rows and forces are computed from.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// Time (s).
    pub time: f64,
    /// One frame per body, the ground first.
    pub frames: Vec<Frame>,
    /// The auxiliary states `s` (rad), one per unwrapped angle.
    pub turns: Vec<f64>,
}

impl Kinematics {
    /// The frame of a body.
    #[must_use]
    pub fn frame(&self, body: BodyId) -> &Frame {
        &self.frames[body.0]
    }
}

/// A point (m) or a vector fixed on a body, in the axes of that body.
///
/// Its gradients hand `(column, line)` to `add`: three entries of a row of `D` from a column on. A
/// virtual rotation `d` in body axes moves `A s` by `A (d x s)`, so `b . A s` has the line
/// `s x A^T b` for `w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// The body that carries it.
    pub body: BodyId,
    /// `s`.
    pub local: Vector3<f64>,
}

impl Mark {
    /// A mark on a body.
    #[must_use]
    pub const fn new(body: BodyId, local: Vector3<f64>) -> Self {
        Self { body, local }
    }

    /// `r + A s`.
    #[must_use]
    pub fn point(&self, at: &Kinematics) -> Vector3<f64> {
        at.frame(self.body).point(&self.local)
    }

    /// `(r + A s)'`.
    #[must_use]
    pub fn point_rate(&self, at: &Kinematics) -> Vector3<f64> {
        at.frame(self.body).point_velocity(&self.local)
    }

    /// `A s`.
    #[must_use]
    pub fn vector(&self, at: &Kinematics) -> Vector3<f64> {
        at.frame(self.body).rotation * self.local
    }

    /// `(A s)'`.
    #[must_use]
    pub fn vector_rate(&self, at: &Kinematics) -> Vector3<f64> {
        at.frame(self.body).vector_rate(&self.local)
    }

    /// `(A s)''`, and also `(r + A s)''`, at `u' = 0`.
    #[must_use]
    pub fn curvature(&self, at: &Kinematics) -> Vector3<f64> {
        at.frame(self.body).centripetal(&self.local)
    }

    /// Gradient of `b . (r + A s)` with `b` kept constant.
    pub(crate) fn point_gradient(
        &self,
        at: &Kinematics,
        b: &Vector3<f64>,
        add: &mut impl FnMut(usize, &Vector3<f64>),
    ) {
        if let Some(column) = at.frame(self.body).translation_column {
            add(column, b);
        }
        self.vector_gradient(at, b, add);
    }

    /// Gradient of `b . A s` with `b` kept constant.
    pub(crate) fn vector_gradient(
        &self,
        at: &Kinematics,
        b: &Vector3<f64>,
        add: &mut impl FnMut(usize, &Vector3<f64>),
    ) {
        let frame = at.frame(self.body);
        if let Some(column) = frame.rotation_column {
            add(column, &self.local.cross(&frame.rotation.tr_mul(b)));
        }
    }
}
