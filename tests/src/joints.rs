//! Joints: their data and the rows they write, derived by hand.
//!
//! `Phi` of two bodies `i` and `j` with points `P = r + A s` and vectors `a = A a'` fixed on them. A virtual rotation
//! `d` in body axes moves `A s` by `A (d x s)`; so a row of `D` has a part for `v` (global axes) and one for `w` (body
//! axes), and with `u' = 0` the acceleration of `A s` is `A (w x (w x s))`. `D u' = gamma`.
//!
//! | constraint | `Phi` | row for `v_j`, `w_j` (that of `i` alike) | `gamma` |
//! |---|---|---|---|
//! | spherical | `P_j - P_i` | `I`, `-A_j s_j~` | `A_i w_i~ w_i~ s_i - A_j w_j~ w_j~ s_j` |
//! | perpendicular 1 | `a . b` | `0`, `(b' x A_j^T a)^T` | `-(b . A_i w_i~ w_i~ a' + a . A_j w_j~ w_j~ b' + 2 (A_i a')' . (A_j b')')` |
//! | distance | `d . d - L^2`, `d = P_j - P_i` | `2 d^T`, `2 (s_j x A_j^T d)^T` | `-2 (d' . d' + d . (A_j w_j~ w_j~ s_j - A_i w_i~ w_i~ s_i))` |
//!
//! None of them uses `A^T A = I`, so they are exact for Euler parameters of any length. Sources: Nikravesh (1988),
//! chapters 7 and 8 (perpendicular type 1, spherical, revolute); Flores (2015), chapters 7 to 9.

use nalgebra::Vector3;

use crate::bodies::{BodyId, Frame};
use crate::rows::Rows;

/// A joint between two bodies, with points (m) and vectors in the axes of the body that carries them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Two points coincide: 3 rows, `P_j - P_i` in global axes (m).
    Spherical {
        /// The bodies `i` and `j`.
        between: [BodyId; 2],
        /// The points `s_i` and `s_j`.
        points: [Vector3<f64>; 2],
    },
    /// Two points coincide and two axes stay parallel: the 3 rows of a spherical joint, then `n_1 . h` and `n_2 . h`.
    Revolute {
        /// The bodies `i` and `j`.
        between: [BodyId; 2],
        /// The points `s_i` and `s_j`.
        points: [Vector3<f64>; 2],
        /// `n_1` and `n_2`, of unit length and perpendicular to the axis, fixed on body `i`.
        normals: [Vector3<f64>; 2],
        /// `h`, the unit axis, fixed on body `j`.
        axis: Vector3<f64>,
    },
    /// Two vectors stay perpendicular (type 1): 1 row, `a . b`.
    Perpendicular {
        /// The bodies `i` and `j`.
        between: [BodyId; 2],
        /// `a` on body `i` and `b` on body `j`.
        vectors: [Vector3<f64>; 2],
    },
    /// Two points keep their distance: 1 row, `d . d - L^2` (m^2) with `d = P_j - P_i`.
    Distance {
        /// The bodies `i` and `j`.
        between: [BodyId; 2],
        /// The points `s_i` and `s_j`.
        points: [Vector3<f64>; 2],
        /// `L` (m).
        length: f64,
    },
}

/// Two unit vectors that with the unit axis `a` make a right-handed frame `(n1, n2, a)`.
///
/// With `k` the place of the component of `a` that is smallest in absolute value (the first one of equals):
/// `n1 = (e_k x a) / |e_k x a|`, `n2 = a x n1`.
#[must_use]
pub fn normals(a: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let mut k = 0;
    for candidate in 1..3 {
        if a[candidate].abs() < a[k].abs() {
            k = candidate;
        }
    }
    let mut e = Vector3::zeros();
    e[k] = 1.0;
    let n1 = e.cross(a).normalize();
    [n1, a.cross(&n1)]
}

impl Joint {
    /// The bodies `i` and `j`.
    #[must_use]
    pub const fn between(&self) -> [BodyId; 2] {
        match self {
            Self::Spherical { between, .. }
            | Self::Revolute { between, .. }
            | Self::Perpendicular { between, .. }
            | Self::Distance { between, .. } => *between,
        }
    }

    /// The points `s_i` and `s_j` (m, body axes) to which reactions are reduced; the centres of mass of a joint
    /// without points.
    #[must_use]
    pub fn points(&self) -> [Vector3<f64>; 2] {
        match self {
            Self::Spherical { points, .. }
            | Self::Revolute { points, .. }
            | Self::Distance { points, .. } => *points,
            Self::Perpendicular { .. } => [Vector3::zeros(); 2],
        }
    }

    /// Number of rows.
    #[must_use]
    pub const fn equations(&self) -> usize {
        match self {
            Self::Spherical { .. } => 3,
            Self::Revolute { .. } => 5,
            Self::Perpendicular { .. } | Self::Distance { .. } => 1,
        }
    }

    /// Writes `Phi`, one number per row.
    pub fn constraints(&self, i: &Frame, j: &Frame, out: &mut [f64]) {
        match self {
            Self::Spherical { points, .. } => out.copy_from_slice(gap(i, j, points).as_slice()),
            Self::Revolute {
                points,
                normals,
                axis,
                ..
            } => {
                out[..3].copy_from_slice(gap(i, j, points).as_slice());
                let h = j.rotation * axis;
                for (value, n) in out[3..].iter_mut().zip(normals) {
                    *value = (i.rotation * n).dot(&h);
                }
            }
            Self::Perpendicular { vectors, .. } => {
                out[0] = (i.rotation * vectors[0]).dot(&(j.rotation * vectors[1]));
            }
            Self::Distance { points, length, .. } => {
                out[0] = gap(i, j, points).norm_squared() - length * length;
            }
        }
    }

    /// Writes `Phi' = D u`, one number per row.
    pub fn constraint_rates(&self, i: &Frame, j: &Frame, out: &mut [f64]) {
        match self {
            Self::Spherical { points, .. } => {
                out.copy_from_slice(gap_rate(i, j, points).as_slice());
            }
            Self::Revolute {
                points,
                normals,
                axis,
                ..
            } => {
                out[..3].copy_from_slice(gap_rate(i, j, points).as_slice());
                for (value, n) in out[3..].iter_mut().zip(normals) {
                    *value = product_rate(i, j, n, axis);
                }
            }
            Self::Perpendicular { vectors, .. } => {
                out[0] = product_rate(i, j, &vectors[0], &vectors[1]);
            }
            Self::Distance { points, .. } => {
                out[0] = 2.0 * gap(i, j, points).dot(&gap_rate(i, j, points));
            }
        }
    }

    /// Writes `gamma`, one number per row.
    pub fn gamma(&self, i: &Frame, j: &Frame, out: &mut [f64]) {
        match self {
            Self::Spherical { points, .. } => {
                out.copy_from_slice((-gap_centripetal(i, j, points)).as_slice());
            }
            Self::Revolute {
                points,
                normals,
                axis,
                ..
            } => {
                out[..3].copy_from_slice((-gap_centripetal(i, j, points)).as_slice());
                for (value, n) in out[3..].iter_mut().zip(normals) {
                    *value = product_gamma(i, j, n, axis);
                }
            }
            Self::Perpendicular { vectors, .. } => {
                out[0] = product_gamma(i, j, &vectors[0], &vectors[1]);
            }
            Self::Distance { points, .. } => {
                out[0] = -2.0
                    * (gap_rate(i, j, points).norm_squared()
                        + gap(i, j, points).dot(&gap_centripetal(i, j, points)));
            }
        }
    }

    /// Writes the rows of `D` from `row` on.
    pub(crate) fn jacobian(&self, i: &Frame, j: &Frame, row: usize, target: &mut impl Rows) {
        match self {
            Self::Spherical { points, .. } => coincidence(i, j, points, row, target),
            Self::Revolute {
                points,
                normals,
                axis,
                ..
            } => {
                coincidence(i, j, points, row, target);
                product(i, j, &normals[0], axis, row + 3, target);
                product(i, j, &normals[1], axis, row + 4, target);
            }
            Self::Perpendicular { vectors, .. } => {
                product(i, j, &vectors[0], &vectors[1], row, target);
            }
            Self::Distance { points, .. } => {
                let d = 2.0 * gap(i, j, points);
                for (frame, s, d) in [(i, &points[0], -d), (j, &points[1], d)] {
                    if let Some(column) = frame.translation_column {
                        target.line(row, column, &d);
                    }
                    if let Some(column) = frame.rotation_column {
                        target.line(row, column, &s.cross(&frame.rotation.tr_mul(&d)));
                    }
                }
            }
        }
    }
}

/// `P_j - P_i`.
fn gap(i: &Frame, j: &Frame, points: &[Vector3<f64>; 2]) -> Vector3<f64> {
    j.point(&points[1]) - i.point(&points[0])
}

/// `P_j' - P_i'`.
fn gap_rate(i: &Frame, j: &Frame, points: &[Vector3<f64>; 2]) -> Vector3<f64> {
    j.point_velocity(&points[1]) - i.point_velocity(&points[0])
}

/// `P_j'' - P_i''` at `u' = 0`.
fn gap_centripetal(i: &Frame, j: &Frame, points: &[Vector3<f64>; 2]) -> Vector3<f64> {
    j.centripetal(&points[1]) - i.centripetal(&points[0])
}

/// `(a . b)'` of `a` on `i` and `b` on `j`.
fn product_rate(i: &Frame, j: &Frame, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    i.vector_rate(a).dot(&(j.rotation * b)) + (i.rotation * a).dot(&j.vector_rate(b))
}

/// `-(a . b)''` at `u' = 0`.
fn product_gamma(i: &Frame, j: &Frame, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    -(i.centripetal(a).dot(&(j.rotation * b))
        + (i.rotation * a).dot(&j.centripetal(b))
        + 2.0 * i.vector_rate(a).dot(&j.vector_rate(b)))
}

/// Rows of `P_j - P_i`: `I` and `-A s~` for `j`, the opposite for `i`.
fn coincidence(
    i: &Frame,
    j: &Frame,
    points: &[Vector3<f64>; 2],
    row: usize,
    target: &mut impl Rows,
) {
    for (frame, s, sign) in [(i, &points[0], -1.0), (j, &points[1], 1.0)] {
        if let Some(column) = frame.translation_column {
            target.diagonal(row, column, sign);
        }
        if let Some(column) = frame.rotation_column {
            let block = frame.rotation * (-sign * s).cross_matrix();
            target.block(row, column, &block);
        }
    }
}

/// Row of `a . b`: `(a' x A_i^T b)^T` for `w_i`, `(b' x A_j^T a)^T` for `w_j`.
fn product(
    i: &Frame,
    j: &Frame,
    a: &Vector3<f64>,
    b: &Vector3<f64>,
    row: usize,
    target: &mut impl Rows,
) {
    if let Some(column) = i.rotation_column {
        let other = i.rotation.tr_mul(&(j.rotation * b));
        target.line(row, column, &a.cross(&other));
    }
    if let Some(column) = j.rotation_column {
        let other = j.rotation.tr_mul(&(i.rotation * a));
        target.line(row, column, &b.cross(&other));
    }
}
