//! Poses and axes of the second reader, over dual numbers.
#![allow(dead_code, reason = "every test uses a part of it")]

use num_dual::Dual2_64;

use crate::reading::Numbers;

pub(crate) type Vector = [Dual2_64; 3];

/// Position and Euler parameters of a body.
#[derive(Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) position: Vector,
    pub(crate) euler: [Dual2_64; 4],
}

pub(crate) fn constant(value: f64) -> Dual2_64 {
    Dual2_64::new(value, 0.0, 0.0)
}

/// The derivative along the motion, with one of its own; no second one is known.
pub(crate) fn rate(number: Dual2_64) -> Dual2_64 {
    Dual2_64::new(number.v1, number.v2, 0.0)
}

pub(crate) fn dot(a: Vector, b: Vector) -> Dual2_64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

impl Pose {
    /// A body that stands still.
    pub(crate) fn still(position: [f64; 3], euler: [f64; 4]) -> Self {
        Self {
            position: position.map(constant),
            euler: euler.map(constant),
        }
    }

    /// The angular velocity along the motion, global, with its derivative: half the sum of
    /// `a x a'` over the axes `a` of the body, which have the length of `p . p`.
    pub(crate) fn spin(&self) -> Vector {
        let mut twice = [constant(0.0); 3];
        for k in 0..3 {
            let axis = self.outwards([0, 1, 2].map(|l| constant(f64::from(u8::from(k == l)))));
            let turning = cross(axis, axis.map(rate));
            twice = [0, 1, 2].map(|l| twice[l] + turning[l]);
        }
        let square: f64 = self.euler.iter().map(|e| e.re * e.re).sum();
        twice.map(|part| part * (0.5 / square))
    }

    /// `A(p) s` by the formula for one vector: `(e0^2 - e.e) s + 2 e (e.s) + 2 e0 (e x s)`;
    /// backwards with `-e`.
    fn turned(&self, s: Vector, sign: f64) -> Vector {
        let [e0, x, y, z] = self.euler;
        let e = [x * sign, y * sign, z * sign];
        let (square, along, around) = (e0 * e0 - dot(e, e), dot(e, s), cross(e, s));
        [0, 1, 2].map(|k| square * s[k] + e[k] * along * 2.0 + e0 * around[k] * 2.0)
    }

    pub(crate) fn outwards(&self, s: Vector) -> Vector {
        self.turned(s, 1.0)
    }

    pub(crate) fn inwards(&self, s: Vector) -> Vector {
        self.turned(s, -1.0)
    }

    pub(crate) fn ground() -> Self {
        Self::still([0.0; 3], [1.0, 0.0, 0.0, 0.0])
    }

    /// From body axes to global ones.
    pub(crate) fn global_of(&self, s: Numbers) -> Numbers {
        self.outwards(s.map(constant)).map(|c| c.re)
    }

    /// From global axes to those of the body.
    pub(crate) fn local_of(&self, s: Numbers) -> Numbers {
        self.inwards(s.map(constant)).map(|c| c.re)
    }
}

/// The two unit vectors perpendicular to an axis, as the documentation has it: the first is
/// `e_k x a`, normalised, where component `k` of `a` is the smallest; axis, first and second are
/// right-handed.
pub(crate) fn normals(axis: Numbers) -> [Numbers; 2] {
    // Round-off must not decide between equals.
    let size = axis.map(f64::abs);
    let smallest = (0..3).fold(0, |k, l| if size[l] < size[k] - 1e-12 { l } else { k });
    let [x, y, z] = axis;
    let first = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]][smallest];
    let length = first.iter().map(|c| c * c).sum::<f64>().sqrt();
    let [a, b, c] = first.map(|component| component / length);
    [[a, b, c], [y * c - z * b, z * a - x * c, x * b - y * a]]
}

/// The same of an axis that the macro cannot see (Duff et al. 2017).
pub(crate) fn normals_without_cases([x, y, z]: Numbers) -> [Numbers; 2] {
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let (a, b) = (-1.0 / (sign + z), -x * y / (sign + z));
    [
        [1.0 + sign * x * x * a, sign * b, -sign * x],
        [b, sign + y * y * a, -y],
    ]
}
