//! The rows of constraints: gradients, and combinations of `Phi`, its rate and its bias.

use super::arena::{Arena, Expr};
use super::expression::{Constraint, ScalarExpr, VectorExpr};
use super::motion::{Gradient, Motion};
use super::scene::{Constrained, Scene};
use super::vector::{Frame, Space, Triple, VectorId, ZERO};

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
        let Self {
            space,
            motion,
            constraints,
            ..
        } = self;
        let Constrained {
            constraint,
            of_velocities,
            ..
        } = &constraints[constraint];
        match constraint {
            Constraint::Scalar(scalar) => {
                let mut gradient = empty();
                if *of_velocities {
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
                    if *of_velocities {
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
        let Self {
            space,
            motion,
            constraints,
            ..
        } = self;
        let Constrained {
            constraint,
            of_velocities,
            ..
        } = &constraints[constraint];
        let wanted = |factor: Expr| factor != Arena::ZERO;
        match constraint {
            Constraint::Scalar(scalar) => {
                type Of = fn(&ScalarExpr, &mut Space, &Motion) -> Expr;
                let terms: [(Expr, Of); 3] = if *of_velocities {
                    let (of_rate, of_value): (Of, Of) = (ScalarExpr::rate, ScalarExpr::value);
                    [(bias, of_rate), (rate, of_value), (Arena::ZERO, of_value)]
                } else {
                    [
                        (bias, ScalarExpr::bias),
                        (rate, ScalarExpr::rate),
                        (value, ScalarExpr::value),
                    ]
                };
                let mut sum = Arena::ZERO;
                for (factor, of) in terms.into_iter().filter(|(factor, _)| wanted(*factor)) {
                    let term = of(scalar, space, motion);
                    let product = space.arena.mul(factor, term);
                    sum = space.arena.add(sum, product);
                }
                vec![sum]
            }
            Constraint::Vector(vector) => {
                type Of = fn(&VectorExpr, &mut Space, &Motion) -> VectorId;
                let terms: [(Expr, Of); 3] = if *of_velocities {
                    let (of_rate, of_value): (Of, Of) = (VectorExpr::rate, VectorExpr::value);
                    [(bias, of_rate), (rate, of_value), (Arena::ZERO, of_value)]
                } else {
                    [
                        (bias, VectorExpr::bias),
                        (rate, VectorExpr::rate),
                        (value, VectorExpr::value),
                    ]
                };
                let terms = terms.into_iter().filter(|(factor, _)| wanted(*factor));
                let terms: Vec<_> = terms
                    .map(|(factor, of)| (factor, of(vector, space, motion)))
                    .collect();
                let sum = space.sum(terms);
                space.components(sum, frame).into()
            }
        }
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
