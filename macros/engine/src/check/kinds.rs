//! The number of kinds that a mechanism may have: every definition is expanded within the one
//! before, and the compiler expands to a limit only.

use syn::{Expr, ExprLit, Lit};

use crate::diag::Faults;
use crate::syntax::mechanism::MechanismSyntax;
use crate::syntax::{Value, ungroup};

/// The key of `#[mechanism(..)]`.
pub(super) const KEY: &str = "recursion_limit";
/// The compiler's own.
const DEFAULT: usize = 128;
/// For what stands around the definitions: macros that write the struct, and what is generated.
const MARGIN: usize = 28;

/// Reads the value of the key.
pub(super) fn read(expr: Option<&Expr>, faults: &mut Faults) {
    if let Some(expr) = expr
        && value(expr).is_none()
    {
        let message = format!(
            "`{KEY}` takes the number that stands at the top of the crate, as in `{KEY} = 256`"
        );
        faults.at(expr, message);
    }
}

fn value(expr: &Expr) -> Option<usize> {
    match ungroup(expr) {
        Expr::Lit(ExprLit {
            lit: Lit::Int(limit),
            ..
        }) => limit.base10_parse().ok(),
        _ => None,
    }
}

/// The refusal of more kinds than the compiler expands; what the compiler itself says then names
/// neither struct nor cause.
#[must_use]
pub fn too_many(syntax: &MechanismSyntax, kinds: usize) -> Option<String> {
    let given = syntax.list.pairs.iter().find_map(|pair| match &pair.value {
        Value::Expr(expr) if pair.key == KEY => value(expr),
        _ => None,
    });
    // A limit below the compiler's own is nobody's wish.
    let limit = given.unwrap_or(DEFAULT).max(DEFAULT);
    if kinds + MARGIN <= limit {
        return None;
    }
    let name = &syntax.name;
    let (most, wanted) = (
        limit - MARGIN,
        (kinds + MARGIN).next_power_of_two().max(2 * DEFAULT),
    );
    Some(format!(
        "`{name}` has {kinds} kinds of bodies, joints and forces; the compiler's recursion limit of {limit} suffices for {most}: write \
         `#![recursion_limit = \"{wanted}\"]` at the top of the crate, and `#[mechanism({KEY} = {wanted})]` above `{name}`"
    ))
}
