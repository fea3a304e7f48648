//! Where things are that should be together: distances and directions in numbers, along global
//! axes, as a sketch would show them.

use super::fixed::uses;
use crate::model::inertia::{IDENTITY, compose, rotation};
use crate::model::{Binding, BodyKind, Element, Model, ParameterKind};

/// Gaps (m) and sines of angles below this are round-off of what was assembled.
const NONE: f64 = 1e-6;

/// A point or a direction of a joint, as one of its bodies carries it.
struct Carried {
    /// The parameter, by its place.
    parameter: usize,
    is_point: bool,
    /// The body, by its name.
    body: String,
    /// In m, or of length 1; global axes.
    at: [f64; 3],
}

/// What a joint's points and axes are off from each other, where its bodies are by `way`: their
/// coordinates as they are described, and there. Without a way they are as described. Nothing where
/// no two of them can be compared, or a number is not seen.
pub(super) fn of_joint(model: &Model, joint: usize, way: Option<&[Vec<f64>; 2]>) -> Option<String> {
    let joint = &model.joints[joint];
    let definition = model.definition(joint);
    let mut carried = Vec::new();
    for place in 0..joint.bodies.len() {
        for (parameter, kind) in uses(definition, place) {
            carried.push(carry(model, joint, way, (place, parameter, kind))?);
        }
    }
    let name = |one: &Carried| definition.parameters[one.parameter].name.to_string();
    let mut said = Vec::new();
    for is_point in [true, false] {
        let all: Vec<&Carried> = carried
            .iter()
            .filter(|one| one.is_point == is_point)
            .collect();
        let mut alone = Vec::new();
        for &one in &all {
            let mut same = all.iter().filter(|other| other.parameter == one.parameter);
            match (same.next(), same.next()) {
                // The first of two or more says it.
                (Some(first), Some(second)) if std::ptr::eq(*first, one) => {
                    said.extend(parted(&name(one), first, second));
                }
                (Some(_), None) => alone.push(one),
                _ => {}
            }
        }
        if let [a, b] = alone[..] {
            let (first, second) = (name(a), name(b));
            said.push(if is_point {
                let gap = brief(norm(between(a.at, b.at)), 4);
                format!("`{first}` and `{second}` are {gap} m apart")
            } else {
                let angle = brief(angle(a.at, b.at), 4);
                format!("`{first}` and `{second}` are at {angle} deg")
            });
        }
    }
    (!said.is_empty()).then(|| said.join(", "))
}

/// What is one point or one direction, on two bodies.
fn parted(name: &str, first: &Carried, second: &Carried) -> Option<String> {
    let (on, other) = (&first.body, &second.body);
    if first.is_point {
        let by = between(first.at, second.at);
        let gap = by_vector(by)?;
        return Some(format!(
            "`{name}` of `{other}` is {gap} from that of `{on}`"
        ));
    }
    let angle = angle(first.at, second.at);
    (angle.to_radians() > NONE).then(|| {
        let angle = brief(angle, 4);
        format!("`{name}` of `{other}` is at {angle} deg to that of `{on}`")
    })
}

/// A distance with its direction; nothing where there is none.
fn by_vector(by: [f64; 3]) -> Option<String> {
    let gap = norm(by);
    (gap > NONE).then(|| {
        // Digits of the distance, so that what is round-off beside it is zero.
        let step = 10.0_f64.powf(gap.log10().floor() - 3.0);
        let [x, y, z] = by.map(|part| brief((part / step).round() * step, 4));
        format!("{} m by [{x}, {y}, {z}]", brief(gap, 4))
    })
}

/// Where a point is beside where it should be, behind a sentence about it; nothing where the macro
/// does not see both.
pub(super) fn beside(at: Option<[f64; 3]>, from: Option<[f64; 3]>) -> String {
    let by = at
        .zip(from)
        .and_then(|(at, from)| by_vector(between(from, at)));
    by.map_or_else(String::new, |by| format!("; this is {by} from there"))
}

/// Carries a parameter of a joint to where its body is.
fn carry(
    model: &Model,
    joint: &Element,
    way: Option<&[Vec<f64>; 2]>,
    (place, parameter, kind): (usize, usize, ParameterKind),
) -> Option<Carried> {
    let is_point = kind == ParameterKind::Point;
    let body = joint.bodies[place];
    let described = match &joint.bindings[parameter] {
        Binding::Global(vector) => model.all_seen(vector)?,
        Binding::Local(copies) => {
            let own = model.all_seen(copies.get(place)?)?;
            let Some(body) = body.map(|body| &model.bodies[body]) else {
                return Some(Carried {
                    parameter,
                    is_point,
                    body: "ground".into(),
                    at: if is_point { own } else { unit(own)? },
                });
            };
            let turned = apply(unit(model.all_seen(&body.orientation)?)?, own);
            let origin = model.all_seen(&body.position)?;
            if is_point {
                sum(origin, turned)
            } else {
                turned
            }
        }
        _ => return None,
    };
    let at = match (body, way) {
        (Some(body), Some([from, to])) => {
            let start = model.layout().coordinate[body];
            let read = |all: &[f64]| {
                let origin: [f64; 3] = all.get(start..start + 3)?.try_into().ok()?;
                let turn = match model.bodies[body].kind {
                    BodyKind::Particle => IDENTITY,
                    BodyKind::Rigid => {
                        let p: [f64; 4] = all.get(start + 3..start + 7)?.try_into().ok()?;
                        unit(p)?
                    }
                };
                Some((origin, turn))
            };
            let ((before, p), (after, q)) = (read(from)?, read(to)?);
            let [a, b, c, d] = p;
            let turn = compose(q, [a, -b, -c, -d]);
            if is_point {
                sum(after, apply(turn, between(before, described)))
            } else {
                apply(turn, described)
            }
        }
        _ => described,
    };
    Some(Carried {
        parameter,
        is_point,
        body: body.map_or("ground".into(), |body| model.bodies[body].name.to_string()),
        at: if is_point { at } else { unit(at)? },
    })
}

fn apply(p: [f64; 4], s: [f64; 3]) -> [f64; 3] {
    rotation(p).map(|row| row.iter().zip(s).map(|(a, s)| a * s).sum())
}

fn between(from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| to[k] - from[k])
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + b[k])
}

fn norm<const N: usize>(s: [f64; N]) -> f64 {
    s.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn unit<const N: usize>(s: [f64; N]) -> Option<[f64; N]> {
    let length = norm(s);
    (length > 0.0 && length.is_finite()).then(|| s.map(|x| x / length))
}

/// The angle between two directions of length 1 (deg).
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    // Of half the angle, which keeps its digits at both ends.
    let (less, more) = (norm(between(a, b)), norm(sum(a, b)));
    (2.0 * less.atan2(more)).to_degrees()
}

/// A number to so many digits.
pub(super) fn brief(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let scale = 10.0_f64.powi(digits - 1 - x.abs().log10().floor() as i32);
    format!("{}", (x * scale).round() / scale)
}
