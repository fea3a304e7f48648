//! The scalars that rows and forces are made of: value, rate, second derivative and gradient,
//! derived by hand.
//!
//! With `d = P_t - P_h` (a tail and a head), vectors `a` and `b` fixed on bodies, and a double
//! prime the second derivative at `u' = 0`, where `(A s)'' = A (w x (w x s))`:
//!
//! | scalar | rate | second derivative | gradient |
//! |---|---|---|---|
//! | `a . b` | `a' . b + a . b'` | `a'' . b + 2 a' . b' + a . b''` | of `a` along `b`, of `b` along `a` |
//! | `a . d` | `a' . d + a . d'` | `a'' . d + 2 a' . d' + a . d''` | of `a` along `d`, of `d` along `a` |
//! | `d . d` | `2 d . d'` | `2 (d' . d' + d . d'')` | of `d` along `2 d` |
//! | `l = sqrt(d . d)` | `d . d' / l` | `(d' . d' + d . d'' - l'^2) / l` | of `d` along `d / l` |
//!
//! None of them uses `A^T A = I`, so they are exact for Euler parameters of any length. Sources:
//! Nikravesh (1988), chapter 7 (perpendicular types 1 and 2); Haug (1989), chapter 9 (dot 1, dot 2,
//! distance).

use nalgebra::Vector3;

use crate::angles::Angle;
use crate::kinematics::{Kinematics, Mark};

/// A scalar function of the configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// `a . b` of two vectors on different bodies.
    Product([Mark; 2]),
    /// `a . (P_t - P_h)`, with the vector `a` on any body and the points head and tail (m).
    Along {
        /// `a`.
        axis: Mark,
        /// Head and tail.
        points: [Mark; 2],
    },
    /// `|P_t - P_h|^2` (m^2) of a head and a tail on different bodies.
    SquaredLength([Mark; 2]),
    /// `|P_t - P_h|` (m) of a head and a tail on different bodies.
    Length([Mark; 2]),
    /// The angle between two bodies about an axis (rad), with its turns counted.
    Angle(Angle),
}

/// `P_t - P_h` with its first two derivatives.
struct Gap {
    value: Vector3<f64>,
    rate: Vector3<f64>,
}

impl Gap {
    fn new([head, tail]: &[Mark; 2], at: &Kinematics) -> Self {
        Self {
            value: gap(head, tail, at),
            rate: tail.point_rate(at) - head.point_rate(at),
        }
    }
}

fn gap(head: &Mark, tail: &Mark, at: &Kinematics) -> Vector3<f64> {
    tail.point(at) - head.point(at)
}

fn gap_curvature([head, tail]: &[Mark; 2], at: &Kinematics) -> Vector3<f64> {
    tail.curvature(at) - head.curvature(at)
}

/// Gradient of `b . (P_t - P_h)` with `b` kept constant.
fn gap_gradient(
    [head, tail]: &[Mark; 2],
    at: &Kinematics,
    b: &Vector3<f64>,
    add: &mut impl FnMut(usize, &Vector3<f64>),
) {
    head.point_gradient(at, &-b, add);
    tail.point_gradient(at, b, add);
}

impl Scalar {
    /// Its value.
    #[must_use]
    pub fn value(&self, at: &Kinematics) -> f64 {
        match self {
            Self::Product([a, b]) => a.vector(at).dot(&b.vector(at)),
            Self::Along { axis, points } => {
                let [head, tail] = points;
                axis.vector(at).dot(&gap(head, tail, at))
            }
            Self::SquaredLength([head, tail]) => gap(head, tail, at).norm_squared(),
            Self::Length([head, tail]) => gap(head, tail, at).norm(),
            Self::Angle(angle) => angle.value(at),
        }
    }

    /// Its rate.
    #[must_use]
    pub fn rate(&self, at: &Kinematics) -> f64 {
        match self {
            Self::Product([a, b]) => {
                a.vector_rate(at).dot(&b.vector(at)) + a.vector(at).dot(&b.vector_rate(at))
            }
            Self::Along { axis, points } => {
                let d = Gap::new(points, at);
                axis.vector_rate(at).dot(&d.value) + axis.vector(at).dot(&d.rate)
            }
            Self::SquaredLength(points) => {
                let d = Gap::new(points, at);
                2.0 * d.value.dot(&d.rate)
            }
            Self::Length(points) => {
                let d = Gap::new(points, at);
                d.value.dot(&d.rate) / d.value.norm()
            }
            Self::Angle(angle) => angle.rate(at),
        }
    }

    /// Its second derivative at `u' = 0`.
    #[must_use]
    pub fn curvature(&self, at: &Kinematics) -> f64 {
        match self {
            Self::Product([a, b]) => {
                a.curvature(at).dot(&b.vector(at))
                    + a.vector(at).dot(&b.curvature(at))
                    + 2.0 * a.vector_rate(at).dot(&b.vector_rate(at))
            }
            Self::Along { axis, points } => {
                let d = Gap::new(points, at);
                axis.curvature(at).dot(&d.value)
                    + axis.vector(at).dot(&gap_curvature(points, at))
                    + 2.0 * axis.vector_rate(at).dot(&d.rate)
            }
            Self::SquaredLength(points) => {
                let d = Gap::new(points, at);
                2.0 * (d.rate.norm_squared() + d.value.dot(&gap_curvature(points, at)))
            }
            Self::Length(points) => {
                let d = Gap::new(points, at);
                let length = d.value.norm();
                let rate = d.value.dot(&d.rate) / length;
                let square = d.rate.norm_squared() + d.value.dot(&gap_curvature(points, at));
                (square - rate * rate) / length
            }
            Self::Angle(angle) => angle.curvature(at),
        }
    }

    /// Hands `factor` times the gradient to `add`, as lines of three entries from a column on; a
    /// column may come twice unless [`Scalar::touches_columns_once`].
    pub(crate) fn gradient(
        &self,
        at: &Kinematics,
        factor: f64,
        add: &mut impl FnMut(usize, &Vector3<f64>),
    ) {
        match self {
            Self::Product([a, b]) => {
                a.vector_gradient(at, &(factor * b.vector(at)), add);
                b.vector_gradient(at, &(factor * a.vector(at)), add);
            }
            Self::Along { axis, points } => {
                let d = gap(&points[0], &points[1], at);
                axis.vector_gradient(at, &(factor * d), add);
                gap_gradient(points, at, &(factor * axis.vector(at)), add);
            }
            Self::SquaredLength(points) => {
                let d = gap(&points[0], &points[1], at);
                gap_gradient(points, at, &(2.0 * factor * d), add);
            }
            Self::Length(points) => {
                let d = gap(&points[0], &points[1], at);
                gap_gradient(points, at, &(factor / d.norm() * d), add);
            }
            Self::Angle(angle) => angle.gradient(at, factor, add),
        }
    }

    /// Whether the gradient hands out no column twice, so that it can be written without being
    /// added up.
    pub(crate) const fn touches_columns_once(&self) -> bool {
        !matches!(self, Self::Along { .. })
    }
}
