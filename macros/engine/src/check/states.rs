//! The user's own states: their rates, and what these read of joints and forces.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprField, Member};

use super::elements::{Found, Reference, bare, known};
use super::expression::too_large;
use super::later::Value as Known;
use super::laws::LawReader;
use super::number::Numbers;
use crate::diag::{Faults, did_you_mean, list};
use crate::model::{
    Element, ElementDef, ElementKind, Extent, LawTerm, Name, Number, Term, UserState,
};
use crate::syntax::Value;
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};

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

impl Numbers<'_> {
    /// Whether an expression names a run-time value.
    pub(super) fn is_value(&self, expr: &Expr) -> bool {
        Faults::unheard(|faults| self.place(expr, faults)) != Found::Nothing
    }

    /// Whether an expression names a state of the user's own.
    pub(super) fn is_state(&self, expr: &Expr) -> bool {
        Faults::unheard(|faults| self.state(expr, faults)).is_some()
    }

    /// The place among the user's own states of what an expression names; `None` if it names none.
    pub(super) fn state(&self, expr: &Expr, faults: &mut Faults) -> Option<Found> {
        let starts = self.values.iter().filter(|value| value.is_start);
        let names = starts.map(|value| &value.name);
        let found = Reference::of(expr)?.find(names, self.unmeasured, &self.field, faults);
        (found != Found::Nothing).then_some(found)
    }

    /// The start of a state, which is where it stands among the run-time values.
    pub(super) fn start(&mut self, place: usize, span: Span) -> Number {
        let value = self.at_run_time(place);
        self.number(Known::Later(value), span)
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

/// The states in the order of the fields, each as far as its rate could be read.
pub(super) fn states(
    syntax: &MechanismSyntax,
    readings: &Readings<'_>,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Vec<Option<UserState>> {
    let is_state = |field: &&Field| matches!(field.role, Some((Role::State, _)));
    let fields = syntax.fields.iter().filter(is_state);
    let starts: Vec<usize> = (0..numbers.values.len())
        .filter(|&place| numbers.values[place].is_start)
        .collect();
    let states = fields.zip(starts).map(|(field, value)| {
        faults.within(&field.name, |faults| {
            state(field, value, readings, numbers, faults)
        })
    });
    states.collect()
}

fn state(
    field: &Field,
    value: usize,
    readings: &Readings<'_>,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Option<UserState> {
    let name = &field.name;
    let mut pairs = field.list.pairs.iter();
    let rate = pairs.find(|pair| pair.key == "rate")?;
    let Value::Expr(expr) = &rate.value else {
        return None;
    };
    numbers.field = name.clone();
    numbers.attribute = "start".into();
    let start = numbers.start(value, expr.span());
    numbers.attribute = "rate".into();
    numbers.words = vec!["time".to_string()];
    let rate = LawReader {
        arguments: &[],
        numbers,
        readings: Some(readings),
    }
    .read(expr, faults);
    numbers.words.clear();
    let rate = rate?;
    let extent: Extent = rate.extent(&[]);
    if extent.is_too_large() {
        faults.at(expr, too_large(&format!("the rate of `{name}` is")));
        return None;
    }
    Some(UserState {
        name: name.clone(),
        value,
        start,
        rate,
    })
}

/// Tells joints and forces what is read of them.
pub(super) fn tell(states: &[UserState], elements: &mut [&mut Element]) {
    fn visit(law: &LawTerm, elements: &mut [&mut Element]) {
        match law {
            LawTerm::Reading { element, term } => {
                let read = &mut elements[*element].read;
                if !read.contains(term) {
                    read.push((**term).clone());
                }
            }
            LawTerm::Sum(terms) => terms.iter().for_each(|(_, term)| visit(term, elements)),
            LawTerm::Product(a, b) => {
                visit(a, elements);
                visit(b, elements);
            }
            LawTerm::Function(_, inner) => visit(inner, elements),
            LawTerm::Number(_)
            | LawTerm::Time
            | LawTerm::Argument(_)
            | LawTerm::Setpoint(_)
            | LawTerm::State(_) => {}
        }
    }
    for state in states {
        visit(&state.rate, elements);
    }
}
