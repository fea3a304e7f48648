//! `Phi` over any number type of num-dual, and from it `D` and `gamma` by automatic
//! differentiation.
//!
//! Nothing here is derived by hand and nothing is shared with the rows of
//! [`joints`](crate::joints): points and vectors are rotated by the formula for one vector,
//! `A(p) s = (e0^2 - e.e) s + 2 e (e.s) + 2 e0 (e x s)`, and derivatives follow curves `q(h)`:
//!
//! * a column of `D`: `r + h`, or `p + h/2 L(p)^T d` with `d` a unit vector of the body, first
//!   derivative at `h = 0`;
//! * `gamma`: `q + q' h + 1/2 q'' h^2` with `u' = 0`, so `p' = 1/2 L(p)^T w`,
//!   `p'' = 1/2 L(p')^T w`, at the time `t + h`, and minus the second derivative at `h = 0`;
//! * `Phi_t`: the time `t + h` alone; the gradient of the potential energy of springs: the curves
//!   of the columns of `D`.
//!
//! A law of time is known by its value and two derivatives, so of a driver this checks how they
//! enter the rows; whether they are the derivatives of the law, finite differences have to say.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Vector3, Vector4};
use num_dual::{Dual2_64, Dual64, DualNum, DualStruct};

use crate::assembler::Assembler;
use crate::bodies::{BodyId, Kind, Orientation, euler_rate};
use crate::forces::Force;
use crate::joints::Row;
use crate::kinematics::Mark;
use crate::laws::Motion;
use crate::scalars::Scalar;

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

/// The poses of all bodies, the ground first, and the auxiliary states.
struct Configuration<T> {
    poses: Vec<Pose<T>>,
    turns: Vec<f64>,
}

impl<T: Number> Configuration<T> {
    fn at(assembler: &Assembler, q: &[T]) -> Self {
        let auxiliary = &q[assembler.body_coordinates()..];
        Self {
            poses: (0..=assembler.bodies().count())
                .map(|body| Pose::at(assembler, BodyId(body), q))
                .collect(),
            turns: auxiliary.iter().map(DualStruct::re).collect(),
        }
    }

    fn vector(&self, mark: &Mark) -> Vector<T> {
        self.poses[mark.body.0].vector(&mark.local)
    }

    fn point(&self, mark: &Mark) -> Vector<T> {
        self.poses[mark.body.0].point(&mark.local)
    }

    fn gap(&self, [head, tail]: &[Mark; 2]) -> Vector<T> {
        subtract(self.point(tail), self.point(head))
    }

    fn scalar(&self, scalar: &Scalar) -> T {
        match scalar {
            Scalar::Product([a, b]) => dot(self.vector(a), self.vector(b)),
            Scalar::Along { axis, points } => dot(self.vector(axis), self.gap(points)),
            Scalar::SquaredLength(points) => {
                let d = self.gap(points);
                dot(d, d)
            }
            Scalar::Length(points) => {
                let d = self.gap(points);
                dot(d, d).sqrt()
            }
            Scalar::Angle(angle) => {
                let pointer = self.vector(&angle.pointer);
                let [x, y] = angle.normals.map(|n| dot(self.vector(&n), pointer));
                let principal = y.atan2(x);
                let slot = angle.slot.expect("an angle of the assembler is counted");
                let turns = ((self.turns[slot] - principal.re()) / TAU).round();
                principal + T::from(TAU * turns)
            }
        }
    }
}

/// A law at a time over a number type, by its Taylor series: exact to the second derivative.
fn law<T: Number>(motion: &Motion, time: T) -> T {
    let [value, rate, curvature] = motion.at(time.re()).map(T::from);
    let step = time - T::from(time.re());
    value + step * (rate + step * curvature * T::from(0.5))
}

/// `Phi(q)` over a number type at the time zero, one number per equation; the same rows as
/// [`Assembler::constraints`].
pub fn constraints<T: Number>(assembler: &Assembler, q: &[T]) -> Vec<T> {
    constraints_at(assembler, T::from(0.0), q)
}

/// `Phi(q, t)` over a number type, one number per equation; the same rows as
/// [`Assembler::constraints_at`].
pub fn constraints_at<T: Number>(assembler: &Assembler, time: T, q: &[T]) -> Vec<T> {
    let at = Configuration::at(assembler, q);
    let mut rows = Vec::with_capacity(assembler.equations());
    for row in assembler.joints().flat_map(|(joint, _)| joint.rows()) {
        match row {
            Row::Coincidence(points) => rows.extend(at.gap(points)),
            Row::Combination { terms, motion } => {
                let mut value = -law(motion, time);
                for (factor, term) in terms {
                    value += at.scalar(term) * T::from(*factor);
                }
                rows.push(value);
            }
        }
    }
    rows
}

/// Potential energy of springs over a number type (J).
pub fn spring_energy<T: Number>(assembler: &Assembler, q: &[T]) -> T {
    let at = Configuration::at(assembler, q);
    let mut energy = T::from(0.0);
    for force in assembler.applied_forces() {
        if let Force::Spring {
            along,
            stiffness,
            free,
            ..
        } = force
        {
            let stretch = at.scalar(along) - T::from(*free);
            energy += stretch * stretch * T::from(0.5 * stiffness);
        }
    }
    energy
}

/// The generalised force of springs at the state `x = (q, u)`: minus the gradient of
/// [`spring_energy`], by first derivatives (N, global axes; N m, body axes).
#[must_use]
pub fn spring_forces(assembler: &Assembler, x: &[f64]) -> DVector<f64> {
    DVector::from_fn(assembler.velocities(), |column, _| {
        -spring_energy(assembler, &curve(assembler, x, column)).eps
    })
}

/// The coordinates of `x = (q, u)` along the unit motion of one velocity.
fn curve(assembler: &Assembler, x: &[f64], column: usize) -> Vec<Dual64> {
    let q = &x[..assembler.coordinates()];
    let mut u = DVector::zeros(assembler.velocities());
    u[column] = 1.0;
    let slope = coordinate_rates(assembler, q, u.as_slice());
    q.iter()
        .zip(slope.iter())
        .map(|(q, slope)| Dual64::new(*q, *slope))
        .collect()
}

/// `Phi_t` at a time (s) and the state `x = (q, u)`, by first derivatives.
#[must_use]
pub fn time_rates(assembler: &Assembler, time: f64, x: &[f64]) -> DVector<f64> {
    let q: Vec<_> = x[..assembler.coordinates()]
        .iter()
        .map(|q| Dual64::from(*q))
        .collect();
    let rows = constraints_at(assembler, Dual64::new(time, 1.0), &q);
    DVector::from_iterator(rows.len(), rows.iter().map(|row| row.eps))
}

/// `D` at the state `x = (q, u)` by first derivatives; the same matrix as [`Assembler::jacobian`].
#[must_use]
pub fn jacobian(assembler: &Assembler, x: &[f64]) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(assembler.equations(), assembler.velocities());
    for column in 0..assembler.velocities() {
        let curve = curve(assembler, x, column);
        for (row, value) in constraints(assembler, &curve).iter().enumerate() {
            out[(row, column)] = value.eps;
        }
    }
    out
}

/// `Phi'` and `gamma` at the state `x = (q, u)` and the time zero by first and second derivatives
/// along the motion with `u' = 0`.
#[must_use]
pub fn constraint_rates_and_gamma(
    assembler: &Assembler,
    x: &[f64],
) -> (DVector<f64>, DVector<f64>) {
    constraint_rates_and_gamma_at(assembler, 0.0, x)
}

/// The same at a time (s), which goes on along the motion.
#[must_use]
pub fn constraint_rates_and_gamma_at(
    assembler: &Assembler,
    time: f64,
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
    let rows = constraints_at(assembler, Dual2_64::new(time, 1.0, 0.0), &curve);
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
