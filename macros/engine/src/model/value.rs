//! What is known at run time only, and the splines that laws read.
//!
//! The parameters of a mechanism are one number for each run-time value, in the order of the
//! fields. Behind all of them are the further numbers of those that are several.

use proc_macro2::{Span, TokenStream};

use super::name::Name;

/// A field, or an element of one, that holds what is known at run time.
#[derive(Clone, Debug)]
pub struct RunTimeValue {
    /// The field, or its element.
    pub name: Name,
    /// Whether it may change at every step; if not, it is set on construction.
    pub is_input: bool,
    /// Whether it is where a state of the user's own starts.
    pub is_start: bool,
    /// The typical value of a parameter (`like`): the rank is decided there, and it is the default.
    /// The default of a start.
    pub like: Option<f64>,
    /// Whether it is one number.
    pub kind: ValueKind,
    /// The type as it was written.
    pub written: TokenStream,
}

impl RunTimeValue {
    /// Whether it is given on construction.
    #[must_use]
    pub const fn is_parameter(&self) -> bool {
        !self.is_input && !self.is_start
    }
}

/// What a run-time value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// A number.
    Number,
    /// An input with its first and second derivative. Its own number is the value.
    Setpoint,
    /// A spline of so many points. Its own number has no meaning.
    Spline(usize),
}

impl ValueKind {
    /// How many further numbers it has.
    #[must_use]
    pub const fn further(self) -> usize {
        match self {
            Self::Number => 0,
            Self::Setpoint => 2,
            // What is outside, knots, values and slopes.
            Self::Spline(points) => 4 + 3 * points,
        }
    }
}

/// The place among the parameters of the first further number of a value.
#[must_use]
pub fn first_further(values: &[RunTimeValue], place: usize) -> usize {
    let before = values.iter().take(place);
    values.len() + before.map(|value| value.kind.further()).sum::<usize>()
}

/// A spline that laws read.
#[derive(Clone, Debug)]
pub struct Spline {
    /// Where its numbers are.
    pub table: Table,
    /// Where it was written first.
    pub span: Span,
}

/// Where the numbers of a spline are.
#[derive(Clone, Debug)]
pub enum Table {
    /// In a constant: its path, and the expression of its table.
    Constant(TokenStream, TokenStream),
    /// In the run-time value of this place, with so many points.
    Value(usize, usize),
}

impl Table {
    /// Whether it is another one, too.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(_, one), Self::Constant(_, other)) => {
                one.to_string() == other.to_string()
            }
            (Self::Value(one, _), Self::Value(other, _)) => one == other,
            _ => false,
        }
    }
}

impl Spline {
    /// How many numbers it has among the constants of a mechanism.
    #[must_use]
    pub const fn numbers(&self) -> usize {
        match self.table {
            Table::Constant(..) => 0,
            Table::Value(_, points) => ValueKind::Spline(points).further(),
        }
    }
}
