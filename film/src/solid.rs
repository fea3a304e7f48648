//! Surfaces of solids as triangles, for other programs to draw.

use std::f32::consts::TAU;

use holonom::nalgebra::{Isometry3, Vector3};

/// Triangles, three corners each, with the normals at the corners.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    pub(crate) points: Vec<Vector3<f32>>,
    pub(crate) normals: Vec<Vector3<f32>>,
}

/// Steps around an axis, and from pole to pole of a ball.
const AROUND: usize = 32;
const POLES: usize = 16;

impl Surface {
    /// What a line of places (along x, from x) encloses as it turns about x. An edge is sharp.
    pub(crate) fn turned(line: &[[f32; 2]]) -> Self {
        let mut surface = Self::default();
        for pair in line.windows(2) {
            let [[x1, r1], [x2, r2]] = [pair[0], pair[1]];
            // To the left of the way along x.
            let normal = [r1 - r2, x2 - x1];
            let corner = |[x, r]: [f32; 2], [nx, nr]: [f32; 2], step: usize| {
                let (sine, cosine) = (TAU * step as f32 / AROUND as f32).sin_cos();
                let at = |x: f32, r: f32| Vector3::new(x, r * cosine, r * sine);
                (at(x, r), at(nx, nr).normalize())
            };
            for step in 0..AROUND {
                let [a, b, c, d] = [
                    corner([x1, r1], normal, step),
                    corner([x2, r2], normal, step),
                    corner([x2, r2], normal, step + 1),
                    corner([x1, r1], normal, step + 1),
                ];
                surface.face([a, d, c]);
                surface.face([a, c, b]);
            }
        }
        surface
    }

    /// Along x, from one end to the other about the origin.
    pub(crate) fn tube(long: f32, outer: f32, inner: f32) -> Self {
        let (a, b) = (-0.5 * long, 0.5 * long);
        let mut line = vec![[a, inner], [a, outer], [b, outer], [b, inner]];
        if inner > 0.0 {
            line.push([a, inner]);
        }
        Self::turned(&line)
    }

    /// Its centre of mass is at the origin, its tip along x.
    pub(crate) fn cone(long: f32, radius: f32) -> Self {
        let (base, tip) = (-0.25 * long, 0.75 * long);
        Self::turned(&[[base, 0.0], [base, radius], [tip, 0.0]])
    }

    pub(crate) fn ball(radius: f32) -> Self {
        let place = |step: usize| {
            let (sine, cosine) = (0.5 * TAU * step as f32 / POLES as f32).sin_cos();
            [-radius * cosine, radius * sine]
        };
        let mut line: Vec<_> = (0..=POLES).map(place).collect();
        // Round-off would turn the last triangles inside out.
        line[POLES] = [radius, 0.0];
        let mut ball = Self::turned(&line);
        ball.normals = ball.points.iter().map(|point| point / radius).collect();
        ball
    }

    pub(crate) fn block(sizes: [f32; 3]) -> Self {
        let mut surface = Self::default();
        let half = sizes.map(|size| 0.5 * size);
        for axis in 0..3 {
            let (k, l) = ((axis + 1) % 3, (axis + 2) % 3);
            for sign in [-1.0_f32, 1.0] {
                let corner = |a: f32, b: f32| {
                    let (mut at, mut normal) = (Vector3::zeros(), Vector3::zeros());
                    (at[axis], at[k], at[l]) = (sign * half[axis], sign * a * half[k], b * half[l]);
                    normal[axis] = sign;
                    (at, normal)
                };
                let [a, b, c, d] =
                    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| corner(a, b));
                surface.face([a, b, c]);
                surface.face([a, c, d]);
            }
        }
        surface
    }

    /// Flat triangles.
    pub(crate) fn flat(faces: impl Iterator<Item = [Vector3<f32>; 3]>) -> Self {
        let mut surface = Self::default();
        for [a, b, c] in faces {
            let normal = (b - a).cross(&(c - a)).normalize();
            surface.face([a, b, c].map(|corner| (corner, normal)));
        }
        surface
    }

    /// A triangle, unless it is a line.
    fn face(&mut self, corners: [(Vector3<f32>, Vector3<f32>); 3]) {
        let [(a, _), (b, _), (c, _)] = corners;
        if (b - a).cross(&(c - a)).norm_squared() > 0.0 {
            for (point, normal) in corners {
                self.points.push(point);
                self.normals.push(normal);
            }
        }
    }

    /// Adds another surface at a place.
    pub(crate) fn add(&mut self, other: &Self, place: &Isometry3<f32>) {
        let points = other
            .points
            .iter()
            .map(|point| place * holonom::nalgebra::Point3::from(*point));
        self.points.extend(points.map(|point| point.coords));
        self.normals
            .extend(other.normals.iter().map(|normal| place * normal));
    }
}

#[cfg(test)]
mod tests {
    use super::Surface;

    /// The volume that triangles enclose whose corners are seen anticlockwise from outside.
    fn volume(surface: &Surface) -> f32 {
        let faces = surface.points.chunks(3);
        faces
            .map(|face| face[0].dot(&face[1].cross(&face[2])) / 6.0)
            .sum()
    }

    #[test]
    fn surfaces_enclose_their_volumes() {
        use std::f32::consts::PI;
        // A polygon of 32 corners has 0.6 % less area than its circle.
        let near = |surface: &Surface, wanted: f32| {
            let found = volume(surface);
            assert!(
                found < wanted && found > 0.97 * wanted,
                "{found} beside {wanted}"
            );
        };
        near(&Surface::tube(2.0, 0.3, 0.0), PI * 0.09 * 2.0);
        near(&Surface::tube(2.0, 0.3, 0.2), PI * 0.05 * 2.0);
        near(&Surface::cone(2.0, 0.3), PI * 0.09 * 2.0 / 3.0);
        near(&Surface::ball(0.3), 4.0 / 3.0 * PI * 0.027);
        let block = Surface::block([0.2, 0.3, 0.4]);
        assert!((volume(&block) - 0.024).abs() < 1e-6);
        for surface in [block, Surface::ball(0.3), Surface::cone(2.0, 0.3)] {
            for (face, normals) in surface.points.chunks(3).zip(surface.normals.chunks(3)) {
                let outwards = (face[1] - face[0]).cross(&(face[2] - face[0]));
                assert!(normals.iter().all(|normal| normal.dot(&outwards) > 0.0));
                assert!(
                    normals
                        .iter()
                        .all(|normal| (normal.norm() - 1.0).abs() < 1e-5)
                );
            }
        }
    }
}
