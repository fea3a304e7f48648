//! A spanning tree of the bodies: which joint carries which body.

use std::cmp::Reverse;

use super::reach::Reach;
use crate::model::Model;

/// Bodies from the leaves to the ground with the joint towards the ground, and the joints left over.
pub(super) struct Tree {
    pub(super) bodies: Vec<(usize, Option<usize>)>,
    pub(super) closing: Vec<usize>,
    /// The body that each joint carries, `None` for a closing joint.
    pub(super) child: Vec<Option<usize>>,
}

/// What speaks for a joint to carry a body, most important first.
type Merit = (Reverse<usize>, Reverse<usize>, String, String);

/// A spanning tree of the bodies, breadth first from the ground.
///
/// Among the joints that could carry a body, the one that takes most of its freedom does: points in common first, then the number
/// of equations, then the names. The order of the fields has no say.
pub(super) fn tree(model: &Model, reach: &Reach) -> Tree {
    let merit = |joint: usize, body: usize| -> Merit {
        let (mut vectors, mut rows) = (0, 0);
        for (_, own) in reach.constraints.iter().filter(|(of, _)| *of == joint) {
            let acting = |row: &usize| reach.rows[*row].contains(&Some(body));
            let acting = own.clone().filter(acting).count();
            rows += acting;
            vectors += usize::from(acting == 3);
        }
        // Equations that are left out follow from others: the joint forbids what it was defined to.
        rows += model.joints[joint].dropped.len();
        (
            Reverse(vectors),
            Reverse(rows),
            model.joints[joint].name.to_string(),
            model.bodies[body].name.to_string(),
        )
    };
    let mut parent: Vec<Option<usize>> = vec![None; model.bodies.len()];
    let mut child = vec![None; model.joints.len()];
    let mut order: Vec<usize> = Vec::new();
    let mut reached = vec![None];
    loop {
        let mut offers: Vec<(Merit, usize, usize)> = Vec::new();
        for (place, joint) in model.joints.iter().enumerate() {
            if child[place].is_some() || !joint.bodies.iter().any(|body| reached.contains(body)) {
                continue;
            }
            for &body in joint.bodies.iter().flatten() {
                let acts = reach.acts(place, body);
                if acts && !order.contains(&body) {
                    offers.push((merit(place, body), place, body));
                }
            }
        }
        offers.sort();
        reached = Vec::new();
        for (_, joint, body) in offers {
            if child[joint].is_none() && parent[body].is_none() {
                parent[body] = Some(joint);
                child[joint] = Some(body);
                reached.push(Some(body));
            }
        }
        // The strongest joint of a level is the last here, and the first to be eliminated.
        order.extend(reached.iter().rev().flatten());
        if reached.is_empty() {
            // Bodies without a way to the ground: the one with most joints is a root.
            let joints = |body: usize| {
                let joints = model.joints.iter();
                joints
                    .filter(|joint| joint.bodies.contains(&Some(body)))
                    .count()
            };
            let rest = (0..model.bodies.len()).filter(|body| !order.contains(body));
            let root = rest
                .min_by_key(|&body| (Reverse(joints(body)), model.bodies[body].name.to_string()));
            let Some(root) = root else { break };
            order.push(root);
            reached.push(Some(root));
        }
    }
    order.reverse();
    let mut closing: Vec<usize> = (0..model.joints.len())
        .filter(|&joint| child[joint].is_none())
        .collect();
    closing.sort_by_key(|&joint| model.joints[joint].name.to_string());
    Tree {
        bodies: order.into_iter().map(|body| (body, parent[body])).collect(),
        closing,
        child,
    }
}
