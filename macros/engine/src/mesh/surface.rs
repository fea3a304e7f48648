//! Triangles that share their corners, closed to all sides.

use std::collections::HashMap;

/// A point in the coordinates of a file.
pub(super) type Point = [f64; 3];

/// Three corners, seen anticlockwise from outside.
pub(super) type Triangle = [Point; 3];

/// A closed surface.
pub(super) struct Surface {
    points: Vec<Point>,
    /// Places of corners.
    faces: Vec<[usize; 3]>,
}

impl Surface {
    /// Joins equal corners, and leaves out triangles of which two corners are one.
    pub(super) fn new(triangles: &[Triangle]) -> Result<Self, String> {
        let mut known = HashMap::new();
        let mut points = Vec::new();
        let mut faces = Vec::new();
        for triangle in triangles {
            if triangle.iter().flatten().any(|x| !x.is_finite()) {
                return Err("has a corner whose place is not a number".into());
            }
            let face = triangle.map(|point| {
                // Negative zero is zero.
                *known
                    .entry(point.map(|x| (x + 0.0).to_bits()))
                    .or_insert_with(|| {
                        points.push(point);
                        points.len() - 1
                    })
            });
            if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
                faces.push(face);
            }
        }
        if faces.is_empty() {
            return Err("has no triangles".into());
        }
        let surface = Self { points, faces };
        surface.closed().map(|()| surface)
    }

    /// Along every edge as many triangles go one way as the other.
    fn closed(&self) -> Result<(), String> {
        let mut ways: HashMap<[usize; 2], [u32; 2]> = HashMap::new();
        for face in &self.faces {
            for [from, to] in edges(*face) {
                let way = usize::from(from > to);
                ways.entry([from.min(to), from.max(to)]).or_default()[way] += 1;
            }
        }
        let open = ways.iter().filter(|(_, [there, back])| there != back);
        let Some((first, [there, back])) = open.clone().min() else {
            return Ok(());
        };
        let [from, to] = first.map(|point| self.points[point]);
        let count = open.count();
        let what = if (there + back) % 2 == 0 {
            "with neighbours of which one is inside out"
        } else {
            "at a hole"
        };
        Err(format!(
            "does not enclose a volume: it has {count} edges {what}, as from {from:?} to {to:?}"
        ))
    }

    /// Corners of its triangles.
    pub(super) fn triangles(&self) -> impl Iterator<Item = Triangle> {
        let faces = self.faces.iter();
        faces.map(|face| face.map(|corner| self.points[corner]))
    }
}

/// The edges of a triangle, around it.
fn edges([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}
