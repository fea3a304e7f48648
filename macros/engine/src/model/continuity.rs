//! Whether a law that switches is continuous there: it then has a value between its two sides.

use super::function::Function;
use super::law::LawTerm;
use super::number::Number;

impl LawTerm {
    /// Whether the law is seen to be continuous where an expression is zero, on whose sign it
    /// depends.
    #[must_use]
    pub fn is_continuous_at(&self, of: &Self) -> bool {
        match self {
            Self::Side(switching) => !switching.of.depends_on_side_of(of),
            Self::Select(switching, parts) => {
                let [first, second] = &**parts;
                (!switching.of.depends_on_side_of(of) || agree(first, second, &switching.of))
                    && first.is_continuous_at(of)
                    && second.is_continuous_at(of)
            }
            Self::Function(Function::Reciprocal, inner) => {
                !inner.vanishes_with(of) && inner.is_continuous_at(of)
            }
            Self::Product(a, b) => {
                (a.is_continuous_at(of) || b.vanishes_with(of) && a.is_bounded())
                    && (b.is_continuous_at(of) || a.vanishes_with(of) && b.is_bounded())
            }
            _ => self.parts().iter().all(|part| part.is_continuous_at(of)),
        }
    }

    /// Whether it is the expression itself, or switches by its sign.
    fn depends_on_side_of(&self, of: &Self) -> bool {
        self.is_up_to_sign(of)
            || self.has(&|term| {
                let switching = term.switching();
                switching.is_some_and(|switching| switching.of.is_up_to_sign(of))
            })
    }

    fn is_up_to_sign(&self, of: &Self) -> bool {
        self == of || *self == of.opposite() || self.opposite() == *of
    }

    /// Whether it divides by nothing that moves.
    fn is_bounded(&self) -> bool {
        !self.has(&|term| match term {
            Self::Function(Function::Reciprocal, inner) => !matches!(**inner, Self::Number(_)),
            _ => false,
        })
    }

    /// Whether it is seen to be zero where an expression is.
    fn vanishes_with(&self, of: &Self) -> bool {
        self.is_up_to_sign(of)
            || match self {
                Self::Number(Number::Literal(value)) => *value == 0.0,
                Self::Product(a, b) => {
                    a.vanishes_with(of) && b.is_bounded() || b.vanishes_with(of) && a.is_bounded()
                }
                Self::Sum(terms) => terms.iter().all(|(_, term)| term.vanishes_with(of)),
                Self::Function(
                    Function::Sine
                    | Function::ArcSine
                    | Function::ArcTangent
                    | Function::SquareRoot,
                    inner,
                ) => inner.vanishes_with(of),
                Self::Select(_, parts) => parts.iter().all(|part| part.vanishes_with(of)),
                _ => false,
            }
    }
}

/// Whether two laws are seen to be equal where an expression is zero.
fn agree(first: &LawTerm, second: &LawTerm, of: &LawTerm) -> bool {
    let difference = LawTerm::Sum(vec![(false, first.clone()), (true, second.clone())]);
    first == second || difference.vanishes_with(of)
}
