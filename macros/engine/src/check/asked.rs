//! Kernels that a mechanism asks for by `kernels = [..]`.

use syn::{Expr, ExprCall};

use super::elements::Found;
use super::number::Numbers;
use crate::diag::{Faults, code, did_you_mean};
use crate::model::{Asked, Coordinates, ValueKind};
use crate::syntax::ungroup;

/// The key of `#[mechanism(..)]`.
pub(super) const KEY: &str = "kernels";

/// What is asked for.
#[derive(Default)]
pub(super) struct Kernels {
    /// The kernels.
    pub(super) asked: Vec<Asked>,
    /// The places of the parameters that `derivatives(..)` names.
    pub(super) derived_by: Vec<usize>,
}

/// Reads its value: words in brackets.
pub(super) fn read(
    expr: Option<&Expr>,
    coordinates: Option<Coordinates>,
    numbers: &Numbers<'_>,
    faults: &mut Faults,
) -> Kernels {
    let mut kernels = Kernels::default();
    let Some(expr) = expr else { return kernels };
    let Expr::Array(array) = ungroup(expr) else {
        faults.at(
            expr,
            format!(
                "`{KEY}` takes a list of words, as in `{KEY} = [mass, inverse]`; {}",
                words()
            ),
        );
        return kernels;
    };
    let are_of_bodies = coordinates.is_some_and(|coordinates| !coordinates.have_joints());
    let asked = &mut kernels.asked;
    for element in &array.elems {
        let word = match ungroup(element) {
            Expr::Call(call) if is_derivatives(&call.func) => {
                if are_of_bodies {
                    faults.at(
                        &call.args,
                        "derivatives by parameters are those of the equations in joint coordinates; write `coordinates = \"joints\"` or `\"both\"`, or `derivatives` alone",
                    );
                }
                kernels.derived_by = named(call, numbers, faults);
                ungroup(&call.func)
            }
            other => other,
        };
        let text = match word {
            Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
            _ => None,
        };
        let known = text.as_deref().and_then(|text| {
            let mut all = Asked::ALL.iter();
            all.find(|(word, _)| *word == text)
        });
        match known {
            Some((word, kernel)) if asked.contains(kernel) => {
                faults.at(element, format!("`{word}` stands here twice"));
            }
            Some((word, kernel)) => {
                if are_of_bodies && *kernel != Asked::Derivatives {
                    faults.at(
                        element,
                        format!(
                            "`{word}` is a kernel of the equations in joint coordinates; write `coordinates = \"joints\"` or `\"both\"` beside `{KEY}`"
                        ),
                    );
                }
                asked.push(*kernel);
            }
            None => {
                let words = words();
                let found = code(element);
                let near = did_you_mean(
                    text.as_deref().unwrap_or(""),
                    Asked::ALL.iter().map(|(word, _)| *word),
                );
                faults.at(
                    element,
                    format!("there is no kernel `{found}`; {words}{near}"),
                );
            }
        }
    }
    kernels
}

/// Whether it is the word of the kernel that takes names of parameters.
fn is_derivatives(expr: &Expr) -> bool {
    let word = Asked::Derivatives.word();
    matches!(ungroup(expr), Expr::Path(path) if path.path.is_ident(word))
}

/// The parameters in `derivatives(..)`, by their places.
fn named(call: &ExprCall, numbers: &Numbers<'_>, faults: &mut Faults) -> Vec<usize> {
    let mut places = Vec::new();
    if call.args.is_empty() {
        faults.at(
            call,
            "`derivatives(..)` takes the parameters by which there are derivatives too, as in `derivatives(length)`; without one write `derivatives`",
        );
    }
    for expr in &call.args {
        let found = code(expr);
        let place = match numbers.place(expr, faults) {
            Found::At(place) => place,
            Found::Refused => continue,
            Found::Nothing => {
                let known = numbers.values.iter();
                let known = known.filter(|value| {
                    value.is_parameter() && matches!(value.kind, ValueKind::Number)
                });
                let known: Vec<String> = known.map(|value| value.name.to_string()).collect();
                let near = did_you_mean(&found, known.iter().map(String::as_str));
                let there = match &known[..] {
                    [] => "this mechanism has none".into(),
                    known => format!("there are `{}`", known.join("`, `")),
                };
                faults.at(
                    expr,
                    format!("`derivatives(..)` takes parameters by name; `{found}` is none, and {there}{near}"),
                );
                continue;
            }
        };
        let value = &numbers.values[place];
        let reason = if places.contains(&place) {
            "stands here twice"
        } else if value.is_input {
            "is an input: there are derivatives by all of them without their names"
        } else if value.is_start {
            "is where a state starts, which is in no equation of motion"
        } else if matches!(value.kind, ValueKind::Spline(_)) {
            "is a spline, which is no number to differentiate by"
        } else {
            places.push(place);
            continue;
        };
        faults.at(expr, format!("`{found}` {reason}"));
    }
    places
}

/// The sentence that lists them.
fn words() -> String {
    let words: Vec<String> = Asked::ALL
        .iter()
        .map(|(word, _)| format!("`{word}`"))
        .collect();
    match words.split_last() {
        Some((last, others)) => format!("there are {} and {last}", others.join(", ")),
        None => String::new(),
    }
}
