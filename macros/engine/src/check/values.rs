//! Run-time values: parameters, inputs and the starts of states.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::Expr;

use super::number::{Numbers, elements};
use super::pairs::Pairs;
use crate::diag::{Faults, code};
use crate::model::{Name, RunTimeValue};
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};

/// Words that numbers and laws are written with.
const TAKEN: [&str; 5] = ["PI", "TAU", "ground", "time", "local"];

/// What gives the rate of a state, for a message.
const RATE: &str =
    "its time derivative, as in `rate = (voltage - resistance * current) / inductance`";

/// The run-time values in the order of the fields.
pub(super) fn values(
    syntax: &MechanismSyntax,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Vec<RunTimeValue> {
    let mut values = Vec::new();
    for field in &syntax.fields {
        let (is_input, is_start) = match &field.role {
            Some((Role::Param, _)) => (false, false),
            Some((Role::Input, _)) => (true, false),
            Some((Role::State, _)) => (false, true),
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
        let what = if is_start { "state" } else { "run-time value" };
        if field.ty.to_token_stream().to_string() != "f64" {
            faults.within(name, |faults| {
                faults.at(
                    &field.ty,
                    format!("`{name}` is of type `{found}`; a {what} is an `f64`"),
                );
            });
        }
        let like = faults.within(name, |faults| match is_start {
            true => start(syntax, field, facade, faults),
            false => like(syntax, field, facade, faults),
        });
        values.push(RunTimeValue {
            name: name.clone(),
            is_input,
            is_start,
            like,
        });
    }
    values
}

/// What a parameter is said to be like.
fn like(
    syntax: &MechanismSyntax,
    field: &Field,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<f64> {
    let (_, word) = field.role.as_ref()?;
    let owner = word.segments.first()?.ident.span();
    let mut pairs = Pairs::new(format!("parameter `{}`", field.name), owner, &field.list);
    let written = pairs.optional("like", faults);
    pairs.finish(faults);
    written_number(syntax, field, ("like", written?), facade, faults)
}

/// Where a state starts.
fn start(
    syntax: &MechanismSyntax,
    field: &Field,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<f64> {
    let (_, word) = field.role.as_ref()?;
    let owner = word.segments.first()?.ident.span();
    let mut pairs = Pairs::new(format!("state `{}`", field.name), owner, &field.list);
    // What it is, is read once joints and forces are known.
    pairs.required("rate", RATE, faults);
    let written = pairs.optional("start", faults);
    pairs.finish(faults);
    match written {
        Some(written) => written_number(syntax, field, ("start", written), facade, faults),
        None => Some(0.0),
    }
}

/// A number that the macro sees, of one element if it is given for several.
fn written_number(
    syntax: &MechanismSyntax,
    field: &Field,
    (key, written): (&str, &Expr),
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<f64> {
    let written = of_element(syntax, &field.name, (key, written), faults)?;
    let mut numbers = Numbers::new(field.name.clone(), &syntax.unmeasured, facade);
    numbers.attribute = key.into();
    numbers.written(written, faults)
}

/// The number for one element of an array: its own, or the one that is given for all.
fn of_element<'a>(
    syntax: &MechanismSyntax,
    name: &Name,
    (key, written): (&str, &'a Expr),
    faults: &mut Faults,
) -> Option<&'a Expr> {
    let Some(several) = elements(written) else {
        return Some(written);
    };
    let fields = syntax.fields.iter();
    let count = fields.filter(|field| field.name.text() == name.text());
    let field = name.text();
    match (name.index(), count.count()) {
        (Some(index), count) if several.len() == count => several.get(index).copied(),
        (Some(_), count) => {
            let found = several.len();
            faults.at(
                written,
                format!(
                    "`{field}` has {count} elements, and `{key}` {found}; give one number for each, or one for all of them, in which `k` may \
                     stand"
                ),
            );
            None
        }
        (None, _) => {
            faults.at(
                written,
                match key {
                    "like" => format!(
                        "`{field}` is one number, and so is what it is like, as in `like = 0.8`"
                    ),
                    _ => format!("`{field}` is one number, and so is `{key}`, as in `{key} = 0.8`"),
                },
            );
            None
        }
    }
}
