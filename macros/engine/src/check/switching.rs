//! Which functions of laws switch, and which laws may have them.

use syn::Expr;

use crate::diag::code;
use crate::model::{Action, ElementDef, ElementKind, Term};
use crate::syntax::ungroup;

/// The functions that switch, and how many numbers each takes.
pub(super) const SWITCHING: [(&str, usize); 4] = [("sign", 1), ("abs", 1), ("min", 2), ("max", 2)];

/// What a driver's law cannot do, and what can.
const DRIVER: &str = "a driver needs its rate and acceleration, too; from one value to another leads `smooth_step`, \
                      and any other curve is a spline";

/// Whether an expression is a call of a function that switches, or an `if`.
pub(super) fn is_switching(expr: &Expr) -> bool {
    match ungroup(expr) {
        Expr::If(_) => true,
        Expr::Call(call) => {
            let name = code(&call.func);
            SWITCHING.iter().any(|(known, _)| *known == name)
        }
        _ => false,
    }
}

/// Why a law of a definition may not switch; `None` where it may.
pub(super) fn no_switches(definition: &ElementDef, parameter: usize) -> Option<&'static str> {
    if definition.kind == ElementKind::Joint {
        return Some(DRIVER);
    }
    let is_law = |term: &Term| matches!(term, Term::Law { parameter: p, .. } if *p == parameter);
    let is_rate = |term: &Term| matches!(term, Term::Rate(inner) if inner.has(is_law));
    let mut reason = None;
    for action in &definition.actions {
        reason = reason.or(match action {
            Action::Potential(energy) if energy.has(is_law) => Some(
                "it stands in a potential, whose gradient is the force; write the force itself, by `f along s` in a `force!`",
            ),
            Action::Along { coordinate, .. } if coordinate.has(is_law) => Some(
                "the force acts along it, so that it needs a gradient; let the force switch, and not what it acts along",
            ),
            _ if action.terms().iter().any(|term| term.has(is_rate)) => {
                Some("its `rate` is taken, and a jump has none; from one value to another leads `smooth_step`")
            }
            _ => None,
        });
    }
    reason
}
