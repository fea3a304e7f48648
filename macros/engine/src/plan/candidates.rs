//! Plans worth counting, and the choice among them.
//!
//! Bodies are eliminated from the leaves of a spanning tree towards the ground, rows of a body's joint right behind it,
//! closing joints last: work grows linearly along a chain. Candidates differ in the axes of point rows and of
//! accelerations, and in whether point rows are paired with accelerations or left to the Schur complement.

use std::collections::VecDeque;

use super::kernels::initial_state;
use super::system::{System, Terms, coupling};
use super::{Pivot, Plan};
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::count::count;
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::scene::{Constraint, Reading, Scene};
use crate::symbolic::twist::{ScalarExpr, VectorExpr};
use crate::symbolic::vector::{Frame, Triple};

/// Bodies from the leaves to the ground with the joint towards the ground, and the joints left over.
struct Tree {
    bodies: Vec<(usize, Option<usize>)>,
    closing: Vec<usize>,
    child: Vec<Option<usize>>,
}

fn tree(model: &Model) -> Tree {
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

/// What the candidates differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Strategy {
    /// Accelerations of rigid bodies in body axes.
    body_accelerations: bool,
    /// Rows in the axes of the body that is carried.
    body_rows: bool,
    /// Point rows paired with accelerations.
    saddles: bool,
    /// Two single rows paired with two components of the angular acceleration.
    forbidden: bool,
}

const STRATEGIES: [Strategy; 7] = {
    const fn strategy(axes: (bool, bool), pivots: (bool, bool)) -> Strategy {
        let (body_accelerations, body_rows) = axes;
        let (saddles, forbidden) = pivots;
        Strategy {
            body_accelerations,
            body_rows,
            saddles,
            forbidden,
        }
    }
    [
        strategy((true, true), (true, true)),
        strategy((true, true), (true, false)),
        strategy((false, false), (true, true)),
        strategy((false, false), (true, false)),
        strategy((true, true), (false, false)),
        strategy((false, true), (false, false)),
        strategy((false, false), (false, false)),
    ]
};

/// The cheapest plan for a model, and its operations for the standard evaluation.
#[must_use]
pub fn choose(model: &Model) -> (Plan, usize) {
    let tree = tree(model);
    let mut best: Option<(Plan, usize)> = None;
    for strategy in STRATEGIES {
        let plan = plan(model, &tree, strategy);
        if best.as_ref().is_some_and(|(known, _)| *known == plan) {
            continue;
        }
        let cost = cost(model, &plan);
        if best.as_ref().is_none_or(|(_, least)| cost < *least) {
            best = Some((plan, cost));
        }
    }
    best.expect("there are strategies")
}

/// The operations of the standard evaluation with a plan.
#[must_use]
pub fn cost(model: &Model, plan: &Plan) -> usize {
    let mut scene = Scene::for_solution(model, Reading::Raw);
    let solution = equations_of_motion(&mut scene, model, plan.clone(), Terms::Plain).0;
    let outputs: Vec<Expr> = solution
        .accelerations
        .into_iter()
        .chain(solution.multipliers)
        .collect();
    count(&scene.space.arena, &outputs, Stage::State).total()
}

/// The solved equations of motion.
pub fn equations_of_motion(
    scene: &mut Scene,
    model: &Model,
    plan: Plan,
    terms: Terms,
) -> (super::system::Solution, System) {
    let kinds: Vec<BodyKind> = model.bodies.iter().map(|body| body.kind).collect();
    let system = System::new(scene, &kinds, plan, terms);
    let right = system.equations_of_motion(scene, terms);
    let upper = crate::plan::system::applied_forces(scene, &kinds);
    let solution = system.solve(scene, &right, &upper);
    (solution, system)
}

fn plan(model: &Model, tree: &Tree, strategy: Strategy) -> Plan {
    let frame_of = |body: usize, wanted: bool| match model.bodies[body].kind {
        BodyKind::Rigid if wanted => Frame::Body(body),
        _ => Frame::Global,
    };
    let translation = (0..model.bodies.len())
        .map(|body| frame_of(body, strategy.body_accelerations))
        .collect();
    let mut scene = Scene::new(model, Reading::Raw);
    let last_body = |joint: usize| {
        model.joints[joint]
            .bodies
            .iter()
            .rev()
            .copied()
            .flatten()
            .next()
    };
    let rows = scene
        .constraints
        .iter()
        .map(|constrained| {
            let child = tree.child[constrained.joint].or_else(|| last_body(constrained.joint));
            child.map_or(Frame::Global, |body| frame_of(body, strategy.body_rows))
        })
        .collect();
    let mut plan = Plan {
        translation,
        rows,
        pivots: Vec::new(),
        compliant_pivots: Vec::new(),
        determinants: Vec::new(),
    };
    let kinds: Vec<BodyKind> = model.bodies.iter().map(|body| body.kind).collect();
    let coupling = coupling(&mut scene, &kinds, &plan);
    let start = StartValues::new(model);
    let mut order = Order {
        scene: &scene,
        coupling: &coupling,
        kinds: &kinds,
        start: &start,
        done: Vec::new(),
    };
    (plan.pivots, plan.determinants) = order.pivots(tree, strategy.saddles, strategy.forbidden);
    (plan.compliant_pivots, _) = order.pivots(tree, strategy.saddles, false);
    plan
}

/// Coordinates at the start, where the macro can see them.
struct StartValues {
    coordinates: Vec<Option<f64>>,
}

impl StartValues {
    fn new(model: &Model) -> Self {
        let initial = initial_state(model);
        let values = evaluate(&initial.arena, &initial.outputs, |_| None);
        Self {
            coordinates: values
                .into_iter()
                .take(model.layout().coordinates)
                .collect(),
        }
    }

    fn input(&self, input: Input) -> Option<f64> {
        match input {
            Input::Coordinate(place) => self.coordinates[place as usize],
            _ => None,
        }
    }
}

struct Order<'a> {
    scene: &'a Scene,
    coupling: &'a [Vec<(usize, Expr)>],
    kinds: &'a [BodyKind],
    start: &'a StartValues,
    done: Vec<bool>,
}

impl Order<'_> {
    fn pivots(&mut self, tree: &Tree, saddles: bool, forbidden: bool) -> (Vec<Pivot>, Vec<f64>) {
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
        ScalarExpr::Constant(_) | ScalarExpr::Product(..) => None,
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
