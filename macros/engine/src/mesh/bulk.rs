//! What a closed surface encloses: sums over the tetrahedra from a point to its triangles.
//!
//! Those of triangles that face the point count negative. The second moments of a tetrahedron with
//! corners 0, a, b, c are `V / 20 (a a^T + b b^T + c c^T + s s^T)` with `s = a + b + c`: F. Tonon,
//! *Explicit exact formulas for the 3-D tetrahedron inertia tensor in terms of its vertex
//! coordinates*, J. Math. Stat. 1 (2005) 8-11.

use super::surface::{Point, Surface};

/// A volume of density 1, in the coordinates of its surface.
#[derive(Clone, Copy, Debug)]
pub struct Bulk {
    /// Its size; negative where the surface is inside out.
    pub volume: f64,
    /// Its centre.
    pub centre: [f64; 3],
    /// The inertia tensor about its centre.
    pub tensor: [[f64; 3]; 3],
}

impl Bulk {
    pub(super) fn new(surface: &Surface) -> Self {
        // From a point in the middle, so that little cancels.
        let count = surface.triangles().count() as f64;
        let mean = |k: usize| -> f64 {
            let corners = surface.triangles().flatten();
            corners.map(|corner| corner[k] / (3.0 * count)).sum()
        };
        let middle = [0, 1, 2].map(mean);
        let (mut volume, mut first, mut second) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
        for corners in surface.triangles() {
            let [a, b, c] = corners.map(|corner| [0, 1, 2].map(|k| corner[k] - middle[k]));
            let part = determinant(a, b, c) / 6.0;
            let s = [0, 1, 2].map(|k| a[k] + b[k] + c[k]);
            volume += part;
            for k in 0..3 {
                first[k] += 0.25 * part * s[k];
                for l in 0..3 {
                    let products = a[k] * a[l] + b[k] * b[l] + c[k] * c[l] + s[k] * s[l];
                    second[k][l] += part / 20.0 * products;
                }
            }
        }
        let centre = first.map(|moment| moment / volume);
        for k in 0..3 {
            for l in 0..3 {
                second[k][l] -= volume * centre[k] * centre[l];
            }
        }
        let trace = second[0][0] + second[1][1] + second[2][2];
        let entry = |k: usize, l: usize| {
            if k == l {
                trace - second[k][k]
            } else {
                -second[k][l]
            }
        };
        Self {
            volume,
            centre: [0, 1, 2].map(|k| middle[k] + centre[k]),
            tensor: [0, 1, 2].map(|k| [0, 1, 2].map(|l| entry(k, l))),
        }
    }
}

/// Six times the volume of a tetrahedron with a corner at the origin.
pub(super) fn determinant(a: Point, b: Point, c: Point) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
