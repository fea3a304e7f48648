//! From what was written to the model: what can be read is checked first, then what only numbers
//! can tell.

use proc_macro2::TokenStream;

use crate::check::definition::Definitions;
use crate::diag::Faults;
use crate::model::{ElementDef, Model};
use crate::syntax::joint::JointSyntax;
use crate::syntax::mechanism::MechanismSyntax;
use crate::{check, rank};

/// A definition where it stands, and what it says of motions against its equations. `None` if
/// anything is wrong; the faults say what.
pub fn definition(syntax: &JointSyntax, faults: &mut Faults) -> Option<ElementDef> {
    let defined = check::joint::define(syntax, faults)?;
    let found = rank::test_assembly::compare(&defined.joint);
    defined.compared(&found, faults)
}

/// A mechanism. `None` if anything is wrong with its parts; the faults say what.
pub fn mechanism(
    syntax: &MechanismSyntax,
    types: &Definitions,
    definitions: Vec<ElementDef>,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<Model> {
    let checked = check::mechanism::check(syntax, types, definitions, facade, faults)?;
    if faults.any() {
        return Some(checked.model);
    }
    let found = if checked.drops() {
        rank::judge_to_drop(&checked.model)
    } else {
        rank::judge(&checked.model)
    };
    let mut model = checked.judged(found, faults);
    check::slopes::add(&mut model, facade);
    if !faults.any() && model.bodies.iter().any(|body| body.as_given) {
        check::bodies::judged(&model, rank::is_definite(&model), faults);
    }
    Some(model)
}
