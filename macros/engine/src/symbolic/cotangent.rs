//! How a weighted sum of what an arena holds changes with its inputs: backward, node by node.
//!
//! Griewank and Walther, *Evaluating Derivatives*, chapter 3. It takes a few times the operations
//! of the sum itself, however many inputs there are.

use std::collections::BTreeMap;

use super::arena::{Arena, Expr, Input, Node, Stage};

/// What the sum changes by with each input.
pub(crate) type Gradient = BTreeMap<Input, Expr>;

/// The gradient of `sum of w y` over pairs of a weight and an output, by the inputs that are asked
/// for; the weights do not change with these. What the sum does not depend on has no entry.
pub(crate) fn gradient(
    arena: &mut Arena,
    sum: &[(Expr, Expr)],
    is_asked: impl Fn(Input) -> bool,
) -> Gradient {
    let outputs: Vec<Expr> = sum.iter().map(|&(_, output)| output).collect();
    let live = arena.live(&outputs, Stage::Parameter);
    let size = live.last().map_or(0, |last| last + 1);
    let mut moves = vec![false; size];
    for &place in &live {
        let node = arena.node(place);
        moves[place] = match node {
            Node::Input(input) => is_asked(input),
            // Of steps and sides there is no slope.
            Node::Constant(_) | Node::Sign(_) | Node::Round(_) | Node::Side(..) => false,
            _ => node.operands().any(|operand| at(&moves, operand)),
        };
    }
    let mut slopes = Slopes {
        by: vec![Groups::new(); size],
        is_plain: plain(arena, &live, &moves),
        moves,
    };
    for &(weight, output) in sum {
        slopes.add(arena, output, (Mask::new(), weight));
    }
    let mut found = Gradient::new();
    for &place in live.iter().rev() {
        for (mask, slope) in std::mem::take(&mut slopes.by[place]) {
            if slope == Arena::ZERO {
                continue;
            }
            match arena.node(place) {
                Node::Input(input) => {
                    found.insert(input, slope);
                }
                node => slopes.hand_down(arena, node, &mask, slope),
            }
        }
    }
    found
}

/// Sides and whether a slope is there where they are not negative, or where they are. Elsewhere it
/// is zero, whatever it would be without: there roots and quotients may have no slope.
type Mask = Vec<(Expr, bool)>;

/// Slopes, by where they are there.
type Groups = BTreeMap<Mask, Expr>;

fn masked(arena: &mut Arena, mask: Mask, slope: Expr) -> Expr {
    mask.into_iter()
        .rev()
        .fold(slope, |slope, (side, is_above)| {
            if is_above {
                arena.above(side, slope)
            } else {
                arena.below(side, slope)
            }
        })
}

/// The nodes whose slopes are finite wherever their values are, and so are those below them: no
/// mask needs to be carried further.
fn plain(arena: &Arena, live: &[usize], moves: &[bool]) -> Vec<bool> {
    let mut plain = vec![true; moves.len()];
    for &place in live {
        let node = arena.node(place);
        let is_plain = match node {
            Node::Input(_)
            | Node::Add(..)
            | Node::Multiply(..)
            | Node::Sine(_)
            | Node::Cosine(_) => true,
            _ => !moves[place],
        };
        let mut operands = node.operands();
        plain[place] = is_plain && operands.all(|operand| at_or(&plain, operand, true));
    }
    plain
}

/// Whether what a reference is of changes. What is known earlier does not.
fn at(moves: &[bool], operand: Expr) -> bool {
    at_or(moves, operand, false)
}

fn at_or(known: &[bool], operand: Expr, otherwise: bool) -> bool {
    known.get(operand.node()).copied().unwrap_or(otherwise)
}

/// What the sum changes by with each node.
struct Slopes {
    by: Vec<Groups>,
    is_plain: Vec<bool>,
    moves: Vec<bool>,
}

impl Slopes {
    /// Adds what the sum changes by with a signed reference.
    fn add(&mut self, arena: &mut Arena, operand: Expr, (mut mask, mut slope): (Mask, Expr)) {
        if !at(&self.moves, operand) {
            return;
        }
        if self.is_plain[operand.node()] {
            slope = masked(arena, std::mem::take(&mut mask), slope);
        }
        let slope = if operand.is_negative() { -slope } else { slope };
        let known = self.by[operand.node()].entry(mask).or_insert(Arena::ZERO);
        *known = arena.add(*known, slope);
    }

    /// Hands what the sum changes by with an operation down to its operands.
    fn hand_down(&mut self, arena: &mut Arena, node: Node, mask: &Mask, slope: Expr) {
        let mut mask = mask.clone();
        let value = |arena: &mut Arena| arena.again(node, |operand| operand);
        let parts: [Option<(Expr, Expr)>; 2] = match node {
            Node::Constant(_)
            | Node::Input(_)
            | Node::Sign(_)
            | Node::Round(_)
            | Node::Side(..) => [None, None],
            Node::Add(a, b) => [Some((a, slope)), Some((b, slope))],
            Node::Multiply(a, b) => [(a, b), (b, a)].map(|(operand, other)| {
                let needed = at(&self.moves, operand);
                needed.then(|| (operand, arena.mul(slope, other)))
            }),
            Node::Reciprocal(a) => {
                let value = value(arena);
                let square = arena.square(value);
                [Some((a, -arena.mul(square, slope))), None]
            }
            Node::SquareRoot(a) => {
                let value = value(arena);
                let twice = arena.add(value, value);
                [Some((a, arena.div(slope, twice))), None]
            }
            Node::Clamp(a) => {
                // Of 0 and 1 the derivative from inside.
                let above = arena.sub(Arena::ONE, a);
                mask.extend([(arena.sign(a), true), (arena.sign(above), true)]);
                [Some((a, slope)), None]
            }
            Node::Sine(a) => {
                let cosine = arena.cos(a);
                [Some((a, arena.mul(cosine, slope))), None]
            }
            Node::Cosine(a) => {
                let sine = arena.sin(a);
                [Some((a, -arena.mul(sine, slope))), None]
            }
            Node::Exponential(a) => {
                let value = value(arena);
                [Some((a, arena.mul(value, slope))), None]
            }
            Node::Angle(sine, cosine) => {
                let (a, b) = (arena.square(sine), arena.square(cosine));
                let square = arena.add(a, b);
                let share = arena.div(slope, square);
                let (along, across) = (arena.mul(cosine, share), arena.mul(sine, share));
                [Some((sine, along)), Some((cosine, -across))]
            }
            Node::Above(side, a) | Node::Below(side, a) => {
                mask.push((side, matches!(node, Node::Above(..))));
                [Some((a, slope)), None]
            }
            Node::Curve(curve, a) => {
                let rate = arena.curve(curve.derived(), a);
                [Some((a, arena.mul(rate, slope))), None]
            }
        };
        for (operand, slope) in parts.into_iter().flatten() {
            self.add(arena, operand, (mask.clone(), slope));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::evaluate::evaluate;
    use crate::symbolic::tangent::{Direction, along};

    const INPUTS: [Input; 2] = [Input::Coordinate(0), Input::Coordinate(1)];

    /// The gradient of `2 f - 3 g` at a point, and the same forward.
    fn both(at: [f64; 2], of: impl Fn(&mut Arena, [Expr; 2]) -> [Expr; 2]) -> [[f64; 2]; 2] {
        let mut arena = Arena::new();
        let arena = &mut arena;
        let inputs = INPUTS.map(|input| arena.input(input));
        let outputs = of(arena, inputs);
        let weights = [2.0, -3.0].map(|weight| arena.constant(weight));
        let sum = [0, 1].map(|k| (weights[k], outputs[k]));
        let backward = gradient(arena, &sum, |_| true);
        let backward = INPUTS.map(|input| backward.get(&input).copied().unwrap_or(Arena::ZERO));
        let directions = INPUTS.map(|input| Direction::from([(input, Arena::ONE)]));
        let columns = along(arena, &outputs, &directions);
        let forward = columns.into_iter().map(|column| {
            let terms = [0, 1].map(|k| arena.mul(weights[k], column[k]));
            arena.sum(terms)
        });
        let forward: Vec<Expr> = forward.collect();
        let known = |input| {
            INPUTS
                .iter()
                .position(|&other| other == input)
                .map(|k| at[k])
        };
        [backward.as_slice(), &forward].map(|slopes| {
            let values = evaluate(arena, slopes, known);
            [0, 1].map(|k| values[k].expect("known"))
        })
    }

    #[test]
    fn backward_is_forward() {
        for at in [[0.3, -0.7], [-1.2, 0.4], [0.05, 2.0]] {
            let [backward, forward] = both(at, |arena, [x, y]| {
                let (sine, root, power) = (arena.sin(x), arena.mul(x, y), arena.exp(y));
                let square = arena.square(root);
                let long = arena.add(square, Arena::ONE);
                let (long, angle) = (arena.sqrt(long), arena.atan2(sine, power));
                let share = arena.div(angle, long);
                let (step, whole) = (arena.clamp(share), arena.cos(power));
                let side = arena.sub(x, y);
                let chosen = arena.select(side, step, whole);
                let first = arena.mul(chosen, share);
                [arena.sub(first, x), arena.mul(first, root)]
            });
            for (found, wanted) in backward.into_iter().zip(forward) {
                assert!((found - wanted).abs() < 1e-13, "{backward:?} {forward:?}");
            }
        }
    }

    /// Springs behind two clearances, at the middle: a length of zero has no slope, and nothing
    /// asks for it.
    #[test]
    fn what_is_masked_has_no_slope() {
        let [backward, forward] = both([0.0, 0.0], |arena, [x, y]| {
            let (a, b) = (arena.square(x), arena.square(y));
            let square = arena.add(a, b);
            let length = arena.sqrt(square);
            let clearances = [0.2, 0.3].map(|clearance| {
                let clearance = arena.constant(clearance);
                let beyond = arena.sub(length, clearance);
                let step = arena.clamp(beyond);
                arena.square(step)
            });
            let spring = arena.add(clearances[0], clearances[1]);
            let pushed = arena.mul(spring, x);
            [arena.add(pushed, y), spring]
        });
        assert_eq!((backward, forward), ([0.0, 2.0], [0.0, 2.0]));
    }
}
