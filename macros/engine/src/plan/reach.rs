//! What each row of `D` acts on, the ground included.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::model::{BodyKind, Model};
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::scene::Scene;
use crate::symbolic::vector::{Frame, Triple, ZERO};

/// What the rows act on.
pub(super) struct Reach {
    /// The bodies that a row acts on; `None` is the ground.
    pub(super) rows: Vec<BTreeSet<Option<usize>>>,
    /// The rows of each constraint, with its joint.
    pub(super) constraints: Vec<(usize, Range<usize>)>,
}

/// A sum below this, relative to its terms, is round-off.
const ROUND_OFF: f64 = 1e-11;

/// Force and moment of a row on a body, global axes.
type Wrench = [Triple; 2];

impl Reach {
    /// Forces and moments of a row on the bodies cancel unless it speaks of the ground: then, and
    /// where it cannot be told, the ground is counted. This is tried at one state that has nothing
    /// special.
    pub(super) fn new(model: &Model, mut scene: Scene) -> Self {
        let mut wrenches: Vec<Vec<(usize, Wrench)>> = Vec::new();
        let mut slopes: Vec<Triple> = Vec::new();
        for constraint in 0..scene.constraints.len() {
            for gradient in scene.gradients(constraint, Frame::Global) {
                let mut row = Vec::new();
                for (body, described) in model.bodies.iter().enumerate() {
                    let force = gradient.force(&mut scene.space, body);
                    let force = scene.space.components(force, Frame::Global);
                    let moment = match described.kind {
                        BodyKind::Rigid => {
                            let moment = gradient.moment(&mut scene.space, body);
                            scene.space.components(moment, Frame::Global)
                        }
                        BodyKind::Particle => ZERO,
                    };
                    if [force, moment] != [ZERO; 2] {
                        row.push((body, [force, moment]));
                    }
                }
                wrenches.push(row);
            }
            slopes.extend(turned(&mut scene, constraint));
        }
        let state = State::generic(model);
        let outputs: Vec<Expr> = wrenches
            .iter()
            .flatten()
            .flat_map(|(_, wrench)| wrench.iter().flatten())
            .chain(slopes.iter().flatten())
            .copied()
            .collect();
        let values = evaluate(&scene.space.arena, &outputs, |input| state.input(input));
        let mut values = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
        let mut next = || [0; 3].map(|_| values.next().unwrap_or(f64::NAN));
        let sums: Vec<Sum> = wrenches
            .iter()
            .map(|row| {
                let mut sum = Sum::default();
                for (body, _) in row {
                    let first = scene.layout.coordinate[*body];
                    let arm = [0, 1, 2].map(|k| state.coordinates[first + k]);
                    let force = next();
                    sum.add(0, force);
                    sum.add(1, next());
                    sum.add(1, cross(arm, force));
                }
                sum
            })
            .collect();
        let rows = wrenches
            .iter()
            .zip(sums)
            .map(|(row, mut sum)| {
                sum.add(1, next().map(|x| -x));
                let ground = (!sum.vanishes()).then_some(None);
                row.iter()
                    .map(|(body, _)| Some(*body))
                    .chain(ground)
                    .collect()
            })
            .collect();
        let constraints = scene.constraints.iter();
        let constraints = constraints
            .map(|c| (c.joint, c.row..c.row + c.equations()))
            .collect();
        Self { rows, constraints }
    }

    /// How many rows of a joint act on a body, those of vector constraints counted twice; `None` if
    /// none does.
    pub(super) fn weight(&self, joint: usize, body: usize) -> Option<usize> {
        let own = self.constraints.iter().filter(|(of, _)| *of == joint);
        let weight: usize = own
            .map(|(_, rows)| {
                let acts = |row: &usize| self.rows[*row].contains(&Some(body));
                match rows.clone().filter(acts).count() {
                    3 => 6,
                    count => count,
                }
            })
            .sum();
        (weight > 0).then_some(weight)
    }
}

/// What turning all bodies together does to the rows of a constraint: nothing to a scalar, `v x e`
/// for the component of a vector `v` along `e`, which vanishes on the constraints.
fn turned(scene: &mut Scene, constraint: usize) -> Vec<Triple> {
    let factors = [Arena::ONE, Arena::ZERO, Arena::ZERO];
    match scene.combination(constraint, Frame::Global, factors)[..] {
        [x, y, z] => vec![
            [Arena::ZERO, z, -y],
            [-z, Arena::ZERO, x],
            [y, -x, Arena::ZERO],
        ],
        _ => vec![ZERO],
    }
}

/// A sum of forces and moments, and of their sizes.
#[derive(Default)]
struct Sum {
    sum: [[f64; 3]; 2],
    size: [f64; 2],
}

impl Sum {
    fn add(&mut self, which: usize, term: [f64; 3]) {
        for (sum, term) in self.sum[which].iter_mut().zip(term) {
            *sum += term;
            self.size[which] += term.abs();
        }
    }

    fn vanishes(&self) -> bool {
        let parts = self.sum.iter().zip(self.size);
        parts
            .into_iter()
            .all(|(sum, size)| sum.iter().all(|x| x.abs() <= ROUND_OFF * size))
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| a[k] * b[l] - a[l] * b[k])
}

/// A state that no constraint knows of.
struct State {
    coordinates: Vec<f64>,
}

impl State {
    fn input(&self, input: Input) -> Option<f64> {
        match input {
            Input::Coordinate(place) => self.coordinates.get(place as usize).copied(),
            Input::Time => Some(0.37),
            Input::Symbol(place) | Input::Varying(place) => {
                Some(spread(0x51 + u64::from(place)).abs() + 0.5)
            }
            _ => None,
        }
    }

    /// Euler parameters are of length 1.
    fn generic(model: &Model) -> Self {
        let layout = model.layout();
        let places = 0..layout.stored();
        let mut coordinates: Vec<f64> = places.map(|place| spread(place as u64)).collect();
        for (body, &first) in model.bodies.iter().zip(&layout.coordinate) {
            if body.kind == BodyKind::Rigid {
                let p = &mut coordinates[first + 3..first + 7];
                let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
                p.iter_mut().for_each(|e| *e /= length);
            }
        }
        Self { coordinates }
    }
}

/// A number between -1 and 1 for each place, without a pattern (Steele et al. 2014, SplitMix).
fn spread(place: u64) -> f64 {
    let mut x = place.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
