//! Values that are known before the state is: computed once, kept in arrays.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::quote;

use super::rows::ArrayElement;
use super::straight_line::{Environment, StraightLine, Value, write};
use crate::model::Symbol;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::table::Table;
use crate::syntax::words::local;

/// The values that kernels take from `prepare` and from `coefficients`, gathered from all kernels.
#[derive(Debug, Default)]
pub struct Store {
    arena: Arena,
    /// What `prepare` computes, behind the numbers of splines.
    constants: Vec<Expr>,
    spline_numbers: usize,
    /// What `coefficients` computes.
    coefficients: Vec<Expr>,
    /// The places of either, behind whether it is a coefficient.
    places: Table<(bool, Expr), usize>,
}

impl Store {
    /// Constants that begin with so many numbers of splines.
    #[must_use]
    pub fn new(spline_numbers: usize) -> Self {
        Self {
            spline_numbers,
            ..Self::default()
        }
    }

    /// The expression that loads a value of a kernel's arena.
    pub fn load(&mut self, arena: &Arena, value: Expr) -> TokenStream {
        let (is_coefficient, place, is_negative) = self.place(arena, value);
        let array = local(if is_coefficient {
            "coefficients"
        } else {
            "constants"
        });
        if is_negative {
            quote!(-#array[#place])
        } else {
            quote!(#array[#place])
        }
    }

    /// Whether a value of a kernel's arena is a coefficient or a constant, its place among these,
    /// and whether its sign is turned.
    pub(super) fn place(&mut self, arena: &Arena, value: Expr) -> (bool, usize, bool) {
        let stage = arena.stage(value);
        let value = self.import(arena, value);
        let is_coefficient = stage == Stage::Coefficient;
        let (slots, first) = if is_coefficient {
            (&mut self.coefficients, 0)
        } else {
            (&mut self.constants, self.spline_numbers)
        };
        let place = *self
            .places
            .entry((is_coefficient, value.abs()))
            .or_insert_with(|| {
                slots.push(value.abs());
                first + slots.len() - 1
            });
        (is_coefficient, place, value.is_negative())
    }

    /// Copies a value into the arena of the store.
    fn import(&mut self, arena: &Arena, value: Expr) -> Expr {
        let mut copies: Table<usize, Expr> = Table::default();
        let copy = |copies: &Table<usize, Expr>, expr: Expr| {
            let copy = copies[&expr.node()];
            if expr.is_negative() { -copy } else { copy }
        };
        for place in needed(arena, value) {
            let made = self
                .arena
                .again(arena.node(place), |operand| copy(&copies, operand));
            copies.insert(place, made);
        }
        copy(&copies, value)
    }

    /// The number of constants. Complete only when every kernel is written.
    #[must_use]
    pub fn constants(&self) -> usize {
        self.spline_numbers + self.constants.len()
    }

    /// The number of coefficients. Complete only when every kernel is written.
    #[must_use]
    pub fn coefficients(&self) -> usize {
        self.coefficients.len()
    }

    /// The body of `coefficients`; may ask for further constants.
    pub fn write_coefficients(&mut self) -> StraightLine {
        let (arena, outputs) = (self.arena.clone(), self.coefficients.clone());
        write(
            &arena,
            &outputs,
            Stage::Coefficient,
            &mut Kernel { store: self },
        )
    }

    /// The body of `take_inputs`: what it writes to the constants that depend on inputs, and their
    /// places. May ask for further constants.
    pub fn write_inputs(&mut self, symbols: &[Symbol]) -> (StraightLine, Vec<usize>) {
        let arena = self.arena.clone();
        let constants = (self.spline_numbers..).zip(self.constants.iter().copied());
        let (places, outputs): (Vec<usize>, Vec<Expr>) = constants
            .filter(|(_, value)| arena.stage(*value) == Stage::Input)
            .unzip();
        let mut inputs = Inputs {
            store: self,
            symbols,
        };
        let line = write(&arena, &outputs, Stage::Input, &mut inputs);
        (line, places)
    }

    /// The body of `prepare`.
    #[must_use]
    pub fn write_constants(&self, symbols: &[Symbol]) -> StraightLine {
        write(
            &self.arena,
            &self.constants,
            Stage::Parameter,
            &mut Preparation { symbols },
        )
    }
}

/// The nodes that a value needs, in order: few of those of an arena.
fn needed(arena: &Arena, value: Expr) -> BTreeSet<usize> {
    let mut needed = BTreeSet::new();
    let mut next = vec![value.node()];
    while let Some(place) = next.pop() {
        if needed.insert(place) {
            next.extend(arena.node(place).operands().map(Expr::node));
        }
    }
    needed
}

/// The environment of a kernel: inputs from its arguments, earlier values from the store.
#[derive(Debug)]
pub struct Kernel<'a> {
    /// Where earlier values come from.
    pub store: &'a mut Store,
}

impl Environment for Kernel<'_> {
    fn input(&mut self, input: Input) -> TokenStream {
        load_input(input)
    }

    fn earlier(&mut self, arena: &Arena, value: Expr) -> Value {
        Value::Expression(self.store.load(arena, value))
    }
}

/// The expression of an input that comes with the arguments of a kernel.
pub(super) fn load_input(input: Input) -> TokenStream {
    let (array, place) = match input {
        Input::Coordinate(place) => ("coordinates", place),
        Input::Velocity(place) => ("velocities", place),
        Input::Acceleration(place) => ("accelerations", place),
        Input::Upper(place) => ("upper", place),
        Input::Lower(place) => ("lower", place),
        Input::Time => {
            let time = local("time");
            return quote!(#time);
        }
        Input::RateGain => return field("rate"),
        Input::PositionGain => return field("position"),
        Input::Compliance(place) => ("compliances", place),
        Input::Symbol(_) | Input::Varying(_) => {
            unreachable!("symbols are constants: `prepare` and `take_inputs` read them")
        }
    };
    let (array, place) = (local(array), place as usize);
    quote!(#array[#place])
}

fn field(name: &str) -> TokenStream {
    let (stabilisation, field) = (local("stabilisation"), quote::format_ident!("{name}"));
    quote!(#stabilisation.#field)
}

/// The environment of `prepare`: symbols as they were written.
struct Preparation<'a> {
    symbols: &'a [Symbol],
}

impl Environment for Preparation<'_> {
    fn input(&mut self, input: Input) -> TokenStream {
        written(self.symbols, input)
    }

    fn earlier(&mut self, _: &Arena, _: Expr) -> Value {
        unreachable!("nothing is earlier than a parameter but literals, which are written in place")
    }
}

/// A symbol as it was written.
fn written(symbols: &[Symbol], input: Input) -> TokenStream {
    match input {
        Input::Symbol(place) | Input::Varying(place) => of_symbol(&symbols[place as usize]),
        other => load_input(other),
    }
}

/// The same, over the scalar `__S`.
pub(super) fn of_symbol(symbol: &Symbol) -> TokenStream {
    let expression = &symbol.expression;
    match &symbol.scalar {
        Some(scalar) => scalar.clone(),
        None => quote!(__S::constant(#expression)),
    }
}

/// The environment of `take_inputs`: symbols as they were written, what does not depend on inputs
/// from the constants.
struct Inputs<'a> {
    store: &'a mut Store,
    symbols: &'a [Symbol],
}

impl Environment for Inputs<'_> {
    fn input(&mut self, input: Input) -> TokenStream {
        written(self.symbols, input)
    }

    fn earlier(&mut self, arena: &Arena, value: Expr) -> Value {
        Value::Expression(self.store.load(arena, value))
    }
}

/// The environment of the back-substitution: state-dependent values come from the factors.
#[derive(Debug)]
pub struct BackSubstitution<'a> {
    /// Where constants and coefficients come from.
    pub store: &'a mut Store,
    /// What the factorisation hands over.
    pub factors: Vec<Expr>,
    /// Their places.
    places: Table<Expr, usize>,
}

impl<'a> BackSubstitution<'a> {
    /// Nothing is handed over yet.
    pub fn new(store: &'a mut Store) -> Self {
        Self {
            store,
            factors: Vec::new(),
            places: Table::default(),
        }
    }
}

impl Environment for BackSubstitution<'_> {
    fn input(&mut self, input: Input) -> TokenStream {
        load_input(input)
    }

    fn earlier(&mut self, arena: &Arena, value: Expr) -> Value {
        if arena.stage(value) < Stage::State {
            return Value::Expression(self.store.load(arena, value));
        }
        let place = *self.places.entry(value).or_insert_with(|| {
            self.factors.push(value);
            self.factors.len() - 1
        });
        Value::Element(ArrayElement::at("factors", place))
    }
}
