//! The same mechanism in joint coordinates: the accelerations of its bodies against a dense
//! solution over all equations.

use std::f64::consts::TAU;

use holonom_engine::coordinates::beginning::Beginning;
use holonom_engine::coordinates::candidates::{Method, Strategy};
use holonom_engine::coordinates::elimination::Solution;
use holonom_engine::coordinates::freedom::Freedom;
use holonom_engine::coordinates::from_bodies::from_bodies;
use holonom_engine::coordinates::links::Links;
use holonom_engine::coordinates::system::Reduced;
use holonom_engine::model::{BodyKind, Model};
use holonom_engine::plan::eliminate::Check;
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::{Arena, Expr, Input, Node, Stage};

use crate::comparison::{Comparison, difference};
use crate::inputs::{Coefficients, Inputs, in_axes, transposed, turned, user_axes};
use crate::reading::Numbers;
use crate::reference::{Equations, State, euler_rates};
use crate::solutions::{SMALL, SOUND, System, TOLERANCE};

/// Euler parameters of a rotation (Shepperd's method: from the largest of the four).
fn euler_parameters(a: [Numbers; 3]) -> [f64; 4] {
    let trace = a[0][0] + a[1][1] + a[2][2];
    let mut squares = [trace, a[0][0], a[1][1], a[2][2]];
    squares[1..].iter_mut().for_each(|x| *x = 2.0 * *x - trace);
    let largest = (0..4)
        .max_by(|&k, &l| squares[k].total_cmp(&squares[l]))
        .expect("four");
    let x = [a[2][1] - a[1][2], a[0][2] - a[2][0], a[1][0] - a[0][1]];
    let y = [a[2][1] + a[1][2], a[0][2] + a[2][0], a[1][0] + a[0][1]];
    let own = 1.0 + squares[largest];
    let p = match largest {
        0 => [own, x[0], x[1], x[2]],
        1 => [x[0], own, y[2], y[1]],
        2 => [x[1], y[2], own, y[0]],
        _ => [x[2], y[1], y[0], own],
    };
    let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
    p.map(|e| e / length)
}

/// Values and their rates, by the rules for sums, products and reciprocals.
fn rates(
    arena: &Arena,
    outputs: &[Expr],
    input: impl Fn(Input) -> Option<(f64, f64)>,
) -> Vec<(f64, f64)> {
    let last = outputs.iter().map(|x| x.node()).max().unwrap_or(0);
    let mut values: Vec<(f64, f64)> = Vec::new();
    let nan = (f64::NAN, f64::NAN);
    for place in 0..=last {
        let of = |x: Expr| {
            let (value, rate) = values[x.node()];
            if x.is_negative() {
                (-value, -rate)
            } else {
                (value, rate)
            }
        };
        let value = match arena.node(place) {
            Node::Constant(bits) => (f64::from_bits(bits), 0.0),
            Node::Input(known) => input(known).unwrap_or(nan),
            Node::Add(a, b) => (of(a).0 + of(b).0, of(a).1 + of(b).1),
            Node::Multiply(a, b) => (of(a).0 * of(b).0, of(a).1 * of(b).0 + of(a).0 * of(b).1),
            Node::Reciprocal(a) => (of(a).0.recip(), -of(a).1 / of(a).0.powi(2)),
            Node::SquareRoot(a) => (of(a).0.sqrt(), of(a).1 / (2.0 * of(a).0.sqrt())),
            Node::Sign(a) => (if of(a).0 < 0.0 { -1.0 } else { 1.0 }, 0.0),
            // Constants are made of them at most.
            _ => nan,
        };
        values.push(value);
    }
    let signed = |x: &Expr| {
        let (value, rate) = values[x.node()];
        if x.is_negative() {
            (-value, -rate)
        } else {
            (value, rate)
        }
    };
    outputs.iter().map(signed).collect()
}

/// From joint coordinates to bodies and back, relative to the largest number: two axes of a
/// universal joint may be nearly parallel.
const THERE_AND_BACK: f64 = 1e-9;

/// Joint coordinates whose Euler parameters have the signs of others: either is the same rotation.
fn with_signs_of(links: &Links, mut coordinates: Vec<f64>, like: &[f64]) -> Vec<f64> {
    for link in &links.links {
        if let Freedom::Ball { rest } = link.freedom {
            let first = 2 * links.turns + rest;
            let product: f64 = (first..first + 4).map(|k| coordinates[k] * like[k]).sum();
            let own = coordinates[first..first + 4].iter_mut();
            own.for_each(|e| *e = e.abs().copysign(*e * product));
        }
    }
    coordinates
}

/// The rates of joint coordinates.
fn coordinate_rates(links: &Links, coordinates: &[f64], velocities: &[f64]) -> Vec<f64> {
    let mut rates = vec![0.0; coordinates.len()];
    for link in &links.links {
        let u = link.velocity;
        match link.freedom {
            Freedom::Turn { pair, .. } => {
                let (c, s) = (coordinates[2 * pair], coordinates[2 * pair + 1]);
                rates[2 * pair] = -s * velocities[u];
                rates[2 * pair + 1] = c * velocities[u];
            }
            Freedom::Slide { rest, .. } => rates[2 * links.turns + rest] = velocities[u],
            Freedom::Screw {
                pair,
                is_reversed,
                counter,
                ..
            } => {
                let (c, s) = (coordinates[2 * pair], coordinates[2 * pair + 1]);
                rates[2 * pair] = -s * velocities[u];
                rates[2 * pair + 1] = c * velocities[u];
                let sign = if is_reversed { -1.0 } else { 1.0 };
                rates[2 * links.turns + links.rest + counter] = sign * velocities[u];
            }
            Freedom::Ball { rest } => {
                let first = 2 * links.turns + rest;
                let p = [0, 1, 2, 3].map(|k| coordinates[first + k]);
                let w = [0, 1, 2].map(|k| velocities[u + k]);
                rates[first..first + 4].copy_from_slice(&euler_rates(p, w));
            }
        }
    }
    rates
}

/// The pivots as kernels record them: compared with what their rows are on free bodies.
fn recorded(reduced: &mut Reduced, model: &Model, checks: &[Check]) -> Vec<Check> {
    let arena = &reduced.scene.space.arena;
    let is_compared = |check: &Check| arena.stage(check.before) == Stage::State;
    if checks.iter().any(is_compared) && !reduced.determines() {
        reduced.find_references(&Beginning::new(model));
    }
    reduced.referred(checks)
}

impl Comparison<'_> {
    /// Joint coordinates of a state, the state that they describe, and its accelerations.
    pub(crate) fn reduced(
        &mut self,
        state: &State,
        strategy: Strategy,
        coefficients: Coefficients,
        terms: Terms,
    ) -> Result<(), String> {
        let model = self.model;
        let mut known = self.in_joints.iter();
        let known = known.position(|(known, _)| *known == strategy);
        let known = known.unwrap_or_else(|| {
            self.in_joints
                .push((strategy, Reduced::of(model, strategy)));
            self.in_joints.len() - 1
        });
        let mut reduced = self.in_joints[known].1.clone();
        let Some(equations) = self.equations(state) else {
            return Ok(());
        };
        if equations.hold() && equations.sides.iter().any(|side| *side <= 0.0) {
            // Opposed axes, between which no angle is the nearest: equations hold there as well.
            return Ok(());
        }
        let cartesian = |state: &State, angles: &[(f64, f64)]| {
            Inputs::new(model, self.described, state, angles, coefficients)
        };
        let mut inputs = cartesian(state, &equations.angles);
        let mut from = reduced.scene.space.arena.clone();
        let outputs = from_bodies(&mut from, model, &reduced.links);
        let joint = inputs.values(&from, &outputs);
        let velocities = reduced.links.velocities;
        let (coordinates, rates_of_joints) = joint.split_at(joint.len() - velocities);
        inputs.coordinates = coordinates.to_vec();
        inputs.velocities = rates_of_joints.to_vec();
        let moving = coordinate_rates(&reduced.links, coordinates, rates_of_joints);
        // The state of the bodies.
        let mut exact = state.clone();
        let arena = &reduced.scene.space.arena;
        for (body, chart) in reduced.charts.iter().enumerate() {
            let r = inputs.values(arena, &chart.position);
            let v = inputs.values(arena, &chart.velocity);
            exact.poses[body].0 = [r[0], r[1], r[2]];
            exact.rates[body].0 = [v[0], v[1], v[2]];
            let Some(rotation) = chart.rotation else {
                continue;
            };
            let rows = rotation.map(|row| inputs.values(arena, &row));
            let rows = rows.map(|row| [row[0], row[1], row[2]]);
            let own = transposed(user_axes(model, body));
            // A C, row by row.
            let user = rows.map(|row| turned(own, row));
            exact.poses[body].1 = euler_parameters(user);
            let w = inputs.values(arena, &chart.spin);
            let w = turned(own, [w[0], w[1], w[2]]);
            exact.rates[body].1 = w;
        }
        // And back: the bodies move as the joints of the tree let them now.
        let again = cartesian(&exact, &equations.angles).values(&from, &outputs);
        let again = with_signs_of(&reduced.links, again, &joint);
        let largest = joint.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        let relative = difference(&again, &joint) / largest;
        if relative > THERE_AND_BACK || relative.is_nan() {
            return Err(format!(
                "joint coordinates, {strategy:?}: {joint:?}\nthere and back: {again:?}\ndifference {relative:e}"
            ));
        }
        let Some(mut equations) = Equations::new(self.described, &exact) else {
            return Ok(());
        };
        // A screw has placed its bodies by an angle that may lie a turn beyond what the first state
        // counts, whose axes need not be parallel: the whole turns are those of that angle.
        let counted = coordinates.len() - equations.angles.len();
        for link in &reduced.links.links {
            if let Freedom::Screw { counter, .. } = link.freedom {
                let beyond = coordinates[counted + counter] - equations.angles[counter].0;
                exact.turns[counter] += (beyond / TAU).round();
            }
        }
        if exact.turns != state.turns {
            match Equations::new(self.described, &exact) {
                Some(counted) => equations = counted,
                None => return Ok(()),
            }
        }
        // Counted angles are those of that state, which may lie beyond half a turn from the first.
        let joint = cartesian(&exact, &equations.angles).values(&from, &outputs);
        let coordinates = &joint[..joint.len() - velocities];
        inputs.coordinates[counted..].copy_from_slice(&coordinates[counted..]);
        // Joints of the tree hold by themselves, rigidly.
        let remains = |joint: usize| {
            let mut constraints = reduced.scene.constraints.iter();
            constraints.any(|constrained| constrained.joint == joint)
        };
        let (mut dropped, mut is_closing) = (Vec::new(), Vec::new());
        for (joint, left_out) in reduced.dropped.iter().enumerate() {
            let rows = model.definition(&model.joints[joint]).equations();
            let is_kept = |row: &usize| !left_out.contains(row);
            dropped.extend((0..rows).map(|row| !is_kept(&row)));
            is_closing.extend((0..rows).filter(is_kept).map(|_| remains(joint)));
        }
        // Where equations that are left out are violated, the others hold on a branch that the
        // mechanism never gets to.
        let is_on_all = equations.hold();
        let equations = equations.without(&dropped);
        let compliances = is_closing.iter().map(|&closes| match terms {
            Terms::Compliant if closes => coefficients.compliance,
            _ => 0.0,
        });
        let matrix = equations.saddle_by_row(&compliances.collect::<Vec<f64>>());
        let Some(system) = System::of(&equations, matrix) else {
            return Ok(());
        };
        let (gain, square) = coefficients.gains(terms);
        let mut right = equations.forces.clone();
        right
            .extend((0..equations.phi.len()).map(|k| {
                equations.gamma[k] - gain * equations.rate[k] - square * equations.phi[k]
            }));
        let (wanted, round_off) = system.solve_with(&right, (gain, square));
        let Solution {
            accelerations,
            multipliers,
            checks,
        } = reduced.solve(terms);
        let checks = recorded(&mut reduced, model, &checks);
        let arena = &reduced.scene.space.arena;
        let pairs: Vec<Expr> = checks
            .iter()
            .flat_map(|check| [check.pivot, check.before])
            .collect();
        let pairs = inputs.values(arena, &pairs);
        let pivots = pairs.chunks(2).map(|pair| (pair[0] / pair[1]).abs());
        // A pivot that is not a number comes behind one that vanishes.
        let smallest = pivots.fold(1.0_f64, f64::min);
        if smallest < SMALL {
            // The kernel says so. Off the constraints velocities may be undetermined that follow
            // from the others on them.
            if is_on_all && system.condition() < SOUND {
                return Err(format!(
                    "joint coordinates, {strategy:?}, {terms:?}: a pivot of {smallest:e} in a system that is not singular\nin {coordinates:?}"
                ));
            }
            self.statistics.told += 1;
            return Ok(());
        }
        // What a dependent velocity is divided by enters the mass matrix of the others twice; the
        // pivots of a factorised mass matrix are squares already.
        let lost = match strategy.method {
            Method::Dependent => smallest.powi(2),
            Method::MassMatrix | Method::Articulated => smallest,
        };
        let round_off = round_off / lost;
        let second = inputs.values(arena, &accelerations);
        let input = |input: Input| {
            let at = |values: &[f64], rates: &[f64], k: u32| {
                let k = k as usize;
                Some((*values.get(k)?, *rates.get(k)?))
            };
            match input {
                Input::Coordinate(k) => at(&inputs.coordinates, &moving, k),
                Input::Velocity(k) => at(&inputs.velocities, &second, k),
                Input::Symbol(k) | Input::Varying(k) => {
                    Some((*inputs.symbols.get(k as usize)?, 0.0))
                }
                _ => None,
            }
        };
        let mut found = Vec::new();
        for (chart, body) in reduced.charts.iter().zip(&model.bodies) {
            found.extend(rates(arena, &chart.velocity, input).iter().map(|x| x.1));
            if body.kind == BodyKind::Rigid {
                found.extend(rates(arena, &chart.spin, input).iter().map(|x| x.1));
            }
        }
        let mut own = in_axes(model, &found, false);
        let (accelerations, forces) = wanted.split_at(own.len());
        let forces = forces.iter().zip(&is_closing);
        let forces = forces
            .filter(|(_, closes)| **closes)
            .map(|(force, _)| *force);
        let wanted: Vec<f64> = accelerations.iter().copied().chain(forces).collect();
        own.extend(inputs.values(arena, &multipliers));
        let relative = difference(&own, &wanted) / round_off;
        if relative > TOLERANCE || relative.is_nan() {
            return Err(format!(
                "joint coordinates, {strategy:?}, {terms:?}: {own:?}\nwanted: {wanted:?}\ndifference over condition {relative:e}, {round_off:e}\nin {coordinates:?} {rates_of_joints:?}"
            ));
        }
        self.statistics.worst = self.statistics.worst.max(relative);
        self.statistics.solutions += 1;
        Ok(())
    }
}
