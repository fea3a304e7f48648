//! The order of elimination: bodies from the leaves of a spanning tree to the ground, rows of a body's joint right behind it,
//! closing joints last.

use std::collections::VecDeque;

use super::Pivot;
use super::kernels::initial_state;
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::scene::{Constraint, Scene};
use crate::symbolic::twist::{ScalarExpr, VectorExpr};
use crate::symbolic::vector::Triple;

/// Bodies from the leaves to the ground with the joint towards the ground, and the joints left over.
pub(super) struct Tree {
    bodies: Vec<(usize, Option<usize>)>,
    closing: Vec<usize>,
    /// The body that each joint carries, `None` for a closing joint.
    pub(super) child: Vec<Option<usize>>,
}

/// A spanning tree of the bodies, breadth first from the ground.
pub(super) fn tree(model: &Model) -> Tree {
    let mut parent: Vec<Option<Option<usize>>> = vec![None; model.bodies.len()];
    let mut child = vec![None; model.joints.len()];
    let mut order = Vec::new();
    let mut queue = VecDeque::from([None]);
    for root in 0..=model.bodies.len() {
        while let Some(at) = queue.pop_front() {
            for (place, joint) in model.joints.iter().enumerate() {
                if !joint.bodies.contains(&at) {
                    continue;
                }
                for &next in joint.bodies.iter().flatten() {
                    if parent[next].is_none() && child[place].is_none() {
                        parent[next] = Some(Some(place));
                        child[place] = Some(next);
                        order.push(next);
                        queue.push_back(Some(next));
                    }
                }
            }
        }
        // Bodies without a way to the ground: the next one is a root.
        if root < model.bodies.len() && parent[root].is_none() {
            parent[root] = Some(None);
            order.push(root);
            queue.push_back(Some(root));
        }
    }
    order.reverse();
    let closing = (0..model.joints.len())
        .filter(|&joint| child[joint].is_none())
        .collect();
    let bodies = order
        .into_iter()
        .map(|body| (body, parent[body].flatten()))
        .collect();
    Tree {
        bodies,
        closing,
        child,
    }
}
/// Coordinates at the start, where the macro can see them.
pub(super) struct StartValues {
    coordinates: Vec<Option<f64>>,
}

impl StartValues {
    pub(super) fn new(model: &Model) -> Self {
        let initial = initial_state(model);
        let values = evaluate(&initial.arena, &initial.outputs, |_| None);
        Self {
            coordinates: values
                .into_iter()
                .take(model.layout().coordinates + model.layout().auxiliaries)
                .collect(),
        }
    }

    fn input(&self, input: Input) -> Option<f64> {
        match input {
            Input::Coordinate(place) => self.coordinates[place as usize],
            Input::Time => Some(0.0),
            _ => None,
        }
    }
}

/// Picks pivots.
pub(super) struct Order<'a> {
    pub(super) scene: &'a Scene,
    pub(super) coupling: &'a [Vec<(usize, Expr)>],
    pub(super) kinds: &'a [BodyKind],
    pub(super) start: &'a StartValues,
    pub(super) done: Vec<bool>,
}

impl Order<'_> {
    /// Pivots from first to last, and the determinants of the forbidden motions at the start.
    pub(super) fn pivots(
        &mut self,
        tree: &Tree,
        saddles: bool,
        forbidden: bool,
    ) -> (Vec<Pivot>, Vec<f64>) {
        let scene = self.scene;
        let velocities = scene.layout.velocities;
        self.done = vec![false; velocities + scene.layout.rows];
        let mut pivots = Vec::new();
        let mut determinants = Vec::new();
        for &(body, joint) in &tree.bodies {
            let first = scene.layout.velocity[body];
            if let Some(joint) = joint.filter(|_| saddles) {
                for row in self.carried_rows(joint, first) {
                    for k in 0..3 {
                        self.take(&mut pivots, Pivot::Saddle(first + k, velocities + row + k));
                    }
                }
            }
            if let Some(joint) = joint.filter(|_| forbidden)
                && let Some((pivot, determinant)) = self.forbidden_motion(joint, body)
                && self.take(&mut pivots, pivot)
            {
                determinants.push(determinant);
            }
            for k in 0..self.kinds[body].velocities() {
                self.take(&mut pivots, Pivot::Acceleration(first + k));
            }
            for row in joint.map_or_else(Vec::new, |joint| rows_of(scene, joint)) {
                self.take(&mut pivots, Pivot::Multiplier(velocities + row));
            }
        }
        for &joint in &tree.closing {
            for row in rows_of(scene, joint) {
                self.take(&mut pivots, Pivot::Multiplier(velocities + row));
            }
        }
        (pivots, determinants)
    }

    /// Adds a pivot if none of its unknowns was eliminated before.
    fn take(&mut self, pivots: &mut Vec<Pivot>, pivot: Pivot) -> bool {
        let unknowns = pivot.unknowns();
        let free = unknowns.iter().all(|&k| !self.done[k]);
        if free {
            unknowns.iter().for_each(|&k| self.done[k] = true);
            pivots.push(pivot);
        }
        free
    }

    /// The first rows of the constraints of a joint that carry the accelerations from `first` on.
    fn carried_rows(&self, joint: usize, first: usize) -> Vec<usize> {
        self.scene
            .constraints
            .iter()
            .filter(|c| c.joint == joint && matches!(c.constraint, Constraint::Vector(_)))
            .map(|c| c.row)
            .filter(|&row| carries(self.coupling, row, first))
            .collect()
    }

    fn prescribed(&self, row: usize, body: usize) -> Option<(Triple, Option<usize>)> {
        let constrained = self.scene.constraints.iter().find(|c| c.row == row)?;
        match &constrained.constraint {
            Constraint::Scalar(scalar) => prescribed(scalar, body),
            Constraint::Vector(_) => None,
        }
    }

    /// The two single rows of a joint that determine two components of a body's angular acceleration.
    ///
    /// The rows must prescribe the scalar products of one vector `h` on the body with two vectors `a`, `b` on another: then
    /// the determinant is `(a x b) . h`, whose size the constraints fix.
    fn forbidden_motion(&self, joint: usize, body: usize) -> Option<(Pivot, f64)> {
        if self.kinds[body] != BodyKind::Rigid {
            return None;
        }
        let rows: Vec<usize> = self
            .scene
            .constraints
            .iter()
            .filter(|c| c.joint == joint && matches!(c.constraint, Constraint::Scalar(_)))
            .map(|c| c.row)
            .collect();
        let [m, n] = rows[..] else { return None };
        if self.prescribed(m, body)? != self.prescribed(n, body)? {
            return None;
        }
        let first = self.scene.layout.velocity[body] + 3;
        let on_body = |row: usize| -> Vec<(usize, Expr)> {
            let own = first - 3..first + 3;
            self.coupling[row]
                .iter()
                .copied()
                .filter(|(k, _)| own.contains(k))
                .collect()
        };
        let (on_m, on_n) = (on_body(m), on_body(n));
        let mut columns: Vec<usize> = on_m.iter().chain(&on_n).map(|(k, _)| *k).collect();
        columns.sort_unstable();
        columns.dedup();
        let [k, l] = columns[..] else { return None };
        if k < first {
            return None;
        }
        let value = |entries: &[(usize, Expr)], column: usize| -> Option<f64> {
            let Some((_, entry)) = entries.iter().find(|(k, _)| *k == column) else {
                return Some(0.0);
            };
            evaluate(&self.scene.space.arena, &[*entry], |input| {
                self.start.input(input)
            })[0]
        };
        let (a, b, c, d) = (
            value(&on_m, k)?,
            value(&on_m, l)?,
            value(&on_n, k)?,
            value(&on_n, l)?,
        );
        let determinant = a * d - b * c;
        let well_posed = determinant.abs() > 0.1 * a.hypot(b) * c.hypot(d);
        let velocities = self.scene.layout.velocities;
        well_posed.then_some((
            Pivot::Forbidden([k, l], [velocities + m, velocities + n]),
            determinant,
        ))
    }
}

/// For a scalar product of a vector on `body` with one on another body, plus constants: that vector, and the other body.
fn prescribed(scalar: &ScalarExpr, body: usize) -> Option<(Triple, Option<usize>)> {
    match scalar {
        ScalarExpr::Dot(a, b) => {
            let (VectorExpr::Fixed(i, u), VectorExpr::Fixed(j, v)) = (&**a, &**b) else {
                return None;
            };
            match (*i == Some(body), *j == Some(body)) {
                (true, false) => Some((*u, *j)),
                (false, true) => Some((*v, *i)),
                _ => None,
            }
        }
        ScalarExpr::Sum(terms) => {
            let mut changing = terms
                .iter()
                .filter(|(_, t)| !matches!(t, ScalarExpr::Constant(_)));
            match (changing.next(), changing.next()) {
                (Some((_, only)), None) => prescribed(only, body),
                _ => None,
            }
        }
        ScalarExpr::Constant(_)
        | ScalarExpr::Product(..)
        | ScalarExpr::Time
        | ScalarExpr::Function(..)
        | ScalarExpr::Angle(_)
        | ScalarExpr::Rate(_) => None,
    }
}

/// Whether the three rows of a constraint are plus or minus the three accelerations from `first` on.
fn carries(coupling: &[Vec<(usize, Expr)>], row: usize, first: usize) -> bool {
    (0..3).all(|k| {
        let own: Vec<_> = coupling[row + k]
            .iter()
            .filter(|(unknown, _)| (first..first + 3).contains(unknown))
            .collect();
        matches!(own[..], [&(unknown, value)] if unknown == first + k && value.abs() == Arena::ONE)
    })
}

fn rows_of(scene: &Scene, joint: usize) -> Vec<usize> {
    scene
        .constraints
        .iter()
        .filter(|constrained| constrained.joint == joint)
        .flat_map(|constrained| constrained.row..constrained.row + constrained.equations())
        .collect()
}
