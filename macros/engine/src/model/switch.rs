//! The switches of a mechanism.

use super::joint::Term;
use super::law::{Held, LawTerm, held};
use super::mechanism::{Binding, Model};

impl Model {
    /// The side that is held of an expression of a law, with what stands for its arguments.
    #[must_use]
    pub fn held(&self, arguments: Option<(usize, &[Term])>, of: &LawTerm) -> Held {
        held(&self.switches, arguments, of)
    }

    /// Whether a law switches, be it by numbers that no run changes.
    #[must_use]
    pub fn has_sides(&self) -> bool {
        let bindings = self.forces.iter().flat_map(|force| &force.bindings);
        let laws = bindings.filter_map(|binding| match binding {
            Binding::Law(law) => Some(law),
            _ => None,
        });
        let mut laws = laws.chain(self.states.iter().map(|state| &state.rate));
        laws.any(|law| law.has(&|term| term.switching().is_some()))
    }
}
