//! Which angles of a joint or force count turns: those whose value is read. A rate, or what is done
//! along an angle, asks for no value.

use super::joint::{Action, ElementKind, Term, Turn};
use super::law::LawTerm;
use super::mechanism::{Binding, Element, Model};

impl Model {
    /// The angles of a joint or force that count turns, in the order of their auxiliary variables.
    #[must_use]
    pub fn counted(&self, element: &Element) -> Vec<Turn> {
        let definition = self.definition(element);
        let is_read = |turn: &Turn| element.read.iter().any(|term| reads(term, *turn, element));
        let counts = |turn: &Turn| match definition.kind {
            ElementKind::Joint => true,
            ElementKind::Force => {
                let mut actions = definition.actions.iter();
                actions.any(|action| acts_by(action, *turn, element)) || is_read(turn)
            }
        };
        // The angle of a joint that no equation speaks of.
        let own = definition
            .angle
            .filter(|turn| !definition.turns.contains(turn));
        let counted = definition.turns.iter().copied().filter(counts);
        counted.chain(own.filter(is_read)).collect()
    }
}

/// Whether what a force does reads the value of an angle.
fn acts_by(action: &Action, turn: Turn, element: &Element) -> bool {
    match action {
        Action::Along { effort, coordinate } => {
            reads(effort, turn, element) || changes_by(coordinate, turn, element)
        }
        _ => {
            let mut terms = action.terms().into_iter();
            terms.any(|term| reads(term, turn, element))
        }
    }
}

/// Whether the value of a term reads that of an angle.
fn reads(term: &Term, turn: Turn, element: &Element) -> bool {
    match term {
        Term::Angle(angle) => *angle == turn,
        Term::Rate(inner) => changes_by(inner, turn, element),
        // It is zero there.
        Term::Initial(_) => false,
        Term::Law {
            parameter,
            arguments,
        } => {
            let law = match &element.bindings[*parameter] {
                Binding::Law(law) => Some(law),
                _ => None,
            };
            let mut arguments = arguments.iter().enumerate();
            arguments.any(|(place, argument)| {
                law.is_none_or(|law| takes(law, place)) && reads(argument, turn, element)
            })
        }
        _ => {
            let mut parts = term.parts().into_iter();
            parts.any(|part| reads(part, turn, element))
        }
    }
}

/// Whether the gradient of a term, or its rate, reads the value of an angle.
fn changes_by(term: &Term, turn: Turn, element: &Element) -> bool {
    !matches!(term, Term::Angle(_)) && reads(term, turn, element)
}

/// Whether a law has an argument in it.
fn takes(law: &LawTerm, argument: usize) -> bool {
    law.has(&|term| matches!(term, LawTerm::Argument(place) if *place == argument))
}
