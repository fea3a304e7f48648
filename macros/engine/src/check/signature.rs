//! The signature of a definition: names of bodies and parameters, and their kinds.

use proc_macro2::Ident;

use crate::diag::{Faults, did_you_mean, list};
use crate::model::{Parameter, ParameterKind};
use crate::syntax::joint::{JointSyntax, ParameterSyntax};

/// Names that a definition may not use for itself.
pub(super) const RESERVED: [&str; 10] = [
    "PI",
    "TAU",
    "between",
    "displacement",
    "drive",
    "ground",
    "let",
    "origin",
    "potential",
    "time",
];

/// The parameters, and the names of those whose kind is not known.
pub(super) fn signature<'a>(
    syntax: &'a JointSyntax,
    faults: &mut Faults,
) -> (Vec<Parameter>, Vec<&'a Ident>) {
    if syntax.bodies.is_empty() {
        let word = syntax.kind.word();
        faults.at(
            &syntax.name,
            format!("a {word} connects at least one body, as in `(i, j)`"),
        );
    }
    let mut ambiguous = Vec::new();
    let mut seen: Vec<&Ident> = Vec::new();
    for name in syntax
        .bodies
        .iter()
        .chain(syntax.parameters.iter().map(|parameter| &parameter.name))
    {
        if RESERVED.contains(&name.to_string().as_str()) {
            faults.at(
                name,
                format!("`{name}` is a word of the language; take another name"),
            );
        }
        if seen.contains(&name) {
            faults.at(name, format!("`{name}` is declared twice"));
        }
        seen.push(name);
    }
    let parameters = syntax
        .parameters
        .iter()
        .map(|parameter| {
            let ParameterSyntax { name, kind, .. } = parameter;
            let found = kind.to_string();
            let known = ParameterKind::ALL.iter().find(|(word, _)| *word == found);
            if known.is_none() {
                ambiguous.push(name);
                let words = ParameterKind::ALL.map(|(word, _)| word);
                let near = did_you_mean(&found, words);
                faults.at(
                    kind,
                    format!("no kind `{found}`; there are {}{near}", list(words)),
                );
            }
            let known = known.map_or(ParameterKind::Number, |(_, kind)| *kind);
            if known != ParameterKind::Law
                && let Some(argument) = parameter.arguments.first()
            {
                faults.at(
                    argument,
                    format!("`{name}` has no arguments: only a `Law` has"),
                );
            }
            Parameter {
                name: name.clone(),
                kind: known,
                arguments: parameter.arguments.clone(),
                default: None,
            }
        })
        .collect();
    (parameters, ambiguous)
}
