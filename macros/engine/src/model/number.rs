//! Numbers of a description: known at expansion, or named and known when the code runs.

use proc_macro2::{Ident, Span, TokenStream};

use super::name::Name;

/// A number as the model knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// Evaluated by the macro.
    Literal(f64),
    /// An entry of the table of symbols, the same for a whole run.
    Symbol(u32),
    /// An entry that depends on inputs, which change from step to step.
    Varying(u32),
}

impl Number {
    /// Zero.
    pub const ZERO: Self = Self::Literal(0.0);
    /// One.
    pub const ONE: Self = Self::Literal(1.0);

    /// The value, if the macro could see it.
    #[must_use]
    pub const fn literal(self) -> Option<f64> {
        match self {
            Self::Literal(value) => Some(value),
            Self::Symbol(_) | Self::Varying(_) => None,
        }
    }
}

/// The values, if the macro could see all of them.
#[must_use]
pub fn literals<const N: usize>(numbers: &[Number; N]) -> Option<[f64; N]> {
    let mut values = [0.0; N];
    for (value, number) in values.iter_mut().zip(numbers) {
        *value = number.literal()?;
    }
    Some(values)
}

/// A number that the macro cannot see, because it names a constant of the user's crate or a
/// run-time value.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// An expression of type `f64`; functions are written as paths below `__private`, run-time
    /// values as local variables.
    pub expression: TokenStream,
    /// The same over the scalar `S`, where it depends on run-time values: they stand in the array
    /// `parameters`.
    pub scalar: Option<TokenStream>,
    /// The places of the run-time values that it depends on, in order.
    pub values: Vec<usize>,
    /// Where it is a run-time value as it is: the place of that.
    pub itself: Option<usize>,
    /// Where it is what another symbol changes by with a run-time value: the places of both. Its
    /// expressions are those of the other.
    pub slope_of: Option<(usize, usize)>,
    /// What it is at their typical values; `None` where one of them has none, for a constant by
    /// its path, and for a slope.
    pub like: Option<f64>,
    /// Where it must be positive and the compiler can evaluate it: a constant of the generated
    /// code, and its value. The expression is its name then, so that one of a wrong type is refused
    /// once.
    pub constant: Option<(Ident, TokenStream)>,
    /// Where it was written.
    pub span: Span,
    /// The field that it describes, or the mechanism.
    pub field: Name,
    /// The attribute that it belongs to.
    pub attribute: String,
}
