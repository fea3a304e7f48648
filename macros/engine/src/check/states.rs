//! The user's own states and their rates.

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use super::elements::{Found, Reference};
use super::expression::too_large;
use super::later::Value as Known;
use super::laws::LawReader;
use super::number::Numbers;
use super::readings::Readings;
use crate::diag::Faults;
use crate::model::{Element, Extent, LawTerm, Number, UserState};
use crate::syntax::Value;
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};

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
        no_switches: None,
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
        if let LawTerm::Reading { element, term } = law {
            let read = &mut elements[*element].read;
            if !read.contains(term) {
                read.push((**term).clone());
            }
        }
        for part in law.parts() {
            visit(part, elements);
        }
    }
    for state in states {
        visit(&state.rate, elements);
    }
}
