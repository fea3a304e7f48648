//! A mechanism as numbers: its constraints at a configuration, small motions, and the way back onto the constraints.
//!
//! Motions are measured without dimension: translations by the size of the mechanism, rotations in radians.

use super::TOLERANCE;
use super::dense::{Rows, norm, orthonormal, remove_all, solve_normal, transposed};
use crate::model::mechanism::Layout;
use crate::model::number::literals;
use crate::model::{Binding, BodyKind, Model, ParameterKind};
use crate::plan::kernels::{Block, Kernel, initial_state, jacobian, rows};
use crate::symbolic::arena::{Arena, Input};
use crate::symbolic::evaluate::evaluate;

/// A row of which no more than this is left anywhere is round-off, over the size that it should have at least.
const VANISHING: f64 = 1e-13;
/// Violations up to this, over the size of the row's gradient, are round-off.
const ASSEMBLED: f64 = 1e-9;
/// A violation this small that a step does not make ten times smaller is left as it is: it is round-off, or the constraints
/// touch each other only, and nearer to the point of contact their rows could not be told apart.
const FINE: f64 = 1e-12;
const STEPS: usize = 50;
const ATTEMPTS: usize = 12;

/// The coordinates of a configuration.
pub(super) type Configuration = Vec<f64>;

/// The constraints of a mechanism, ready to be evaluated.
pub(super) struct Constraints {
    kinds: Vec<BodyKind>,
    layout: Layout,
    /// The rows of each joint.
    counts: Vec<usize>,
    phi: Kernel,
    jacobian: Kernel,
    blocks: Vec<Block>,
    /// The size of the mechanism (m).
    length: f64,
    /// The size of each row's gradient near the start; `None` for a row that vanishes everywhere.
    sizes: Vec<Option<f64>>,
    /// What the size of a row is at least: that of an angle, a length or a squared length.
    least: f64,
}

impl Constraints {
    /// The constraints, and the configuration that the attributes describe; `None` where the macro cannot see a number that
    /// they depend on.
    pub(super) fn new(
        model: &Model,
        mut motion: impl FnMut(usize) -> Vec<f64>,
    ) -> Option<(Self, Configuration)> {
        let layout = model.layout();
        let initial = initial_state(model);
        let start: Option<Vec<f64>> = evaluate(&initial.arena, &initial.outputs, |_| None)
            .into_iter()
            .take(layout.coordinates + layout.auxiliaries)
            .collect();
        let start = start?;
        let (jacobian, blocks) = jacobian(model);
        let length = length(model);
        let mut constraints = Self {
            kinds: model.bodies.iter().map(|body| body.kind).collect(),
            counts: model
                .joints
                .iter()
                .map(|joint| model.equations(joint))
                .collect(),
            phi: rows(model, [Arena::ONE, Arena::ZERO, Arena::ZERO]),
            jacobian,
            blocks,
            length,
            sizes: Vec::new(),
            least: length.powi(2).min(1.0),
            layout,
        };
        constraints.evaluate(&constraints.phi, &start)?;
        // Off the constraints, so that a gradient that vanishes on them has a size.
        let mut sizes = vec![0.0_f64; constraints.layout.rows];
        for place in 0..3 {
            let mut at = start.clone();
            if place > 0 {
                at = constraints.moved(&at, &motion(constraints.layout.velocities));
            }
            for (size, row) in sizes.iter_mut().zip(constraints.gradients(&at)?) {
                *size = size.max(norm(&row));
            }
        }
        let least = VANISHING * constraints.least;
        constraints.sizes = sizes
            .into_iter()
            .map(|size| (size > least).then_some(size))
            .collect();
        Some((constraints, start))
    }

    /// The outputs of a kernel; `None` where one is not known, or beyond all numbers.
    fn evaluate(&self, kernel: &Kernel, at: &[f64]) -> Option<Vec<f64>> {
        let values = evaluate(&kernel.arena, &kernel.outputs, |input| match input {
            Input::Coordinate(place) => at.get(place as usize).copied(),
            Input::Symbol(_) => None,
            // The time at the start; neither Phi nor D depends on the others.
            Input::Time
            | Input::Velocity(_)
            | Input::RateGain
            | Input::PositionGain
            | Input::Compliance
            | Input::Upper(_)
            | Input::Lower(_) => Some(0.0),
        });
        values
            .into_iter()
            .map(|value| value.filter(|value| value.is_finite()))
            .collect()
    }

    /// `D` over motions without dimension.
    fn gradients(&self, at: &[f64]) -> Option<Rows> {
        let values = self.evaluate(&self.jacobian, at)?;
        let mut rows = vec![vec![0.0; self.layout.velocities]; self.layout.rows];
        for &Block {
            joint,
            body,
            offset,
        } in &self.blocks
        {
            let columns = self.kinds[body].velocities();
            let first = self.layout.velocity[body];
            let own = &mut rows[self.layout.row[joint]..][..self.counts[joint]];
            for (row, values) in own.iter_mut().zip(values[offset..].chunks(columns)) {
                for (k, value) in values.iter().enumerate() {
                    row[first + k] = if k < 3 { value * self.length } else { *value };
                }
            }
        }
        Some(rows)
    }

    /// The rows of `D` over motions without dimension, of unit length; those beneath the tolerance are zero.
    pub(super) fn directions(&self, at: &[f64], tolerance: f64) -> Option<Rows> {
        let mut rows = self.gradients(at)?;
        for (row, size) in rows.iter_mut().zip(&self.sizes) {
            let length = norm(row);
            let is_sound = size.is_some_and(|size| length > tolerance * size);
            let factor = if is_sound { length.recip() } else { 0.0 };
            row.iter_mut().for_each(|x| *x *= factor);
        }
        Some(rows)
    }

    /// The violations, over the sizes of the gradients: about the distances to where the constraints hold.
    fn violations(&self, at: &[f64]) -> Option<Vec<f64>> {
        let mut values = self.evaluate(&self.phi, at)?;
        for (value, size) in values.iter_mut().zip(&self.sizes) {
            if *value != 0.0 {
                *value /= size.unwrap_or(self.least);
            }
        }
        Some(values)
    }

    /// Another configuration after a motion without dimension. Coordinates that belong to no body stay as they are.
    pub(super) fn moved(&self, at: &[f64], motion: &[f64]) -> Configuration {
        let mut moved = at.to_vec();
        for (body, kind) in self.kinds.iter().enumerate() {
            let (q, u) = (self.layout.coordinate[body], self.layout.velocity[body]);
            for k in 0..3 {
                moved[q + k] += self.length * motion[u + k];
            }
            if *kind == BodyKind::Rigid {
                let turned = turned(
                    [3, 4, 5, 6].map(|k| at[q + k]),
                    [3, 4, 5].map(|k| motion[u + k]),
                );
                moved[q + 3..q + 7].copy_from_slice(&turned);
            }
        }
        moved
    }

    /// A configuration near the given one that satisfies the constraints (Levenberg and Marquardt: steps of least length
    /// where the gradients are independent, and no worse where they are not).
    pub(super) fn assembled(&self, from: &[f64]) -> Option<Configuration> {
        const BOUND: f64 = 0.5;
        let mut at = from.to_vec();
        let mut violations = self.violations(&at)?;
        let mut size = norm(&violations);
        let mut caution = 1.0;
        for _ in 0..STEPS {
            if size == 0.0 {
                break;
            }
            let mut gradients = self.gradients(&at)?;
            for (row, size) in gradients.iter_mut().zip(&self.sizes) {
                let factor = size.map_or(0.0, f64::recip);
                row.iter_mut().for_each(|x| *x *= factor);
            }
            let mut next = None;
            for _ in 0..ATTEMPTS {
                let damping = (caution * size * size).max(1e-14);
                if let Some(y) = solve_normal(&gradients, &violations, damping) {
                    let step = transposed(&gradients, &y);
                    let factor = -(BOUND / norm(&step)).min(1.0);
                    let step: Vec<f64> = step.iter().map(|x| factor * x).collect();
                    let reached = self.moved(&at, &step);
                    let violations = self.violations(&reached)?;
                    let reduced = norm(&violations);
                    if reduced < size {
                        next = Some((reached, violations, reduced));
                        break;
                    }
                }
                if size <= FINE {
                    break;
                }
                caution *= 10.0;
            }
            let Some((reached, reached_violations, reduced)) = next else {
                break;
            };
            let is_done = reduced <= FINE && reduced > 0.1 * size;
            (at, violations, size) = (reached, reached_violations, reduced);
            caution = (0.1 * caution).max(1.0);
            if is_done {
                break;
            }
        }
        (size <= ASSEMBLED).then_some(at)
    }
}

/// The rows of `D` at configurations along a motion that the constraints leave free, straight on as far as they let it: a few turns
/// of what turns fastest. None where nothing can move.
pub(super) fn tour(constraints: &Constraints, start: &[f64], mut heading: Vec<f64>) -> Vec<Rows> {
    const STOPS: usize = 60;
    const STEP: f64 = 0.3;
    let mut rows = Vec::new();
    let mut at = start.to_vec();
    for _ in 0..STOPS {
        let Some(here) = constraints.directions(&at, TOLERANCE) else {
            break;
        };
        remove_all(&mut heading, &orthonormal(&here, TOLERANCE));
        rows.push(here);
        let largest = heading.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if largest < TOLERANCE {
            break;
        }
        heading.iter_mut().for_each(|x| *x *= STEP / largest);
        let Some(reached) = constraints.assembled(&constraints.moved(&at, &heading)) else {
            break;
        };
        at = reached;
    }
    rows
}

/// Euler parameters, of unit length, after a small rotation about an axis of the body.
fn turned(p: [f64; 4], rotation: [f64; 3]) -> [f64; 4] {
    let [x, y, z] = rotation.map(|component| 0.5 * component);
    let turned = crate::model::inertia::compose(p, [1.0, x, y, z]);
    let length = norm(&turned);
    turned.map(|e| e / length)
}

/// The largest distance of a body or a joint's point from the mean of all of them; one where there is none.
fn length(model: &Model) -> f64 {
    let mut points: Vec<[f64; 3]> = model
        .bodies
        .iter()
        .filter_map(|body| literals(&body.position))
        .collect();
    for joint in &model.joints {
        let parameters = &model.definition(joint).parameters;
        for (parameter, binding) in parameters.iter().zip(&joint.bindings) {
            if parameter.kind != ParameterKind::Point {
                continue;
            }
            match binding {
                Binding::Global(point) => points.extend(literals(point)),
                Binding::Local(arms) => {
                    for (arm, body) in arms.iter().zip(&joint.bodies) {
                        let centre = body.map_or(Some([0.0; 3]), |body| {
                            literals(&model.bodies[body].position)
                        });
                        // Its direction does not matter for a size.
                        if let (Some(arm), Some(centre)) = (literals(arm), centre) {
                            points.push([0, 1, 2].map(|k| centre[k] + arm[k]));
                        }
                    }
                }
                Binding::Scalar(_) | Binding::Law(_) | Binding::Default => {}
            }
        }
    }
    let count = points.len() as f64;
    let mean = [0, 1, 2].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let largest = points
        .iter()
        .map(|point| norm(&[0, 1, 2].map(|k| point[k] - mean[k])))
        .fold(0.0, f64::max);
    if largest.is_normal() { largest } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::turned;

    #[test]
    fn a_small_rotation_is_about_an_axis_of_the_body() {
        let [w, x, y, z] = turned([0.5, 0.5, 0.5, 0.5], [0.0, 0.0, 2e-3]);
        // The body's z axis is the global x axis here: p' = 1/2 (0, w, 0, 0) p.
        let expected = [0.5 - 5e-4, 0.5 + 5e-4, 0.5 - 5e-4, 0.5 + 5e-4];
        for (found, expected) in [w, x, y, z].into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6);
        }
    }
}
