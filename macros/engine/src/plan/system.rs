//! The saddle system of a scene in the axes of a plan, and its solution back in the axes of the
//! state.

use super::augmented::{Augmented, handed_on, shares};
use super::eliminate::{Check, Factors, factorise_within};
use super::symmetric::Symmetric;
use super::{Pivot, Plan};
use crate::model::BodyKind;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::count::count;
use crate::symbolic::expression::Constraint;
use crate::symbolic::rotation;
use crate::symbolic::scene::Scene;
use crate::symbolic::vector::{Frame, Triple, VectorId, ZERO, cross};

/// The terms of a formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Terms {
    /// Rigid, without stabilisation.
    Plain,
    /// Rigid, with terms of `Phi` and `Phi'`.
    Stabilised,
    /// With compliance and stabilisation.
    Compliant,
}

impl Terms {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Stabilised, Self::Compliant];

    /// The factors of `Phi`, `Phi'` and the quadratic terms in `gamma*`.
    pub fn factors(self, arena: &mut Arena) -> [Expr; 3] {
        match self {
            Self::Plain => [Arena::ZERO, Arena::ZERO, -Arena::ONE],
            Self::Stabilised | Self::Compliant => {
                let position = arena.input(Input::PositionGain);
                let rate = arena.input(Input::RateGain);
                [-position, -rate, -Arena::ONE]
            }
        }
    }
}

/// Accelerations and multipliers, in the axes of the state and of the definitions.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// `u'`: translation in global axes, rotation in principal axes.
    pub accelerations: Vec<Expr>,
    /// `lambda`, rows in the axes of their definition.
    pub multipliers: Vec<Expr>,
}

/// The right-hand side, in the axes of the plan.
#[derive(Clone, Debug)]
pub struct RightHandSide {
    values: Vec<Expr>,
    /// The forces and moments on the bodies about their centres of mass, in the same axes.
    about_centres: Vec<Expr>,
    /// What the present motion adds to the acceleration of each centre of mass, beyond that of the
    /// point of reference and the angular acceleration.
    known: Vec<VectorId>,
}

/// The factorised system of a scene.
#[derive(Clone, Debug)]
pub struct System {
    plan: Plan,
    kinds: Vec<BodyKind>,
    /// The matrix in the axes of the plan and about its points, and the same about centres of mass.
    matrix: Symmetric,
    about_centres: Symmetric,
    factors: Factors,
}

/// The entries of `D` in the axes of a plan: for each row, unknowns and values.
pub fn coupling(scene: &mut Scene, kinds: &[BodyKind], plan: &Plan) -> Vec<Vec<(usize, Expr)>> {
    let mut rows = Vec::new();
    for (place, &frame) in plan.rows.iter().enumerate() {
        for gradient in scene.gradients(place, frame) {
            let mut row = Vec::new();
            for (body, kind) in kinds.iter().enumerate() {
                let first = scene.layout.velocity[body];
                let force = gradient.force(&mut scene.space, body);
                let force = scene.space.components(force, plan.translation[body]);
                row.extend((0..3).map(|k| (first + k, force[k])));
                if *kind == BodyKind::Rigid {
                    let moment = gradient.moment(&mut scene.space, body);
                    let moment = scene.space.components(moment, Frame::Body(body));
                    row.extend((0..3).map(|k| (first + 3 + k, moment[k])));
                }
            }
            row.retain(|&(_, value)| value != Arena::ZERO);
            rows.push(row);
        }
    }
    rows
}

impl Plan {
    /// Makes the points of the plan those of reference.
    pub(super) fn refer(&self, scene: &mut Scene) {
        for (body, constraint) in self.points.iter().enumerate() {
            let point = constraint.and_then(|constraint| scene.point_on(constraint, body));
            scene.motion.reference[body] = point.unwrap_or(ZERO);
        }
    }
}

/// The matrix in the axes of a plan, about the present points of reference.
fn assembled(
    scene: &mut Scene,
    kinds: &[BodyKind],
    plan: &Plan,
    compliances: &[Expr],
    augmented: &Augmented,
) -> Symmetric {
    let (velocities, rows) = (scene.layout.velocities, scene.layout.rows);
    let mut matrix = Symmetric::new(velocities + rows);
    for (body, kind) in kinds.iter().enumerate() {
        let first = scene.layout.velocity[body];
        let mass = augmented.mass[body];
        for k in 0..3 {
            matrix.set(first + k, first + k, mass);
        }
        if *kind != BodyKind::Rigid {
            continue;
        }
        let points = &augmented.points[body];
        let (moment, inertia) = scene.moments_about_reference(body, points);
        for k in 0..3 {
            for (l, &entry) in inertia[k].iter().enumerate().skip(k) {
                matrix.set(first + 3 + k, first + 3 + l, entry);
            }
            // What a rotation about one axis does to the centre of mass.
            let mut axis = ZERO;
            axis[k] = Arena::ONE;
            let moved = cross(&mut scene.space.arena, axis, moment);
            let moved = scene.space.native(Frame::Body(body), moved);
            let moved = scene.space.components(moved, plan.translation[body]);
            for (l, component) in moved.into_iter().enumerate() {
                matrix.set(first + l, first + 3 + k, component);
            }
        }
    }
    for (row, entries) in coupling(scene, kinds, plan).into_iter().enumerate() {
        for (unknown, value) in entries {
            matrix.set(velocities + row, unknown, value);
        }
        matrix.set(velocities + row, velocities + row, -compliances[row]);
    }
    matrix
}

/// Where two bodies are held by rows that forbid a motion, the determinant of these is an entry of
/// the rotation between them.
fn relate(scene: &mut Scene, kinds: &[BodyKind], plan: &Plan, matrix: &Symmetric) {
    let layout = &scene.layout;
    let body_of = |unknown: usize| layout.velocity.iter().rposition(|&first| first <= unknown);
    let mut pairs = Vec::new();
    for pivot in &plan.pivots {
        if let Pivot::Forbidden([own, _], [row, _]) = *pivot {
            let unknowns = matrix.neighbours(row).filter(|&k| k < layout.velocities);
            let own = body_of(own);
            pairs.extend(unknowns.filter_map(|other| body_of(other).zip(own)));
        }
    }
    pairs.dedup();
    for (other, own) in pairs {
        if other != own && kinds[other] == BodyKind::Rigid {
            rotation::relate(&mut scene.space, other, own);
        }
    }
}

impl System {
    /// Assembles and factorises the matrix.
    ///
    /// # Panics
    /// If the plan does not eliminate every unknown once.
    pub fn new(scene: &mut Scene, kinds: &[BodyKind], plan: Plan, terms: Terms) -> Self {
        Self::within(scene, kinds, plan, terms, usize::MAX).expect("there is no bound")
    }

    /// The same; `None` if the factors take more than so many nodes.
    pub(super) fn within(
        scene: &mut Scene,
        kinds: &[BodyKind],
        plan: Plan,
        terms: Terms,
        most: usize,
    ) -> Option<Self> {
        let compliances = compliances(scene, terms);
        scene.motion.reference.fill(ZERO);
        let described = Augmented::none(scene);
        let about_centres = assembled(scene, kinds, &plan, &compliances, &described);
        let matrix = if plan.points.iter().any(Option::is_some) {
            plan.refer(scene);
            assembled(scene, kinds, &plan, &compliances, &described)
        } else {
            about_centres.clone()
        };
        let handed_on = match terms {
            Terms::Plain | Terms::Stabilised => handed_on(scene, kinds, &plan),
            Terms::Compliant => Vec::new(),
        };
        let (to_factorise, shares) = if handed_on.is_empty() {
            (matrix.clone(), Vec::new())
        } else {
            let (augmented, masses) = Augmented::new(scene, &handed_on);
            let matrix = assembled(scene, kinds, &plan, &compliances, &augmented);
            let shares = shares(scene, &matrix, &handed_on, &masses);
            (matrix, shares)
        };
        relate(scene, kinds, &plan, &matrix);
        let arena = &mut scene.space.arena;
        let mut factors = factorise_within(
            arena,
            to_factorise,
            about_centres.clone(),
            (&plan.pivots, &plan.determinants),
            most,
        )?;
        factors.shares = shares;
        if terms == Terms::Compliant {
            // Quasi-definite: every pivot is safe.
            factors.checks.clear();
        }
        Some(Self {
            plan,
            kinds: kinds.to_vec(),
            matrix,
            about_centres,
            factors,
        })
    }

    /// What every solution needs.
    #[must_use]
    pub fn factors(&self) -> Vec<Expr> {
        self.factors.entries()
    }

    /// The kinds of the bodies.
    pub(super) fn kinds(&self) -> &[BodyKind] {
        &self.kinds
    }

    /// The pivots to be checked, with the row instead of the unknown.
    #[must_use]
    pub fn checks(&self, scene: &Scene) -> Vec<Check> {
        let row = |check: &Check| check.unknown - scene.layout.velocities;
        self.factors
            .checks
            .iter()
            .map(|check| Check {
                unknown: row(check),
                ..*check
            })
            .collect()
    }

    /// The right-hand side of the equations of motion: gravity, gyroscopic moments, `gamma*`.
    pub fn equations_of_motion(&self, scene: &mut Scene, terms: Terms) -> RightHandSide {
        let frames = &self.plan.translation;
        scene.motion.reference.fill(ZERO);
        let about_centres = forces(scene, &self.kinds, frames, false);
        self.plan.refer(scene);
        let mut right = forces(scene, &self.kinds, frames, true);
        let factors = terms.factors(&mut scene.space.arena);
        for (place, &frame) in self.plan.rows.iter().enumerate() {
            right.extend(scene.combination(place, frame, factors));
        }
        let known = (0..self.kinds.len())
            .map(|body| centripetal(scene, body))
            .collect();
        RightHandSide {
            values: right,
            about_centres,
            known,
        }
    }

    /// Solves for a given right-hand side, in the axes of the state and of the definitions.
    pub fn solve_given(&self, scene: &mut Scene) -> Solution {
        let right = self.given(scene);
        let arena = &mut scene.space.arena;
        let upper: Vec<Expr> = (0..scene.layout.velocities)
            .map(|k| arena.input(Input::Upper(k as u32)))
            .collect();
        self.solve(scene, &right, &upper, Stage::RightHandSide)
    }

    fn given(&self, scene: &mut Scene) -> RightHandSide {
        let arena = &mut scene.space.arena;
        let mut right: Vec<Expr> = (0..scene.layout.velocities)
            .map(|k| arena.input(Input::Upper(k as u32)))
            .collect();
        let mut about_centres = right.clone();
        right.extend((0..scene.layout.rows).map(|k| arena.input(Input::Lower(k as u32))));
        for (body, &frame) in self.plan.translation.iter().enumerate() {
            let first = scene.layout.velocity[body];
            let force = [0, 1, 2].map(|k| right[first + k]);
            let force = scene.space.native(Frame::Global, force);
            let components = scene.space.components(force, frame);
            right[first..first + 3].copy_from_slice(&components);
            about_centres[first..first + 3].copy_from_slice(&components);
            if self.kinds[body] == BodyKind::Rigid {
                let moment = about_reference(scene, body, force);
                for (k, moment) in moment.into_iter().enumerate() {
                    let sum = scene.space.arena.add(right[first + 3 + k], moment);
                    right[first + 3 + k] = sum;
                }
            }
        }
        self.turn_rows(scene, &mut right, true);
        let nothing = scene.space.native(Frame::Global, ZERO);
        RightHandSide {
            values: right,
            about_centres,
            known: vec![nothing; self.kinds.len()],
        }
    }

    fn turn_rows(&self, scene: &mut Scene, values: &mut [Expr], into_plan: bool) {
        for (place, &frame) in self.plan.rows.iter().enumerate() {
            let constrained = &scene.constraints[place];
            if matches!(constrained.constraint, Constraint::Vector(_)) {
                let first = scene.layout.velocities + constrained.row;
                let (from, to) = if into_plan {
                    (Frame::Global, frame)
                } else {
                    (frame, Frame::Global)
                };
                turn(scene, values, first, from, to);
            }
        }
    }

    /// The acceleration of the centre of mass of a body from that of its point of reference, and
    /// what is known of the difference.
    fn of_centre(
        &self,
        scene: &mut Scene,
        body: usize,
        accelerations: &[Expr],
        known: VectorId,
    ) -> Triple {
        let first = scene.layout.velocity[body];
        let a = [0, 1, 2].map(|k| accelerations[first + k]);
        let a = scene.space.native(self.plan.translation[body], a);
        let turning = self.turning(scene, body, accelerations);
        let space = &mut scene.space;
        let sum = space.sum([a, turning, known].map(|term| (Arena::ONE, term)));
        space.components(sum, Frame::Global)
    }

    /// What the angular acceleration of a body adds to the acceleration of its centre of mass,
    /// beyond that of the point of reference.
    fn turning(&self, scene: &mut Scene, body: usize, accelerations: &[Expr]) -> VectorId {
        let centre = scene.centre(body);
        let first = scene.layout.velocity[body] + 3;
        if centre == ZERO {
            return scene.space.native(Frame::Global, ZERO);
        }
        let frame = Frame::Body(body);
        let space = &mut scene.space;
        let w = space.native(frame, [0, 1, 2].map(|k| accelerations[first + k]));
        let (factor, along) = space.direction(centre);
        let along = space.native(frame, along);
        let turning = space.cross(frame, w, along);
        // In global axes at once, where it is asked for: otherwise plans of nearly equal cost are
        // told apart by the order of the fields.
        space.components(turning, Frame::Global);
        space.scale(factor, turning)
    }

    /// Solves for a right-hand side, with as few operations of a stage or later as possible.
    pub fn solve(
        &self,
        scene: &mut Scene,
        right: &RightHandSide,
        upper: &[Expr],
        stage: Stage,
    ) -> Solution {
        let arena = &mut scene.space.arena;
        let factors = &self.factors;
        let mut ways = vec![factors.solve(arena, right.values.clone())];
        if factors.carry() {
            ways.push(factors.solve_from_known(arena, &self.matrix, &right.values));
        }
        let mut solutions = Vec::new();
        for values in ways {
            let (centres, balanced) = self.about_centres(scene, &values, right);
            let substituted = self.finished(scene, values, &centres);
            let by_newton = self.by_newton(scene, &substituted, upper);
            let balanced = self.finished(scene, balanced, &centres);
            solutions.extend([substituted, by_newton, balanced]);
        }
        solutions.dedup();
        let arena = &scene.space.arena;
        let cheapest = solutions.into_iter().min_by_key(|solution| {
            let outputs = [&solution.accelerations[..], &solution.multipliers].concat();
            count(arena, &outputs, stage).weighted()
        });
        cheapest.expect("there is a way")
    }

    /// The accelerations of the centres of mass in global axes; and, in the axes of the plan, the
    /// solution about centres of mass with multipliers by the balance of forces.
    fn about_centres(
        &self,
        scene: &mut Scene,
        values: &[Expr],
        right: &RightHandSide,
    ) -> (Vec<Triple>, Vec<Expr>) {
        let mut about_centres = values.to_vec();
        let mut centres = Vec::new();
        for (body, &frame) in self.plan.translation.iter().enumerate() {
            let first = scene.layout.velocity[body];
            if self.plan.points[body].is_none() {
                let known = [0, 1, 2].map(|k| values[first + k]);
                centres.push(scene.space.turn(known, frame, Frame::Global));
                continue;
            }
            let global = self.of_centre(scene, body, values, right.known[body]);
            let vector = scene.space.native(Frame::Global, global);
            let components = scene.space.components(vector, frame);
            about_centres[first..first + 3].copy_from_slice(&components);
            centres.push(global);
        }
        let (arena, matrix) = (&mut scene.space.arena, &self.about_centres);
        let factors = &self.factors;
        factors.balance(arena, matrix, &right.about_centres, &mut about_centres);
        (centres, about_centres)
    }

    /// A solution in the axes of the state and of the definitions.
    fn finished(&self, scene: &mut Scene, mut values: Vec<Expr>, centres: &[Triple]) -> Solution {
        self.turn_rows(scene, &mut values, false);
        let multipliers = values.split_off(scene.layout.velocities);
        for (&first, centre) in scene.layout.velocity.iter().zip(centres) {
            values[first..first + 3].copy_from_slice(centre);
        }
        Solution {
            accelerations: values,
            multipliers,
        }
    }

    /// The same with accelerations of centres of mass by Newton's law where the plan has others.
    fn by_newton(&self, scene: &mut Scene, solution: &Solution, upper: &[Expr]) -> Solution {
        let mut solution = solution.clone();
        for (body, &frame) in self.plan.translation.iter().enumerate() {
            if frame == Frame::Global && self.plan.points[body].is_none() {
                continue;
            }
            let first = scene.layout.velocity[body];
            let force: Triple = [0, 1, 2].map(|k| upper[first + k]);
            let mass = scene.mass[body];
            let gradients = self.forces_on(scene, body);
            let arena = &mut scene.space.arena;
            let global = newton(arena, mass, force, &gradients, &solution.multipliers);
            solution.accelerations[first..first + 3].copy_from_slice(&global);
        }
        solution
    }

    /// The rows of `D` for the translation of a body, global axes.
    fn forces_on(&self, scene: &mut Scene, body: usize) -> Vec<(usize, Triple)> {
        let mut forces = Vec::new();
        for place in 0..self.plan.rows.len() {
            let row = scene.constraints[place].row;
            for (k, gradient) in scene
                .gradients(place, Frame::Global)
                .into_iter()
                .enumerate()
            {
                let force = gradient.force(&mut scene.space, body);
                if !scene.space.is_zero(force) {
                    forces.push((row + k, scene.space.components(force, Frame::Global)));
                }
            }
        }
        // Not in the order of the fields, but in that in which multipliers become known.
        let velocities = scene.layout.velocities;
        let eliminated: Vec<usize> = self.plan.pivots.iter().flat_map(|p| p.unknowns()).collect();
        forces.sort_by_key(|(row, _)| {
            let place = eliminated.iter().position(|k| *k == velocities + row);
            std::cmp::Reverse(place)
        });
        forces
    }
}

/// The compliance of every row. The rows of a vector constraint have one, so that it is the same in
/// any axes.
fn compliances(scene: &mut Scene, terms: Terms) -> Vec<Expr> {
    let rows = scene.constraints.iter();
    let places = rows.flat_map(|constrained| vec![constrained.row; constrained.equations()]);
    let places: Vec<usize> = places.collect();
    let compliance = |row: usize| match terms {
        Terms::Compliant => scene.space.arena.input(Input::Compliance(row as u32)),
        Terms::Plain | Terms::Stabilised => Arena::ZERO,
    };
    places.into_iter().map(compliance).collect()
}

/// `r'' = (F - D^T lambda) / m`.
fn newton(
    arena: &mut Arena,
    mass: Expr,
    force: Triple,
    rows: &[(usize, Triple)],
    multipliers: &[Expr],
) -> Triple {
    let inverse = arena.reciprocal(mass);
    [0, 1, 2].map(|k| {
        let mut reaction = Arena::ZERO;
        for (row, direction) in rows {
            let product = arena.mul(direction[k], multipliers[*row]);
            reaction = arena.add(reaction, product);
        }
        let free = arena.mul(force[k], inverse);
        let constrained = arena.mul(reaction, inverse);
        arena.sub(free, constrained)
    })
}

fn turn(scene: &mut Scene, values: &mut [Expr], first: usize, from: Frame, to: Frame) {
    let components = [0, 1, 2].map(|k| values[first + k]);
    let turned = scene.space.turn(components, from, to);
    values[first..first + 3].copy_from_slice(&turned);
}

/// `w x (w x c)` of the centre of mass from the point of reference.
fn centripetal(scene: &mut Scene, body: usize) -> VectorId {
    let (w, centre) = (scene.motion.spin_components[body], scene.centre(body));
    scene.space.spun(body, w, centre)
}

/// The moment of a force at the centre of mass about the point of reference, principal axes.
fn about_reference(scene: &mut Scene, body: usize, force: VectorId) -> Triple {
    let frame = Frame::Body(body);
    let centre = scene.centre(body);
    let centre = scene.space.native(frame, centre);
    let moment = scene.space.cross(frame, centre, force);
    scene.space.components(moment, frame)
}

/// `g`: gravity and forces of the language in global axes; moments, the gyroscopic among them, in
/// principal axes.
pub fn applied_forces(scene: &mut Scene, kinds: &[BodyKind]) -> Vec<Expr> {
    forces(scene, kinds, &vec![Frame::Global; kinds.len()], false)
}

/// `g` with forces in given axes and moments about the points of reference; if wished, with what
/// the accelerations of centres of mass take that those of the points of reference do not have.
fn forces(scene: &mut Scene, kinds: &[BodyKind], frames: &[Frame], inertial: bool) -> Vec<Expr> {
    let applied = scene.applied();
    let mut forces = Vec::new();
    for (body, (kind, &frame)) in kinds.iter().zip(frames).enumerate() {
        let gravity = scene.space.native(Frame::Global, scene.gravity);
        let weight = scene.space.scale(scene.mass[body], gravity);
        let known = centripetal(scene, body);
        let factor = if inertial {
            -scene.mass[body]
        } else {
            Arena::ZERO
        };
        let known = scene.space.scale(factor, known);
        let force = applied.force(&mut scene.space, body);
        let [weight, known, force] =
            [weight, known, force].map(|term| scene.space.components(term, frame));
        forces.extend([0, 1, 2].map(|k| {
            let arena = &mut scene.space.arena;
            let sum = arena.add(weight[k], force[k]);
            arena.add(sum, known[k])
        }));
        if *kind == BodyKind::Rigid {
            let gyroscopic = scene.gyroscopic_moment(body);
            let weight = scene.space.scale(scene.mass[body], gravity);
            let weight = about_reference(scene, body, weight);
            let moment = applied.moment(&mut scene.space, body);
            let moment = scene.space.components(moment, Frame::Body(body));
            forces.extend([0, 1, 2].map(|k| {
                let arena = &mut scene.space.arena;
                let sum = arena.add(gyroscopic[k], moment[k]);
                arena.add(sum, weight[k])
            }));
        }
    }
    forces
}
