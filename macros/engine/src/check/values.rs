//! Run-time values: parameters and inputs.

use quote::ToTokens;

use crate::diag::{Faults, code};
use crate::model::RunTimeValue;
use crate::syntax::mechanism::{MechanismSyntax, Role};

/// Words that numbers and laws are written with.
const TAKEN: [&str; 5] = ["PI", "TAU", "ground", "time", "local"];

/// The run-time values in the order of the fields.
pub(super) fn values(syntax: &MechanismSyntax, faults: &mut Faults) -> Vec<RunTimeValue> {
    let mut values = Vec::new();
    for field in &syntax.fields {
        let is_input = match &field.role {
            Some((Role::Param, _)) => false,
            Some((Role::Input, _)) => true,
            _ => continue,
        };
        let name = &field.name;
        if TAKEN.iter().any(|word| name.field() == word) {
            faults.at_name(
                name,
                format!(
                    "`{}` is a word of the language; take another name",
                    name.field()
                ),
            );
        }
        let found = code(&field.ty);
        if field.ty.to_token_stream().to_string() != "f64" {
            faults.within(name, |faults| {
                faults.at(
                    &field.ty,
                    format!("`{name}` is of type `{found}`; a run-time value is an `f64`"),
                );
            });
        }
        values.push(RunTimeValue {
            name: name.clone(),
            is_input,
        });
    }
    values
}
