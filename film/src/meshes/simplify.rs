//! Fewer triangles: corners that are near each other become one.
//!
//! Space is divided into cubes, and each cube keeps the point from which the planes of its
//! triangles are nearest (P. Lindstrom, "Out-of-core simplification of large polygonal models",
//! SIGGRAPH 2000). So flat faces stay flat and edges sharp. All meshes have cubes of one size, so
//! that they look equally fine.

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

use holonom::nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::part::{Part, is_triangle};

/// Tries for a size of the cubes.
const TRIES: usize = 12;
/// A try is good enough with this part of the triangles that are asked for.
const ENOUGH: f64 = 0.8;
/// Directions in which planes say less than this part of what they say in others are left alone:
/// a flat or round face has no sharpest point.
const FLAT: f64 = 1e-3;

/// Leaves at most so many triangles in all.
pub(super) fn to(parts: &mut [Part], most: usize) {
    let before: usize = parts.iter().map(|part| part.faces.len()).sum();
    let area: f64 = parts.iter().map(Part::area).sum();
    if before <= most || area <= 0.0 {
        return;
    }
    let most = most.max(1);
    // A cube on a surface has about a corner, and a corner two triangles.
    let mut cube = (2.0 * area / most as f64).sqrt();
    // The cubes that give the most triangles of those that do not give too many.
    let mut best: Option<(usize, f64)> = None;
    for _ in 0..TRIES {
        let after: usize = parts.iter().map(|part| count(part, cube)).sum();
        let ratio = after as f64 / most as f64;
        if ratio <= 1.0 && best.is_none_or(|(most, _)| most < after) {
            best = Some((after, cube));
        }
        if (ENOUGH..=1.0).contains(&ratio) {
            break;
        }
        // Towards the middle of what is good enough.
        cube *= (ratio.clamp(0.01, 100.0) / (0.5 + 0.5 * ENOUGH)).sqrt();
    }
    let cube = best.map_or(cube, |(_, cube)| cube);
    for part in parts {
        *part = clustered(part, cube);
    }
}

/// Cubes are many, and nobody chooses their places to be slow: a product hashes them.
#[derive(Default)]
struct Product(u64);

impl Hasher for Product {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.write_u64(u64::from(number));
    }

    fn write_i64(&mut self, number: i64) {
        self.write_u64(number.cast_unsigned());
    }

    fn write_u64(&mut self, number: u64) {
        // An odd number near 2^64 over the golden ratio (D. E. Knuth, The Art of Computer
        // Programming 3, 6.4); the high bits are the mixed ones.
        let mixed = (self.0 ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 32);
    }
}

type Hash = BuildHasherDefault<Product>;

/// The number of the cube of each corner, and how many cubes there are.
fn clusters(part: &Part, cube: f64) -> (Vec<u32>, usize) {
    let mut places: HashMap<(i64, i64, i64), u32, Hash> = HashMap::default();
    let cell = |x: f64| (x / cube).floor() as i64;
    let clusters = part.points.iter().map(|point| {
        let next = places.len() as u32;
        let key = (cell(point.x), cell(point.y), cell(point.z));
        *places.entry(key).or_insert(next)
    });
    let clusters = clusters.collect();
    (clusters, places.len())
}

/// At least as many triangles as are left.
fn count(part: &Part, cube: f64) -> usize {
    let (clusters, _) = clusters(part, cube);
    let faces = part.faces.iter();
    let faces = faces.map(|face| face.map(|corner| clusters[corner as usize]));
    faces.filter(|face| is_triangle(*face)).count()
}

/// The planes of the triangles at the corners of a cube: the sum of squared distances from them,
/// and the mean of the corners.
#[derive(Clone, Default)]
struct Planes {
    squares: Matrix3<f64>,
    linear: Vector3<f64>,
    points: Vector3<f64>,
    weight: f64,
}

impl Planes {
    /// The point nearest to all planes that is no farther from the mean than the cube is wide.
    fn nearest(&self, cube: f64) -> Vector3<f64> {
        let mean = self.points / self.weight;
        let SymmetricEigen {
            eigenvalues,
            eigenvectors,
        } = SymmetricEigen::new(self.squares);
        let largest = eigenvalues.amax();
        let residual = self.linear - self.squares * mean;
        let mut off = Vector3::zeros();
        for (value, vector) in eigenvalues.iter().zip(eigenvectors.column_iter()) {
            if *value > FLAT * largest {
                off += vector * (vector.dot(&residual) / value);
            }
        }
        if off.norm() <= cube { mean + off } else { mean }
    }
}

fn clustered(part: &Part, cube: f64) -> Part {
    let (clusters, cubes) = clusters(part, cube);
    let mut planes = vec![Planes::default(); cubes];
    let mut known: HashSet<[u32; 3], Hash> = HashSet::default();
    let mut faces = Vec::new();
    for (face, [a, b, c]) in part.faces.iter().zip(part.triangles()) {
        let normal = 0.5 * (b - a).cross(&(c - a));
        let area = normal.norm();
        let face = face.map(|corner| clusters[corner as usize]);
        for (cluster, corner) in face.into_iter().zip([a, b, c]) {
            let planes = &mut planes[cluster as usize];
            planes.squares += normal * normal.transpose();
            planes.linear += normal * normal.dot(&a);
            planes.points += area * corner;
            planes.weight += area;
        }
        // The smallest first, so that equal triangles are known.
        let first = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
        let turned = [0, 1, 2].map(|k| face[(first + k) % 3]);
        if is_triangle(turned) && known.insert(turned) {
            faces.push(turned);
        }
    }
    let points = planes.iter().map(|planes| {
        if planes.weight > 0.0 {
            planes.nearest(cube)
        } else {
            Vector3::zeros()
        }
    });
    Part {
        colour: part.colour.clone(),
        points: points.collect(),
        faces,
    }
}
