//! Run-time values: parameters, inputs and the starts of states.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, GenericArgument, PathArguments, Type};

use super::number::{Numbers, elements};
use super::pairs::Pairs;
use crate::diag::{Faults, code};
use crate::model::{Name, RunTimeValue, ValueKind};
use crate::syntax::integer::integer;
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};
use crate::syntax::ungroup;

/// Words that numbers and laws are written with.
const TAKEN: [&str; 5] = ["PI", "TAU", "ground", "time", "local"];

/// What gives the rate of a state, for a message.
const RATE: &str =
    "its time derivative, as in `rate = (voltage - resistance * current) / inductance`";

/// The run-time values in the order of the fields.
pub(super) fn values(
    syntax: &MechanismSyntax,
    is_assembly: bool,
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
        let (like, has_order) = faults.within(name, |faults| {
            if is_input {
                (None, order(field, faults))
            } else if is_start {
                (start(syntax, field, facade, faults), false)
            } else {
                (like(syntax, field, facade, faults), false)
            }
        });
        let kind = faults.within(name, |faults| {
            if is_start && field.ty.to_token_stream().to_string() != "f64" {
                let found = code(&field.ty);
                faults.at(
                    &field.ty,
                    format!("`{name}` is of type `{found}`; a state is an `f64`"),
                );
                return None;
            }
            let kind = kind(syntax, field, has_order, faults)?;
            allowed(kind, field, is_input, (is_assembly, has_order), faults).then_some(kind)
        });
        values.push(RunTimeValue {
            name: name.clone(),
            is_input,
            is_start,
            like,
            kind: kind.unwrap_or(ValueKind::Number),
            written: field.ty.to_token_stream(),
        });
    }
    values
}

/// What a value is by its type.
fn kind(
    syntax: &MechanismSyntax,
    field: &Field,
    has_order: bool,
    faults: &mut Faults,
) -> Option<ValueKind> {
    if field.ty.to_token_stream().to_string() == "f64" {
        return Some(ValueKind::Number);
    }
    let (name, found) = (&field.name, code(&field.ty));
    let last = match &field.ty {
        Type::Path(path) => path.path.segments.last(),
        _ => None,
    };
    match last {
        Some(last) if last.ident == "Setpoint" => Some(ValueKind::Setpoint),
        Some(last) if last.ident == "Spline" => {
            let points = match &last.arguments {
                PathArguments::AngleBracketed(list) if list.args.len() == 1 => list.args.first(),
                _ => None,
            };
            let points = points.and_then(|points| self::points(syntax, points));
            if points.is_none() {
                faults.at(
                    &field.ty,
                    format!(
                        "`{name}` is a spline: its number of points is written in figures, as in `Spline<36>`, or given by \
                         `#[mechanism(N = 36)]` where it is the constant `N`"
                    ),
                );
            }
            points.map(ValueKind::Spline)
        }
        _ if has_order => {
            faults.at(
                &field.ty,
                format!(
                    "`{name}` is of type `{found}`; an input with its derivatives is a `Setpoint`"
                ),
            );
            None
        }
        _ => {
            faults.at(
                &field.ty,
                format!("`{name}` is of type `{found}`; a run-time value is an `f64`"),
            );
            None
        }
    }
}

/// The number of points in the type of a spline.
fn points(syntax: &MechanismSyntax, points: &GenericArgument) -> Option<usize> {
    match points {
        GenericArgument::Const(points) => usize::try_from(integer(ungroup(points)).ok()?).ok(),
        GenericArgument::Type(Type::Path(path)) => {
            let name = path.path.get_ident()?;
            let known = syntax.lengths.iter().find(|(known, _)| known == name);
            known.map(|(_, points)| *points)
        }
        _ => None,
    }
}

/// Whether a value of a kind may be described so.
fn allowed(
    kind: ValueKind,
    field: &Field,
    is_input: bool,
    (is_assembly, has_order): (bool, bool),
    faults: &mut Faults,
) -> bool {
    let name = &field.name;
    let message = match kind {
        ValueKind::Number if has_order => format!(
            "`{name}` is of type `f64`; an input with its derivatives is a `Setpoint`, which has `value`, `rate` and `acceleration`"
        ),
        ValueKind::Setpoint if !is_input => {
            format!(
                "`{name}` is a `Setpoint`, which may change at every step: describe it by `#[input(order = 2)]`"
            )
        }
        ValueKind::Setpoint if !has_order => {
            format!(
                "`{name}` is a `Setpoint`, an input with its derivatives: write `#[input(order = 2)]`"
            )
        }
        ValueKind::Spline(_) if is_input => {
            format!("`{name}` is a spline, which is set on construction: describe it by `#[param]`")
        }
        ValueKind::Setpoint if is_assembly => format!(
            "`{name}` is an input with its derivatives, which a mechanism has, and no assembly; describe the driver in the mechanism"
        ),
        ValueKind::Spline(_) if is_assembly => format!(
            "`{name}` is a spline for run time, which a mechanism has, and no assembly; take a constant by its path, as in `crate::CAM(time)`"
        ),
        _ => return true,
    };
    faults.at(&field.ty, message);
    false
}

/// The pairs behind the word that says what a field is.
fn pairs_of<'a>(what: &str, field: &'a Field) -> Option<Pairs<'a>> {
    let (_, word) = field.role.as_ref()?;
    let owner = word.segments.first()?.ident.span();
    let what = format!("{what} `{}`", field.name);
    Some(Pairs::new(what, owner, &field.list))
}

/// Whether an input has its first and second derivative.
fn order(field: &Field, faults: &mut Faults) -> bool {
    let Some(mut pairs) = pairs_of("input", field) else {
        return false;
    };
    let written = pairs.optional("order", faults);
    pairs.finish(faults);
    let Some(written) = written else {
        return false;
    };
    let is_two = matches!(integer(written), Ok(2));
    if !is_two {
        faults.at(
            written,
            "`order` is 2, for an input with its first and second derivative; without them leave it out",
        );
    }
    is_two
}

/// What a parameter is said to be like.
fn like(
    syntax: &MechanismSyntax,
    field: &Field,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<f64> {
    let mut pairs = pairs_of("parameter", field)?;
    let written = pairs.optional("like", faults);
    pairs.finish(faults);
    let written = written?;
    if field.ty.to_token_stream().to_string() != "f64" {
        faults.at(
            written,
            "`like` is the typical value of a number; leave it out",
        );
        return None;
    }
    written_number(syntax, field, ("like", written), facade, faults)
}

/// Where a state starts.
fn start(
    syntax: &MechanismSyntax,
    field: &Field,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<f64> {
    let mut pairs = pairs_of("state", field)?;
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
