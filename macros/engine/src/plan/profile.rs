//! The equations of motion of the bodies for mechanisms that run by their joints: factorised by
//! loops over `D M^-1 D^T`, not by straight-line code.
//!
//! What is generated is an order of the rows and, of each row, the first that it is coupled with.
//! Elimination fills in between that one and the diagonal, and nowhere else.

use super::reach::Reach;
use super::tree::{Tree, tree};
use crate::model::Model;
use crate::symbolic::arena::{Arena, Input};
use crate::symbolic::equations::Kernel;
use crate::symbolic::scene::Scene;

/// Which entries of `D M^-1 D^T` are kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Profile {
    /// The place of each row in the order of elimination.
    pub places: Vec<usize>,
    /// Where the entries of each place end: those from the first place that it is coupled with to
    /// the diagonal, one place after the other.
    pub ends: Vec<usize>,
}

impl Profile {
    /// Rows from the leaves of the spanning tree to the ground, those of closing joints last.
    pub(super) fn new(model: &Model) -> Self {
        let reach = Reach::new(model, Scene::for_solution(model));
        let tree = tree(model, &reach);
        let layout = model.layout();
        let mut places = vec![0; layout.rows];
        let mut ends = Vec::with_capacity(layout.rows);
        // The first place of a row that acts on each body.
        let mut firsts: Vec<Option<usize>> = vec![None; model.bodies.len()];
        for joint in in_turn(model, &tree) {
            let bodies = || model.joints[joint].bodies.iter().flatten();
            let own = ends.len();
            for &body in bodies() {
                firsts[body].get_or_insert(own);
            }
            let first = bodies().filter_map(|&body| firsts[body]).min();
            let first = first.unwrap_or(own);
            let rows = layout.row[joint]..layout.row[joint] + model.equations(&model.joints[joint]);
            for place in &mut places[rows] {
                *place = ends.len();
                let before = ends.last().copied().unwrap_or(0);
                ends.push(before + ends.len() + 1 - first);
            }
        }
        Self { places, ends }
    }

    /// How many entries there are.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.ends.last().copied().unwrap_or(0)
    }
}

/// All joints in their order of elimination. What a joint carries stands before it, one branch
/// after the other, the largest first: so little lies between a joint and those that it carries.
/// Closing joints come last.
fn in_turn(model: &Model, tree: &Tree) -> Vec<usize> {
    let carrying = || tree.bodies.iter().filter_map(|&(_, joint)| joint);
    let mut carried: Vec<Vec<usize>> = vec![Vec::new(); model.joints.len()];
    let mut sizes = vec![1; model.joints.len()];
    let mut roots = Vec::new();
    // Leaves come first.
    for joint in carrying() {
        let bodies = model.joints[joint].bodies.iter().flatten();
        let nearer = bodies.filter_map(|&body| {
            let of_body = tree.bodies.iter().find(|(other, _)| *other == body)?.1?;
            (tree.depths[of_body] < tree.depths[joint]).then_some(of_body)
        });
        match nearer.max_by_key(|&other| tree.depths[other]) {
            Some(carrier) => {
                carried[carrier].push(joint);
                sizes[carrier] += sizes[joint];
            }
            None => roots.push(joint),
        }
    }
    // Backwards: a joint, then what it carries, the smallest branch first.
    let mut order = Vec::new();
    let mut next = roots;
    while let Some(joint) = next.pop() {
        order.push(joint);
        let branches = &mut carried[joint];
        branches.sort_by_key(|&branch| std::cmp::Reverse(sizes[branch]));
        next.append(branches);
    }
    order.reverse();
    order.extend(&tree.closing);
    order
}

/// The compliance of each row.
pub(super) fn compliances(scene: &Scene) -> Kernel {
    let mut arena = Arena::new();
    let mut outputs = Vec::new();
    for constrained in &scene.constraints {
        let compliance = arena.input(Input::Compliance(constrained.row as u32));
        outputs.resize(outputs.len() + constrained.equations(), compliance);
    }
    Kernel { arena, outputs }
}
