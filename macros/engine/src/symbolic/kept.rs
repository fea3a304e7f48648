//! Constraints of which some equations are left out.

use super::arena::Arena;
use super::expression::{Constraint, ScalarExpr, VectorExpr};
use super::vector::ZERO;

/// What is left of a constraint whose first equation stands at `first` among those of its joint's
/// definition. Of three equations the remaining ones become scalar products with global unit
/// vectors.
pub(super) fn kept(constraint: Constraint, first: usize, dropped: &[usize]) -> Vec<Constraint> {
    let is_kept = |k: &usize| !dropped.contains(&(first + k));
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
                    let mut unit = ZERO;
                    unit[k] = Arena::ONE;
                    Constraint::Scalar(ScalarExpr::Dot(
                        Box::new(VectorExpr::Fixed(None, unit)),
                        Box::new(vector.clone()),
                    ))
                })
                .collect()
        }
    }
}
