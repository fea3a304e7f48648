//! A spanning tree of the bodies: which joint carries which body.

use std::cmp::Reverse;

use super::reach::Reach;
use crate::model::{Model, Name};

/// Bodies from the leaves to the ground with the joint towards the ground, and the joints left
/// over.
pub(super) struct Tree {
    pub(super) bodies: Vec<(usize, Option<usize>)>,
    pub(super) closing: Vec<usize>,
    /// The body that each joint carries, `None` for a closing joint.
    pub(super) child: Vec<Option<usize>>,
    /// How many joints are between each joint that carries a body and the ground.
    pub(super) depths: Vec<usize>,
    /// How many joints are between each joint that carries a body and the leaf that is farthest.
    pub(super) heights: Vec<usize>,
}

/// What speaks for a joint to carry a body, most important first.
type Merit<'a> = (Reverse<usize>, usize, &'a Name, &'a Name);

/// A spanning tree of the bodies, grown from the ground.
///
/// Of all joints that could carry a body, the one with most equations on it does, where those of a
/// vector count twice because they are eliminated together with accelerations; then the one nearest
/// to the ground, and among equals the names decide. The order of the fields has no say.
pub(super) fn tree(model: &Model, reach: &Reach) -> Tree {
    let mut parent: Vec<Option<usize>> = vec![None; model.bodies.len()];
    let mut child = vec![None; model.joints.len()];
    // How many joints each body is away from the ground, or from the root of its tree.
    let mut depth: Vec<Option<usize>> = vec![None; model.bodies.len()];
    loop {
        let mut best: Option<(Merit<'_>, usize, usize)> = None;
        for (place, joint) in model.joints.iter().enumerate() {
            let known = joint.bodies.iter().filter_map(|body| match body {
                Some(body) => depth[*body],
                None => Some(0),
            });
            let Some(from) = known.min().filter(|_| child[place].is_none()) else {
                continue;
            };
            for &body in joint.bodies.iter().flatten() {
                let Some(weight) = reach.weight(place, body) else {
                    continue;
                };
                // Equations that are left out follow from others: the joint forbids what it was
                // defined to.
                let weight = Reverse(weight + joint.dropped.len());
                let merit = (weight, from, &joint.name, &model.bodies[body].name);
                let is_better = best.as_ref().is_none_or(|(known, ..)| merit < *known);
                if depth[body].is_none() && is_better {
                    best = Some((merit, place, body));
                }
            }
        }
        if let Some(((_, from, ..), joint, body)) = best {
            parent[body] = Some(joint);
            child[joint] = Some(body);
            depth[body] = Some(from + 1);
            continue;
        }
        // Bodies without a way to the ground: the one with most joints is a root.
        let rest = (0..model.bodies.len()).filter(|&body| depth[body].is_none());
        let root = model.most_jointed(rest);
        let Some(root) = root else { break };
        depth[root] = Some(0);
    }
    let mut order: Vec<usize> = (0..model.bodies.len()).collect();
    order.sort_by_key(|&body| {
        let weight = parent[body].and_then(|joint| reach.weight(joint, body));
        let joint = parent[body].map(|joint| &model.joints[joint].name);
        let name = &model.bodies[body].name;
        (Reverse(depth[body]), Reverse(weight), joint, name)
    });
    let mut closing: Vec<usize> = (0..model.joints.len())
        .filter(|&joint| child[joint].is_none())
        .collect();
    closing.sort_by_key(|&joint| &model.joints[joint].name);
    let mut depths = vec![0; model.joints.len()];
    let mut heights = vec![0; model.joints.len()];
    for &body in &order {
        let Some(joint) = parent[body] else { continue };
        depths[joint] = depth[body].map_or(0, |depth| depth.saturating_sub(1));
        // Leaves come first, so that the heights of all children are known.
        let children = model.joints[joint].bodies.iter().flatten();
        let below = children
            .filter(|&&other| other != body && depth[other] < depth[body])
            .filter_map(|&other| parent[other]);
        let height = heights[joint] + 1;
        for joint in below {
            heights[joint] = heights[joint].max(height);
        }
    }
    Tree {
        bodies: order.into_iter().map(|body| (body, parent[body])).collect(),
        closing,
        child,
        depths,
        heights,
    }
}
