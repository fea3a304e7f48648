//! Masses handed over closing joints.
//!
//! Where rows hold a point of one link on a point of another, both have one acceleration, and a
//! mass there may be counted on either. What becomes simpler by it is a link that turns: with the
//! right mass at its closing point counted on the other link, its centre of mass lies on its axis,
//! and it no longer couples the motions of those that carry it. A coupler is two masses at its pins
//! and a moment of inertia.
//!
//! With `P` and `Q` for the velocities of the point on both links, `D = P - Q` are the rows,
//! whatever their violation, and `P^T F = Q^T F + D^T F`: so the rates are those of the mechanism
//! as it is, and its multipliers differ by the force `F = m (a - g)` that the mass takes. Rows with
//! a compliance do not hold the points together.

use super::algebra::{Inertia, add, apply};
use super::elimination::Solution;
use super::frames::Frames;
use super::freedom::Freedom;
use super::kinematics::Kinematics;
use super::links::Links;
use super::system::Reduced;
use super::wrenches::Wrench;
use crate::model::{Binding, Model, ParameterKind};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::vector::{Frame, Triple, ZERO, cross, dot};

/// What vanishes is smaller than this, beside what it is a difference of.
const ROUND_OFF: f64 = 1e-11;

/// A mass is handed over up to this multiple of the link's own: a pin that is near to the axis
/// would take a large one, and round-off with it.
const MOST: f64 = 10.0;

/// A mass at a point of a closing joint.
#[derive(Clone, Debug)]
pub(super) struct Handover {
    /// The link whose mass it is.
    pub(super) giver: usize,
    /// The point in that link's frame.
    from: Triple,
    /// The component of the link's first moment that vanishes.
    component: usize,
    /// The link on which it is counted, `None` for the ground.
    receiver: Option<usize>,
    /// The point in that link's frame.
    onto: Triple,
    /// The rows that hold the points together, each with the direction (global axes) along which.
    rows: Vec<(usize, Triple)>,
    /// The mass.
    pub(super) mass: Expr,
}

/// A random state off the constraints, pairs and Euler parameters of length 1.
fn anywhere(links: &Links, input: Input, seed: usize) -> Option<f64> {
    /// Multiples of the golden ratio have no pattern.
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let number = |place: usize| ((place + 1 + 97 * seed) as f64 * GOLDEN).fract();
    match input {
        Input::Coordinate(place) if (place as usize) < 2 * links.turns => {
            let (sine, cosine) = (7.0 * number(place as usize / 2)).sin_cos();
            Some(if place % 2 == 0 { cosine } else { sine })
        }
        Input::Coordinate(place) => Some(number(place as usize) - 0.4),
        Input::Velocity(place) => Some(number(place as usize + 13) - 0.6),
        Input::Symbol(place) | Input::Varying(place) => Some(number(place as usize + 29) + 0.5),
        Input::Time => Some(number(41)),
        _ => None,
    }
}

impl Reduced {
    /// The points of closing joints over which a mass can be handed; none yet.
    pub(super) fn handovers(&mut self, model: &Model) -> Vec<Handover> {
        let mut handovers = Vec::new();
        if self.scene.constraints.is_empty() {
            return handovers;
        }
        let (rows, right) = self.rows(Terms::Plain);
        let mut joints: Vec<usize> = self.scene.constraints.iter().map(|c| c.joint).collect();
        joints.sort_unstable();
        joints.dedup();
        for joint in joints {
            let [a, b] = model.joints[joint].bodies[..] else {
                continue;
            };
            let link = |body: Option<usize>| body.and_then(|body| self.links.bodies[body].link);
            // What stands further from the ground gives.
            let (giver, receiver) = if link(a) > link(b) { (a, b) } else { (b, a) };
            let Some(giving) = link(giver).filter(|_| link(a) != link(b)) else {
                continue;
            };
            let Freedom::Turn { axis, .. } = self.links.links[giving].freedom else {
                continue;
            };
            let receiving = link(receiver);
            let held = self.held(joint, giver);
            for (parameter, binding) in model
                .definition(&model.joints[joint])
                .parameters
                .iter()
                .zip(&model.joints[joint].bindings)
            {
                let (ParameterKind::Point, Binding::Global(point)) = (parameter.kind, binding)
                else {
                    continue;
                };
                let arena = &mut self.scene.space.arena;
                let from = self.links.point_on(arena, model, giver, *point);
                let onto = self.links.point_on(arena, model, receiver, *point);
                let across = [(axis + 1) % 3, (axis + 2) % 3].into_iter();
                let across: Vec<usize> = across.filter(|&k| from[k] != Arena::ZERO).collect();
                let &[component] = &across[..] else { continue };
                let handover = Handover {
                    giver: giving,
                    from,
                    component,
                    receiver: receiving,
                    onto,
                    rows: held.clone(),
                    mass: Arena::ZERO,
                };
                if self.hold_together(&handover, &rows, &right) {
                    handovers.push(handover);
                    break;
                }
            }
        }
        handovers
    }

    /// The rows of a joint that move a body along a direction that is known, global axes.
    fn held(&mut self, joint: usize, body: Option<usize>) -> Vec<(usize, Triple)> {
        let mut held = Vec::new();
        let Some(body) = body else { return held };
        for place in 0..self.scene.constraints.len() {
            if self.scene.constraints[place].joint != joint {
                continue;
            }
            let row = self.scene.constraints[place].row;
            let gradients = self.scene.gradients(place, Frame::Global);
            for (k, gradient) in gradients.into_iter().enumerate() {
                let force = gradient.force(&mut self.scene.space, body);
                let force = self.scene.space.components(force, Frame::Global);
                let known = force.map(|component| self.scene.space.arena.literal(component));
                if let [Some(x), Some(y), Some(z)] = known
                    && (x * x + y * y + z * z - 1.0).abs() < 1e-12
                {
                    held.push((row + k, force));
                }
            }
        }
        held
    }

    /// Whether some rows say just that a point of one link is a point of another, at any state:
    /// along their directions, and across them because nothing moves there.
    fn hold_together(&mut self, handover: &Handover, rows: &[Vec<Expr>], right: &[Expr]) -> bool {
        let across = match handover.rows[..] {
            [(_, a), (_, b)] => vec![cross(&mut self.scene.space.arena, a, b)],
            [_, _, _] => Vec::new(),
            _ => return false,
        };
        let directions: Vec<Triple> = handover
            .rows
            .iter()
            .map(|(_, e)| *e)
            .chain(across)
            .collect();
        let arena = &mut self.scene.space.arena;
        let motion = Kinematics::new(arena, &self.links, ZERO);
        // What must vanish beside what it is a difference of: angles between directions, entries of
        // rows, velocity terms.
        let mut vanishing: [Vec<Expr>; 3] = Default::default();
        let mut beside: [Vec<Expr>; 3] = [vec![Arena::ONE], Vec::new(), Vec::new()];
        for (place, &e) in directions.iter().enumerate() {
            for &other in &directions[..place] {
                vanishing[0].push(dot(arena, e, other));
            }
            let [giving, receiving] = handover.along(arena, &self.links, e);
            let [of_giver, of_receiver] = handover.known(arena, &self.links, &motion, e);
            let Some((row, _)) = handover.rows.get(place) else {
                vanishing[1].extend(giving.into_iter().chain(receiving));
                vanishing[2].extend([of_giver, of_receiver]);
                continue;
            };
            for ((&entry, giving), receiving) in rows[*row].iter().zip(giving).zip(receiving) {
                let difference = arena.sub(giving, receiving);
                vanishing[1].push(arena.sub(entry, difference));
                beside[1].push(giving);
            }
            let difference = arena.sub(of_giver, of_receiver);
            vanishing[2].push(arena.add(right[*row], difference));
            beside[2].push(of_giver);
        }
        let largest = |exprs: &[Expr], seed: usize| {
            let values = evaluate(arena, exprs, |input| anywhere(&self.links, input, seed));
            let mut values = values.into_iter().map(|value| value.map(f64::abs));
            values.try_fold(0.0, |most, value| Some(f64::max(most, value?)))
        };
        (0..3).all(|seed| {
            vanishing.iter().zip(&beside).all(|(zeros, beside)| {
                let both = largest(zeros, seed).zip(largest(beside, seed));
                both.is_some_and(|(zero, beside)| zero <= ROUND_OFF * beside)
            })
        })
    }
}

impl Links {
    /// Counts as much of a link's mass on another one as makes a component of its first moment
    /// vanish.
    pub(super) fn hand_over(&mut self, arena: &mut Arena, handover: &mut Handover) {
        let Handover {
            giver,
            from,
            component,
            receiver,
            onto,
            ..
        } = *handover;
        let inertia = self.links[giver].inertia;
        let mass = arena.div(inertia.first[component], from[component]);
        // What the macro cannot see may be anything.
        let known = arena.literal(mass).zip(arena.literal(inertia.mass));
        if !known.is_some_and(|(mass, own)| mass.abs() <= MOST * own.abs()) {
            return;
        }
        handover.mass = mass;
        let taken = Inertia::point(arena, -mass, from);
        let mut left = inertia.plus(arena, taken);
        left.first[component] = Arena::ZERO;
        self.links[giver].inertia = left;
        if let Some(receiver) = receiver {
            let point = Inertia::point(arena, mass, onto);
            let sum = self.links[receiver].inertia.plus(arena, point);
            self.links[receiver].inertia = sum;
        }
    }
}

impl Handover {
    /// What a direction of global axes is along the velocities, for the point on the giver and that
    /// on the receiver.
    fn along(&self, arena: &mut Arena, links: &Links, direction: Triple) -> [Vec<Expr>; 2] {
        [(Some(self.giver), self.from), (self.receiver, self.onto)].map(|(link, at)| {
            let Some(link) = link else {
                return vec![Arena::ZERO; links.velocities];
            };
            let force = links
                .frames
                .turn(arena, direction, Frames::GROUND, links.axes(Some(link)));
            let at = links.in_axes(arena, at, Some(link));
            let mut wrenches = vec![Wrench::NONE; links.links.len()];
            wrenches[link] = Wrench {
                force,
                moment: cross(arena, at, force),
            };
            links.project(arena, wrenches)
        })
    }

    /// The acceleration of the point along a direction of global axes, but for the rates of
    /// velocities; on the giver and on the receiver.
    fn known(
        &self,
        arena: &mut Arena,
        links: &Links,
        motion: &Kinematics,
        direction: Triple,
    ) -> [Expr; 2] {
        [(Some(self.giver), self.from), (self.receiver, self.onto)].map(|(link, at)| {
            let Some(link) = link else {
                return dot(arena, direction, motion.ground);
            };
            let direction =
                links
                    .frames
                    .turn(arena, direction, Frames::GROUND, links.axes(Some(link)));
            let at = links.in_axes(arena, at, Some(link));
            let bend = apply(arena, motion.second[link], at);
            let acceleration = add(arena, motion.bias[link], bend);
            dot(arena, direction, acceleration)
        })
    }

    /// What right-hand sides of the rows beyond the motion's own, `extra`, change of the forces
    /// along the velocities: there the giver's point has that acceleration besides.
    pub(super) fn correct(
        &self,
        arena: &mut Arena,
        links: &Links,
        extra: &[Expr],
        forces: &mut [Expr],
    ) {
        for &(row, direction) in &self.rows {
            if extra[row] == Arena::ZERO {
                continue;
            }
            let force = arena.mul(self.mass, extra[row]);
            let [_, receiving] = self.along(arena, links, direction);
            for (sum, entry) in forces.iter_mut().zip(receiving) {
                let term = arena.mul(force, entry);
                *sum = arena.sub(*sum, term);
            }
        }
    }

    /// Takes the force that the mass takes out of the multipliers. There is no `motion` where
    /// right-hand sides are given.
    pub(super) fn multipliers(
        &self,
        arena: &mut Arena,
        links: &Links,
        motion: Option<&Kinematics>,
        extra: &[Expr],
        solution: &mut Solution,
    ) {
        for &(row, direction) in &self.rows {
            let mut acceleration = extra[row];
            if let Some(motion) = motion {
                let [_, known] = self.known(arena, links, motion, direction);
                acceleration = arena.add(acceleration, known);
            }
            let [_, receiving] = self.along(arena, links, direction);
            let by_rates = dot_all(arena, &receiving, &solution.accelerations);
            acceleration = arena.add(acceleration, by_rates);
            let force = arena.mul(self.mass, acceleration);
            let multiplier = &mut solution.multipliers[row];
            *multiplier = arena.sub(*multiplier, force);
        }
    }
}

fn dot_all(arena: &mut Arena, a: &[Expr], b: &[Expr]) -> Expr {
    let mut sum = Arena::ZERO;
    for (&a, &b) in a.iter().zip(b) {
        let product = arena.mul(a, b);
        sum = arena.add(sum, product);
    }
    sum
}
