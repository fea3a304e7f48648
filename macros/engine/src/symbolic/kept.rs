//! Constraints of which some equations are left out.

use super::arena::Arena;
use super::expression::{Constraint, ScalarExpr, VectorExpr};
use super::vector::{Triple, ZERO};
use crate::model::Element;

/// What is left of a constraint whose first equation stands at `first` among those of its joint's
/// definition. Of three equations the remaining ones become scalar products with unit vectors,
/// which are fixed on the ground or on a body of the joint ([`Element::components_of`]).
pub(super) fn kept(
    arena: &mut Arena,
    constraint: Constraint,
    first: usize,
    joint: &Element,
) -> Vec<Constraint> {
    let is_kept = |k: &usize| !joint.dropped.contains(&(first + k));
    match constraint {
        Constraint::Scalar(scalar) => is_kept(&0)
            .then_some(Constraint::Scalar(scalar))
            .into_iter()
            .collect(),
        Constraint::Vector(vector) => {
            let components: Vec<usize> = (0..3).filter(is_kept).collect();
            if components.len() == 3 {
                return vec![Constraint::Vector(vector)];
            }
            components
                .into_iter()
                .map(|k| {
                    let (body, unit) = direction(arena, first, k, joint);
                    Constraint::Scalar(ScalarExpr::Dot(
                        Box::new(VectorExpr::Fixed(body, unit)),
                        Box::new(vector.clone()),
                    ))
                })
                .collect()
        }
    }
}

/// The direction of a component, and the body that it is fixed on.
fn direction(
    arena: &mut Arena,
    first: usize,
    k: usize,
    joint: &Element,
) -> (Option<usize>, Triple) {
    match joint.components_of(first) {
        Some(components) => {
            let unit = components.axes[k].map(|component| arena.constant(component));
            (joint.bodies[components.place], unit)
        }
        None => {
            let mut unit = ZERO;
            unit[k] = Arena::ONE;
            (None, unit)
        }
    }
}
