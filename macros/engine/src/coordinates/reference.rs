//! What the recorded pivots of rows are compared with.
//!
//! A pivot is small if it is small beside what its row would be without the others. In joint
//! coordinates that vanishes as well where links are in line: the tree has taken what the row could
//! act on, and the pivot of the only row of a loop would never be small beside itself. So pivots
//! are compared with what their rows would be on free bodies, as those of the bodies are: with its
//! greatest value along a sweep where that varies little, which costs nothing.

use super::beginning::Beginning;
use super::stops::sweep;
use super::system::Reduced;
use crate::plan::eliminate::Check;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::evaluate::evaluate;
use crate::symbolic::vector::{Frame, Triple};

impl Reduced {
    /// Finds out what the rows are on free bodies, along a sweep; `None` of those that no number
    /// stands for.
    pub fn find_references(&mut self, beginning: &Beginning<'_>) {
        let mut trial = self.clone();
        let mobilities = trial.mobilities();
        let arena = &trial.scene.space.arena;
        let stops = sweep(arena, beginning, &trial.links);
        let mut known: Vec<Vec<f64>> = vec![Vec::new(); mobilities.len()];
        for (time, coordinates) in &stops {
            let values = evaluate(arena, &mobilities, |input| match input {
                Input::Coordinate(place) => coordinates.get(place as usize).copied(),
                Input::Time => Some(*time),
                _ => None,
            });
            for (known, value) in known.iter_mut().zip(values) {
                known.extend(value.filter(|value| value.is_finite() && *value > 0.0));
            }
        }
        self.references = known.iter().map(|known| size(known)).collect();
    }

    /// The same pivots, compared with what their rows are on free bodies; those that do not change
    /// with the state never vanish.
    #[must_use]
    pub fn referred(&mut self, checks: &[Check]) -> Vec<Check> {
        let mut mobilities = None;
        let referred = checks.iter().map(|check| {
            if self.scene.space.arena.stage(check.before) < Stage::State {
                return *check;
            }
            let known = self.references.get(check.unknown).copied().flatten();
            let before = match known {
                Some(greatest) => self.scene.space.arena.constant(greatest),
                None => mobilities.get_or_insert_with(|| self.mobilities())[check.unknown],
            };
            Check { before, ..*check }
        });
        referred.collect()
    }

    /// `d M^-1 d^T` of every row `d` of the Jacobian of the bodies. An angle that the coordinates
    /// hold acts on velocities by itself, but on free bodies by moments as any other.
    pub(super) fn mobilities(&mut self) -> Vec<Expr> {
        let mut mobilities = Vec::new();
        for place in 0..self.scene.constraints.len() {
            for gradient in self.scene.gradients_by_bodies(place, Frame::Global) {
                let scene = &mut self.scene;
                let mut sum = Arena::ZERO;
                for body in 0..scene.metric.len() {
                    let force = gradient.force(&mut scene.space, body);
                    if !scene.space.is_zero(force) {
                        let force = scene.space.components(force, Frame::Global);
                        let (mass, _) = scene.metric[body];
                        sum = plus_squares(&mut scene.space.arena, sum, force, [mass; 3]);
                    }
                    let moment = gradient.moment(&mut scene.space, body);
                    if !scene.space.is_zero(moment) {
                        let moment = scene.space.components(moment, Frame::Body(body));
                        let (_, inertia) = scene.metric[body];
                        sum = plus_squares(&mut scene.space.arena, sum, moment, inertia);
                    }
                }
                mobilities.push(sum);
            }
        }
        mobilities
    }
}

/// The greatest of some values, which stands for all of them. `None` where they are too far from
/// each other for that: of a row that is cubic in a distance, or of an angle near the point where
/// it is undefined.
fn size(values: &[f64]) -> Option<f64> {
    /// The least value over the greatest one.
    const LEAST: f64 = 1e-3;
    let least = values.iter().copied().reduce(f64::min)?;
    let greatest = values.iter().copied().reduce(f64::max)?;
    (least > LEAST * greatest).then_some(greatest)
}

/// `sum + v.v` with the squares over masses.
fn plus_squares(arena: &mut Arena, sum: Expr, v: Triple, masses: Triple) -> Expr {
    let mut sum = sum;
    for (component, mass) in v.into_iter().zip(masses) {
        let square = arena.square(component);
        let term = arena.div(square, mass);
        sum = arena.add(sum, term);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn only_values_near_to_each_other_have_a_size() {
        assert_eq!(size(&[2.0, 0.5, 1.0]), Some(2.0));
        assert_eq!(size(&[2.0, 1.7e8, 0.5, 1.0]), None);
        assert_eq!(size(&[3.0, 1e-4, 2.0]), None);
        assert_eq!(size(&[]), None);
    }
}
