//! The reader of one body's numbers.

use syn::Expr;

use crate::check::number::{AT_LIKES, Numbers};
use crate::diag::Faults;
use crate::model::{Name, Number};

/// The word that takes a mass and an inertia that no body has, of a model that was identified or
/// simplified.
pub(super) const AS_GIVEN: &str = "as_given";

/// What a link without a mass may have: base parameters tell no more of it.
const MASS_MOVES: &str = "; a mass at a point on the axis of a hinge may be counted to either of its bodies: take \
     some from the other one, and no motion changes";

/// The same of moments, which measurements, taken link by link, get wrong by what motions do not
/// tell.
pub(super) const MOMENTS_MOVE: &str = "; if they were measured, raise both moments across the axis of a hinge by one amount and \
     take it from the other body of the hinge, unless that is the ground: no motion changes";

pub(super) struct Reader<'a, 'b> {
    pub(super) name: &'a Name,
    pub(super) numbers: &'a mut Numbers<'b>,
    pub(super) faults: &'a mut Faults,
    /// Whether mass and inertia need not be those of a body.
    pub(super) as_given: bool,
}

impl Reader<'_, '_> {
    pub(super) fn at(&mut self, attribute: &str) {
        self.numbers.field = self.name.clone();
        self.numbers.attribute = attribute.into();
    }

    pub(super) fn mass(&mut self, expr: &Expr) -> Option<Number> {
        self.at("mass");
        let mass = self.numbers.scalar(expr, self.faults)?;
        if self.as_given {
            return self.written_out(expr, &[mass]).map(|()| mass);
        }
        if let Some(value) = self.numbers.seen(mass).filter(|&value| value <= 0.0) {
            let place = place_of(&[mass]);
            let instead = if value == 0.0 { MASS_MOVES } else { "" };
            self.faults.advised(
                expr,
                format!(
                    "the mass of `{}` must be positive, in kg; this is {value}{place}",
                    self.name
                ),
                instead,
            );
            return None;
        }
        Some(mass)
    }

    /// What is as given is judged once, with all bodies, so that it must be seen here.
    pub(super) fn written_out(&mut self, expr: &Expr, numbers: &[Number]) -> Option<()> {
        if literals_of(numbers) {
            return Some(());
        }
        self.faults.at(
            expr,
            format!(
                "`{}` is `{AS_GIVEN}`: its mass and inertia must be numbers that the macro can see",
                self.name
            ),
        );
        None
    }
}

fn literals_of(numbers: &[Number]) -> bool {
    numbers.iter().all(|number| number.literal().is_some())
}

/// Where numbers are what the macro sees, if that is not everywhere.
pub(super) fn place_of(numbers: &[Number]) -> &'static str {
    let is_seen_everywhere = numbers.iter().all(|number| number.literal().is_some());
    if is_seen_everywhere { "" } else { AT_LIKES }
}
