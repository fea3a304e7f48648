//! Equations that were left out, where somebody asks whether they still follow from the others.

use super::arena::Arena;
use super::equations::{Kernel, with_scene};
use super::scene::Scene;
use super::vector::Frame;
use crate::model::{BodyKind, Model};

/// Value and gradient of every equation that was left out, one after the other, joint by joint.
/// Gradients go over all velocities.
#[must_use]
pub fn left_out(model: &Model) -> Kernel {
    let mut others = model.clone();
    for (joint, described) in others.joints.iter_mut().zip(&model.joints) {
        let equations = 0..model.definition(described).equations();
        joint.dropped = equations
            .filter(|equation| !described.dropped.contains(equation))
            .collect();
    }
    with_scene(&Scene::new(&others), |scene| {
        let factors = [Arena::ONE, Arena::ZERO, Arena::ZERO];
        let mut outputs = Vec::new();
        for place in 0..scene.constraints.len() {
            let values = scene.combination(place, Frame::Global, factors);
            let gradients = scene.gradients(place, Frame::Global);
            for (value, gradient) in values.into_iter().zip(gradients) {
                outputs.push(value);
                for (body, described) in others.bodies.iter().enumerate() {
                    let force = gradient.force(&mut scene.space, body);
                    outputs.extend(scene.space.components(force, Frame::Global));
                    if described.kind == BodyKind::Rigid {
                        let moment = gradient.moment(&mut scene.space, body);
                        outputs.extend(scene.space.components(moment, Frame::Body(body)));
                    }
                }
            }
        }
        outputs
    })
}
