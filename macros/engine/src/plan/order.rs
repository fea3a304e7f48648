//! The order of elimination: bodies from the leaves of a spanning tree to the ground, rows of a
//! body's joint behind it as soon as they are safe, closing joints last; or rows behind all bodies.
//!
//! A row may follow the bodies that are eliminated already if their accelerations determine its
//! multiplier in every regular configuration. The bodies that rows have tied together so far make a
//! part of the mechanism, and what is left of the mechanism is felt through these rows only. Were
//! their gradients on the part dependent, a combination of the rows would act with no force and no
//! moment on the part; where they hold it against *one* other body, or against the ground, reaction
//! and action cancel, and it would act on nothing: the rows of `D` would be dependent. With two
//! bodies outside the part this does not follow, and the row waits.
//!
//! Rows may also wait until all bodies are eliminated. Rows that were eliminated before are
//! independent with the bodies that were, the others with all bodies: `D M^-1 D^T` is positive
//! definite, and so is what is left of it after any of its rows. Their order is free.

use std::collections::BTreeSet;

use super::Pivot;
use super::fill::{Block, fill};
use super::reach::Reach;
use super::tree::Tree;
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::equations::initial_state;
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::expression::{Constraint, ScalarExpr, VectorExpr};
use crate::symbolic::scene::Scene;
use crate::symbolic::vector::Triple;

/// Coordinates at the start, where the macro can see them.
pub(super) struct StartValues {
    coordinates: Vec<Option<f64>>,
}

impl StartValues {
    pub(super) fn new(model: &Model) -> Self {
        let initial = initial_state(model);
        let values = evaluate(&initial.arena, &initial.outputs, |_| None);
        Self {
            coordinates: values.into_iter().take(model.layout().stored()).collect(),
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

/// A part of the mechanism that is eliminated and held together by rows that are.
#[derive(Clone, Default)]
struct Part {
    bodies: BTreeSet<usize>,
    /// What its rows hold it against.
    outside: BTreeSet<Option<usize>>,
}

/// The order of elimination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sequence {
    /// Bodies from the leaves, point rows together with the accelerations that they carry, other
    /// rows behind them as soon as they are safe.
    Leaves {
        /// Two single rows paired with two components of the angular acceleration.
        forbidden: bool,
        /// Point rows between moving bodies wait until all bodies are eliminated, and begin there
        /// then.
        late: Option<Rows>,
    },
    /// All bodies, then all rows: the diagonal of the bodies does not fill in, and what is left,
    /// `-D M^-1 D^T`, couples rows of neighbours only.
    BodiesFirst(Rows),
}

/// Where rows begin once all bodies are eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    /// At the leaves.
    Leaves,
    /// At the ground.
    Ground,
    /// At the ground and at the leaves: half the way, and as many operations along a chain.
    BothEnds,
}

/// Picks pivots.
pub(super) struct Order<'a> {
    pub(super) scene: &'a Scene,
    pub(super) coupling: &'a [Vec<(usize, Expr)>],
    pub(super) kinds: &'a [BodyKind],
    pub(super) start: &'a StartValues,
    pub(super) reach: &'a Reach,
    done: Vec<bool>,
    parts: Vec<Part>,
}

impl<'a> Order<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        coupling: &'a [Vec<(usize, Expr)>],
        kinds: &'a [BodyKind],
        start: &'a StartValues,
        reach: &'a Reach,
    ) -> Self {
        Self {
            scene,
            coupling,
            kinds,
            start,
            reach,
            done: Vec::new(),
            parts: Vec::new(),
        }
    }

    /// Pivots from first to last, and the determinants of the forbidden motions at the start.
    pub(super) fn pivots(&mut self, tree: &Tree, sequence: Sequence) -> (Vec<Pivot>, Vec<f64>) {
        self.done = vec![false; self.scene.layout.velocities + self.scene.layout.rows];
        self.parts = Vec::new();
        match sequence {
            Sequence::Leaves { forbidden, late } => self.leaves_first(tree, forbidden, late),
            Sequence::BodiesFirst(rows) => (self.bodies_first(tree, rows), Vec::new()),
        }
    }

    /// Rows are independent, so that `D M^-1 D^T` is positive definite, and so is what is left of
    /// it: any order of the rows is safe.
    fn bodies_first(&mut self, tree: &Tree, rows: Rows) -> Vec<Pivot> {
        let mut pivots = Vec::new();
        for &(body, _) in &tree.bodies {
            self.take_body(&mut pivots, body);
        }
        for row in self.rows_in_order(tree, rows) {
            let row = self.scene.layout.velocities + row;
            self.take(&mut pivots, Pivot::Multiplier(row));
        }
        pivots
    }

    /// All rows, those of closing joints last. From the leaves of a tree no elimination couples
    /// what was not coupled; where another beginning does, as in a tree that branches, it is not
    /// heeded.
    fn rows_in_order(&self, tree: &Tree, rows: Rows) -> Vec<usize> {
        let joints = joints_in_order(tree, rows);
        let from_leaves = joints_in_order(tree, Rows::Leaves);
        let fills_less = self.fill(&from_leaves) < self.fill(&joints);
        let joints = if fills_less { from_leaves } else { joints };
        joints
            .into_iter()
            .flat_map(|joint| rows_of(self.scene, joint))
            .collect()
    }

    /// What rows fill in if those of the joints are eliminated in this order.
    fn fill(&self, joints: &[usize]) -> usize {
        let blocks = joints.iter().map(|&joint| {
            let rows = rows_of(self.scene, joint);
            let bodies = rows.iter().map(|&row| &self.reach.rows[row]);
            Block {
                equations: rows.len(),
                bodies: bodies.flatten().copied().flatten().collect(),
            }
        });
        fill(&blocks.collect::<Vec<_>>())
    }

    fn take_body(&mut self, pivots: &mut Vec<Pivot>, body: usize) {
        let first = self.scene.layout.velocity[body];
        for k in 0..self.kinds[body].velocities() {
            self.take(pivots, Pivot::Acceleration(first + k));
        }
    }

    fn leaves_first(
        &mut self,
        tree: &Tree,
        forbidden: bool,
        late: Option<Rows>,
    ) -> (Vec<Pivot>, Vec<f64>) {
        let scene = self.scene;
        let velocities = scene.layout.velocities;
        let mut pivots = Vec::new();
        let mut determinants = Vec::new();
        let mut waiting: Vec<usize> = Vec::new();
        for &(body, joint) in &tree.bodies {
            self.enter(body);
            // Of a leaf the block is made of numbers, which the rows of its joint carry on as they
            // are.
            let is_filled = self.is_filled(body);
            if let Some(joint) = joint {
                if is_filled {
                    for k in self.free(joint, body) {
                        self.take(&mut pivots, Pivot::Acceleration(k));
                    }
                }
                // What turns with the body goes first, unless the point rows know of it.
                let turns_first = is_filled && self.are_about_their_point(joint, body);
                for turns in [turns_first, !turns_first] {
                    if !turns {
                        self.take_carried(&mut pivots, joint, body, late);
                    } else if forbidden {
                        let determinant = self.take_forbidden(&mut pivots, joint, body);
                        determinants.extend(determinant);
                    }
                }
            }
            self.take_body(&mut pivots, body);
            let behind = joint.map_or_else(Vec::new, |joint| rows_of(scene, joint));
            let waits = |row: &usize| {
                late.is_some() && self.is_of_vector(*row) && self.is_between_bodies(*row)
            };
            waiting.extend(behind.into_iter().filter(|row| !waits(row)));
            waiting.retain(|&row| {
                let ready = self.done[velocities + row] || self.hold(&[row]);
                if ready {
                    self.take(&mut pivots, Pivot::Multiplier(velocities + row));
                }
                !ready
            });
        }
        let rest = self.rows_in_order(tree, late.unwrap_or(Rows::Leaves));
        for row in waiting.into_iter().chain(rest) {
            self.take(&mut pivots, Pivot::Multiplier(velocities + row));
        }
        (pivots, determinants)
    }

    /// Point rows of a joint together with the accelerations of the body that it carries.
    fn take_carried(
        &mut self,
        pivots: &mut Vec<Pivot>,
        joint: usize,
        body: usize,
        late: Option<Rows>,
    ) {
        let (first, velocities) = (
            self.scene.layout.velocity[body],
            self.scene.layout.velocities,
        );
        for row in self.carried_rows(joint, first) {
            let rows = [row, row + 1, row + 2];
            let is_free = |row: &usize| self.is_first_on(*row, body);
            let waits = late.is_some() && self.is_between_bodies(row);
            if waits || !rows.iter().all(is_free) || !self.hold(&rows) {
                continue;
            }
            for k in 0..3 {
                self.take(pivots, Pivot::Saddle(first + k, velocities + row + k));
            }
        }
    }

    /// The motion that a joint forbids the body that it carries; its determinant at the start.
    fn take_forbidden(
        &mut self,
        pivots: &mut Vec<Pivot>,
        joint: usize,
        body: usize,
    ) -> Option<f64> {
        let (accelerations, rows, determinant) = self.forbidden_motion(joint, body)?;
        if !rows.iter().all(|&row| self.is_first_on(row, body)) || !self.hold(&rows) {
            return None;
        }
        let rows = rows.map(|row| self.scene.layout.velocities + row);
        self.take(pivots, Pivot::Forbidden(accelerations, rows));
        Some(determinant)
    }

    /// Whether the point rows of a joint do not act on the angular acceleration of the body that it
    /// carries.
    fn are_about_their_point(&self, joint: usize, body: usize) -> bool {
        let first = self.scene.layout.velocity[body];
        let carried = self.carried_rows(joint, first);
        let mut rows = carried.iter().flat_map(|&row| &self.coupling[row..row + 3]);
        let own = first + 3..first + self.kinds[body].velocities();
        rows.all(|row| row.iter().all(|(k, _)| !own.contains(k)))
    }

    /// Whether a row that acts on a body is eliminated, so that its block of masses is not made of
    /// numbers any more.
    fn is_filled(&self, body: usize) -> bool {
        let velocities = self.scene.layout.velocities;
        let mut rows = self.reach.rows.iter().enumerate();
        rows.any(|(row, bodies)| self.done[velocities + row] && bodies.contains(&Some(body)))
    }

    /// The accelerations of a body that no row of the joint acts on which carries it. Before the
    /// others they know of their own body only, so that little is coupled with them.
    fn free(&self, joint: usize, body: usize) -> Vec<usize> {
        let first = self.scene.layout.velocity[body];
        let own = first..first + self.kinds[body].velocities();
        let rows = rows_of(self.scene, joint);
        let acts = |k: usize| {
            let mut entries = rows.iter().flat_map(|&row| &self.coupling[row]);
            entries.any(|(unknown, _)| *unknown == k)
        };
        own.filter(|&k| !acts(k)).collect()
    }

    /// Whether a row acts on more than one body.
    fn is_between_bodies(&self, row: usize) -> bool {
        self.reach.rows[row].iter().flatten().count() > 1
    }

    fn is_of_vector(&self, row: usize) -> bool {
        self.scene.constraints.iter().any(|c| {
            (c.row..c.row + 3).contains(&row) && matches!(c.constraint, Constraint::Vector(_))
        })
    }

    /// The accelerations of a body are eliminated from here on.
    fn enter(&mut self, body: usize) {
        let part = Part {
            bodies: BTreeSet::from([body]),
            outside: BTreeSet::new(),
        };
        self.parts.push(part);
        self.join(|part| part.bodies.contains(&body) || part.outside.contains(&Some(body)));
    }

    /// Makes one part of several.
    fn join(&mut self, joined: impl Fn(&Part) -> bool) {
        let (together, mut rest): (Vec<Part>, Vec<Part>) =
            self.parts.drain(..).partition(|part| joined(part));
        let mut whole = Part::default();
        for part in together {
            whole.bodies.extend(part.bodies);
            whole.outside.extend(part.outside);
        }
        let Part { bodies, outside } = &mut whole;
        outside.retain(|body| body.is_none_or(|body| !bodies.contains(&body)));
        rest.push(whole);
        self.parts = rest;
    }

    /// Adds rows to what holds the parts together, if their multipliers are determined with them.
    fn hold(&mut self, rows: &[usize]) -> bool {
        let touched: BTreeSet<Option<usize>> = rows
            .iter()
            .flat_map(|&row| self.reach.rows[row].iter().copied())
            .collect();
        let is_held = |part: &Part| {
            part.bodies
                .iter()
                .any(|&body| touched.contains(&Some(body)))
        };
        let held: Vec<&Part> = self.parts.iter().filter(|part| is_held(part)).collect();
        let is_inside = |body: Option<usize>| {
            body.is_some_and(|body| held.iter().any(|part| part.bodies.contains(&body)))
        };
        let outside: BTreeSet<Option<usize>> = held
            .iter()
            .flat_map(|part| part.outside.iter().copied())
            .chain(touched.iter().copied())
            .filter(|&body| !is_inside(body))
            .collect();
        if held.is_empty() || outside.len() > 1 {
            return false;
        }
        self.join(is_held);
        if let Some(whole) = self.parts.last_mut() {
            whole.outside = outside;
        }
        true
    }

    /// Whether no body that a row acts on was eliminated before this one, so that the row is as it
    /// was assembled.
    fn is_first_on(&self, row: usize, body: usize) -> bool {
        let mut bodies = self.reach.rows[row].iter().flatten();
        bodies.all(|&other| {
            other == body || !self.parts.iter().any(|part| part.bodies.contains(&other))
        })
    }

    /// Adds a pivot if none of its unknowns was eliminated before.
    fn take(&mut self, pivots: &mut Vec<Pivot>, pivot: Pivot) {
        let unknowns = pivot.unknowns();
        if unknowns.iter().all(|&k| !self.done[k]) {
            unknowns.iter().for_each(|&k| self.done[k] = true);
            pivots.push(pivot);
        }
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

    /// The two single rows of a joint that determine two components of a body's angular
    /// acceleration.
    ///
    /// The rows must prescribe the scalar products of one vector `h` on the body with two vectors
    /// `a`, `b` on another: then the determinant is `(a x b) . h`, whose size the constraints fix.
    fn forbidden_motion(&self, joint: usize, body: usize) -> Option<([usize; 2], [usize; 2], f64)> {
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
        well_posed.then_some(([k, l], [m, n], determinant))
    }
}

/// For a scalar product of a vector on `body` with one on another body, plus constants: that
/// vector, and the other body.
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
        | ScalarExpr::Setpoint(_)
        | ScalarExpr::Function(..)
        | ScalarExpr::Angle(_)
        | ScalarExpr::Direction(_)
        | ScalarExpr::Rate(_)
        | ScalarExpr::Side { .. }
        | ScalarExpr::Select { .. }
        | ScalarExpr::State { .. } => None,
    }
}

/// Whether the three rows of a constraint are plus or minus the three accelerations from `first`
/// on.
fn carries(coupling: &[Vec<(usize, Expr)>], row: usize, first: usize) -> bool {
    (0..3).all(|k| {
        let own: Vec<_> = coupling[row + k]
            .iter()
            .filter(|(unknown, _)| (first..first + 3).contains(unknown))
            .collect();
        matches!(own[..], [&(unknown, value)] if unknown == first + k && value.abs() == Arena::ONE)
    })
}

/// All joints, the closing ones last.
fn joints_in_order(tree: &Tree, rows: Rows) -> Vec<usize> {
    let mut joints: Vec<usize> = tree.bodies.iter().filter_map(|(_, joint)| *joint).collect();
    match rows {
        Rows::Leaves => {}
        Rows::Ground => joints.reverse(),
        Rows::BothEnds => {
            let from_end = |joint: &usize| tree.heights[*joint].min(tree.depths[*joint]);
            joints.sort_by_key(from_end);
        }
    }
    joints.extend(&tree.closing);
    joints
}

fn rows_of(scene: &Scene, joint: usize) -> Vec<usize> {
    scene
        .constraints
        .iter()
        .filter(|constrained| constrained.joint == joint)
        .flat_map(|constrained| constrained.row..constrained.row + constrained.equations())
        .collect()
}
