//! Points and vectors that are fixed on bodies: from the attributes to components in principal body axes.
//!
//! What the macro can see becomes a literal; what is a symbol becomes an expression that `prepare` computes once.

use super::arena::{Arena, Expr, Input};
use super::vector::{Triple, cross, dot};
use crate::model::inertia::{compose, rotation, snap};
use crate::model::number::literals;
use crate::model::{Binding, Body, BodyKind, JointUse, Model, Number, ParameterKind};

/// A number as an expression.
pub fn number(arena: &mut Arena, number: Number) -> Expr {
    match number {
        Number::Literal(value) => arena.constant(value),
        Number::Symbol(symbol) => arena.input(Input::Symbol(symbol)),
    }
}

/// Three numbers as expressions.
pub fn triple(arena: &mut Arena, numbers: [Number; 3]) -> Triple {
    numbers.map(|n| number(arena, n))
}

/// Euler parameters of the principal axes at the start.
pub fn initial_orientation(arena: &mut Arena, body: &Body) -> [Expr; 4] {
    let [c0, c1, c2, c3] = body.user_axes;
    let inverse = [c0, -c1, -c2, -c3];
    if let Some(user) = literals(&body.orientation) {
        return compose(user, inverse).map(|e| arena.constant(snap(e)));
    }
    // A(user) = A(principal) C, so that principal = user * conjugate(c).
    let p = body.orientation.map(|n| number(arena, n));
    let squares = p.map(|e| arena.square(e));
    let norm = arena.sum(squares);
    let length = arena.sqrt(norm);
    let p = p.map(|e| arena.div(e, length));
    let c = inverse.map(|e| arena.constant(e));
    let mut term = |signs: [(usize, usize, bool); 4]| {
        let mut sum = Arena::ZERO;
        for (k, l, minus) in signs {
            let product = arena.mul(p[k], c[l]);
            sum = arena.add(sum, if minus { -product } else { product });
        }
        sum
    };
    [
        term([(0, 0, false), (1, 1, true), (2, 2, true), (3, 3, true)]),
        term([(0, 1, false), (1, 0, false), (2, 3, false), (3, 2, true)]),
        term([(0, 2, false), (1, 3, true), (2, 0, false), (3, 1, false)]),
        term([(0, 3, false), (1, 2, false), (2, 1, true), (3, 0, false)]),
    ]
}

/// The rotation matrix of unit Euler parameters.
pub fn matrix(arena: &mut Arena, p: [Expr; 4]) -> [Triple; 3] {
    let values = p.map(|e| arena.literal(e));
    if let [Some(e0), Some(e1), Some(e2), Some(e3)] = values {
        return rotation([e0, e1, e2, e3]).map(|row| row.map(|entry| arena.constant(entry)));
    }
    super::scene::homogeneous_rotation(arena, p)
}

pub(super) fn transpose(m: [Triple; 3]) -> [Triple; 3] {
    [0, 1, 2].map(|k| [m[0][k], m[1][k], m[2][k]])
}

pub(super) fn apply(arena: &mut Arena, m: [Triple; 3], v: Triple) -> Triple {
    m.map(|row| dot(arena, row, v))
}

/// Takes components that are round-off beside `size` as zero, so that they fold.
pub(super) fn clean(arena: &mut Arena, v: Triple, size: f64) -> Triple {
    v.map(|component| match arena.literal(component) {
        Some(value) if value.abs() <= 8.0 * f64::EPSILON * size => Arena::ZERO,
        Some(value) if size == 1.0 => arena.constant(snap(value)),
        _ => component,
    })
}

pub(super) fn size(arena: &Arena, v: Triple) -> f64 {
    v.iter()
        .filter_map(|&c| arena.literal(c))
        .fold(0.0, |m, x| m.max(x.abs()))
}

/// A vector of unit length in the same direction.
fn normalise(arena: &mut Arena, v: Triple) -> Triple {
    let square = dot(arena, v, v);
    let length = arena.sqrt(square);
    let unit = v.map(|component| arena.div(component, length));
    clean(arena, unit, 1.0)
}

/// The first of two unit vectors perpendicular to a unit axis `a`: `e_k x a`, normalised, where component `k` of `a` is the
/// smallest in absolute value, the first of equals. For an axis that the macro cannot see, a formula without
/// cases (Duff et al. 2017, J. Comput. Graph. Tech. 6).
fn normal(arena: &mut Arena, a: Triple) -> Triple {
    if let [Some(x), Some(y), Some(z)] = a.map(|component| arena.literal(component)) {
        let mut k = 0;
        for (l, component) in [x, y, z].iter().enumerate() {
            if component.abs() < [x, y, z][k].abs() {
                k = l;
            }
        }
        let mut unit = [Arena::ZERO; 3];
        unit[k] = Arena::ONE;
        let perpendicular = cross(arena, unit, a);
        return normalise(arena, perpendicular);
    }
    let [x, y, z] = a;
    let sign = arena.sign(z);
    let denominator = arena.add(sign, z);
    let factor = arena.reciprocal(denominator);
    let xy = arena.mul(x, y);
    let b = -arena.mul(xy, factor);
    let square = arena.square(x);
    let scaled = arena.mul(square, factor);
    let signed = arena.mul(sign, scaled);
    let first = arena.sub(Arena::ONE, signed);
    [first, arena.mul(sign, b), -arena.mul(sign, x)]
}

/// Where a body stands at the start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub(super) position: Triple,
    /// From principal to global axes.
    pub(super) axes: [Triple; 3],
    /// From the user's to principal axes.
    user_axes: [Triple; 3],
}

pub(super) fn placement(arena: &mut Arena, model: &Model, body: Option<usize>) -> Placement {
    let identity = rotation([1.0, 0.0, 0.0, 0.0]).map(|row| row.map(|entry| arena.constant(entry)));
    let Some(body) = body.map(|body| &model.bodies[body]) else {
        return Placement {
            position: super::vector::ZERO,
            axes: identity,
            user_axes: identity,
        };
    };
    let position = triple(arena, body.position);
    if body.kind == BodyKind::Particle {
        return Placement {
            position,
            axes: identity,
            user_axes: identity,
        };
    }
    let p = initial_orientation(arena, body);
    let axes = matrix(arena, p);
    let user_axes = rotation(body.user_axes).map(|row| row.map(|entry| arena.constant(entry)));
    Placement {
        position,
        axes,
        user_axes,
    }
}

/// A vector parameter of a joint on each of its bodies: the components in principal axes of the point (from the centre of
/// mass), vector or axis, and for an axis the two normals.
#[derive(Clone, Debug)]
pub struct Copies {
    /// The point, vector or axis.
    pub vector: Vec<Triple>,
    /// For an axis its normals; axis, first and second are right-handed.
    pub normals: Vec<[Triple; 2]>,
}

/// The copies of a vector parameter on the bodies of a joint.
pub fn copies(
    arena: &mut Arena,
    model: &Model,
    joint: &JointUse,
    kind: ParameterKind,
    binding: &Binding,
) -> Copies {
    let placements: Vec<_> = joint
        .bodies
        .iter()
        .map(|&body| placement(arena, model, body))
        .collect();
    let mut result = Copies {
        vector: Vec::new(),
        normals: Vec::new(),
    };
    let mut normals: Option<[Triple; 2]> = None;
    for (place, at) in placements.iter().enumerate() {
        let into_body = transpose(at.axes);
        let mut vector = match binding {
            Binding::Scalar(_) | Binding::Law(_) | Binding::Default => super::vector::ZERO,
            Binding::Local(given) => {
                let given = triple(
                    arena,
                    given.get(place).copied().unwrap_or([Number::ZERO; 3]),
                );
                let scale = size(arena, given);
                let turned = apply(arena, at.user_axes, given);
                clean(arena, turned, scale)
            }
            Binding::Global(given) => {
                let given = triple(arena, *given);
                if kind == ParameterKind::Point {
                    let scale = size(arena, given).max(size(arena, at.position));
                    let arm = [0, 1, 2].map(|k| arena.sub(given[k], at.position[k]));
                    let turned = apply(arena, into_body, arm);
                    clean(arena, turned, scale)
                } else {
                    let scale = size(arena, given);
                    let turned = apply(arena, into_body, given);
                    clean(arena, turned, scale)
                }
            }
        };
        if kind == ParameterKind::Axis {
            vector = normalise(arena, vector);
            let global = *normals.get_or_insert_with(|| {
                // From the first body; the others get the same normals at the start, so that angles start at zero.
                let on_first = match binding {
                    Binding::Global(given) => {
                        let given = triple(arena, *given);
                        normalise(arena, given)
                    }
                    _ => apply(arena, at.axes, vector),
                };
                let first = normal(arena, on_first);
                let second = cross(arena, on_first, first);
                [first, clean(arena, second, 1.0)]
            });
            result.normals.push(global.map(|n| {
                let turned = apply(arena, into_body, n);
                clean(arena, turned, 1.0)
            }));
        }
        result.vector.push(vector);
    }
    result
}
