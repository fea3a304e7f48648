//! Kernels that a mechanism asks for by `kernels = [..]`.

use syn::Expr;

use crate::diag::{Faults, code, did_you_mean};
use crate::model::{Asked, Coordinates};
use crate::syntax::ungroup;

/// The key of `#[mechanism(..)]`.
pub(super) const KEY: &str = "kernels";

/// Reads its value: words in brackets.
pub(super) fn read(
    expr: Option<&Expr>,
    coordinates: Option<Coordinates>,
    faults: &mut Faults,
) -> Vec<Asked> {
    let Some(expr) = expr else { return Vec::new() };
    let Expr::Array(array) = ungroup(expr) else {
        faults.at(
            expr,
            format!(
                "`{KEY}` takes a list of words, as in `{KEY} = [mass, inverse]`; {}",
                words()
            ),
        );
        return Vec::new();
    };
    if coordinates.is_some_and(|coordinates| !coordinates.have_joints()) {
        faults.at(
            expr,
            format!(
                "`{KEY}` are those of the equations in joint coordinates; write `coordinates = \"joints\"` or `\"both\"` beside it"
            ),
        );
    }
    let mut asked = Vec::new();
    for element in &array.elems {
        let text = match ungroup(element) {
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
            Some((_, kernel)) => asked.push(*kernel),
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
    asked
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
