//! What rates of the user's own states read of joints and forces.

use proc_macro2::Ident;
use syn::{ExprField, Member};

use super::elements::{Found, Reference, bare, known};
use crate::diag::{Faults, did_you_mean, list};
use crate::model::{Element, ElementDef, ElementKind, LawTerm, Name, Term};

/// What rates of states may read.
pub(super) struct Readings<'a> {
    /// The joints, then the forces, in the order of the fields.
    pub(super) names: Vec<&'a Name>,
    /// The same; `None` for one that was refused.
    pub(super) elements: Vec<Option<&'a Element>>,
    pub(super) definitions: &'a [ElementDef],
    /// The bodies.
    pub(super) bodies: &'a [&'a Name],
    /// Arrays whose length was refused.
    pub(super) unmeasured: &'a [Ident],
}

impl Readings<'_> {
    /// A reading, as in `hinge.rate`.
    pub(super) fn read(
        &self,
        field: &ExprField,
        by: &Name,
        faults: &mut Faults,
    ) -> Option<LawTerm> {
        let Member::Named(word) = &field.member else {
            faults.at(field, "expected a reading such as `hinge.rate`");
            return None;
        };
        let Some(reference) = Reference::of(&field.base) else {
            faults.at(
                field,
                "expected a reading of a joint or force by its field, as in `hinge.rate`",
            );
            return None;
        };
        let names = self.names.iter().copied();
        let element = match reference.find(names.clone(), self.unmeasured, by, faults) {
            Found::At(element) => element,
            Found::Refused => return None,
            Found::Nothing => {
                self.refuse(&reference, by, faults);
                return None;
            }
        };
        let definition = &self.definitions[self.elements[element]?.definition];
        let readings = readings(definition);
        let found = readings.iter().find(|(name, _)| word == name);
        if let Some((_, term)) = found {
            let term = Box::new(term.clone());
            return Some(LawTerm::Reading { element, term });
        }
        let (name, kind) = (&reference.field, &definition.name);
        let names: Vec<&str> = readings.iter().map(|(name, _)| name.as_str()).collect();
        let near = did_you_mean(&word.to_string(), names.iter().copied());
        let there = match (names.is_empty(), definition.kind) {
            (false, _) => format!("`{kind}` has {}{near}", list(&names)),
            (true, ElementKind::Joint) => {
                format!("`{kind}` has no angle and no displacement to be read")
            }
            (true, ElementKind::Force) => {
                format!("`{kind}` has no law, whose arguments are what is read of a force")
            }
        };
        faults.at(
            word,
            format!(
                "the rate of a state reads positions and velocities, and no `{word}` of `{name}`: {there}"
            ),
        );
        None
    }

    fn refuse(&self, reference: &Reference<'_>, by: &Name, faults: &mut Faults) {
        let text = reference.text();
        let bodies = self.bodies.iter().copied();
        if reference.find(bodies, self.unmeasured, by, faults) != Found::Nothing {
            faults.at(
                reference.at(),
                format!(
                    "`{text}` is a body; the rate of a state reads joints and forces, as in `hinge.rate`"
                ),
            );
            return;
        }
        let all = known(self.names.iter().copied(), by);
        let near = did_you_mean(&text, all.iter().map(|name| bare(name)));
        let there = match all.is_empty() {
            true => "there are none".to_string(),
            false => format!("there are {}", list(&all)),
        };
        faults.at(
            reference.at(),
            format!("no joint or force `{text}`; {there}{near}"),
        );
    }
}

/// What can be read of a joint, or of a force: the arguments of its laws.
fn readings(definition: &ElementDef) -> Vec<(String, Term)> {
    let rate = |term: &Term| Term::Rate(Box::new(term.clone()));
    let mut found = Vec::new();
    match definition.kind {
        ElementKind::Joint => {
            let angle = definition.angle.map(Term::Angle);
            let displacement = definition.displacement.clone();
            let of = [("angle", &angle), ("displacement", &displacement)];
            let alone = angle.is_some() != displacement.is_some();
            for (name, term) in of {
                let Some(term) = term else { continue };
                found.push((name.to_string(), term.clone()));
                let name = if alone {
                    "rate".to_string()
                } else {
                    format!("{name}_rate")
                };
                found.push((name, rate(term)));
            }
        }
        ElementKind::Force => {
            let terms = definition.actions.iter().flat_map(|action| action.terms());
            for term in terms {
                term.visit(&mut |term| {
                    let Term::Law {
                        parameter,
                        arguments,
                    } = term
                    else {
                        return;
                    };
                    let names = &definition.parameters[*parameter].arguments;
                    for (name, argument) in names.iter().zip(arguments) {
                        let is_law = |term: &Term| matches!(term, Term::Law { .. });
                        let is_new = found.iter().all(|(known, _)| name != known);
                        if is_new && !argument.has(is_law) {
                            found.push((name.to_string(), argument.clone()));
                        }
                    }
                });
            }
        }
    }
    found
}
