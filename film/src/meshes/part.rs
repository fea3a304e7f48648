//! A mesh of one colour.

use std::collections::HashMap;

use holonom::nalgebra::{Matrix4, Point3, Vector3};

use crate::page::{Mesh, Shorts};

/// Triangles of one colour. Corners are seen anticlockwise from outside.
#[derive(Clone, Debug, Default)]
pub(crate) struct Part {
    /// Such as `#4c8eda`.
    pub(crate) colour: Option<String>,
    pub(crate) points: Vec<Vector3<f64>>,
    pub(crate) faces: Vec<[u32; 3]>,
}

/// A page counts the corners of a mesh by 16 bits.
const CORNERS: usize = 1 << 16;

impl Part {
    /// The mesh in another frame. A reflection turns it inside out, which is undone.
    pub(crate) fn transform(&mut self, by: &Matrix4<f64>) {
        for point in &mut self.points {
            *point = by.transform_point(&Point3::from(*point)).coords;
        }
        if by.fixed_view::<3, 3>(0, 0).determinant() < 0.0 {
            for [_, second, third] in &mut self.faces {
                std::mem::swap(second, third);
            }
        }
    }

    /// Drops what has no place, and joins equal points, so that faces which meet have the same.
    pub(crate) fn welded(&mut self) {
        let mut known = HashMap::new();
        let mut points = Vec::new();
        let places: Vec<Option<u32>> = self
            .points
            .iter()
            .map(|point| {
                let is_place = point.iter().all(|x| x.is_finite());
                is_place.then(|| {
                    // Negative zero is zero.
                    let bits = [point.x, point.y, point.z].map(|x| ((x + 0.0) as f32).to_bits());
                    *known.entry(bits).or_insert_with(|| {
                        points.push(*point);
                        points.len() as u32 - 1
                    })
                })
            })
            .collect();
        let place = |corner: u32| places.get(corner as usize).copied().flatten();
        let faces = self.faces.iter().filter_map(|&[a, b, c]| {
            let face = [place(a)?, place(b)?, place(c)?];
            is_triangle(face).then_some(face)
        });
        self.faces = faces.collect();
        self.points = points;
    }

    /// Three corners of each triangle.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> {
        let at = |corner: u32| self.points[corner as usize];
        self.faces.iter().map(move |face| face.map(at))
    }

    /// The area of all triangles.
    pub(crate) fn area(&self) -> f64 {
        let doubled = self
            .triangles()
            .map(|[a, b, c]| (b - a).cross(&(c - a)).norm());
        0.5 * doubled.sum::<f64>()
    }

    /// The mesh as a page has it: several where it has too many corners.
    pub(crate) fn packed(&self, body: Option<usize>) -> Vec<Mesh> {
        let mut meshes = Vec::new();
        let mut faces = &self.faces[..];
        while !faces.is_empty() {
            let mut places: HashMap<u32, u16> = HashMap::new();
            let mut corners: Vec<Vector3<f64>> = Vec::new();
            let mut packed = Vec::new();
            let mut taken = 0;
            for face in faces {
                if corners.len() + 3 > CORNERS {
                    break;
                }
                packed.extend(face.map(|corner| {
                    *places.entry(corner).or_insert_with(|| {
                        corners.push(self.points[corner as usize]);
                        (corners.len() - 1) as u16
                    })
                }));
                taken += 1;
            }
            faces = &faces[taken..];
            meshes.push(self.boxed(body, &corners, packed));
        }
        meshes
    }

    /// Corners as parts of their box.
    fn boxed(&self, body: Option<usize>, corners: &[Vector3<f64>], faces: Vec<u16>) -> Mesh {
        let first = corners[0];
        let low = corners.iter().fold(first, |low, corner| low.inf(corner));
        let high = corners.iter().fold(first, |high, corner| high.sup(corner));
        let step = |k: usize, at: f64| {
            let wide = high[k] - low[k];
            let part = if wide > 0.0 {
                (at - low[k]) / wide
            } else {
                0.0
            };
            (part * f64::from(u16::MAX)).round() as u16
        };
        let steps = corners
            .iter()
            .flat_map(|corner| [0, 1, 2].map(|k| step(k, corner[k])));
        Mesh {
            body,
            colour: self.colour.clone(),
            low: [low.x, low.y, low.z].map(|x| x as f32),
            high: [high.x, high.y, high.z].map(|x| x as f32),
            corners: Shorts(steps.collect()),
            faces: Shorts(faces),
        }
    }
}

/// Whether no corner is another one.
pub(crate) fn is_triangle([a, b, c]: [u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// Shares of red, green and blue as a page has a colour.
pub(crate) fn colour(shares: [f64; 3]) -> String {
    let [red, green, blue] = shares.map(|share| (share.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}
