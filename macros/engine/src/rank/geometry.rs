//! Rotations, screws, and the size of a mechanism.

use super::dense::{dot, norm};
use crate::model::{Binding, Model, ParameterKind};

/// Euler parameters, of unit length, after a rotation about an axis of the body.
pub(super) fn turned(p: [f64; 4], rotation: [f64; 3]) -> [f64; 4] {
    let angle = norm(&rotation);
    let factor = if angle > 0.0 {
        (0.5 * angle).sin() / angle
    } else {
        0.5
    };
    let [x, y, z] = rotation.map(|component| factor * component);
    let turned = crate::model::inertia::compose(p, [(0.5 * angle).cos(), x, y, z]);
    let length = norm(&turned);
    turned.map(|e| e / length)
}

/// How far a point gets that is carried along a screw by a rotation about an axis of the body at a
/// constant rate, where it would get by the translation if it went straight on.
pub(super) fn along_screw(p: [f64; 4], rotation: [f64; 3], translation: [f64; 3]) -> [f64; 3] {
    let angle = norm(&rotation);
    if angle == 0.0 {
        return translation;
    }
    let axes = crate::model::inertia::rotation(p);
    let axis = axes.map(|row| dot(&row, &rotation) / angle);
    let cross = |v: [f64; 3]| {
        let [x, y, z] = axis;
        [
            y * v[2] - z * v[1],
            z * v[0] - x * v[2],
            x * v[1] - y * v[0],
        ]
    };
    let across = cross(translation);
    let back = cross(across);
    let (sine, rest) = (1.0 - angle.sin() / angle, (1.0 - angle.cos()) / angle);
    [0, 1, 2].map(|k| translation[k] + rest * across[k] + sine * back[k])
}

/// The largest distance of a body or a joint's point from the mean of all of them; one where there
/// is none.
pub(super) fn length(model: &Model) -> f64 {
    let mut points: Vec<[f64; 3]> = model
        .bodies
        .iter()
        .filter_map(|body| model.all_seen(&body.position))
        .collect();
    for joint in &model.joints {
        let parameters = &model.definition(joint).parameters;
        for (parameter, binding) in parameters.iter().zip(&joint.bindings) {
            if parameter.kind != ParameterKind::Point {
                continue;
            }
            match binding {
                Binding::Global(point) => points.extend(model.all_seen(point)),
                Binding::Local(arms) => {
                    for (arm, body) in arms.iter().zip(&joint.bodies) {
                        let centre = body.map_or(Some([0.0; 3]), |body| {
                            model.all_seen(&model.bodies[body].position)
                        });
                        // Its direction does not matter for a size.
                        if let (Some(arm), Some(centre)) = (model.all_seen(arm), centre) {
                            points.push([0, 1, 2].map(|k| centre[k] + arm[k]));
                        }
                    }
                }
                Binding::Scalar(_) | Binding::Law(_) | Binding::Default => {}
            }
        }
    }
    let count = points.len() as f64;
    let mean = [0, 1, 2].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let largest = points
        .iter()
        .map(|point| norm(&[0, 1, 2].map(|k| point[k] - mean[k])))
        .fold(0.0, f64::max);
    // All in one place, to round-off of the mean.
    let far = points.iter().map(|point| norm(point)).fold(0.0, f64::max);
    if largest > 1e-12 * far && largest.is_normal() {
        largest
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::{along_screw, turned};

    #[test]
    fn a_small_rotation_is_about_an_axis_of_the_body() {
        let [w, x, y, z] = turned([0.5, 0.5, 0.5, 0.5], [0.0, 0.0, 2e-3]);
        // The body's z axis is the global x axis here: p' = 1/2 (0, w, 0, 0) p.
        let expected = [0.5 - 5e-4, 0.5 + 5e-4, 0.5 - 5e-4, 0.5 + 5e-4];
        for (found, expected) in [w, x, y, z].into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn a_screw_leads_around_its_axis() {
        // About a body's z axis that is the global x axis, from [0, 2, 0] by three quarters of a
        // turn to [0, 0, -2] and 0.3 along.
        let angle = 1.5 * std::f64::consts::PI;
        let way = along_screw([0.5; 4], [0.0, 0.0, angle], [0.3, 0.0, 2.0 * angle]);
        for (found, expected) in way.into_iter().zip([0.3, -2.0, -2.0]) {
            assert!((found - expected).abs() < 1e-14, "{way:?}");
        }
    }

    #[test]
    fn whole_turns_lead_back() {
        let p = [0.5, -0.5, 0.5, 0.5];
        let turn = 4.0 * std::f64::consts::PI;
        for (found, expected) in turned(p, [0.6 * turn, 0.0, 0.8 * turn]).into_iter().zip(p) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert_eq!(turned(p, [0.0; 3]), p);
    }
}
