//! The kernels of a mechanism by numbers, and a dense solution of the same saddle system to judge
//! them.

use holonom_engine::model::{BodyKind, Model};
use holonom_engine::plan::Plan;
use holonom_engine::plan::candidates::equations_of_motion;
use holonom_engine::plan::eliminate::Check;
use holonom_engine::plan::kernels::{Evaluation, Kernels};
use holonom_engine::plan::system::Terms;
use holonom_engine::symbolic::arena::{Arena, Expr, Input};
use holonom_engine::symbolic::equations::Kernel;
use holonom_engine::symbolic::evaluate::evaluate;
use holonom_engine::symbolic::scene::Scene;

/// The compliance of the compliant systems here.
const COMPLIANCE: f64 = 1e-3;

/// The numbers here that the macro cannot see.
pub(crate) const SYMBOL: f64 = 2.0;

/// Numbers between -1 and 1 (Marsaglia's xorshift).
#[derive(Clone)]
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        ((self.number() + 1.0) / 2.0 * bound as f64) as usize % bound
    }
}

/// A state of a mechanism.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) coordinates: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
}

impl State {
    /// As described.
    pub(crate) fn described(model: &Model, kernels: &Kernels) -> Self {
        let nothing = Self {
            coordinates: Vec::new(),
            velocities: Vec::new(),
        };
        let mut coordinates = nothing.of(&kernels.initial_state);
        let layout = model.layout();
        let velocities = coordinates.split_off(layout.coordinates + layout.auxiliaries);
        Self {
            coordinates,
            velocities,
        }
    }

    /// Somewhere near, on the constraints or not, with Euler parameters of length 1, and moving.
    pub(crate) fn near(&self, model: &Model, size: f64, dice: &mut Dice) -> Self {
        let layout = model.layout();
        let mut state = self.clone();
        state.coordinates[..layout.coordinates]
            .iter_mut()
            .for_each(|x| *x += size * dice.number());
        state
            .velocities
            .iter_mut()
            .for_each(|x| *x += dice.number());
        for (body, &first) in model.bodies.iter().zip(&layout.coordinate) {
            if body.kind == BodyKind::Rigid {
                let p = &mut state.coordinates[first + 3..first + 7];
                let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
                p.iter_mut().for_each(|e| *e /= length);
            }
        }
        state
    }

    fn values(&self, arena: &Arena, outputs: &[Expr]) -> Vec<f64> {
        let values = evaluate(arena, outputs, |input| match input {
            Input::Coordinate(place) => self.coordinates.get(place as usize).copied(),
            Input::Velocity(place) => self.velocities.get(place as usize).copied(),
            Input::Time => Some(0.3),
            Input::Compliance(_) => Some(COMPLIANCE),
            Input::Symbol(_) | Input::Varying(_) => Some(SYMBOL),
            _ => None,
        });
        values
            .into_iter()
            .map(|value| value.expect("a known input"))
            .collect()
    }

    pub(crate) fn of(&self, kernel: &Kernel) -> Vec<f64> {
        self.values(&kernel.arena, &kernel.outputs)
    }

    /// The standard formulation by a plan.
    pub(crate) fn by_plan(&self, model: &Model, plan: &Plan) -> Evaluated {
        let mut scene = Scene::for_solution(model);
        let (solution, system) = equations_of_motion(&mut scene, model, plan.clone(), Terms::Plain);
        let checks = system.checks(&scene);
        let arena = &scene.space.arena;
        let of = |outputs: &[Expr]| self.values(arena, outputs);
        let [pivots, before] =
            [|check: &Check| check.pivot, |check: &Check| check.before].map(|part| {
                let outputs: Vec<Expr> = checks.iter().map(part).collect();
                of(&outputs)
            });
        Evaluated {
            solution: of(&[solution.accelerations, solution.multipliers].concat()),
            pivots: pivots.iter().zip(before).map(|(a, b)| a / b).collect(),
        }
    }
}

/// What a fused evaluation gives.
pub(crate) struct Evaluated {
    /// Accelerations, then multipliers.
    pub(crate) solution: Vec<f64>,
    /// The relative pivots.
    pub(crate) pivots: Vec<f64>,
}

/// The fused evaluation of some terms.
pub(crate) fn evaluated(
    model: &Model,
    kernels: &Kernels,
    terms: Terms,
    state: &State,
) -> Evaluated {
    let is_wanted = |known: &&Evaluation| known.terms == terms;
    let evaluation = kernels
        .evaluations
        .iter()
        .find(is_wanted)
        .expect("all are there");
    let layout = model.layout();
    let mut values = state.of(&evaluation.kernel);
    let mut solution = values.split_off(layout.coordinates + layout.auxiliaries);
    let pivots = solution.split_off(layout.velocities + layout.rows);
    Evaluated { solution, pivots }
}

/// The same by `D`, `gamma`, the masses and the forces, by elimination with the largest pivot; and
/// how far from singular the system is: the smallest pivot over the largest entry of the scaled
/// matrix.
pub(crate) fn dense(
    model: &Model,
    kernels: &Kernels,
    state: &State,
    compliance: f64,
) -> (Vec<f64>, f64) {
    let layout = model.layout();
    let (velocities, rows) = (layout.velocities, layout.rows);
    let size = velocities + rows;
    let mut matrix = vec![vec![0.0; size + 1]; size];
    for (k, mass) in state.of(&kernels.mass).into_iter().enumerate() {
        matrix[k][k] = mass;
    }
    let jacobian = state.of(&kernels.jacobian);
    for block in &kernels.blocks {
        let columns = model.bodies[block.body].kind.velocities();
        for row in 0..model.equations(&model.joints[block.joint]) {
            for column in 0..columns {
                let value = jacobian[block.offset + row * columns + column];
                let (k, l) = (
                    velocities + layout.row[block.joint] + row,
                    layout.velocity[block.body] + column,
                );
                matrix[k][l] = value;
                matrix[l][k] = value;
            }
        }
    }
    for (k, row) in matrix.iter_mut().enumerate().skip(velocities) {
        row[k] = -compliance;
    }
    for (k, force) in state.of(&kernels.forces).into_iter().enumerate() {
        matrix[k][size] = force;
    }
    for (k, gamma) in state.of(&kernels.gamma).into_iter().enumerate() {
        matrix[velocities + k][size] = gamma;
    }
    solved(matrix)
}

pub(crate) fn compliance() -> f64 {
    COMPLIANCE
}

fn solved(mut matrix: Vec<Vec<f64>>) -> (Vec<f64>, f64) {
    let size = matrix.len();
    let mut smallest = f64::INFINITY;
    for k in 0..size {
        let pivot = (k..size)
            .max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs()))
            .unwrap_or(k);
        matrix.swap(k, pivot);
        smallest = smallest.min(matrix[k][k].abs());
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        for other in below {
            let factor = other[k] / row[k];
            if factor != 0.0 {
                other
                    .iter_mut()
                    .zip(row)
                    .skip(k)
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let mut solution = vec![0.0; size];
    for k in (0..size).rev() {
        let known: f64 = (k + 1..size).map(|l| matrix[k][l] * solution[l]).sum();
        solution[k] = (matrix[k][size] - known) / matrix[k][k];
    }
    (solution, smallest)
}

/// The largest difference over the largest number.
pub(crate) fn deviation(found: &[f64], wanted: &[f64]) -> f64 {
    assert_eq!(found.len(), wanted.len());
    let largest = wanted.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    let worst = |worst: f64, (a, b): (&f64, &f64)| {
        let difference = (a - b).abs() / largest;
        // Not a number is a deviation.
        if difference <= worst {
            worst
        } else {
            difference
        }
    };
    found.iter().zip(wanted).fold(0.0, worst)
}
