//! Frames and inertias.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};

/// A frame in another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// From axes of the frame to axes of the other one.
    pub(crate) rotation: Matrix3<f64>,
    /// The frame's origin in the other one (m).
    pub(crate) origin: Vector3<f64>,
}

impl Frame {
    pub(crate) const IDENTITY: Self = Self {
        rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        origin: Vector3::new(0.0, 0.0, 0.0),
    };

    /// A frame in this one, in the frame in which this one is.
    pub(crate) fn compose(&self, inner: &Self) -> Self {
        Self {
            rotation: self.rotation * inner.rotation,
            origin: self.origin + self.rotation * inner.origin,
        }
    }
}

/// How far from a quarter turn an angle may be to be taken as one (rad): six figures of pi.
const NEARLY: f64 = 1e-5;

/// The rotation of URDF's `rpy` (rad): about the fixed axes x, y and z, in this order.
pub(crate) fn rotation(rpy: Vector3<f64>, quarter_turns: bool) -> Matrix3<f64> {
    let ways = [rpy.x, rpy.y, rpy.z].map(|angle| sine_and_cosine(angle, quarter_turns));
    let [(sx, cx), (sy, cy), (sz, cz)] = ways;
    let about_x = Matrix3::new(1.0, 0.0, 0.0, 0.0, cx, -sx, 0.0, sx, cx);
    let about_y = Matrix3::new(cy, 0.0, sy, 0.0, 1.0, 0.0, -sy, 0.0, cy);
    let about_z = Matrix3::new(cz, -sz, 0.0, sz, cz, 0.0, 0.0, 0.0, 1.0);
    about_z * about_y * about_x
}

/// Exact at quarter turns, to the last digits of the angle or of what a file gives of pi.
fn sine_and_cosine(angle: f64, quarter_turns: bool) -> (f64, f64) {
    let quarters = (angle / FRAC_PI_2).round();
    let near = if quarter_turns {
        NEARLY
    } else {
        2.0 * f64::EPSILON * angle.abs()
    };
    if (angle - quarters * FRAC_PI_2).abs() > near {
        return angle.sin_cos();
    }
    match quarters.rem_euclid(4.0) as u8 {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// Euler parameters of a rotation, scalar first, of length 1, the first that is not zero positive.
pub(crate) fn euler_parameters(rotation: &Matrix3<f64>) -> [f64; 4] {
    let r = |i: usize, k: usize| rotation[(i, k)];
    // Four times the products of each Euler parameter with all; the longest row is the best.
    let (xx, yy, zz) = (r(0, 0), r(1, 1), r(2, 2));
    let (wx, wy, wz) = (r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
    let (xy, xz, yz) = (r(0, 1) + r(1, 0), r(0, 2) + r(2, 0), r(1, 2) + r(2, 1));
    let rows = [
        [1.0 + xx + yy + zz, wx, wy, wz],
        [wx, 1.0 + xx - yy - zz, xy, xz],
        [wy, xy, 1.0 - xx + yy - zz, yz],
        [wz, xz, yz, 1.0 - xx - yy + zz],
    ];
    let squares = |row: &[f64; 4]| row.iter().map(|x| x * x).sum::<f64>();
    let mut best = rows[0];
    for row in rows {
        if squares(&row) > squares(&best) {
            best = row;
        }
    }
    let length = squares(&best).sqrt();
    let first = best.iter().find(|x| x.abs() > 1e-9 * length);
    let sign = if first.is_some_and(|x| *x < 0.0) {
        -1.0
    } else {
        1.0
    };
    best.map(|x| x / (sign * length))
}

/// What the macro would refuse as a number: nothing that small is meant.
const LEAST: f64 = 1e-40;

/// Without a negative zero.
pub(crate) fn number(x: f64) -> f64 {
    if x.abs() < LEAST { 0.0 } else { x }
}

pub(crate) fn clean(vector: Vector3<f64>) -> [f64; 3] {
    [vector.x, vector.y, vector.z].map(number)
}

/// Mass, centre of mass and inertia.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    /// In kg.
    pub(crate) mass: f64,
    /// In some frame (m).
    pub(crate) centre: Vector3<f64>,
    /// About the centre of mass, in axes of that frame (kg m^2).
    pub(crate) tensor: Matrix3<f64>,
}

impl Inertia {
    pub(crate) const ZERO: Self = Self {
        mass: 0.0,
        centre: Vector3::new(0.0, 0.0, 0.0),
        tensor: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    /// A mass at a point.
    pub(crate) fn point(mass: f64, centre: Vector3<f64>) -> Self {
        Self {
            mass,
            centre,
            ..Self::ZERO
        }
    }

    /// What is given in a frame, in the frame in which that one is: `R I R^T`.
    pub(crate) fn carried(&self, frame: &Frame) -> Self {
        let r = &frame.rotation;
        Self {
            mass: self.mass,
            centre: frame.origin + r * self.centre,
            tensor: tidied(r * self.tensor * r.transpose()),
        }
    }

    /// Both as one body, by the parallel axis theorem.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if self.mass == 0.0 || other.mass == 0.0 {
            let centre = if self.mass == 0.0 {
                other.centre
            } else {
                self.centre
            };
            let tensor = self.tensor + other.tensor;
            return Self {
                mass,
                centre,
                tensor,
            };
        }
        let centre = (self.centre * self.mass + other.centre * other.mass) / mass;
        let apart = other.centre - self.centre;
        // Two masses at a distance: that of the reduced mass.
        let reduced = self.mass * other.mass / mass;
        let around = Matrix3::identity() * apart.norm_squared() - apart * apart.transpose();
        Self {
            mass,
            centre,
            tensor: self.tensor + other.tensor + around * reduced,
        }
    }

    /// Principal moments (kg m^2), from the smallest.
    pub(crate) fn moments(&self) -> [f64; 3] {
        let mut moments: [f64; 3] = self.tensor.symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        moments
    }
}

/// Symmetric, and without products that are round-off of the rotation.
fn tidied(tensor: Matrix3<f64>) -> Matrix3<f64> {
    let symmetric = (tensor + tensor.transpose()) * 0.5;
    let round_off = 2.0 * f64::EPSILON * symmetric.amax();
    symmetric.map(|x| if x.abs() <= round_off { 0.0 } else { x })
}
