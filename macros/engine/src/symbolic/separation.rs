//! Lengths at whose zero a force turns round: it acts along a direction, and has a size there.
//!
//! A length is a root of squares. As it passes through zero, its direction turns round. A force
//! along it jumps, unless its size vanishes with the length, or is odd in the rate as that of a
//! damper. What is without bound at zero, such as gravitation, is a pole and no jump.

use super::arena::{Arena, Expr, Input};
use super::bind::Effect;
use super::equations::{Kernel, with_scene};
use super::evaluate::evaluate;
use super::expression::{ScalarExpr, VectorExpr};
use super::scene::Scene;
use super::vector::{Frame, ZERO};
use crate::model::Function;

/// The separations whose lengths have a direction that a force turns round with, and the force of
/// each by its place; three components each.
#[derive(Clone, Debug)]
pub struct Separations {
    /// The components.
    pub kernel: Kernel,
    /// The forces.
    pub forces: Vec<usize>,
}

/// Lengths (m) that are as good as zero.
const SMALL: [f64; 2] = [1e-18, 2e-18];

/// At how many places numbers are tried.
const TRIALS: u32 = 8;

impl Separations {
    /// Those of a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut found: Vec<(usize, ScalarExpr)> = Vec::new();
        for (force, effects) in scene.effects.iter().enumerate() {
            let mut lengths: Vec<&ScalarExpr> = Vec::new();
            for effect in effects {
                each_scalar(effect, &mut |scalar| collect(scalar, &mut lengths));
            }
            for length in lengths {
                let is_known = found.iter().any(|(_, known)| known == length);
                let jumps = |trial| jumps(&scene.space.arena, effects, length, trial);
                if !is_known && (0..TRIALS).any(jumps) {
                    found.push((force, length.clone()));
                }
            }
        }
        let kernel = with_scene(scene, |scene| {
            let lengths = found.iter();
            lengths
                .flat_map(|(_, length)| components(scene, length))
                .collect()
        });
        Self {
            kernel,
            forces: found.into_iter().map(|(force, _)| force).collect(),
        }
    }
}

/// Calls `visit` with the scalars of an effect.
fn each_scalar<'a>(effect: &'a Effect, visit: &mut impl FnMut(&'a ScalarExpr)) {
    match effect {
        Effect::Potential(energy) => visit(energy),
        Effect::Along(effort, coordinate) => {
            visit(effort);
            visit(coordinate);
        }
        Effect::Force(vector, _) | Effect::Moment(vector, _) => factors(vector, visit),
    }
}

/// The factors of a vector.
fn factors<'a>(vector: &'a VectorExpr, visit: &mut impl FnMut(&'a ScalarExpr)) {
    match vector {
        VectorExpr::Fixed(..)
        | VectorExpr::Point(..)
        | VectorExpr::Rate(_)
        | VectorExpr::Spin(_) => {}
        VectorExpr::Sum(terms) => terms.iter().for_each(|(_, term)| factors(term, visit)),
        VectorExpr::Scaled(factor, inner) => {
            visit(factor);
            factors(inner, visit);
        }
        VectorExpr::Cross(a, b) => {
            factors(a, visit);
            factors(b, visit);
        }
    }
}

/// The parts of a scalar that are scalars.
fn parts(scalar: &ScalarExpr) -> Vec<&ScalarExpr> {
    match scalar {
        ScalarExpr::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
        ScalarExpr::Product(a, b) => vec![a, b],
        ScalarExpr::Function(_, inner) | ScalarExpr::Rate(inner) => vec![inner],
        ScalarExpr::Direction(angle) => vec![&angle.sine, &angle.cosine],
        ScalarExpr::Side { of, .. } => vec![of],
        ScalarExpr::Select { side, parts } => vec![side, &parts[0], &parts[1]],
        ScalarExpr::Constant(_)
        | ScalarExpr::Dot(..)
        | ScalarExpr::Time
        | ScalarExpr::Angle(_)
        | ScalarExpr::Setpoint(_)
        | ScalarExpr::State { .. } => Vec::new(),
    }
}

/// What stands under a root, if it is the square of a separation. The direction of a velocity is
/// that of friction, which holds.
fn under(length: &ScalarExpr) -> Option<&ScalarExpr> {
    let ScalarExpr::Function(Function::SquareRoot, under) = length else {
        return None;
    };
    let is_square = |term: &ScalarExpr| match term {
        ScalarExpr::Product(a, b) => a == b && !a.has_rate(),
        _ => false,
    };
    match &**under {
        ScalarExpr::Dot(a, b) if a == b && !a.has_rate() => Some(under),
        ScalarExpr::Sum(terms) if terms.len() <= 3 => terms
            .iter()
            .all(|(factor, term)| *factor == Arena::ONE && is_square(term))
            .then_some(under),
        _ => None,
    }
}

/// Adds the lengths in a scalar.
fn collect<'a>(scalar: &'a ScalarExpr, lengths: &mut Vec<&'a ScalarExpr>) {
    if under(scalar).is_some() && !lengths.contains(&scalar) {
        lengths.push(scalar);
    }
    for part in parts(scalar) {
        collect(part, lengths);
    }
}

/// The separation of a length, global axes or whatever axes it is written in.
fn components(scene: &mut Scene, length: &ScalarExpr) -> [Expr; 3] {
    let Scene { space, motion, .. } = scene;
    match under(length) {
        Some(ScalarExpr::Dot(vector, _)) => {
            let vector = vector.value(space, motion);
            space.components(vector, Frame::Global)
        }
        Some(ScalarExpr::Sum(terms)) => {
            let mut found = ZERO;
            for (place, (_, term)) in found.iter_mut().zip(terms) {
                if let ScalarExpr::Product(root, _) = term {
                    *place = root.value(space, motion);
                }
            }
            found
        }
        _ => ZERO,
    }
}

/// A value and its slope by the length.
type Dual = [f64; 2];

/// Numbers in the place of all that is not known of expressions.
struct Probe<'a> {
    arena: &'a Arena,
    length: &'a ScalarExpr,
    /// The length and its rate.
    at: [f64; 2],
    trial: u32,
}

/// Whether the force along a length is another one on the other side of zero.
fn jumps(arena: &Arena, effects: &[Effect], length: &ScalarExpr, trial: u32) -> bool {
    let along = |length_at: f64, rate: f64| {
        let probe = Probe {
            arena,
            length,
            at: [length_at, rate],
            trial,
        };
        effects
            .iter()
            .map(|effect| probe.along(effect))
            .sum::<f64>()
    };
    let [small, twice] = SMALL;
    let rate = number(trial, 1);
    let (before, after) = (along(small, -rate), along(small, rate));
    // Within a factor of the half of another: it neither vanishes nor grows without bound.
    let is_flat = |rate: f64, here: f64| (along(twice, rate) / here - 1.0).abs() < 0.1;
    let turned = (before + after).abs() > 1e-9 * (before.abs() + after.abs());
    turned && (is_flat(rate, after) || is_flat(-rate, before))
}

/// A number between 0.5 and 1.5 of either sign, the same whenever it is asked for.
fn number(trial: u32, of: u64) -> f64 {
    let mixed = (u64::from(trial) << 32 ^ of)
        .wrapping_add(0x9e37_79b9_7f4a_7c15)
        .wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ mixed >> 31).wrapping_mul(0x94d0_49bb_1331_11eb);
    let size = 0.5 + (mixed >> 12) as f64 / (1_u64 << 52) as f64;
    // The first trials are those of numbers as they mostly are.
    if trial > 2 && mixed & 1 == 1 {
        -size
    } else {
        size
    }
}

impl Probe<'_> {
    /// The force that lengthens the length.
    fn along(&self, effect: &Effect) -> f64 {
        match effect {
            Effect::Potential(energy) => -self.dual(energy)[1],
            Effect::Along(effort, coordinate) => self.dual(effort)[0] * self.dual(coordinate)[1],
            Effect::Force(vector, _) | Effect::Moment(vector, _) => {
                // A factor by which the separation itself may be multiplied.
                let mut sum = 0.0;
                factors(vector, &mut |factor| {
                    let mut lengths = Vec::new();
                    collect(factor, &mut lengths);
                    if lengths.contains(&self.length) {
                        sum += self.dual(factor)[0] * self.at[0];
                    }
                });
                sum
            }
        }
    }

    fn constant(&self, value: Expr) -> f64 {
        let known = |input: Input| {
            let place = match input {
                Input::Symbol(place) => u64::from(place) << 8,
                Input::Varying(place) => u64::from(place) << 8 | 2,
                Input::Coordinate(place) => u64::from(place) << 8 | 4,
                Input::Velocity(place) => u64::from(place) << 8 | 6,
                _ => 8,
            };
            Some(number(self.trial, place))
        };
        let values = evaluate(self.arena, &[value], known);
        // A spline has some value.
        values[0].unwrap_or_else(|| number(self.trial, 10))
    }

    fn dual(&self, scalar: &ScalarExpr) -> Dual {
        if scalar == self.length {
            return [self.at[0], 1.0];
        }
        if under(self.length) == Some(scalar) {
            return [self.at[0] * self.at[0], 2.0 * self.at[0]];
        }
        match scalar {
            ScalarExpr::Constant(value) => [self.constant(*value), 0.0],
            ScalarExpr::State { value, .. } | ScalarExpr::Setpoint([value, ..]) => {
                [self.constant(*value), 0.0]
            }
            ScalarExpr::Time => [number(self.trial, 3).abs(), 0.0],
            ScalarExpr::Dot(..) | ScalarExpr::Angle(_) => [self.unknown(scalar), 0.0],
            ScalarExpr::Sum(terms) => {
                terms.iter().fold([0.0; 2], |[sum, slope], (factor, term)| {
                    let factor = self.constant(*factor);
                    let [value, by] = self.dual(term);
                    [sum + factor * value, slope + factor * by]
                })
            }
            ScalarExpr::Product(a, b) => {
                let ([a, by_a], [b, by_b]) = (self.dual(a), self.dual(b));
                [a * b, a * by_b + b * by_a]
            }
            ScalarExpr::Function(function, inner) => {
                let [x, by] = self.dual(inner);
                let [value, slope] = self.function(*function, x);
                [value, if by == 0.0 { 0.0 } else { slope * by }]
            }
            ScalarExpr::Direction(angle) => {
                let ([s, ds], [c, dc]) = (self.dual(&angle.sine), self.dual(&angle.cosine));
                let area = c * ds - s * dc;
                let slope = if area == 0.0 {
                    0.0
                } else {
                    area / (c * c + s * s)
                };
                [s.atan2(c), slope]
            }
            ScalarExpr::Rate(inner) => {
                // Of what depends on the length, by the chain rule.
                let [_, by] = self.dual(inner);
                let rate = if by == 0.0 {
                    self.unknown(scalar)
                } else {
                    by * self.at[1]
                };
                [rate, 0.0]
            }
            ScalarExpr::Side { of, .. } => {
                let [value, _] = self.dual(of);
                [if value == 0.0 { 0.0 } else { value.signum() }, 0.0]
            }
            ScalarExpr::Select { side, parts } => {
                let [side, _] = self.dual(side);
                self.dual(&parts[usize::from(side < 0.0)])
            }
        }
    }

    /// A function and its slope.
    fn function(&self, function: Function, x: f64) -> Dual {
        if let Function::Curve(curve) = function {
            let place = u64::from(curve.spline) << 8 | u64::from(curve.derivative) << 4;
            return [12, 13].map(|k| number(self.trial, place | k));
        }
        let mut arena = Arena::new();
        let at = arena.input(Input::Time);
        let outputs = [
            function.value(&mut arena, at),
            function.slope(&mut arena, at),
        ];
        let values = evaluate(&arena, &outputs, |_| Some(x));
        [0, 1].map(|k| values[k].unwrap_or(f64::NAN))
    }

    /// Some number for what depends on where bodies are: the same for the same expression.
    fn unknown(&self, scalar: &ScalarExpr) -> f64 {
        let written = format!("{scalar:?}");
        let hashed = written.bytes().fold(7_u64, |hashed, byte| {
            hashed.wrapping_mul(31).wrapping_add(u64::from(byte))
        });
        number(self.trial, hashed)
    }
}
