//! `Phi` over any number type of num-dual, and from it `D` and `gamma` by automatic differentiation.
//!
//! Nothing here is derived by hand and nothing is shared with the rows of [`joints`](crate::joints): points and
//! vectors are rotated by the formula for one vector, `A(p) s = (e0^2 - e.e) s + 2 e (e.s) + 2 e0 (e x s)`, and derivatives
//! follow curves `q(h)`:
//!
//! * a column of `D`: `r + h`, or `p + h/2 L(p)^T d` with `d` a unit vector of the body, first derivative at `h = 0`;
//! * `gamma`: `q + q' h + 1/2 q'' h^2` with `u' = 0`, so `p' = 1/2 L(p)^T w`, `p'' = 1/2 L(p')^T w`, and minus the second
//!   derivative at `h = 0`.

use nalgebra::{DMatrix, DVector, Vector3, Vector4};
use num_dual::{Dual2_64, Dual64, DualNum};

use crate::assembler::Assembler;
use crate::bodies::{BodyId, Kind, Orientation, euler_rate};
use crate::joints::Joint;

/// A number type of num-dual over `f64`: `f64` itself, `Dual64`, `Dual2_64`, `HyperDual64`, ...
pub trait Number: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

type Vector<T> = [T; 3];

/// Position and Euler parameters of a body over a number type.
struct Pose<T> {
    position: Vector<T>,
    euler: [T; 4],
}

fn dot<T: Number>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Number>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn subtract<T: Number>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

impl<T: Number> Pose<T> {
    /// The pose of a body at `q`.
    fn at(assembler: &Assembler, body: BodyId, q: &[T]) -> Self {
        let zero = T::from(0.0);
        let mut pose = Self {
            position: [zero; 3],
            euler: [T::from(1.0), zero, zero, zero],
        };
        let Some((body, start, _)) = assembler.bodies().nth(body.0.wrapping_sub(1)) else {
            return pose;
        };
        if body.kind != Kind::Ground {
            pose.position.copy_from_slice(&q[start..start + 3]);
        }
        if body.kind == Kind::Rigid {
            pose.euler.copy_from_slice(&q[start + 3..start + 7]);
            if assembler.orientation() == Orientation::Normalised {
                let squares = pose.euler.map(|e| e * e);
                let length = (squares[0] + squares[1] + squares[2] + squares[3]).sqrt();
                pose.euler = pose.euler.map(|e| e / length);
            }
        }
        pose
    }

    /// `A s`.
    fn vector(&self, s: &Vector3<f64>) -> Vector<T> {
        let s = [s.x, s.y, s.z].map(T::from);
        let [e0, e1, e2, e3] = self.euler;
        let e = [e1, e2, e3];
        let scale = e0 * e0 - dot(e, e);
        let along = dot(e, s) * T::from(2.0);
        let turned = cross(e, s);
        [0, 1, 2].map(|k| scale * s[k] + along * e[k] + T::from(2.0) * e0 * turned[k])
    }

    /// `r + A s`.
    fn point(&self, s: &Vector3<f64>) -> Vector<T> {
        let arm = self.vector(s);
        [0, 1, 2].map(|k| self.position[k] + arm[k])
    }
}

/// `Phi(q)` over a number type, one number per equation; the same rows as
/// [`Assembler::constraints`].
pub fn constraints<T: Number>(assembler: &Assembler, q: &[T]) -> Vec<T> {
    let mut rows = Vec::with_capacity(assembler.equations());
    for (joint, _) in assembler.joints() {
        let [i, j] = joint.between().map(|body| Pose::at(assembler, body, q));
        let gap = |points: &[Vector3<f64>; 2]| subtract(j.point(&points[1]), i.point(&points[0]));
        match joint {
            Joint::Spherical { points, .. } => rows.extend(gap(points)),
            Joint::Revolute {
                points,
                normals,
                axis,
                ..
            } => {
                rows.extend(gap(points));
                rows.extend(normals.map(|n| dot(i.vector(&n), j.vector(axis))));
            }
            Joint::Perpendicular { vectors, .. } => {
                rows.push(dot(i.vector(&vectors[0]), j.vector(&vectors[1])));
            }
            Joint::Distance { points, length, .. } => {
                let d = gap(points);
                rows.push(dot(d, d) - T::from(length * length));
            }
        }
    }
    rows
}

/// `D` at the state `x = (q, u)` by first derivatives; the same matrix as [`Assembler::jacobian`].
#[must_use]
pub fn jacobian(assembler: &Assembler, x: &[f64]) -> DMatrix<f64> {
    let q = &x[..assembler.coordinates()];
    let mut out = DMatrix::zeros(assembler.equations(), assembler.velocities());
    for column in 0..assembler.velocities() {
        let mut u = DVector::zeros(assembler.velocities());
        u[column] = 1.0;
        let slope = coordinate_rates(assembler, q, u.as_slice());
        let curve: Vec<_> = q
            .iter()
            .zip(slope.iter())
            .map(|(q, slope)| Dual64::new(*q, *slope))
            .collect();
        for (row, value) in constraints(assembler, &curve).iter().enumerate() {
            out[(row, column)] = value.eps;
        }
    }
    out
}

/// `Phi'` and `gamma` at the state `x = (q, u)` by first and second derivatives along the motion with `u' = 0`.
#[must_use]
pub fn constraint_rates_and_gamma(
    assembler: &Assembler,
    x: &[f64],
) -> (DVector<f64>, DVector<f64>) {
    let (q, u) = x.split_at(assembler.coordinates());
    let rate = coordinate_rates(assembler, q, u);
    // The rates of the coordinates are linear in p, so p'' is the same map at p'; r'' = v' = 0.
    let mut curvature = coordinate_rates(assembler, rate.as_slice(), u);
    for (body, start, _) in assembler.bodies() {
        if body.kind != Kind::Ground {
            curvature.fixed_rows_mut::<3>(start).fill(0.0);
        }
    }
    let curve: Vec<_> = (0..q.len())
        .map(|k| Dual2_64::new(q[k], rate[k], curvature[k]))
        .collect();
    let rows = constraints(assembler, &curve);
    (
        DVector::from_iterator(rows.len(), rows.iter().map(|row| row.v1)),
        DVector::from_iterator(rows.len(), rows.iter().map(|row| -row.v2)),
    )
}

/// `q'` at `q` with velocities `u`.
fn coordinate_rates(assembler: &Assembler, q: &[f64], u: &[f64]) -> DVector<f64> {
    let mut out = DVector::zeros(q.len());
    for (body, k, n) in assembler.bodies() {
        if body.kind != Kind::Ground {
            out.fixed_rows_mut::<3>(k)
                .copy_from(&Vector3::from_column_slice(&u[n..n + 3]));
        }
        if body.kind == Kind::Rigid {
            let p = Vector4::from_column_slice(&q[k + 3..k + 7]);
            let w = Vector3::from_column_slice(&u[n + 3..n + 6]);
            out.fixed_rows_mut::<4>(k + 3)
                .copy_from(&euler_rate(&p, &w));
        }
    }
    out
}
