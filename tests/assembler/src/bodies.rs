//! Bodies: mass, initial pose and the kinematics of one instant.
//!
//! Notation of every module of the assembler: `r` position of the centre of mass (m, global axes),
//! `p = (e0, e)` Euler parameters from body to global axes, `A(p)` the rotation from body to global
//! axes, `v = r'` (m/s, global axes), `w` angular velocity (rad/s, **body** axes), `x~` the matrix
//! of the cross product, a prime the time derivative.
//!
//! Sources: Nikravesh, *Computer-Aided Analysis of Mechanical Systems* (1988), chapter 6; Flores,
//! *Concepts and Formulations for Spatial Multibody Dynamics* (2015), chapters 4 to 6.

use nalgebra::{Matrix3, Vector3, Vector4};

/// The place of a body in its [`Assembler`](crate::assembler::Assembler).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BodyId(pub(crate) usize);

/// The body that does not move: global axes, origin at zero, no coordinates.
pub const GROUND: BodyId = BodyId(0);

/// What decides how many coordinates a body has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Does not move: neither coordinates nor velocities.
    Ground,
    /// A point mass: `r` and `v`, its axes stay parallel to the global ones.
    Particle,
    /// A rigid body: `(r, p)` and `(v, w)`.
    Rigid,
}

impl Kind {
    /// Number of coordinates: 0, 3, 7.
    #[must_use]
    pub const fn coordinates(self) -> usize {
        match self {
            Self::Ground => 0,
            Self::Particle => 3,
            Self::Rigid => 7,
        }
    }

    /// Number of velocities: 0, 3, 6.
    #[must_use]
    pub const fn velocities(self) -> usize {
        match self {
            Self::Ground => 0,
            Self::Particle => 3,
            Self::Rigid => 6,
        }
    }
}

/// How Euler parameters are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Orientation {
    /// `A(p)` in its homogeneous form with `p` as it is: `|p|^2` times a rotation.
    #[default]
    Raw,
    /// `A(p / |p|)`: always a rotation.
    Normalised,
}

/// A body with its initial state. Body axes are the principal axes about the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Which coordinates it has.
    pub kind: Kind,
    /// Mass (kg).
    pub mass: f64,
    /// Principal moments of inertia about the centre of mass (kg m^2).
    pub inertia: Vector3<f64>,
    /// Initial `r` (m, global axes).
    pub position: Vector3<f64>,
    /// Initial `p`, scalar first.
    pub euler: Vector4<f64>,
    /// Initial `v` (m/s, global axes).
    pub velocity: Vector3<f64>,
    /// Initial `w` (rad/s, body axes).
    pub rate: Vector3<f64>,
}

impl Body {
    /// A rigid body at rest with its axes parallel to the global ones: mass (kg), principal moments
    /// of inertia (kg m^2), position of the centre of mass (m, global axes).
    #[must_use]
    pub fn rigid(mass: f64, inertia: [f64; 3], position: [f64; 3]) -> Self {
        Self {
            kind: Kind::Rigid,
            mass,
            inertia: inertia.into(),
            position: position.into(),
            euler: Vector4::new(1.0, 0.0, 0.0, 0.0),
            velocity: Vector3::zeros(),
            rate: Vector3::zeros(),
        }
    }

    /// A point mass at rest: mass (kg), position (m, global axes).
    #[must_use]
    pub fn particle(mass: f64, position: [f64; 3]) -> Self {
        Self {
            kind: Kind::Particle,
            ..Self::rigid(mass, [0.0; 3], position)
        }
    }

    /// The ground.
    #[must_use]
    pub fn ground() -> Self {
        Self {
            kind: Kind::Ground,
            ..Self::rigid(0.0, [0.0; 3], [0.0; 3])
        }
    }

    /// The same body with other initial Euler parameters, scalar first.
    #[must_use]
    pub fn with_euler(mut self, euler: [f64; 4]) -> Self {
        self.euler = euler.into();
        self
    }

    /// The same body with initial velocities: `v` (m/s, global axes) and `w` (rad/s, body axes).
    #[must_use]
    pub fn with_velocity(mut self, velocity: [f64; 3], rate: [f64; 3]) -> Self {
        self.velocity = velocity.into();
        self.rate = rate.into();
        self
    }

    /// The kinematics of the initial state, with `p` as it was given.
    #[must_use]
    pub fn initial_frame(&self) -> Frame {
        Frame {
            position: self.position,
            rotation: rotation(&self.euler),
            velocity: self.velocity,
            rate: self.rate,
            ..Frame::fixed()
        }
    }
}

/// `A(p) = (e0^2 - e.e) I + 2 e e^T + 2 e0 e~`, body to global axes; `|p|^2` times a rotation
/// (Nikravesh 1988, section 6.2).
#[must_use]
pub fn rotation(p: &Vector4<f64>) -> Matrix3<f64> {
    let [e0, e1, e2, e3] = [p[0], p[1], p[2], p[3]];
    let (s0, s1, s2, s3) = (e0 * e0, e1 * e1, e2 * e2, e3 * e3);
    Matrix3::new(
        s0 + s1 - s2 - s3,
        2.0 * (e1 * e2 - e0 * e3),
        2.0 * (e1 * e3 + e0 * e2),
        2.0 * (e1 * e2 + e0 * e3),
        s0 - s1 + s2 - s3,
        2.0 * (e2 * e3 - e0 * e1),
        2.0 * (e1 * e3 - e0 * e2),
        2.0 * (e2 * e3 + e0 * e1),
        s0 - s1 - s2 + s3,
    )
}

/// `p' = 1/2 L(p)^T w` with `L(p) = [-e, e0 I - e~]`, `w` in body axes and `p` as it is (Nikravesh
/// 1988, section 6.4). It is orthogonal to `p`, so it leaves `|p|` unchanged to first order.
#[must_use]
pub fn euler_rate(p: &Vector4<f64>, w: &Vector3<f64>) -> Vector4<f64> {
    let [e0, e1, e2, e3] = [p[0], p[1], p[2], p[3]];
    0.5 * Vector4::new(
        -e1 * w.x - e2 * w.y - e3 * w.z,
        e0 * w.x + e2 * w.z - e3 * w.y,
        e0 * w.y + e3 * w.x - e1 * w.z,
        e0 * w.z + e1 * w.y - e2 * w.x,
    )
}

/// The kinematics of one body at one instant, and where its velocities stand among those of the
/// mechanism.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// `r` (m, global axes).
    pub position: Vector3<f64>,
    /// `A`, body to global axes.
    pub rotation: Matrix3<f64>,
    /// `v` (m/s, global axes).
    pub velocity: Vector3<f64>,
    /// `w` (rad/s, body axes).
    pub rate: Vector3<f64>,
    /// First of the three columns of `v`, if the body can move.
    pub(crate) translation_column: Option<usize>,
    /// First of the three columns of `w`, if the body can turn.
    pub(crate) rotation_column: Option<usize>,
}

impl Frame {
    /// At the origin, along the global axes, at rest.
    #[must_use]
    pub fn fixed() -> Self {
        Self {
            position: Vector3::zeros(),
            rotation: Matrix3::identity(),
            velocity: Vector3::zeros(),
            rate: Vector3::zeros(),
            translation_column: None,
            rotation_column: None,
        }
    }

    /// The point `P = r + A s` (m, global axes) of `s` (m, body axes).
    #[must_use]
    pub fn point(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * s
    }

    /// Its velocity `P' = v + A (w x s)` (m/s, global axes).
    #[must_use]
    pub fn point_velocity(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.velocity + self.vector_rate(s)
    }

    /// `(A s)' = A (w x s)`, global axes.
    #[must_use]
    pub fn vector_rate(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * self.rate.cross(s)
    }

    /// The part of `(A s)''` that is quadratic in velocities, `A (w x (w x s))`, global axes.
    #[must_use]
    pub fn centripetal(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * self.rate.cross(&self.rate.cross(s))
    }
}
