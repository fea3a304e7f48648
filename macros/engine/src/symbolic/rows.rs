//! The rows of constraints: gradients, and combinations of `Phi`, its rate and its bias.

use super::arena::{Arena, Expr};
use super::expression::{Constraint, VectorExpr};
use super::motion::{Gradient, Motion};
use super::scene::{Constrained, Scene};
use super::vector::{Frame, Space, Triple, ZERO};

impl Scene {
    /// The gradients of a constraint's rows, in the given axes.
    pub fn gradients(&mut self, constraint: usize, frame: Frame) -> Vec<Gradient> {
        self.pulled_back(constraint, frame, Gradient::default)
    }

    /// The same, by forces and moments on the bodies alone.
    pub(crate) fn gradients_by_bodies(&mut self, constraint: usize, frame: Frame) -> Vec<Gradient> {
        self.pulled_back(constraint, frame, Gradient::by_bodies)
    }

    fn pulled_back(
        &mut self,
        constraint: usize,
        frame: Frame,
        empty: fn() -> Gradient,
    ) -> Vec<Gradient> {
        let (space, motion, constrained) = self.constrained(constraint);
        let of_velocities = constrained.of_velocities;
        match &constrained.constraint {
            Constraint::Scalar(scalar) => {
                let mut gradient = empty();
                if of_velocities {
                    scalar.pull_back_rates(space, motion, Arena::ONE, &mut gradient);
                } else {
                    scalar.pull_back(space, motion, Arena::ONE, &mut gradient);
                }
                vec![gradient]
            }
            Constraint::Vector(vector) => [0, 1, 2]
                .map(|k| {
                    let mut unit = ZERO;
                    unit[k] = Arena::ONE;
                    let covector = space.native(frame, unit);
                    let mut gradient = empty();
                    if of_velocities {
                        let factor = Arena::ONE;
                        vector.pull_back_rates(space, motion, factor, covector, &mut gradient);
                    } else {
                        vector.pull_back(space, motion, Arena::ONE, covector, &mut gradient);
                    }
                    gradient
                })
                .into(),
        }
    }

    /// `value * Phi + rate * Phi' + bias * (Phi'' without accelerations)` of a constraint, in the
    /// given axes. Equations of velocities are `Phi'` as they are written, and have no `Phi`.
    pub fn combination(
        &mut self,
        constraint: usize,
        frame: Frame,
        [value, rate, bias]: [Expr; 3],
    ) -> Vec<Expr> {
        let (space, motion, constrained) = self.constrained(constraint);
        // Of an equation of velocities, the expression is the rate.
        let [value, rate, bias] = if constrained.of_velocities {
            [rate, bias, Arena::ZERO]
        } else {
            [value, rate, bias]
        };
        let wanted = |factor: Expr| factor != Arena::ZERO;
        match &constrained.constraint {
            Constraint::Scalar(scalar) => {
                let mut sum = Arena::ZERO;
                let mut add = |space: &mut Space, factor: Expr, term: Expr| {
                    let product = space.arena.mul(factor, term);
                    sum = space.arena.add(sum, product);
                };
                if wanted(bias) {
                    let term = scalar.bias(space, motion);
                    add(space, bias, term);
                }
                if wanted(rate) {
                    let term = scalar.rate(space, motion);
                    add(space, rate, term);
                }
                if wanted(value) {
                    let term = scalar.value(space, motion);
                    add(space, value, term);
                }
                vec![sum]
            }
            Constraint::Vector(vector) => {
                let mut terms = Vec::new();
                if wanted(bias) {
                    terms.push((bias, vector.bias(space, motion)));
                }
                if wanted(rate) {
                    terms.push((rate, vector.rate(space, motion)));
                }
                if wanted(value) {
                    terms.push((value, vector.value(space, motion)));
                }
                let sum = space.sum(terms);
                space.components(sum, frame).into()
            }
        }
    }

    /// A constraint, and what its rows are computed in.
    fn constrained(&mut self, constraint: usize) -> (&mut Space, &Motion, &Constrained) {
        (&mut self.space, &self.motion, &self.constraints[constraint])
    }

    /// The vector that a constraint between positions holds at zero.
    fn between_vectors(&self, constraint: usize) -> Option<&VectorExpr> {
        match &self.constraints[constraint] {
            Constrained {
                constraint: Constraint::Vector(vector),
                of_velocities: false,
                ..
            } => Some(vector),
            _ => None,
        }
    }

    /// The point on a body that a constraint between vectors speaks of, from the centre of mass.
    #[must_use]
    pub fn point_on(&self, constraint: usize, body: usize) -> Option<Triple> {
        let VectorExpr::Sum(terms) = self.between_vectors(constraint)? else {
            return None;
        };
        let mut points = terms.iter().filter_map(|(_, term)| match term {
            VectorExpr::Point(Some(on), point) if *on == body => Some(*point),
            _ => None,
        });
        points.next().filter(|_| points.next().is_none())
    }

    /// What a constraint between vectors holds a point of a body to, if it is one point of another
    /// body or of the ground: the other body and the point there, from its centre of mass.
    #[must_use]
    pub fn joins(&self, constraint: usize, body: usize) -> Option<Option<(usize, Triple)>> {
        let VectorExpr::Sum(terms) = self.between_vectors(constraint)? else {
            return None;
        };
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for (factor, term) in terms {
            match term {
                VectorExpr::Point(Some(on), _) if *on == body => own.push(*factor),
                VectorExpr::Point(Some(on), point) => others.push((*factor, *on, *point)),
                VectorExpr::Point(None, _) | VectorExpr::Fixed(None, _) => {}
                _ => return None,
            }
        }
        match (&own[..], &others[..]) {
            ([factor], []) if factor.abs() == Arena::ONE => Some(None),
            ([factor], [(other, on, point)])
                if factor.abs() == Arena::ONE && *other == -*factor =>
            {
                Some(Some((*on, *point)))
            }
            _ => None,
        }
    }
}
