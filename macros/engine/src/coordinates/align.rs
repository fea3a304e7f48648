//! Where angles are counted from: a link's frame may be turned about the axis of its motion, so
//! that more of what is fixed in it lies on coordinate axes.
//!
//! What is described at an angle of 0.1 rad has sines and cosines of 0.1 in every vector, and each
//! costs operations at every evaluation. Counted from where the vectors lie on axes, the angle is
//! 0.1 rad at the start, and they have zeros.

use super::algebra::apply;
use super::freedom::Freedom;
use super::links::Links;
use crate::model::{Binding, Model, ParameterKind};
use crate::symbolic::arena::{Arena, Expr};
use crate::symbolic::fixed::{clean, size, transpose};
use crate::symbolic::vector::Triple;

/// Cosine and sine of an angle in the reference configuration.
pub(super) type ReferenceAngle = [Expr; 2];

/// The angle of a frame that is not turned.
pub(super) const NOT_TURNED: ReferenceAngle = [Arena::ONE, Arena::ZERO];

impl Links {
    /// The points of closing joints, each with the link that it is fixed on and in that one's
    /// frame.
    pub(super) fn closing_points(
        &self,
        arena: &mut Arena,
        model: &Model,
        closing: &[usize],
    ) -> Vec<(usize, Triple)> {
        let mut points = Vec::new();
        for joint in closing.iter().map(|&joint| &model.joints[joint]) {
            let parameters = &model.definition(joint).parameters;
            for (parameter, binding) in parameters.iter().zip(&joint.bindings) {
                let (ParameterKind::Point, Binding::Global(point)) = (parameter.kind, binding)
                else {
                    continue;
                };
                for &body in joint.bodies.iter().flatten() {
                    if let Some(link) = self.bodies[body].link {
                        points.push((link, self.point_on(arena, model, Some(body), *point)));
                    }
                }
            }
        }
        points
    }

    /// What is fixed on each link, global axes in the reference configuration: some points, the
    /// first moment with what is carried, offsets and axes of what is carried.
    pub(super) fn fixed_vectors(
        &self,
        arena: &mut Arena,
        points: &[(usize, Triple)],
    ) -> Vec<Vec<Triple>> {
        let mut regrouped = self.clone();
        regrouped.regroup(arena, &mut []);
        let mut vectors = Vec::new();
        for place in 0..self.links.len() {
            // Of equals the first counts: a mass that is handed over takes a component of the first
            // moment with it.
            let points = points.iter().filter(|(link, _)| *link == place);
            let mut fixed: Vec<Triple> = points.map(|(_, point)| *point).collect();
            fixed.push(regrouped.links[place].inertia.first);
            for child in self.children(Some(place)) {
                fixed.push(self.links[child].offset);
                match self.links[child].freedom {
                    Freedom::Turn { axis, .. } | Freedom::Screw { axis, .. } => {
                        fixed.push(self.axis_on_carrier(arena, child, axis));
                    }
                    Freedom::Slide { along, .. } => fixed.push(along),
                    Freedom::Ball { .. } => {}
                }
            }
            let into = transpose(self.rotation_into(self.links[place].frame));
            vectors.push(fixed.iter().map(|&v| apply(arena, into, v)).collect());
        }
        vectors
    }
}

/// The turn about a coordinate axis by which the most components of vectors vanish; none where no
/// other is better.
pub(super) fn best_angle(arena: &mut Arena, vectors: &[Triple], axis: usize) -> ReferenceAngle {
    let across = ((axis + 1) % 3, (axis + 2) % 3);
    let mut best = (zeros(arena, vectors, across, NOT_TURNED), NOT_TURNED);
    for v in vectors {
        let Some(angle) = onto_axis(arena, v[across.0], v[across.1]) else {
            continue;
        };
        let zeros = zeros(arena, vectors, across, angle);
        if zeros > best.0 {
            best = (zeros, angle);
        }
    }
    best.1
}

/// The smallest turn of the axes that brings one of them onto a vector; `None` where it is there,
/// or unknown.
fn onto_axis(arena: &mut Arena, x: Expr, y: Expr) -> Option<ReferenceAngle> {
    let (x, y) = (arena.literal(x)?, arena.literal(y)?);
    if x == 0.0 || y == 0.0 {
        return None;
    }
    let length = x.hypot(y);
    // Onto the first axis or the second, forwards or backwards.
    let (c, s) = if x.abs() >= y.abs() {
        (x.abs(), y * x.signum())
    } else {
        (y.abs(), -x * y.signum())
    };
    let (c, s) = (c / length, s / length);
    Some([c, s].map(|part| arena.constant(part)))
}

/// The components of a vector along axes that are turned by an angle, without round-off.
pub(super) fn turned_axes(
    arena: &mut Arena,
    v: Triple,
    (i, j): (usize, usize),
    [c, s]: ReferenceAngle,
    size: f64,
) -> Triple {
    let [ci, si, cj, sj] =
        [(c, v[i]), (s, v[i]), (c, v[j]), (s, v[j])].map(|(a, b)| arena.mul(a, b));
    let mut turned = v;
    turned[i] = arena.add(ci, sj);
    turned[j] = arena.sub(cj, si);
    clean(arena, turned, size)
}

/// The zeros among the components of vectors across an axis, were the frame turned.
fn zeros(arena: &mut Arena, fixed: &[Triple], across: (usize, usize), by: ReferenceAngle) -> usize {
    let mut zeros = 0;
    for &v in fixed {
        let size = size(arena, v);
        let turned = turned_axes(arena, v, across, by, size);
        let across = [turned[across.0], turned[across.1]].into_iter();
        zeros += across.filter(|&component| component == Arena::ZERO).count();
    }
    zeros
}
