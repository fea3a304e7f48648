//! Where a part is: its points, directions and rotations, from its own axes to global ones.

use super::number::Numbers;
use super::turning::Turn;
use crate::model::inertia::{IDENTITY, compose, rotation};
use crate::model::{Binding, Body, Number, ParameterKind, Shape, ShapeKind};

/// A mirror, then a rotation, then a translation.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    /// The axis that the plane of the mirror is perpendicular to.
    pub(super) mirror: Option<usize>,
    /// The rotation.
    pub(super) rotation: Turn,
    /// The translation (m).
    pub(super) at: [Number; 3],
}

impl Placement {
    /// The placement of a part of this part.
    pub(super) fn of_part(&self, inner: &Self, numbers: &mut Numbers<'_>) -> Self {
        let seen = numbers.mirrored(&inner.rotation, self.mirror);
        let turned = numbers.composed(&self.rotation, &seen);
        let (mirror, turned) = match (self.mirror, inner.mirror) {
            (one, None) | (None, one) => (one, turned),
            (Some(a), Some(b)) if a == b => (None, turned),
            // Two mirrors are half a turn about the third axis.
            (Some(a), Some(b)) => {
                let mut half = [0.0; 4];
                half[1 + (3 - a - b)] = 1.0;
                (None, numbers.composed(&turned, &Turn::Seen(half)))
            }
        };
        Self {
            mirror,
            rotation: turned,
            at: self.point(inner.at, numbers),
        }
    }

    /// A point in global axes.
    pub(super) fn point(&self, point: [Number; 3], numbers: &mut Numbers<'_>) -> [Number; 3] {
        self.applied(point, self.at, numbers)
    }

    /// A direction in global axes.
    fn direction(&self, direction: [Number; 3], numbers: &mut Numbers<'_>) -> [Number; 3] {
        self.applied(direction, [Number::ZERO; 3], numbers)
    }

    /// Mirrored, then turned; and something added.
    fn applied(
        &self,
        vector: [Number; 3],
        constant: [Number; 3],
        numbers: &mut Numbers<'_>,
    ) -> [Number; 3] {
        let Some(p) = self.rotation.seen() else {
            let mirrored = self.local(vector, numbers);
            return numbers.turned(&self.rotation, mirrored, constant);
        };
        let mut matrix = rotation(p);
        if let Some(axis) = self.mirror {
            matrix.iter_mut().for_each(|row| row[axis] = -row[axis]);
        }
        [0, 1, 2].map(|k| numbers.linear(matrix[k], vector, constant[k]))
    }

    /// A vector in the axes of a body, which are mirrored with it.
    fn local(&self, vector: [Number; 3], numbers: &mut Numbers<'_>) -> [Number; 3] {
        let mut local = vector;
        if let Some(axis) = self.mirror {
            local[axis] = numbers.negated(local[axis]);
        }
        local
    }

    /// Moves a body there. Its user's axes lie as in the mirror, but for the one across it, which
    /// is turned round: `R` becomes `S R S`.
    pub(super) fn body(&self, body: &mut Body, numbers: &mut Numbers<'_>) {
        let name = body.name.clone();
        let at = |numbers: &mut Numbers<'_>, attribute: &str| {
            numbers.field = name.clone();
            numbers.attribute = attribute.into();
        };
        at(numbers, "position");
        body.position = self.point(body.position, numbers);
        at(numbers, "velocity");
        body.velocity = self.direction(body.velocity, numbers);
        at(numbers, "angular_velocity");
        let spin = self.local(body.angular_velocity, numbers);
        body.angular_velocity = match self.mirror {
            Some(_) => spin.map(|component| numbers.negated(component)),
            None => spin,
        };
        at(numbers, "orientation");
        body.orientation = self.orientation(body.orientation, numbers);
        body.user_axes = mirrored(body.user_axes, self.mirror);
        body.shapes.iter_mut().for_each(|shape| self.shape(shape));
    }

    /// Euler parameters of a body's axes, of any length.
    fn orientation(&self, p: [Number; 4], numbers: &mut Numbers<'_>) -> [Number; 4] {
        let Some(rotation) = self.rotation.seen() else {
            let p = numbers.mirrored(&numbers.turn(p), self.mirror);
            return numbers.parameters(&numbers.composed(&self.rotation, &p));
        };
        let mut p = p;
        if let Some(axis) = self.mirror {
            for k in [0, 1, 2] {
                if k != axis {
                    p[1 + k] = numbers.negated(p[1 + k]);
                }
            }
        }
        if rotation == IDENTITY {
            return p;
        }
        let [a, b, c, d] = rotation;
        let product = [[a, -b, -c, -d], [b, a, -d, c], [c, d, a, -b], [d, -c, b, a]];
        product.map(|row| numbers.linear(row, p, Number::ZERO))
    }

    /// What a body looks like, in its axes. Every shape but a mesh is symmetric to the plane across
    /// its z axis.
    fn shape(&self, shape: &mut Shape) {
        let Some(axis) = self.mirror else { return };
        if let (ShapeKind::Mesh, Number::Literal(scale)) = (shape.kind, &mut shape.sizes[2]) {
            *scale = -*scale;
        }
        shape.centre[axis] = -shape.centre[axis];
        // Mirrors across `axis` and across the shape's own z are a rotation.
        let turned = mirrored(shape.axes, Some(axis));
        shape.axes = if axis == 2 {
            turned
        } else {
            let mut half = [0.0; 4];
            half[1 + (1 - axis)] = 1.0;
            compose(turned, half)
        };
    }

    /// Moves what a parameter of a joint or a force is. `is_pseudovector`: see `mirror.rs`.
    pub(super) fn binding(
        &self,
        binding: Binding,
        kind: ParameterKind,
        is_pseudovector: bool,
        numbers: &mut Numbers<'_>,
    ) -> Binding {
        let signed = |vector: [Number; 3], numbers: &mut Numbers<'_>| {
            if self.mirror.is_some() && is_pseudovector {
                vector.map(|component| numbers.negated(component))
            } else {
                vector
            }
        };
        match binding {
            Binding::Global(point) if kind == ParameterKind::Point => {
                Binding::Global(self.point(point, numbers))
            }
            Binding::Global(vector) => {
                let placed = self.direction(vector, numbers);
                Binding::Global(signed(placed, numbers))
            }
            Binding::Local(copies) => {
                let copies = copies.into_iter().map(|copy| {
                    let local = self.local(copy, numbers);
                    signed(local, numbers)
                });
                Binding::Local(copies.collect())
            }
            other => other,
        }
    }
}

/// Euler parameters of a rotation that is seen in a mirror.
fn mirrored(p: [f64; 4], mirror: Option<usize>) -> [f64; 4] {
    let mut p = p;
    if let Some(axis) = mirror {
        for k in [0, 1, 2] {
            if k != axis {
                p[1 + k] = -p[1 + k];
            }
        }
    }
    p
}

#[cfg(test)]
mod tests {
    use super::{Number, Placement, Shape, ShapeKind, Turn, rotation};
    use crate::model::inertia::IDENTITY;
    use crate::model::number::literals;

    /// A mesh of a mirrored part has its points where a mirror shows them.
    #[test]
    fn meshes_are_mirrored() {
        let point = |shape: &Shape| {
            let (a, scale) = (rotation(shape.axes), literals(&shape.sizes));
            let scale = scale.expect("numbers");
            let in_file = [0.3, -0.2, 0.7];
            let along = |k: usize| -> f64 { (0..3).map(|l| a[k][l] * scale[l] * in_file[l]).sum() };
            [0, 1, 2].map(|k| shape.centre[k] + along(k))
        };
        for axis in 0..3 {
            let placement = Placement {
                mirror: Some(axis),
                rotation: Turn::Seen(IDENTITY),
                at: [Number::ZERO; 3],
            };
            let mut shape = Shape {
                kind: ShapeKind::Mesh,
                sizes: [Number::Literal(2.0); 3],
                centre: [0.1, 0.2, 0.3],
                axes: [0.5, 0.5, -0.1, 0.7],
                is_hole: false,
                file: None,
            };
            let mut wanted = point(&shape);
            wanted[axis] = -wanted[axis];
            placement.shape(&mut shape);
            let found = point(&shape);
            for k in 0..3 {
                assert!((found[k] - wanted[k]).abs() < 1e-14, "{found:?} {wanted:?}");
            }
        }
    }
}
