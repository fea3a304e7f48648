//! Rates in the expressions of definitions.

use quote::ToTokens;

use crate::diag::Faults;
use crate::model::Term;

/// Refuses an equation of velocities that is not linear in them.
pub(super) fn is_linear(term: &Term, at: impl ToTokens, faults: &mut Faults) -> bool {
    let is_linear = term.degree().is_some();
    if !is_linear {
        faults.at(
            at,
            "an equation of velocities is linear in them: a sum of terms with one `rate(..)` or `angular_velocity(..)` each, \
             times what depends on positions and the time",
        );
    }
    is_linear
}

/// Refuses a rate where it has no place.
pub(super) fn has_rate(term: &Term, at: impl ToTokens, message: &str, faults: &mut Faults) -> bool {
    let has = term.has(Term::is_rate);
    if has {
        faults.at(at, message);
    }
    has
}

/// Whether a scalar has one value for all states.
pub(super) fn is_constant(term: &Term) -> bool {
    match term {
        Term::Number(_) | Term::Scalar(_) | Term::Initial(_) => true,
        Term::Sum(terms) => terms.iter().all(|(_, term)| is_constant(term)),
        Term::Product(a, b) | Term::Direction(a, b) => is_constant(a) && is_constant(b),
        Term::Function(_, term) => is_constant(term),
        _ => false,
    }
}
