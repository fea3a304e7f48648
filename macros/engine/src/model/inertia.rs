//! Principal axes of an inertia tensor, and rotations given by Euler parameters.

/// Euler parameters of no rotation.
pub const IDENTITY: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// The rotation matrix of unit Euler parameters (Nikravesh 1988, eq. 6.19), entries beyond
/// round-off from 0 and 1 only.
#[must_use]
pub fn rotation(p: [f64; 4]) -> [[f64; 3]; 3] {
    let [e0, e1, e2, e3] = p;
    let half = [
        [
            e0 * e0 + e1 * e1 - 0.5,
            e1 * e2 - e0 * e3,
            e1 * e3 + e0 * e2,
        ],
        [
            e1 * e2 + e0 * e3,
            e0 * e0 + e2 * e2 - 0.5,
            e2 * e3 - e0 * e1,
        ],
        [
            e1 * e3 - e0 * e2,
            e2 * e3 + e0 * e1,
            e0 * e0 + e3 * e3 - 0.5,
        ],
    ];
    half.map(|row| row.map(|entry| snap(2.0 * entry)))
}

/// Takes what differs from 0, 1 or -1 by round-off as exact, so that it folds.
#[must_use]
pub fn snap(value: f64) -> f64 {
    const ROUND_OFF: f64 = 8.0 * f64::EPSILON;
    let nearest = value.round();
    if nearest.abs() <= 1.0 && (value - nearest).abs() < ROUND_OFF {
        nearest + 0.0
    } else {
        value
    }
}

/// The product of Euler parameters: first `b`, then `a`.
#[must_use]
pub fn compose(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// Principal moments of a symmetric tensor, and the Euler parameters of the rotation that takes
/// components in the given axes to principal axes. Jacobi's method; a diagonal tensor keeps its
/// axes and their order.
#[must_use]
pub fn principal(tensor: [[f64; 3]; 3]) -> ([f64; 3], [f64; 4]) {
    let mut a = tensor;
    // Columns: principal axes in the given axes.
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let size = a.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    for _ in 0..64 {
        let (mut p, mut q) = (0, 1);
        for (k, l) in [(0, 2), (1, 2)] {
            if a[k][l].abs() > a[p][q].abs() {
                (p, q) = (k, l);
            }
        }
        if a[p][q].abs() <= f64::EPSILON * f64::EPSILON * size {
            break;
        }
        let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        let t = if theta < 0.0 { -1.0 } else { 1.0 } / (theta.abs() + theta.hypot(1.0));
        let c = 1.0 / t.hypot(1.0);
        let s = t * c;
        for row in &mut a {
            let (x, y) = (row[p], row[q]);
            row[p] = c * x - s * y;
            row[q] = s * x + c * y;
        }
        let (row_p, row_q) = (a[p], a[q]);
        a[p] = [0, 1, 2].map(|k| c * row_p[k] - s * row_q[k]);
        a[q] = [0, 1, 2].map(|k| s * row_p[k] + c * row_q[k]);
        for row in &mut axes {
            let (x, y) = (row[p], row[q]);
            row[p] = c * x - s * y;
            row[q] = s * x + c * y;
        }
    }
    let transposed = [0, 1, 2].map(|k| [axes[0][k], axes[1][k], axes[2][k]]);
    ([a[0][0], a[1][1], a[2][2]], euler_parameters(transposed))
}

/// Euler parameters of a rotation matrix, by the largest of the four (Nikravesh 1988, section
/// 6.2.3).
#[must_use]
pub fn euler_parameters(m: [[f64; 3]; 3]) -> [f64; 4] {
    let trace = m[0][0] + m[1][1] + m[2][2];
    let squares = [
        1.0 + trace,
        1.0 + 2.0 * m[0][0] - trace,
        1.0 + 2.0 * m[1][1] - trace,
        1.0 + 2.0 * m[2][2] - trace,
    ];
    let mut largest = 0;
    for k in 1..4 {
        if squares[k] > squares[largest] {
            largest = k;
        }
    }
    let skew = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let scale = 0.5 / squares[largest].sqrt();
    let mut p = [0.0; 4];
    p[largest] = 0.5 * squares[largest].sqrt();
    if largest == 0 {
        for k in 0..3 {
            p[k + 1] = scale * skew[k];
        }
    } else {
        let k = largest - 1;
        p[0] = scale * skew[k];
        for l in 0..3 {
            if l != k {
                p[l + 1] = scale * (m[k][l] + m[l][k]);
            }
        }
    }
    p
}

#[cfg(test)]
mod tests {
    use super::{compose, euler_parameters, principal, rotation};

    #[test]
    fn principal_axes_give_the_tensor_back() {
        let tensor = [[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.0]];
        let (moments, p) = principal(tensor);
        let c = rotation(p);
        for k in 0..3 {
            for l in 0..3 {
                let entry: f64 = (0..3).map(|m| c[m][k] * moments[m] * c[m][l]).sum();
                assert!(
                    (entry - tensor[k][l]).abs() < 1e-14,
                    "{entry} {}",
                    tensor[k][l]
                );
            }
        }
    }

    #[test]
    fn a_diagonal_tensor_keeps_its_axes() {
        let (moments, p) = principal([[3.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]]);
        assert_eq!((moments, p), ([3.0, 1.0, 2.0], super::IDENTITY));
    }

    #[test]
    fn rotations_compose() {
        let a = [0.5, 0.5, 0.5, 0.5];
        let b = [0.6, 0.0, 0.8, 0.0];
        let (ma, mb, mab) = (rotation(a), rotation(b), rotation(compose(a, b)));
        for k in 0..3 {
            for l in 0..3 {
                let entry: f64 = (0..3).map(|m| ma[k][m] * mb[m][l]).sum();
                assert!((entry - mab[k][l]).abs() < 1e-15);
            }
        }
        let back = euler_parameters(mab);
        let same: f64 = back.iter().zip(compose(a, b)).map(|(x, y)| x * y).sum();
        assert!((same.abs() - 1.0).abs() < 1e-15);
    }
}
