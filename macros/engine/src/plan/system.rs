//! The saddle system of a scene in the axes of a plan, and its solution back in the axes of the state.

use super::Plan;
use super::eliminate::{Check, Factors, Symmetric, factorise};
use crate::model::BodyKind;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::count::count;
use crate::symbolic::scene::{Constraint, Scene};
use crate::symbolic::vector::{Frame, Triple};

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
#[derive(Clone, Debug)]
pub struct Solution {
    /// `u'`: translation in global axes, rotation in principal axes.
    pub accelerations: Vec<Expr>,
    /// `lambda`, rows in the axes of their definition.
    pub multipliers: Vec<Expr>,
}

impl Solution {
    /// The operations that it takes, of a stage or later.
    fn operations(&self, arena: &Arena, stage: Stage) -> usize {
        let outputs = [&self.accelerations[..], &self.multipliers].concat();
        count(arena, &outputs, stage).total()
    }
}

/// The right-hand side, in the axes of the plan.
#[derive(Clone, Debug)]
pub struct RightHandSide(Vec<Expr>);

/// The factorised system of a scene.
#[derive(Clone, Debug)]
pub struct System {
    plan: Plan,
    kinds: Vec<BodyKind>,
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

impl System {
    /// Assembles and factorises the matrix.
    pub fn new(scene: &mut Scene, kinds: &[BodyKind], plan: Plan, terms: Terms) -> Self {
        let (velocities, rows) = (scene.layout.velocities, scene.layout.rows);
        let mut matrix = Symmetric::new(velocities + rows);
        for (body, kind) in kinds.iter().enumerate() {
            let first = scene.layout.velocity[body];
            for k in 0..3 {
                matrix.set(first + k, first + k, scene.mass[body]);
                if *kind == BodyKind::Rigid {
                    matrix.set(first + 3 + k, first + 3 + k, scene.inertia[body][k]);
                }
            }
        }
        let compliances = compliances(scene, terms);
        for (row, entries) in coupling(scene, kinds, &plan).into_iter().enumerate() {
            for (unknown, value) in entries {
                matrix.set(velocities + row, unknown, value);
            }
            matrix.set(velocities + row, velocities + row, -compliances[row]);
        }
        let arena = &mut scene.space.arena;
        let mut factors = factorise(arena, matrix, &plan.pivots, &plan.determinants);
        if terms == Terms::Compliant {
            // Quasi-definite: every pivot is safe.
            factors.checks.clear();
        }
        Self {
            plan,
            kinds: kinds.to_vec(),
            factors,
        }
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
        let mut right = forces(scene, &self.kinds, &self.plan.translation);
        let factors = terms.factors(&mut scene.space.arena);
        for (place, &frame) in self.plan.rows.iter().enumerate() {
            right.extend(scene.combination(place, frame, factors));
        }
        RightHandSide(right)
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
        right.extend((0..scene.layout.rows).map(|k| arena.input(Input::Lower(k as u32))));
        for (body, &frame) in self.plan.translation.iter().enumerate() {
            turn(
                scene,
                &mut right,
                scene.layout.velocity[body],
                Frame::Global,
                frame,
            );
        }
        self.turn_rows(scene, &mut right, true);
        RightHandSide(right)
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

    /// Solves for a right-hand side, with as few operations of a stage or later as possible.
    pub fn solve(
        &self,
        scene: &mut Scene,
        right: &RightHandSide,
        upper: &[Expr],
        stage: Stage,
    ) -> Solution {
        let mut values = self.factors.solve(&mut scene.space.arena, right.0.clone());
        self.turn_rows(scene, &mut values, false);
        let multipliers = values.split_off(scene.layout.velocities);
        let mut solution = Solution {
            accelerations: values,
            multipliers,
        };
        let mut by_newton = Vec::new();
        for (body, &frame) in self.plan.translation.iter().enumerate() {
            if frame == Frame::Global {
                continue;
            }
            let first = scene.layout.velocity[body];
            let force: Triple = [0, 1, 2].map(|k| upper[first + k]);
            let mass = scene.mass[body];
            let gradients = self.forces_on(scene, body);
            let arena = &mut scene.space.arena;
            let global = newton(arena, mass, force, &gradients, &solution.multipliers);
            by_newton.push((first, global));
            let accelerations = &mut solution.accelerations;
            turn(scene, accelerations, first, frame, Frame::Global);
        }
        // Whether the accelerations along the axes of the plan are needed at all shows in the whole only.
        let mut least = solution.operations(&scene.space.arena, stage);
        for (first, global) in by_newton {
            let mut other = solution.clone();
            other.accelerations[first..first + 3].copy_from_slice(&global);
            let operations = other.operations(&scene.space.arena, stage);
            if operations < least {
                (solution, least) = (other, operations);
            }
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

/// The compliance of every row. The rows of a vector constraint have one, so that it is the same in any axes.
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

/// `g`: gravity and forces of the language in global axes; moments, the gyroscopic among them, in principal axes.
pub fn applied_forces(scene: &mut Scene, kinds: &[BodyKind]) -> Vec<Expr> {
    forces(scene, kinds, &vec![Frame::Global; kinds.len()])
}

/// `g` with forces in given axes.
fn forces(scene: &mut Scene, kinds: &[BodyKind], frames: &[Frame]) -> Vec<Expr> {
    let applied = scene.applied();
    let mut forces = Vec::new();
    for (body, (kind, &frame)) in kinds.iter().zip(frames).enumerate() {
        let gravity = scene.space.native(Frame::Global, scene.gravity);
        let gravity = scene.space.components(gravity, frame);
        let weight = gravity.map(|g| scene.space.arena.mul(scene.mass[body], g));
        let force = applied.force(&mut scene.space, body);
        let force = scene.space.components(force, frame);
        forces.extend([0, 1, 2].map(|k| scene.space.arena.add(weight[k], force[k])));
        if *kind == BodyKind::Rigid {
            let gyroscopic = scene.gyroscopic_moment(body);
            let moment = applied.moment(&mut scene.space, body);
            let moment = scene.space.components(moment, Frame::Body(body));
            forces.extend([0, 1, 2].map(|k| scene.space.arena.add(gyroscopic[k], moment[k])));
        }
    }
    forces
}
