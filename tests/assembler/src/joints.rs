//! Joints: the bodies they connect and the rows they write.
//!
//! A joint is a list of primitive rows over the marks of one to three bodies: coincidences of
//! points, and scalar rows `Phi = sum of c_k f_k(q) - f(t)` of the functions of
//! [`scalars`](crate::scalars). The time stands apart from the configuration, so `Phi_t = -f'`,
//! `Phi_tt = -f''` and no mixed derivative is left:
//!
//! ```text
//! Phi' = D u + Phi_t      D u' = gamma      gamma = -(sum of c_k f_k'' at u' = 0) + f''
//! ```
//!
//! Coincidence: `Phi = P_j - P_i`, rows `I`, `-A_j s_j~` for `v_j`, `w_j` (those of `i` alike),
//! `gamma` the centripetal terms `A_i w_i~ w_i~ s_i - A_j w_j~ w_j~ s_j`. Sources: Nikravesh
//! (1988), chapters 7 and 8; Flores (2015), chapters 7 to 9.
//!
//! The joints by name, from points and axes in global axes, are in [`library`](crate::library) and
//! [`drivers`](crate::drivers).

use nalgebra::Vector3;

use crate::angles::Angle;
use crate::bodies::BodyId;
use crate::kinematics::{Kinematics, Mark};
use crate::laws::Motion;
use crate::rows::Rows;
use crate::scalars::Scalar;

/// A primitive of a joint.
#[derive(Clone, Debug)]
pub enum Row {
    /// Two points coincide: 3 rows, `P_j - P_i` in global axes (m).
    Coincidence([Mark; 2]),
    /// `sum of c_k f_k(q) - f(t)`: 1 row.
    Combination {
        /// The factors `c_k` and the functions `f_k`.
        terms: Vec<(f64, Scalar)>,
        /// `f`.
        motion: Motion,
    },
}

/// A joint among one to three bodies, with points (m) and vectors in the axes of the body that
/// carries them.
#[derive(Clone, Debug)]
pub struct Joint {
    bodies: Vec<BodyId>,
    points: Vec<Vector3<f64>>,
    rows: Vec<Row>,
}

/// A rule that gives an axis its two normals.
pub type Normals = fn(&Vector3<f64>) -> [Vector3<f64>; 2];

/// Two unit vectors that with the unit axis `a` make a right-handed frame `(n1, n2, a)`.
///
/// With `k` the place of the component of `a` that is smallest in absolute value (the first one of
/// equals): `n1 = (e_k x a) / |e_k x a|`, `n2 = a x n1`.
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

/// The same by a rule that compares no components, for an axis that becomes known at run time:
/// `n1 = (1 + s a1^2 c, s a1 a2 c, -s a1)` and `n2 = a x n1`, with `s` the sign of `a3` and
/// `c = -1 / (s + a3)` (Duff et al., *Building an Orthonormal Basis, Revisited*, Journal of
/// Computer Graphics Techniques 6 (2017), 1-8).
#[must_use]
pub fn smooth_normals(a: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let s = 1.0_f64.copysign(a.z);
    let c = -1.0 / (s + a.z);
    let n1 = Vector3::new(1.0 + s * a.x * a.x * c, s * a.x * a.y * c, -s * a.x);
    [n1, a.cross(&n1)]
}

impl Row {
    /// A function that keeps a value: `f(q) - value`.
    #[must_use]
    pub fn constant(function: Scalar, value: f64) -> Self {
        Self::driven(function, Motion::Constant(value))
    }

    /// A function that follows a law: `f(q) - f(t)`.
    #[must_use]
    pub fn driven(function: Scalar, motion: Motion) -> Self {
        Self::Combination {
            terms: vec![(1.0, function)],
            motion,
        }
    }

    /// A combination that keeps the value zero.
    #[must_use]
    pub fn combination(terms: impl Into<Vec<(f64, Scalar)>>) -> Self {
        Self::Combination {
            terms: terms.into(),
            motion: Motion::Constant(0.0),
        }
    }

    /// Two vectors that stay perpendicular (type 1): `a . b`.
    #[must_use]
    pub fn perpendicular(a: Mark, b: Mark) -> Self {
        Self::constant(Scalar::Product([a, b]), 0.0)
    }

    /// Number of rows.
    #[must_use]
    pub const fn equations(&self) -> usize {
        match self {
            Self::Coincidence(_) => 3,
            Self::Combination { .. } => 1,
        }
    }

    /// Calls `three` with the points of a coincidence, `one` with the terms and the law of a
    /// combination.
    fn write(
        &self,
        out: &mut [f64],
        three: impl Fn(&[Mark; 2]) -> Vector3<f64>,
        one: impl Fn(&[(f64, Scalar)], &Motion) -> f64,
    ) {
        match self {
            Self::Coincidence(points) => out.copy_from_slice(three(points).as_slice()),
            Self::Combination { terms, motion } => out[0] = one(terms, motion),
        }
    }
}

/// `sum of c_k f(f_k)`.
fn sum(terms: &[(f64, Scalar)], of: impl Fn(&Scalar) -> f64) -> f64 {
    terms.iter().map(|(factor, term)| factor * of(term)).sum()
}

impl Joint {
    /// A joint from its bodies, the point on each of them to which reactions are reduced (m, body
    /// axes; zero is the centre of mass), and its rows.
    ///
    /// # Panics
    /// Without as many points as bodies.
    #[must_use]
    pub fn new(
        bodies: impl Into<Vec<BodyId>>,
        points: impl Into<Vec<Vector3<f64>>>,
        rows: impl Into<Vec<Row>>,
    ) -> Self {
        let (bodies, points) = (bodies.into(), points.into());
        assert_eq!(bodies.len(), points.len(), "one point for each body");
        Self {
            bodies,
            points,
            rows: rows.into(),
        }
    }

    /// Two points on two bodies coincide: 3 rows.
    #[must_use]
    pub fn spherical_at(between: [BodyId; 2], points: [Vector3<f64>; 2]) -> Self {
        Self::new(between, points, [coincidence(between, points)])
    }

    /// Two points coincide and two axes stay parallel: the 3 rows of a spherical joint, then
    /// `n_1 . h` and `n_2 . h` of `n_1` and `n_2` on body `i` and the axis `h` on body `j`.
    #[must_use]
    pub fn revolute_at(
        between: [BodyId; 2],
        points: [Vector3<f64>; 2],
        normals: [Vector3<f64>; 2],
        axis: Vector3<f64>,
    ) -> Self {
        let [n1, n2] = normals.map(|n| Mark::new(between[0], n));
        let axis = Mark::new(between[1], axis);
        let rows = [
            coincidence(between, points),
            Row::perpendicular(n1, axis),
            Row::perpendicular(n2, axis),
        ];
        Self::new(between, points, rows)
    }

    /// Two vectors, on body `i` and on body `j`, stay perpendicular: 1 row.
    #[must_use]
    pub fn perpendicular_at([i, j]: [BodyId; 2], [a, b]: [Vector3<f64>; 2]) -> Self {
        let row = Row::perpendicular(Mark::new(i, a), Mark::new(j, b));
        Self::new([i, j], [Vector3::zeros(); 2], [row])
    }

    /// Two points keep the distance `length` (m): 1 row, `d . d - L^2` (m^2).
    #[must_use]
    pub fn distance_at(between: [BodyId; 2], points: [Vector3<f64>; 2], length: f64) -> Self {
        let ends = marks(between, points);
        let row = Row::constant(Scalar::SquaredLength(ends), length * length);
        Self::new(between, points, [row])
    }

    /// Adds rows behind the others.
    pub(crate) fn push(&mut self, row: Row) {
        self.rows.push(row);
    }

    /// The bodies, in the order in which the joint names them.
    #[must_use]
    pub fn bodies(&self) -> &[BodyId] {
        &self.bodies
    }

    /// The point on each body (m, body axes) to which reactions are reduced; the centre of mass
    /// where a joint names none.
    #[must_use]
    pub fn points(&self) -> &[Vector3<f64>] {
        &self.points
    }

    /// The primitives in order.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Number of rows.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.rows.iter().map(Row::equations).sum()
    }

    /// The angles in the order in which the rows name them.
    pub(crate) fn angles_mut(&mut self) -> impl Iterator<Item = &mut Angle> {
        let terms = self.rows.iter_mut().flat_map(|row| match row {
            Row::Coincidence(_) => [].iter_mut(),
            Row::Combination { terms, .. } => terms.iter_mut(),
        });
        terms.filter_map(|(_, term)| match term {
            Scalar::Angle(angle) => Some(angle),
            _ => None,
        })
    }

    /// Calls a kernel of every row with the row's part of `out`.
    fn for_rows(&self, out: &mut [f64], kernel: impl Fn(&Row, &mut [f64])) {
        let mut first = 0;
        for row in &self.rows {
            let next = first + row.equations();
            kernel(row, &mut out[first..next]);
            first = next;
        }
    }

    /// Writes `Phi`, one number per row.
    pub fn constraints(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |row, out| {
            row.write(
                out,
                |[i, j]| j.point(at) - i.point(at),
                |terms, motion| sum(terms, |f| f.value(at)) - motion.at(at.time)[0],
            );
        });
    }

    /// Writes `Phi' = D u + Phi_t`, one number per row.
    pub fn constraint_rates(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |row, out| {
            row.write(
                out,
                |[i, j]| j.point_rate(at) - i.point_rate(at),
                |terms, motion| sum(terms, |f| f.rate(at)) - motion.at(at.time)[1],
            );
        });
    }

    /// Writes `gamma`, one number per row.
    pub fn gamma(&self, at: &Kinematics, out: &mut [f64]) {
        self.for_rows(out, |row, out| {
            row.write(
                out,
                |[i, j]| i.curvature(at) - j.curvature(at),
                |terms, motion| motion.at(at.time)[2] - sum(terms, |f| f.curvature(at)),
            );
        });
    }

    /// Writes `Phi_t` for the order 1 and `Phi_tt` for the order 2, one number per row.
    pub fn time_derivatives(&self, time: f64, order: usize, out: &mut [f64]) {
        self.for_rows(out, |row, out| {
            let one = |_: &[(f64, Scalar)], motion: &Motion| -motion.at(time)[order];
            row.write(out, |_| Vector3::zeros(), one);
        });
    }

    /// Writes the rows of `D` from `row` on.
    pub(crate) fn jacobian(&self, at: &Kinematics, row: usize, target: &mut impl Rows) {
        let mut line = row;
        for row in &self.rows {
            match row {
                Row::Coincidence(points) => write_coincidence(at, points, line, target),
                Row::Combination { terms, .. } => match terms.as_slice() {
                    [(factor, term)] if term.touches_columns_once() => {
                        term.gradient(at, *factor, &mut |column, entries| {
                            target.line(line, column, entries);
                        });
                    }
                    terms => {
                        self.clear(at, line, target);
                        for (factor, term) in terms {
                            term.gradient(at, *factor, &mut |column, entries| {
                                target.add(line, column, entries);
                            });
                        }
                    }
                },
            }
            line += row.equations();
        }
    }

    /// Writes zeros for all bodies of the joint, for terms to be added to.
    fn clear(&self, at: &Kinematics, row: usize, target: &mut impl Rows) {
        for body in &self.bodies {
            let frame = at.frame(*body);
            let columns = [frame.translation_column, frame.rotation_column];
            for column in columns.into_iter().flatten() {
                target.line(row, column, &Vector3::zeros());
            }
        }
    }
}

fn marks([i, j]: [BodyId; 2], [s_i, s_j]: [Vector3<f64>; 2]) -> [Mark; 2] {
    [Mark::new(i, s_i), Mark::new(j, s_j)]
}

fn coincidence(between: [BodyId; 2], points: [Vector3<f64>; 2]) -> Row {
    Row::Coincidence(marks(between, points))
}

/// Rows of `P_j - P_i`: `I` and `-A s~` for `j`, the opposite for `i`.
fn write_coincidence(at: &Kinematics, points: &[Mark; 2], row: usize, target: &mut impl Rows) {
    for (point, sign) in points.iter().zip([-1.0, 1.0]) {
        let frame = at.frame(point.body);
        if let Some(column) = frame.translation_column {
            target.diagonal(row, column, sign);
        }
        if let Some(column) = frame.rotation_column {
            let block = frame.rotation * (-sign * point.local).cross_matrix();
            target.block(row, column, &block);
        }
    }
}
