//! A spanning tree of the bodies: which joint carries which body by the motions that it leaves
//! free, and which joints stay as equations.

use crate::model::number::literals;
use crate::model::{
    Binding, BodyKind, Comparison, Direction, Element, Model, Motion, Name, Number, ParameterKind,
    Rank,
};
use crate::rank::moves::compare;

/// A body and what it moves by.
#[derive(Clone, Debug)]
pub struct Carried {
    /// The body.
    pub body: usize,
    /// The body that carries it, `None` for the ground.
    pub by: Option<usize>,
    /// The joint; `None` for a body that no joint carries, which moves freely.
    pub joint: Option<usize>,
    /// The motions, from the carrier to the body. Of a free body: parameters are coordinate axes.
    pub motions: Vec<Motion>,
    /// Whether the joint names the carrier last, so that its motions are those of the carrier
    /// against the body.
    pub is_reversed: bool,
}

/// The tree.
#[derive(Clone, Debug)]
pub struct Spanning {
    /// A body stands behind the one that carries it.
    pub carried: Vec<Carried>,
    /// The joints that stay as equations.
    pub closing: Vec<usize>,
}

/// A way to carry a body: freedoms, depth, names decide in this order.
type Merit<'a> = (usize, usize, &'a Name, &'a Name);

impl Spanning {
    /// The tree of a mechanism, whatever the order of its fields: the joint with the fewest motions
    /// first, then the one nearest to the ground. Those that the user cuts stay equations.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let mut depth: Vec<Option<usize>> = vec![None; model.bodies.len()];
        let mut carried = Vec::new();
        let mut carries = vec![false; model.joints.len()];
        let able = able(model);
        loop {
            let mut best: Option<(Merit<'_>, Carried)> = None;
            for (place, joint) in model.joints.iter().enumerate() {
                let depth_of = |body: Option<usize>| body.map_or(Some(0), |body| depth[body]);
                let [first, second] = joint.bodies[..] else {
                    continue;
                };
                if !able[place] || joint.is_cut {
                    continue;
                }
                for (by, body, is_reversed) in [(first, second, false), (second, first, true)] {
                    let (Some(body), Some(from)) = (body, depth_of(by)) else {
                        continue;
                    };
                    if depth[body].is_some() {
                        continue;
                    }
                    let Some(motions) = motions(model, joint, by, body, is_reversed) else {
                        continue;
                    };
                    let names = (&joint.name, &model.bodies[body].name);
                    let merit = (freedoms(&motions), from, names.0, names.1);
                    if best.as_ref().is_none_or(|(known, _)| merit < *known) {
                        let found = Carried {
                            body,
                            by,
                            joint: Some(place),
                            motions,
                            is_reversed,
                        };
                        best = Some((merit, found));
                    }
                }
            }
            if let Some(((_, from, ..), found)) = best {
                depth[found.body] = Some(from + 1);
                carries[found.joint.expect("it was found at a joint")] = true;
                carried.push(found);
                continue;
            }
            let left = (0..model.bodies.len()).filter(|&body| depth[body].is_none());
            let root = model.most_jointed(left);
            let Some(body) = root else { break };
            depth[body] = Some(1);
            carried.push(free(model, body));
        }
        let mut closing: Vec<usize> = (0..model.joints.len()).filter(|&k| !carries[k]).collect();
        closing.sort_by_key(|&joint| &model.joints[joint].name);
        Self { carried, closing }
    }

    /// How many of the equations that remain are independent, where that is known and not all of
    /// them need be.
    pub(super) fn independent(&self, model: &Model) -> Option<usize> {
        let Rank::Decided { rank, .. } = model.independence.rank else {
            return None;
        };
        let carrying = self.carried.iter().filter_map(|carried| carried.joint);
        let hold = carrying.map(|joint| model.definition(&model.joints[joint]).equations());
        let wanted = rank.saturating_sub(hold.sum());
        model.independence.dropped.then_some(wanted)
    }

    /// The mechanism without the equations of the joints that carry, and with all others.
    #[must_use]
    pub fn remaining(&self, model: &Model) -> Model {
        let mut model = model.clone();
        // What follows from what is another question where some equations hold by themselves.
        model
            .joints
            .iter_mut()
            .for_each(|joint| joint.dropped.clear());
        for joint in self.carried.iter().filter_map(|carried| carried.joint) {
            let equations = model.definition(&model.joints[joint]).equations();
            model.joints[joint].dropped = (0..equations).collect();
        }
        model
    }
}

/// Which joints move as they say, by their own equations. Numbers that the macro cannot see stand
/// for any: what holds with some holds with all, or by chance.
fn able(model: &Model) -> Vec<bool> {
    let mut seen = model.clone();
    let any = |number: &mut Number| {
        if let Number::Symbol(symbol) | Number::Varying(symbol) = *number {
            // Numbers without a pattern: the golden ratio's multiples.
            *number = Number::Literal(0.5 + (f64::from(symbol) * 0.618_033_988_749_895).fract());
        }
    };
    for body in &mut seen.bodies {
        body.position.iter_mut().for_each(any);
        if literals(&body.orientation).is_some() {
            continue;
        }
        body.orientation.iter_mut().for_each(any);
        // Those that are written have the length 1, and others get it where the code runs.
        if let Some(p) = literals(&body.orientation) {
            let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
            body.orientation = p.map(|e| Number::Literal(e / length));
        }
    }
    for binding in seen.joints.iter_mut().flat_map(|joint| &mut joint.bindings) {
        match binding {
            Binding::Global(numbers) => numbers.iter_mut().for_each(any),
            Binding::Local(copies) => copies.iter_mut().flatten().for_each(any),
            Binding::Scalar(number) => any(number),
            Binding::Law(_) | Binding::Default => {}
        }
    }
    (0..model.joints.len())
        .map(|joint| compare(&seen, joint) == Comparison::Agrees)
        .collect()
}

/// How many velocities motions have.
pub(super) fn freedoms(motions: &[Motion]) -> usize {
    motions.iter().map(|motion| motion.freedoms()).sum()
}

/// A body that moves freely: along the global axes and about its centre of mass.
fn free(model: &Model, body: usize) -> Carried {
    let slides = [0, 1, 2].map(|parameter| Motion::Slide {
        along: Direction {
            parameter,
            normal: None,
        },
    });
    let mut motions = slides.to_vec();
    if model.bodies[body].kind == BodyKind::Rigid {
        motions.push(Motion::Ball { point: 0 });
    }
    Carried {
        body,
        by: None,
        joint: None,
        motions,
        is_reversed: false,
    }
}

/// The motions by which a joint carries a body, from the carrier on; `None` where it cannot, so
/// that it stays as equations.
fn motions(
    model: &Model,
    joint: &Element,
    by: Option<usize>,
    body: usize,
    is_reversed: bool,
) -> Option<Vec<Motion>> {
    let definition = model.definition(joint);
    let mut motions = definition.motions.clone()?;
    // Lines and points that are given body by body need not meet in the reference configuration.
    let vectors = definition.parameters.iter().zip(&joint.bindings);
    let all_global = vectors
        .filter(|(parameter, _)| parameter.kind.is_vector())
        .all(|(_, binding)| matches!(binding, Binding::Global(_)));
    let is_particle = |body: usize| model.bodies[body].kind == BodyKind::Particle;
    if !all_global || by == Some(body) || by.is_some_and(is_particle) {
        return None;
    }
    let turns = |motions: &[Motion]| {
        let turns = motions
            .iter()
            .filter(|motion| !matches!(motion, Motion::Slide { .. }));
        turns.count()
    };
    if is_reversed {
        motions.reverse();
    }
    if is_particle(body) {
        // It has no orientation: a ball at its own place is nothing.
        match motions.last() {
            Some(Motion::Ball { point }) if stands_at(model, joint, body, *point) => motions.pop(),
            _ => return None,
        };
        return (turns(&motions) == 0).then_some(motions);
    }
    // More angles have no closed form from the orientations, and that of a screw is the joint's.
    let is_alone = |motion: &Motion| matches!(motion, Motion::Ball { .. } | Motion::Screw { .. });
    let most = if motions.iter().any(is_alone) { 1 } else { 2 };
    (turns(&motions) <= most).then_some(motions)
}

/// Whether a particle stands at a point of its joint, as far as the macro can see.
fn stands_at(model: &Model, joint: &Element, body: usize, point: usize) -> bool {
    let Binding::Global(given) = &joint.bindings[point] else {
        return false;
    };
    let is_point = model.definition(joint).parameters[point].kind == ParameterKind::Point;
    is_point
        && match (literals(given), literals(&model.bodies[body].position)) {
            (Some(given), Some(position)) => given == position,
            _ => *given == model.bodies[body].position,
        }
}
