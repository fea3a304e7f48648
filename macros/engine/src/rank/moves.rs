//! How a joint is said to move, against its equations.
//!
//! The bodies are displaced by random amounts of every motion, each carried by those before it, and
//! both together anywhere: then the equations must hold, no motion may have a part along a
//! gradient, and there must be as many motions as the rank of the gradients leaves.

use super::assemble;
use super::dense::norm;
use super::displacement::{Displacement, Twist, apply};
use super::limits::TOLERANCE;
use super::motion::{Configuration, Constraints};
use super::random::Random;
use super::span::independent;
use super::sparse::{Row, Rows, width};
use crate::model::{BodyKind, Comparison, Direction, Element, Model, Motion};
use crate::symbolic::arena::Arena;
use crate::symbolic::bind::advance;
use crate::symbolic::fixed::{Copies, copies};
use crate::symbolic::vector::Triple;

/// Configurations besides the reference one.
const PLACES: usize = 3;
/// What is left of a motion along a gradient by round-off, both of unit length.
const ROUND_OFF: f64 = 1e-9;

/// Compares the motions that a joint of two bodies states with its equations, those that a
/// mechanism leaves out among them.
#[must_use]
pub fn compare(model: &Model, joint: usize) -> Comparison {
    let mut model = model.only(joint);
    for joint in &mut model.joints {
        joint.dropped.clear();
    }
    let [joint] = &model.joints[..] else {
        return Comparison::Undecided;
    };
    let Some(motions) = &model.definition(joint).motions else {
        return Comparison::Undecided;
    };
    let found = Pair::new(&model, joint).and_then(|mut pair| {
        let motions: Option<Vec<Moving>> = motions
            .iter()
            .map(|motion| pair.moving(&model, joint, *motion))
            .collect();
        pair.compare(&motions?)
    });
    found.unwrap_or(Comparison::Undecided)
}

/// A motion in the reference configuration, in global axes.
enum Moving {
    Turn {
        axis: [f64; 3],
        point: [f64; 3],
    },
    Slide {
        along: [f64; 3],
    },
    /// The translation is by `advance` for a radian.
    Screw {
        axis: [f64; 3],
        point: [f64; 3],
        advance: f64,
    },
    Ball {
        point: [f64; 3],
    },
}

impl Moving {
    /// Its scalar motions.
    fn twists(&self) -> Vec<Twist> {
        match *self {
            Self::Turn { axis, point } => vec![Twist::about(point, axis)],
            Self::Slide { along } => vec![Twist::along(along)],
            Self::Screw {
                axis,
                point,
                advance,
            } => vec![Twist::screw(point, axis, advance)],
            Self::Ball { point } => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|axis| Twist::about(point, axis))
                .into(),
        }
    }

    /// A displacement of up to a radian, or the given length.
    fn random(&self, length: f64, random: &mut Random) -> Displacement {
        match *self {
            Self::Turn { axis, point } => {
                let angle = random.number();
                Displacement::about(point, axis.map(|x| angle * x))
            }
            Self::Slide { along } => {
                let way = length * random.number();
                Displacement::along(along.map(|x| way * x))
            }
            Self::Screw {
                axis,
                point,
                advance,
            } => {
                let angle = random.number();
                let turned = Displacement::about(point, axis.map(|x| angle * x));
                Displacement::along(axis.map(|x| advance * angle * x)).after(&turned)
            }
            Self::Ball { point } => Displacement::about(point, [0; 3].map(|_| random.number())),
        }
    }
}

/// Two bodies and the joint between them.
struct Pair {
    constraints: Constraints,
    described: Configuration,
    bodies: [Option<usize>; 2],
    random: Random,
}

impl Pair {
    /// `None` where the equations cannot be evaluated, do not hold, or change with time.
    fn new(model: &Model, joint: &Element) -> Option<Self> {
        let [first, second] = joint.bodies[..] else {
            return None;
        };
        let mut random = Random::new();
        let (constraints, described) =
            Constraints::new(model, |velocities| random.motion(velocities))?;
        let violations = constraints.violations(&described)?;
        let is_sound = violations
            .iter()
            .all(|far| far.abs() <= assemble::ASSEMBLED);
        (first != second && is_sound && !constraints.is_driven()).then_some(Self {
            constraints,
            described,
            bodies: [first, second],
            random,
        })
    }

    /// Where a body of the joint stands in the reference configuration.
    fn pose(&self, body: usize) -> ([f64; 3], [f64; 4]) {
        match self.bodies[body] {
            Some(body) => self.constraints.pose(&self.described, body),
            None => ([0.0; 3], crate::model::inertia::IDENTITY),
        }
    }

    fn moving(&self, model: &Model, joint: &Element, motion: Motion) -> Option<Moving> {
        Some(match motion {
            Motion::Turn { axis, point } => Moving::Turn {
                axis: self.direction(model, joint, axis)?,
                point: self.point(model, joint, point)?,
            },
            Motion::Slide { along } => Moving::Slide {
                along: self.direction(model, joint, along)?,
            },
            Motion::Screw { axis, point, pitch } => {
                let mut arena = Arena::new();
                let advance = advance(&mut arena, model, joint, pitch);
                Moving::Screw {
                    axis: self.direction(model, joint, Direction::axis(axis))?,
                    point: self.point(model, joint, point)?,
                    advance: arena.literal(advance)?,
                }
            }
            Motion::Ball { point } => Moving::Ball {
                point: self.point(model, joint, point)?,
            },
        })
    }

    fn point(&self, model: &Model, joint: &Element, parameter: usize) -> Option<[f64; 3]> {
        self.common(
            model,
            joint,
            parameter,
            |copies, body| copies.vector[body],
            true,
        )
    }

    fn direction(&self, model: &Model, joint: &Element, of: Direction) -> Option<[f64; 3]> {
        let copy = |copies: &Copies, body: usize| match of.normal {
            Some(which) => copies.normals[body][which],
            None => copies.vector[body],
        };
        self.common(model, joint, of.parameter, copy, false)
    }

    /// A point, or a direction, in global axes, if its copies on the bodies are the same.
    fn common(
        &self,
        model: &Model,
        joint: &Element,
        parameter: usize,
        copy: impl Fn(&Copies, usize) -> Triple,
        is_point: bool,
    ) -> Option<[f64; 3]> {
        let mut arena = Arena::new();
        let copies = copies(&mut arena, model, joint, parameter);
        let [first, second] = [0, 1].map(|body| {
            let (position, orientation) = self.pose(body);
            let [x, y, z] = copy(&copies, body).map(|component| arena.literal(component));
            let turned = apply(orientation, [x?, y?, z?]);
            Some(if is_point {
                [0, 1, 2].map(|k| position[k] + turned[k])
            } else {
                turned
            })
        });
        let (first, second) = (first?, second?);
        let difference = [0, 1, 2].map(|k| first[k] - second[k]);
        let size = self.constraints.length.max(norm(&first));
        (norm(&difference) <= ROUND_OFF * size).then_some(first)
    }

    fn compare(&mut self, motions: &[Moving]) -> Option<Comparison> {
        let twists: Vec<(usize, Twist)> = motions
            .iter()
            .enumerate()
            .flat_map(|(place, motion)| motion.twists().into_iter().map(move |t| (place, t)))
            .collect();
        let described = self.described.clone();
        let still = vec![Displacement::NONE; motions.len()];
        let rows = self.constraints.directions(&described, TOLERANCE)?;
        let columns = self.columns(&twists, &still, &Displacement::NONE, &described)?;
        let against = forbidden(&rows, &twists, &columns);
        if !against.is_empty() {
            return Some(Comparison::Forbidden(against));
        }
        let (mut rank, mut free) = (0, 0);
        for _ in 0..PLACES {
            let length = self.constraints.length;
            let random = &mut self.random;
            let amounts = motions.iter().map(|motion| motion.random(length, random));
            let amounts: Vec<Displacement> = amounts.collect();
            let between = amounts
                .iter()
                .fold(Displacement::NONE, |all, next| all.after(next));
            let (all, at) = self.displaced(&between);
            let violations = self.constraints.violations(&at)?;
            let sizes = violations.iter().map(|far| far.abs()).enumerate();
            let worst = sizes.max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((row, far)) = worst
                && far > ROUND_OFF
            {
                return Some(Comparison::Violated(row));
            }
            let rows = self.constraints.directions(&at, TOLERANCE)?;
            let columns = self.columns(&twists, &amounts, &all, &at)?;
            let against = forbidden(&rows, &twists, &columns);
            if !against.is_empty() {
                return Some(Comparison::Forbidden(against));
            }
            rank = rank.max(independent(&[rows], TOLERANCE).len());
            free = free.max(independent(&[columns], TOLERANCE).len());
        }
        let (moved, _) = self.moved()?;
        let left = self
            .constraints
            .kind(moved)
            .velocities()
            .saturating_sub(rank);
        let stated = twists.len();
        // A particle does not turn: a ball at its place says nothing of it, and may be said.
        let is_dependent = free < stated && self.constraints.kind(moved) == BodyKind::Rigid;
        Some(if is_dependent {
            Comparison::Dependent {
                stated,
                independent: free,
            }
        } else if free < left {
            Comparison::Fewer { stated, left }
        } else {
            Comparison::Agrees
        })
    }

    /// The body that the motions displace, and whether it is the first of the joint, which then
    /// goes the other way.
    fn moved(&self) -> Option<(usize, bool)> {
        let [first, second] = self.bodies;
        match second {
            Some(body) => Some((body, false)),
            None => Some((first?, true)),
        }
    }

    /// The configuration after a displacement of the second body against the first, where both go
    /// anywhere together if they can; and where the motions of the first are displaced to.
    fn displaced(&mut self, between: &Displacement) -> (Displacement, Configuration) {
        let length = self.constraints.length;
        let random = &mut self.random;
        let all = match self.bodies {
            [Some(_), Some(_)] => {
                let turn = Displacement::about([0.0; 3], [0; 3].map(|_| random.number()));
                Displacement::along([0; 3].map(|_| length * random.number())).after(&turn)
            }
            [_, None] => between.inverse(),
            _ => Displacement::NONE,
        };
        let mut at = self.described.clone();
        for (body, by) in self.bodies.into_iter().zip([all, all.after(between)]) {
            if let Some(body) = body {
                let (position, orientation) = self.constraints.pose(&at, body);
                let pose = (by.of_point(position), by.of_orientation(orientation));
                self.constraints.place(&mut at, body, pose);
            }
        }
        self.constraints.rewrap(&mut at);
        (all, at)
    }

    /// What the scalar motions do to the velocities, without dimension and of unit length, or zero.
    fn columns(
        &self,
        twists: &[(usize, Twist)],
        amounts: &[Displacement],
        all: &Displacement,
        at: &Configuration,
    ) -> Option<Rows> {
        let (body, is_first) = self.moved()?;
        let sign = if is_first { -1.0 } else { 1.0 };
        let mut carriers = vec![*all];
        for amount in amounts {
            carriers.push(carriers[carriers.len() - 1].after(amount));
        }
        let columns = twists.iter().map(|(motion, twist)| {
            let twist = twist.carried(&carriers[*motion]);
            let mut column = Row::of(&self.constraints.velocity_of(at, body, &twist));
            let size = column.norm();
            column.scale(if size > TOLERANCE { sign / size } else { 0.0 });
            column
        });
        Some(columns.collect())
    }
}

/// The motions that have a part along a gradient.
fn forbidden(rows: &Rows, twists: &[(usize, Twist)], columns: &Rows) -> Vec<(usize, usize)> {
    let mut found: Vec<(usize, usize, f64)> = Vec::new();
    let length = width(rows).max(width(columns));
    for ((motion, _), column) in twists.iter().zip(columns) {
        let column = column.dense(length);
        for (row, gradient) in rows.iter().enumerate() {
            let along = gradient.along(&column).abs();
            if along <= ROUND_OFF {
                continue;
            }
            match found.iter_mut().find(|known| known.0 == *motion) {
                Some(known) if known.2 >= along => {}
                Some(known) => (known.1, known.2) = (row, along),
                None => found.push((*motion, row, along)),
            }
        }
    }
    found
        .into_iter()
        .map(|(motion, row, _)| (motion, row))
        .collect()
}
