//! Laws that switch: expressions whose sign decides, and the switches of a mechanism.

use super::joint::Term;
use super::mechanism::{LawTerm, Model};
use super::name::Name;
use super::number::Number;

/// An expression of a law whose sign decides.
#[derive(Clone, Debug)]
pub struct Switching {
    /// The expression.
    pub of: LawTerm,
    /// As it was written.
    pub text: String,
}

/// By the expression alone.
impl PartialEq for Switching {
    fn eq(&self, other: &Self) -> bool {
        self.of == other.of
    }
}

/// An expression whose sign decides in laws of a mechanism: one for all laws that read the same.
#[derive(Clone, Debug)]
pub struct Switch {
    /// The force or the state whose law it stands in, the first one of several.
    pub owner: Name,
    /// As it was written.
    pub text: String,
    /// What stands for its arguments: a force by its place among joints and forces, and the terms
    /// of its definition. `None` where it has no arguments.
    pub arguments: Option<(usize, Vec<Term>)>,
    /// The expression.
    pub of: LawTerm,
    /// The side that is held, 1 or -1; 0 where it is that of the expression.
    pub held: Number,
    /// Whether it depends on nothing but the time, and on what is given from outside.
    pub is_of_time: bool,
}

/// The side that is held of an expression, and whether it is that of its opposite.
pub type Held = Option<(Number, bool)>;

impl Model {
    /// The side that is held of an expression of a law, with what stands for its arguments.
    #[must_use]
    pub fn held(&self, arguments: Option<(usize, &[Term])>, of: &LawTerm) -> Held {
        held(&self.switches, arguments, of)
    }

    /// Whether a law switches, be it by numbers that no run changes.
    #[must_use]
    pub fn has_sides(&self) -> bool {
        use super::mechanism::Binding;
        let bindings = self.forces.iter().flat_map(|force| &force.bindings);
        let laws = bindings.filter_map(|binding| match binding {
            Binding::Law(law) => Some(law),
            _ => None,
        });
        let mut laws = laws.chain(self.states.iter().map(|state| &state.rate));
        laws.any(|law| law.has(&|term| term.switching().is_some()))
    }
}

/// The same among the switches that are known.
#[must_use]
pub fn held(switches: &[Switch], arguments: Option<(usize, &[Term])>, of: &LawTerm) -> Held {
    let is_same = |switch: &Switch| match (&switch.arguments, arguments) {
        (None, _) => true,
        (Some((place, terms)), Some((wanted, given))) => *place == wanted && terms == given,
        (Some(_), None) => false,
    };
    let find = |of: &LawTerm| {
        let mut known = switches.iter();
        known.find(|switch| switch.of == *of && is_same(switch))
    };
    if let Some(switch) = find(of) {
        return Some((switch.held, false));
    }
    find(&of.opposite()).map(|switch| (switch.held, true))
}

impl LawTerm {
    /// The terms that it is made of.
    #[must_use]
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Number(_)
            | Self::Time
            | Self::Argument(_)
            | Self::Setpoint(_)
            | Self::State(_)
            | Self::Reading { .. } => Vec::new(),
            Self::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            Self::Product(a, b) => vec![a, b],
            Self::Function(_, inner) => vec![inner],
            Self::Side(switching) => vec![&switching.of],
            Self::Select(switching, parts) => {
                let [first, second] = &**parts;
                vec![&switching.of, first, second]
            }
        }
    }

    /// Whether something in it fulfils a condition.
    pub fn has(&self, wanted: &impl Fn(&Self) -> bool) -> bool {
        wanted(self) || self.parts().into_iter().any(|part| part.has(wanted))
    }

    /// The expression whose sign decides here.
    #[must_use]
    pub fn switching(&self) -> Option<&Switching> {
        match self {
            Self::Side(switching) | Self::Select(switching, _) => Some(switching),
            _ => None,
        }
    }

    /// The same with the other sign: `b - a` of `a - b`.
    #[must_use]
    pub fn opposite(&self) -> Self {
        match self {
            Self::Sum(terms) => match &terms[..] {
                [(false, a), (true, b)] => Self::Sum(vec![(false, b.clone()), (true, a.clone())]),
                [(true, a)] => a.clone(),
                _ => Self::Sum(vec![(true, self.clone())]),
            },
            _ => Self::Sum(vec![(true, self.clone())]),
        }
    }
}
