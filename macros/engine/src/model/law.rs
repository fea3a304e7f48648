//! Laws, and expressions in them whose sign decides.

use super::function::Function;
use super::joint::{Extent, Term};
use super::name::Name;
use super::number::Number;

/// An expression of a law.
#[derive(Clone, Debug, PartialEq)]
pub enum LawTerm {
    /// A number.
    Number(Number),
    /// The time (s).
    Time,
    /// An argument by its place.
    Argument(usize),
    /// A sum with signs: `true` is minus.
    Sum(Vec<(bool, LawTerm)>),
    /// A product.
    Product(Box<LawTerm>, Box<LawTerm>),
    /// A function.
    Function(Function, Box<LawTerm>),
    /// The angle of a sine (first) and a cosine, times any positive number, from `-pi` to `pi`.
    Direction(Box<LawTerm>, Box<LawTerm>),
    /// A state of the user's own, by its place.
    State(usize),
    /// What is read of a joint, or behind the joints of a force: in rates of states alone.
    Reading {
        /// The place of the joint or force.
        element: usize,
        /// A scalar of its definition.
        term: Box<Term>,
    },
    /// An input with its first and second derivative.
    Setpoint([Number; 3]),
    /// On which side of its zero an expression is: 1, -1, or 0 at zero.
    Side(Box<Switching>),
    /// The first law where an expression is not negative, else the second.
    Select(Box<Switching>, Box<[LawTerm; 2]>),
}

impl LawTerm {
    /// How large it is with arguments of given extents.
    #[must_use]
    pub fn extent(&self, arguments: &[Extent]) -> Extent {
        match self {
            Self::Number(_) | Self::Time | Self::State(_) | Self::Setpoint(_) => Extent::ONE,
            Self::Argument(place) => arguments[*place],
            Self::Sum(terms) => Extent::sum(terms.iter().map(|(_, term)| term.extent(arguments))),
            Self::Product(a, b) => a.extent(arguments).product(b.extent(arguments)),
            Self::Function(_, inner) => inner.extent(arguments).function(),
            Self::Direction(..) | Self::Side(_) | Self::Select(..) => {
                let parts = self.parts().into_iter();
                Extent::sum(parts.map(|part| part.extent(arguments))).function()
            }
            Self::Reading { term, .. } => term
                .extent(&|_: usize, arguments: &[Extent]| Extent::sum(arguments.iter().copied())),
        }
    }
}

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
    /// Whether all laws that it stands in are seen to be continuous at its zero.
    pub is_continuous: bool,
}

/// The side that is held of an expression, and whether it is that of its opposite.
pub type Held = Option<(Number, bool)>;

/// The same among the switches that are known.
#[must_use]
pub fn held(switches: &[Switch], arguments: Option<(usize, &[Term])>, of: &LawTerm) -> Held {
    let (place, is_opposite) = place(switches, arguments, of)?;
    Some((switches[place].held, is_opposite))
}

/// The place of an expression among the switches that are known, and whether it is the opposite of
/// what stands there.
#[must_use]
pub fn place(
    switches: &[Switch],
    arguments: Option<(usize, &[Term])>,
    of: &LawTerm,
) -> Option<(usize, bool)> {
    let is_same = |switch: &Switch| match (&switch.arguments, arguments) {
        (None, _) => true,
        (Some((place, terms)), Some((wanted, given))) => *place == wanted && terms == given,
        (Some(_), None) => false,
    };
    let find = |of: &LawTerm| {
        let mut known = switches.iter();
        known.position(|switch| switch.of == *of && is_same(switch))
    };
    if let Some(place) = find(of) {
        return Some((place, false));
    }
    find(&of.opposite()).map(|place| (place, true))
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
            Self::Product(a, b) | Self::Direction(a, b) => vec![a, b],
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
