//! The pendulum of chapter 15 with matrices whose sizes the compiler knows: what a good engineer
//! writes by hand for one body and one revolute joint to the ground, without a generator.
//!
//! ```text
//! Phi = (r + A s - c, n_1 . A h, n_2 . A h)      D = [ I  -A s~ ; 0  (h x A^T n_k)^T ]
//! gamma = (-A w~ w~ s, -n_k . A w~ w~ h)         M u' + D^T lambda = g,  D u' = gamma
//! ```
//!
//! Sources: Flores (2015), chapter 15; Nikravesh (1988), chapters 7 and 8.

use nalgebra::linalg::Cholesky;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3, Vector4};

use crate::bodies::{Orientation, euler_rate, rotation};

/// Number of velocities.
const U: usize = 6;
/// Number of equations.
const M: usize = 5;

/// `lambda`: force on the joint's three point rows (N), then moment on its two axis rows (N m).
pub type Multipliers = SVector<f64, M>;

/// The data of the mechanism. The state is `x = (r, p, v, w)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum {
    /// Mass (kg).
    pub mass: f64,
    /// Principal moments of inertia about the centre of mass (kg m^2).
    pub inertia: Vector3<f64>,
    /// Acceleration of gravity (m/s^2, global axes).
    pub gravity: Vector3<f64>,
    /// `c`, the point on the ground (m, global axes).
    pub anchor: Vector3<f64>,
    /// `s`, the point on the body (m, body axes).
    pub point: Vector3<f64>,
    /// `n_1` and `n_2`, unit vectors perpendicular to the axis, on the ground (global axes).
    pub normals: [Vector3<f64>; 2],
    /// `h`, the unit axis on the body (body axes).
    pub axis: Vector3<f64>,
    /// How Euler parameters are read.
    pub orientation: Orientation,
}

/// What both solvers start from.
struct Terms {
    jacobian: SMatrix<f64, M, U>,
    gamma: SVector<f64, M>,
    forces: SVector<f64, U>,
}

impl Pendulum {
    /// The rod of chapter 15: hinged at the origin about x, gravity along -z (Flores 2015, table
    /// 15.1).
    #[must_use]
    pub fn chapter_15(orientation: Orientation) -> Self {
        let axis = Vector3::x();
        Self {
            mass: 7.02,
            inertia: Vector3::new(0.5855265, 0.0010530, 0.5855265),
            gravity: Vector3::new(0.0, 0.0, -9.81),
            anchor: Vector3::zeros(),
            point: Vector3::new(0.0, -0.5, 0.0),
            normals: crate::joints::normals(&axis),
            axis,
            orientation,
        }
    }

    /// The right-hand side `x' = (r', p', v', w')` by the Schur complement
    /// `(D M^-1 D^T) lambda = D M^-1 g - gamma` and Cholesky; returns `lambda`, or `None` and
    /// leaves `out` alone if the complement is not positive definite.
    #[must_use]
    pub fn rates_schur(
        &self,
        _time: f64,
        x: &[f64; 13],
        out: &mut [f64; 13],
    ) -> Option<Multipliers> {
        let Terms {
            jacobian,
            gamma,
            forces,
        } = self.terms(x);
        let mobility = self.mass_diagonal().map(f64::recip);
        let mut weighted = jacobian.transpose();
        for mut column in weighted.column_iter_mut() {
            column.component_mul_assign(&mobility);
        }
        let free = forces.component_mul(&mobility);
        let mut lambda = jacobian * free - gamma;
        Cholesky::new(jacobian * weighted)?.solve_mut(&mut lambda);
        write_rates(x, &(free - weighted * lambda), out);
        Some(lambda)
    }

    /// The same right-hand side by LU with partial pivoting of the whole `[M D^T; D 0]`, 11 by 11;
    /// returns `lambda`, or `None` and leaves `out` alone if the matrix is singular.
    #[must_use]
    pub fn rates_lu(&self, _time: f64, x: &[f64; 13], out: &mut [f64; 13]) -> Option<Multipliers> {
        let terms = self.terms(x);
        let mut matrix = SMatrix::<f64, { U + M }, { U + M }>::zeros();
        matrix
            .fixed_view_mut::<U, U>(0, 0)
            .set_diagonal(&self.mass_diagonal());
        matrix
            .fixed_view_mut::<M, U>(U, 0)
            .copy_from(&terms.jacobian);
        matrix
            .fixed_view_mut::<U, M>(0, U)
            .tr_copy_from(&terms.jacobian);
        let mut solution = SVector::<f64, { U + M }>::zeros();
        solution.fixed_rows_mut::<U>(0).copy_from(&terms.forces);
        solution.fixed_rows_mut::<M>(U).copy_from(&terms.gamma);
        if !matrix.lu().solve_mut(&mut solution) {
            return None;
        }
        write_rates(x, &solution.fixed_rows::<U>(0).into_owned(), out);
        Some(solution.fixed_rows::<M>(U).into_owned())
    }

    /// `(m, m, m, J1, J2, J3)`.
    fn mass_diagonal(&self) -> SVector<f64, U> {
        let Self {
            mass: m,
            inertia: j,
            ..
        } = self;
        SVector::from([*m, *m, *m, j.x, j.y, j.z])
    }

    /// `D`, `gamma` and `g` at a state.
    fn terms(&self, x: &[f64; 13]) -> Terms {
        let a = self.rotation(x);
        let w = Vector3::new(x[10], x[11], x[12]);
        let centripetal = |s: &Vector3<f64>| a * w.cross(&w.cross(s));
        let (point, axis) = (centripetal(&self.point), centripetal(&self.axis));
        let [n1, n2] = &self.normals;

        let mut jacobian = SMatrix::<f64, M, U>::zeros();
        jacobian.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        jacobian
            .fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&(a * (-self.point).cross_matrix()));
        for (row, n) in [(3, n1), (4, n2)] {
            jacobian
                .fixed_view_mut::<1, 3>(row, 3)
                .tr_copy_from(&self.axis.cross(&a.tr_mul(n)));
        }
        let force = self.gravity * self.mass;
        let torque = self.inertia.component_mul(&w).cross(&w);
        Terms {
            jacobian,
            gamma: -SVector::from([point.x, point.y, point.z, n1.dot(&axis), n2.dot(&axis)]),
            forces: SVector::from([force.x, force.y, force.z, torque.x, torque.y, torque.z]),
        }
    }

    /// `A` at a state, body to global axes.
    fn rotation(&self, x: &[f64; 13]) -> Matrix3<f64> {
        let p = euler(x);
        match self.orientation {
            Orientation::Raw => rotation(&p),
            Orientation::Normalised => rotation(&p) / p.norm_squared(),
        }
    }
}

/// `p` of a state.
fn euler(x: &[f64; 13]) -> Vector4<f64> {
    Vector4::new(x[3], x[4], x[5], x[6])
}

/// Writes `(v, 1/2 L(p)^T w, u')`.
fn write_rates(x: &[f64; 13], accelerations: &SVector<f64, U>, out: &mut [f64; 13]) {
    let w = Vector3::new(x[10], x[11], x[12]);
    out[..3].copy_from_slice(&x[7..10]);
    out[3..7].copy_from_slice(euler_rate(&euler(x), &w).as_slice());
    out[7..].copy_from_slice(accelerations.as_slice());
}
