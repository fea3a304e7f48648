//! Points and vectors that are fixed on bodies: from the attributes to components in principal body
//! axes.
//!
//! What the macro can see becomes a literal; what is a symbol becomes an expression that `prepare`
//! computes once.

use super::arena::{Arena, Expr, Input};
use super::rotation::homogeneous_rotation;
use super::vector::{Triple, ZERO, cross, dot};
use crate::model::inertia::{compose, rotation, snap};
use crate::model::number::literals;
use crate::model::{Binding, Body, BodyKind, Element, Model, Number, ParameterKind};

/// A number as an expression.
pub fn number(arena: &mut Arena, number: Number) -> Expr {
    match number {
        Number::Literal(value) => arena.constant(value),
        Number::Symbol(symbol) => arena.input(Input::Symbol(symbol)),
        Number::Varying(symbol) => arena.input(Input::Varying(symbol)),
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
    homogeneous_rotation(arena, p)
}

pub(crate) fn transpose(m: [Triple; 3]) -> [Triple; 3] {
    [0, 1, 2].map(|k| [m[0][k], m[1][k], m[2][k]])
}

pub(super) fn apply(arena: &mut Arena, m: [Triple; 3], v: Triple) -> Triple {
    m.map(|row| dot(arena, row, v))
}

/// Takes components that are round-off beside `size` as zero, and those that are `size` but for
/// round-off as `size`, so that they fold.
pub(crate) fn clean(arena: &mut Arena, v: Triple, size: f64) -> Triple {
    let round_off = 8.0 * f64::EPSILON * size;
    v.map(|component| match arena.literal(component) {
        Some(value) if value.abs() <= round_off => Arena::ZERO,
        Some(value) if (value.abs() - size).abs() < round_off => {
            arena.constant(size.copysign(value))
        }
        _ => component,
    })
}

pub(crate) fn size(arena: &Arena, v: Triple) -> f64 {
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

/// Components of a unit axis that differ by less are equal: round-off must not decide which of them
/// is the smallest.
const EQUAL: f64 = 1e-12;

/// The first of two unit vectors perpendicular to a unit axis `a`: `e_k x a`, normalised, where
/// component `k` of `a` is the smallest in absolute value, the first of equals. For an axis that
/// the macro cannot see, a formula without cases (Duff et al. 2017, J. Comput. Graph. Tech. 6).
fn normal(arena: &mut Arena, a: Triple) -> Triple {
    if let [Some(x), Some(y), Some(z)] = a.map(|component| arena.literal(component)) {
        let mut k = 0;
        for (l, component) in [x, y, z].iter().enumerate() {
            if component.abs() < [x, y, z][k].abs() - EQUAL {
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

/// An axis given in global axes, of unit length, and its two normals.
pub(crate) fn axis_and_normals(arena: &mut Arena, given: Triple) -> [Triple; 3] {
    let axis = normalise(arena, given);
    let first = normal(arena, axis);
    let second = cross(arena, axis, first);
    [axis, first, clean(arena, second, 1.0)]
}

/// Where a body stands at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    pub(crate) position: Triple,
    /// From principal to global axes.
    pub(crate) axes: [Triple; 3],
    /// From the user's to principal axes.
    user_axes: [Triple; 3],
}

pub(crate) fn placement(arena: &mut Arena, model: &Model, body: Option<usize>) -> Placement {
    let identity = rotation([1.0, 0.0, 0.0, 0.0]).map(|row| row.map(|entry| arena.constant(entry)));
    let Some(body) = body.map(|body| &model.bodies[body]) else {
        return Placement {
            position: ZERO,
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

/// A vector parameter of a joint on each of its bodies: the components in principal axes of the
/// point (from the centre of mass), vector or axis, and for an axis the two normals.
#[derive(Clone, Debug)]
pub struct Copies {
    /// The point, vector or axis.
    pub vector: Vec<Triple>,
    /// For an axis its normals; axis, first and second are right-handed.
    pub normals: Vec<[Triple; 2]>,
}

/// The copies of a vector parameter on the bodies of a joint.
///
/// All bodies have the same normals in the reference configuration where their axes are the same,
/// and so angles are zero there. Axes that are given by body need not be parallel: then the normals
/// are those of the first body that the definition speaks of, taken along by the least rotation
/// that makes the axes parallel, so that every body has a right-handed frame with its own axis.
pub fn copies(arena: &mut Arena, model: &Model, joint: &Element, parameter: usize) -> Copies {
    let definition = model.definition(joint);
    let kind = definition.parameters[parameter].kind;
    let binding = &joint.bindings[parameter];
    let placements: Vec<_> = joint
        .bodies
        .iter()
        .map(|&body| placement(arena, model, body))
        .collect();
    let mut vector: Vec<Triple> = placements
        .iter()
        .enumerate()
        .map(|(place, at)| copy(arena, kind, binding, place, at))
        .collect();
    if kind != ParameterKind::Axis {
        return Copies {
            vector,
            normals: Vec::new(),
        };
    }
    vector = vector
        .into_iter()
        .map(|axis| normalise(arena, axis))
        .collect();
    let of_body = |arena: &mut Arena, place: usize| -> Triple {
        apply(arena, placements[place].axes, vector[place])
    };
    let (first, is_common) = match binding {
        Binding::Global(given) => {
            let given = triple(arena, *given);
            (normalise(arena, given), true)
        }
        _ => {
            let axis = of_body(arena, definition.first_body_of(parameter));
            (clean(arena, axis, 1.0), false)
        }
    };
    let normals = {
        let n = normal(arena, first);
        let second = cross(arena, first, n);
        [n, clean(arena, second, 1.0)]
    };
    let normals = (0..placements.len())
        .map(|place| {
            let own = if is_common {
                normals
            } else {
                let axis = of_body(arena, place);
                taken_along(arena, normals, first, axis)
            };
            let into_body = transpose(placements[place].axes);
            own.map(|n| {
                let turned = apply(arena, into_body, n);
                clean(arena, turned, 1.0)
            })
        })
        .collect();
    Copies { vector, normals }
}

/// A point that is given at the start (global axes), from the centre of mass in the principal axes
/// of a body.
pub fn point_on(
    arena: &mut Arena,
    model: &Model,
    body: Option<usize>,
    point: [Number; 3],
) -> Triple {
    let at = placement(arena, model, body);
    let binding = Binding::Global(point);
    copy(arena, ParameterKind::Point, &binding, 0, &at)
}

/// The components of a vector parameter in the principal axes of a body.
fn copy(
    arena: &mut Arena,
    kind: ParameterKind,
    binding: &Binding,
    place: usize,
    at: &Placement,
) -> Triple {
    match binding {
        Binding::Local(given) => {
            let given = triple(arena, given[place]);
            let turned = apply(arena, at.user_axes, given);
            let scale = size(arena, given);
            clean(arena, turned, scale)
        }
        Binding::Global(given) => {
            let given = triple(arena, *given);
            let (arm, scale) = if kind == ParameterKind::Point {
                let scale = size(arena, given).max(size(arena, at.position));
                let arm = [0, 1, 2].map(|k| arena.sub(given[k], at.position[k]));
                (arm, scale)
            } else {
                (given, size(arena, given))
            };
            let turned = apply(arena, transpose(at.axes), arm);
            clean(arena, turned, scale)
        }
        Binding::Scalar(_) | Binding::Law(_) | Binding::Default => {
            unreachable!("points, axes and vectors have three components: `check` has seen to it")
        }
    }
}

/// Two normals of an axis `a`, taken along by the least rotation that makes `a` parallel to another
/// axis, in its direction or against it: `n - (n . b) (a + b) / (1 + a . b)` with `b` the other
/// axis or its opposite, whichever is nearer. The second is turned where `b` is the opposite, so
/// that both are right-handed with the other axis.
fn taken_along(arena: &mut Arena, normals: [Triple; 2], a: Triple, axis: Triple) -> [Triple; 2] {
    let cosine = dot(arena, a, axis);
    // Round-off must not decide what is nearer of a direction and its opposite where the axes are
    // perpendicular.
    let cosine = match arena.literal(cosine) {
        Some(value) if value.abs() <= 8.0 * f64::EPSILON => Arena::ZERO,
        _ => cosine,
    };
    let sign = arena.sign(cosine);
    let b = axis.map(|component| arena.mul(sign, component));
    let difference = [0, 1, 2].map(|k| arena.sub(b[k], a[k]));
    let is_parallel = |component: &Expr| {
        let value = arena.literal(*component);
        value.is_some_and(|value| value.abs() <= 8.0 * f64::EPSILON)
    };
    let [first, second] = if difference.iter().all(is_parallel) {
        normals
    } else {
        let along = arena.mul(sign, cosine);
        let denominator = arena.add(Arena::ONE, along);
        let factor = arena.reciprocal(denominator);
        normals.map(|n| {
            let share = dot(arena, n, b);
            let share = arena.mul(share, factor);
            let turned = [0, 1, 2].map(|k| {
                let sum = arena.add(a[k], b[k]);
                let term = arena.mul(share, sum);
                arena.sub(n[k], term)
            });
            clean(arena, turned, 1.0)
        })
    };
    [first, second.map(|component| arena.mul(sign, component))]
}
