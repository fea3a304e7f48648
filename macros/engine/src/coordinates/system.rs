//! The equations of motion in joint coordinates: `[M D^T; D -E] (u', lambda) = (forces, gamma*)`.

use super::algebra::{add, apply};
use super::beginning::Beginning;
use super::candidates::{Method, Strategy};
use super::dependent::{Led, dependent};
use super::elimination::{Elimination, Solution};
use super::frames::Frames;
use super::handover::Handover;
use super::kinematics::Kinematics;
use super::links::{Links, Runs};
use super::origins::ToGround;
use super::wrenches::{Wrench, inertial};
use crate::model::{BodyKind, Model};
use crate::plan::Pivot;
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::fixed::{clean, size, transpose};
use crate::symbolic::motion::Gradient;
use crate::symbolic::scene::{Chart, Scene};
use crate::symbolic::vector::{Frame, ZERO, cross, dot};

/// A mechanism in joint coordinates, in symbols.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The links.
    pub links: Links,
    /// The bodies as functions of joint coordinates, forces, and the equations that remain.
    pub scene: Scene,
    /// Of the bodies.
    pub charts: Vec<Chart>,
    /// The equations of each joint that are left out, of those that remain.
    pub dropped: Vec<Vec<usize>>,
    /// How they are solved.
    pub(super) strategy: Strategy,
    /// The links with masses handed over closing joints.
    counted: Option<(Links, Vec<Handover>)>,
    /// What is eliminated before the rest where rows have no compliance, and the determinants in
    /// the reference configuration.
    pub(super) together: (Vec<Pivot>, Vec<f64>),
    /// What recorded pivots are compared with, row by row, where it is known.
    pub(super) references: Vec<Option<f64>>,
}

impl Reduced {
    /// A mechanism in the coordinates of its joints.
    #[must_use]
    pub fn of(model: &Model, strategy: Strategy) -> Self {
        Self::from_beginning(&Beginning::new(model), strategy, Led::WhereItVanishes)
    }

    /// The same of a mechanism of which something is known already.
    pub(super) fn from_beginning(beginning: &Beginning<'_>, strategy: Strategy, led: Led) -> Self {
        let Beginning {
            model, spanning, ..
        } = beginning;
        let mut arena = Arena::new();
        let mut links = Links::new(&mut arena, model, spanning, strategy.runs);
        if strategy.runs == Runs::Shared {
            links.share_axes();
        }
        let mut whole = links.clone();
        links.regroup(&mut arena, &mut []);
        let mut remaining = spanning.remaining(model);
        let mut reduced = Self::new(arena.clone(), &remaining, links.clone(), strategy);
        // Nothing can be done about these, and where they hold nothing need be.
        let mut left_out = reduced.empty_rows(&remaining);
        let rows = remaining.layout().rows - left_out.len();
        if spanning
            .independent(model)
            .is_some_and(|wanted| wanted < rows)
        {
            left_out.extend(beginning.following());
        }
        if !left_out.is_empty() {
            for (joint, row) in left_out {
                let dropped = &mut remaining.joints[joint].dropped;
                if !dropped.contains(&row) {
                    dropped.push(row);
                    dropped.sort_unstable();
                }
            }
            reduced = Self::new(arena, &remaining, links, strategy);
        }
        if strategy.method == Method::Dependent && !reduced.scene.constraints.is_empty() {
            reduced.together = reduced.clone().taken_together((beginning, led));
        }
        if !reduced.together.0.is_empty() {
            let mut handovers = reduced.handovers(model);
            let arena = &mut reduced.scene.space.arena;
            whole.regroup(arena, &mut handovers);
            handovers.retain(|handover| handover.mass != Arena::ZERO);
            reduced.counted = (!handovers.is_empty()).then_some((whole, handovers));
        }
        for &joint in &spanning.closing {
            reduced.dropped[joint].clone_from(&remaining.joints[joint].dropped);
        }
        reduced
    }

    /// The velocities that rows determine, with these, and their determinants.
    fn taken_together(mut self, beginning: (&Beginning<'_>, Led)) -> (Vec<Pivot>, Vec<f64>) {
        let (rows, _) = self.rows(Terms::Plain);
        let mobilities = self.mobilities();
        let constraints = self.scene.constraints.iter();
        let joints: Vec<usize> = constraints
            .flat_map(|c| std::iter::repeat_n(c.joint, c.equations()))
            .collect();
        let rows = (&rows[..], &mobilities[..], &joints[..]);
        dependent(&self.scene.space.arena, rows, &self.links, beginning)
    }

    /// The equations, by joint and place, that no velocity changes.
    fn empty_rows(&mut self, model: &Model) -> Vec<(usize, usize)> {
        let mut empty = Vec::new();
        let (rows, _) = self.rows(Terms::Plain);
        for constrained in &self.scene.constraints {
            let joint = constrained.joint;
            let of_joint = &model.joints[joint];
            let count = model.definition(of_joint).equations();
            let mut kept = (0..count).filter(|row| !of_joint.dropped.contains(row));
            let first = constrained.row - self.scene.layout.row[joint];
            let own = rows[constrained.row..].iter().take(constrained.equations());
            for (entries, row) in own.zip(kept.by_ref().skip(first)) {
                if entries.iter().all(|&entry| entry == Arena::ZERO) {
                    empty.push((joint, row));
                }
            }
        }
        empty
    }

    /// A mechanism whose joints of the tree have no equations any more.
    #[must_use]
    pub fn new(mut arena: Arena, model: &Model, links: Links, strategy: Strategy) -> Self {
        let motion = Kinematics::new(&mut arena, &links, ZERO);
        let charts = charts(&mut arena, model, &links, &motion, &ToGround::Stepwise);
        let first_counter = 2 * links.turns + links.rest;
        let known = |arena: &mut Arena, bodies, axis| links.angle(arena, bodies, axis);
        let mut scene = Scene::on(model, arena, &charts, first_counter, false, &known);
        // Forces on bodies count at the origins of links. A particle has no axes for the arm.
        for (body, standing) in links.bodies.iter().enumerate() {
            if model.bodies[body].kind == BodyKind::Particle {
                continue;
            }
            let into = transpose(standing.axes);
            let arm = apply(&mut scene.space.arena, into, standing.centre);
            let scale = size(&scene.space.arena, standing.centre);
            let arm = clean(&mut scene.space.arena, arm, scale);
            scene.motion.reference[body] = arm.map(|component| -component);
        }
        Self {
            links,
            scene,
            charts,
            dropped: vec![Vec::new(); model.joints.len()],
            strategy,
            counted: None,
            together: (Vec::new(), Vec::new()),
            references: Vec::new(),
        }
    }

    /// How many times velocities are eliminated with the rows that determine them.
    pub(super) fn together_count(&self) -> usize {
        self.together.0.len()
    }

    /// How many masses are counted on another link, where all rows that remain determine
    /// velocities.
    #[must_use]
    pub fn handed_over(&self) -> usize {
        let counted = self.counted.as_ref();
        counted.map_or(0, |(_, handovers)| handovers.len())
    }

    /// The wrenches on the links of forces and moments on the bodies.
    pub(super) fn wrenches(&mut self, gradient: &Gradient) -> Vec<Wrench> {
        let Self { links, scene, .. } = self;
        let mut wrenches = vec![Wrench::NONE; links.links.len()];
        for (body, standing) in links.bodies.iter().enumerate() {
            let Some(link) = standing.link else { continue };
            let force = gradient.force(&mut scene.space, body);
            let moment = gradient.moment(&mut scene.space, body);
            let force = scene.space.components(force, Frame::Global);
            let is_particle = scene.space.rotation(body).is_none();
            let moment = if is_particle {
                ZERO
            } else {
                scene.space.components(moment, Frame::Body(body))
            };
            let arena = &mut scene.space.arena;
            let axes = links.axes(Some(link));
            let force = links.frames.turn(arena, force, Frames::GROUND, axes);
            let moment = apply(arena, standing.axes, moment);
            let mut moment = links.in_axes(arena, moment, Some(link));
            if is_particle {
                let centre = links.in_axes(arena, standing.centre, Some(link));
                moment = cross(arena, centre, force);
            }
            wrenches[link] = wrenches[link].plus(arena, Wrench { force, moment });
        }
        wrenches
    }

    /// Gravity, forces of the language and what the motion of links takes, as wrenches on the
    /// links, and efforts along the velocities.
    fn forces(&mut self, links: &Links) -> (Vec<Wrench>, Vec<Expr>) {
        let applied = self.scene.applied();
        let wrenches = self.wrenches(&applied);
        let motion = self.falling();
        let arena = &mut self.scene.space.arena;
        let taken: Vec<Wrench> = (0..links.links.len())
            .map(|link| {
                let taken = inertial(arena, links, &motion, link).opposite();
                taken.plus(arena, wrenches[link])
            })
            .collect();
        let mut efforts = vec![Arena::ZERO; links.velocities];
        applied.add_along(arena, &mut efforts);
        (taken, efforts)
    }

    /// The motion on a ground that accelerates against gravity.
    fn falling(&mut self) -> Kinematics {
        let gravity = self.scene.gravity;
        let arena = &mut self.scene.space.arena;
        Kinematics::new(arena, &self.links, gravity.map(|component| -component))
    }

    /// The rows that remain: `D` along the velocities, and `gamma*`.
    pub(super) fn rows(&mut self, terms: Terms) -> (Vec<Vec<Expr>>, Vec<Expr>) {
        let arena = &mut self.scene.space.arena;
        let factors = terms.factors(arena);
        let motion = Kinematics::new(arena, &self.links, ZERO);
        let (mut rows, mut right) = (Vec::new(), Vec::new());
        for place in 0..self.scene.constraints.len() {
            let wanted = self.scene.combination(place, Frame::Global, factors);
            let gradients = self.scene.gradients(place, Frame::Global);
            for (gradient, wanted) in gradients.into_iter().zip(wanted) {
                let wrenches = self.wrenches(&gradient);
                let known = self.known(&motion, &gradient);
                let arena = &mut self.scene.space.arena;
                right.push(arena.sub(wanted, known));
                let mut row = self.links.project(arena, wrenches);
                gradient.add_along(arena, &mut row);
                rows.push(row);
            }
        }
        (rows, right)
    }

    /// What accelerations of bodies without second rates contribute to a row.
    fn known(&mut self, motion: &Kinematics, gradient: &Gradient) -> Expr {
        let Self { links, scene, .. } = self;
        let mut sum = Arena::ZERO;
        for (body, standing) in links.bodies.iter().enumerate() {
            let Some(link) = standing.link else { continue };
            let force = gradient.force(&mut scene.space, body);
            let moment = gradient.moment(&mut scene.space, body);
            let axes = links.axes(Some(link));
            if !scene.space.is_zero(force) {
                let force = scene.space.components(force, Frame::Global);
                let is_particle = scene.space.rotation(body).is_none();
                let arena = &mut scene.space.arena;
                let force = links.frames.turn(arena, force, Frames::GROUND, axes);
                let mut acceleration = motion.bias[link];
                if is_particle {
                    let centre = links.in_axes(arena, standing.centre, Some(link));
                    let bend = apply(arena, motion.second[link], centre);
                    acceleration = add(arena, acceleration, bend);
                }
                let term = dot(arena, force, acceleration);
                sum = arena.add(sum, term);
            }
            if !scene.space.is_zero(moment) && motion.spin_bias[link] != ZERO {
                let moment = scene.space.components(moment, Frame::Body(body));
                let arena = &mut scene.space.arena;
                let moment = apply(arena, standing.axes, moment);
                let moment = links.in_axes(arena, moment, Some(link));
                let term = dot(arena, moment, motion.spin_bias[link]);
                sum = arena.add(sum, term);
            }
        }
        sum
    }

    /// Rates of the velocities, and multipliers.
    pub fn solve(&mut self, terms: Terms) -> Solution {
        self.solve_with(terms, &[])
    }

    /// The same with efforts along the velocities beside the described forces.
    pub(super) fn solve_with(&mut self, terms: Terms, beside: &[Expr]) -> Solution {
        let (rows, gamma) = self.rows(terms);
        let elimination = self.elimination(terms, &rows);
        let (links, handovers) = self.counted(&elimination);
        let (wrenches, mut efforts) = self.forces(&links);
        let arena = &mut self.scene.space.arena;
        for (effort, &beside) in efforts.iter_mut().zip(beside) {
            *effort = arena.add(*effort, beside);
        }
        if self.strategy.method == Method::Articulated && rows.is_empty() {
            return Solution {
                accelerations: links.articulated(arena, &wrenches, &efforts),
                multipliers: Vec::new(),
                checks: Vec::new(),
            };
        }
        let mut forces = links.project(arena, wrenches);
        for (force, &effort) in forces.iter_mut().zip(&efforts) {
            *force = arena.add(*force, effort);
        }
        let extra = self.stabilisation(terms);
        let arena = &mut self.scene.space.arena;
        for handover in &handovers {
            handover.correct(arena, &links, &extra, &mut forces);
        }
        let mut solution = elimination.solve(arena, &links, &rows, forces, gamma);
        if !handovers.is_empty() {
            let motion = self.falling();
            let arena = &mut self.scene.space.arena;
            for handover in &handovers {
                handover.multipliers(arena, &links, Some(&motion), &extra, &mut solution);
            }
        }
        solution
    }

    /// What forces and moments on the bodies and right-hand sides of the rows, both given when the
    /// system is solved, make of rates and multipliers.
    pub fn solve_given(&mut self, terms: Terms) -> Solution {
        let (rows, _) = self.rows(terms);
        let elimination = self.elimination(terms, &rows);
        let (links, handovers) = self.counted(&elimination);
        let wrenches = self.given();
        let arena = &mut self.scene.space.arena;
        let lower = (0..rows.len()).map(|row| arena.input(Input::Lower(row as u32)));
        let lower: Vec<Expr> = lower.collect();
        if self.strategy.method == Method::Articulated && rows.is_empty() {
            let efforts = vec![Arena::ZERO; links.velocities];
            return Solution {
                accelerations: links.articulated(arena, &wrenches, &efforts),
                multipliers: Vec::new(),
                checks: Vec::new(),
            };
        }
        let mut forces = links.project(arena, wrenches);
        for handover in &handovers {
            handover.correct(arena, &links, &lower, &mut forces);
        }
        let mut solution = elimination.solve(arena, &links, &rows, forces, lower.clone());
        for handover in &handovers {
            handover.multipliers(arena, &links, None, &lower, &mut solution);
        }
        solution
    }

    /// The links as their masses are counted, and the masses that are handed over: where all rows
    /// determine velocities.
    fn counted(&self, elimination: &Elimination) -> (Links, Vec<Handover>) {
        match &self.counted {
            Some((links, handovers)) if elimination.is_determined => {
                (links.clone(), handovers.clone())
            }
            _ => (self.links.clone(), Vec::new()),
        }
    }

    /// What is wanted of the rows beside that they hold: terms of stabilisation.
    fn stabilisation(&mut self, terms: Terms) -> Vec<Expr> {
        let [value, rate, _] = terms.factors(&mut self.scene.space.arena);
        let mut wanted = Vec::new();
        for place in 0..self.scene.constraints.len() {
            let factors = [value, rate, Arena::ZERO];
            wanted.extend(self.scene.combination(place, Frame::Global, factors));
        }
        wanted
    }

    /// The wrenches on the links of given forces (global axes) and moments about centres of mass
    /// (principal axes), which stand as the velocities of the bodies do.
    fn given(&mut self) -> Vec<Wrench> {
        let Self { links, scene, .. } = self;
        let mut wrenches = vec![Wrench::NONE; links.links.len()];
        for (body, standing) in links.bodies.iter().enumerate() {
            let Some(link) = standing.link else { continue };
            let is_rigid = scene.space.rotation(body).is_some();
            let first = scene.layout.velocity[body];
            let arena = &mut scene.space.arena;
            let mut at = |k: usize| arena.input(Input::Upper((first + k) as u32));
            let force = [0, 1, 2].map(&mut at);
            let moment = if is_rigid {
                [3, 4, 5].map(&mut at)
            } else {
                ZERO
            };
            let force = links
                .frames
                .turn(arena, force, Frames::GROUND, links.axes(Some(link)));
            let moment = apply(arena, standing.axes, moment);
            let moment = links.in_axes(arena, moment, Some(link));
            let centre = links.in_axes(arena, standing.centre, Some(link));
            let by_arm = cross(arena, centre, force);
            let moment = add(arena, moment, by_arm);
            wrenches[link] = wrenches[link].plus(arena, Wrench { force, moment });
        }
        wrenches
    }

    /// Whether every row determines a velocity where rows have no compliance.
    #[must_use]
    pub fn determines(&self) -> bool {
        let taken = self.together.0.iter().flat_map(|pivot| pivot.unknowns());
        taken.filter(|&k| k >= self.links.velocities).count() == self.scene.layout.rows
    }
}

impl Reduced {
    /// The order in which velocities and multipliers are eliminated.
    pub(super) fn elimination(&self, terms: Terms, rows: &[Vec<Expr>]) -> Elimination {
        let velocities = self.links.velocities;
        let (together, determinants) = if terms == Terms::Compliant {
            (Vec::new(), Vec::new())
        } else {
            self.together.clone()
        };
        // Leaves that close no loop, then what their rows determine, then the rest.
        let closing: Vec<usize> = (0..velocities)
            .filter(|&k| rows.iter().any(|row| row[k] != Arena::ZERO))
            .collect();
        let is_leaf = |k: &usize| closing.last().is_none_or(|last| k > last);
        let done: Vec<usize> = together.iter().flat_map(|pivot| pivot.unknowns()).collect();
        let accelerations = (0..velocities).rev().filter(|k| !done.contains(k));
        let (leaves, rest): (Vec<usize>, Vec<usize>) = accelerations.partition(is_leaf);
        let behind = (velocities..velocities + rows.len()).filter(|row| !done.contains(row));
        let behind: Vec<usize> = behind.collect();
        let leaves = leaves.into_iter().map(Pivot::Acceleration);
        Elimination {
            is_determined: behind.is_empty(),
            pivots: leaves
                .chain(together.iter().copied())
                .chain(rest.into_iter().map(Pivot::Acceleration))
                .chain(behind.into_iter().map(Pivot::Multiplier))
                .collect(),
            determinants,
            is_compliant: terms == Terms::Compliant,
        }
    }
}

impl Reduced {
    /// The bodies by the rotations of all frames, over an arena that knows them by steps.
    pub(super) fn charts_by_rotations(&self, arena: &mut Arena, model: &Model) -> Vec<Chart> {
        let motion = Kinematics::new(arena, &self.links, ZERO);
        let rotations = self.links.frames.rotations(arena);
        charts(
            arena,
            model,
            &self.links,
            &motion,
            &ToGround::ByRotations(rotations),
        )
    }
}

/// The bodies as functions of joint coordinates.
fn charts(
    arena: &mut Arena,
    model: &Model,
    links: &Links,
    motion: &Kinematics,
    way: &ToGround,
) -> Vec<Chart> {
    let origins = links.origins_in_global_axes(arena, way);
    let bodies = model.bodies.iter().zip(&links.bodies);
    bodies
        .map(|(body, standing)| {
            let link = standing.link;
            let axes = links.axes(link);
            let frame = link.map_or(Frames::GROUND, |link| links.links[link].frame);
            let centre = links.in_axes(arena, standing.centre, link);
            let arm = way.turn(arena, links, centre, axes);
            let position = add(arena, link.map_or(ZERO, |link| origins[link]), arm);
            let mut chart = Chart {
                position,
                velocity: ZERO,
                spin: ZERO,
                rotation: None,
                orientation: None,
            };
            if let Some(link) = link {
                let sweep = cross(arena, motion.spin[link], centre);
                let velocity = add(arena, motion.velocity[link], sweep);
                chart.velocity = way.turn(arena, links, velocity, axes);
            }
            if body.kind == BodyKind::Rigid {
                let columns =
                    transpose(standing.axes).map(|column| way.turn(arena, links, column, frame));
                chart.rotation = Some(transpose(columns));
                if let Some(link) = link {
                    let spin = links.frames.turn(arena, motion.spin[link], axes, frame);
                    let into = transpose(standing.axes);
                    chart.spin = apply(arena, into, spin);
                }
            }
            chart
        })
        .collect()
}
