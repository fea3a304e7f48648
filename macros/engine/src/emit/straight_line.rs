//! An arena to statements: one `let` for every node, named after its origin; what is used once,
//! soon and without a name of its own stands where it is used.

use std::collections::BTreeMap;
use std::ops::Range;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::rows::{ArrayElement, unpack};
use crate::model::Curve;
use crate::symbolic::arena::{Arena, Expr, Input, Node, Stage};
use crate::symbolic::uses::{Fused, Uses};
use crate::syntax::words::local;

/// How values of an earlier stage, and inputs, reach the code.
pub trait Environment {
    /// The expression that loads an input of the stage at hand.
    fn input(&mut self, input: Input) -> TokenStream;

    /// What loads a value known earlier.
    fn earlier(&mut self, arena: &Arena, value: Expr) -> Value;
}

/// What a statement gives a name to.
#[derive(Clone, Debug)]
pub enum Value {
    /// What an expression gives.
    Expression(TokenStream),
    /// What stands in a row of values.
    Element(ArrayElement),
}

/// Statements, and the outputs as expressions over them.
#[derive(Clone, Debug)]
pub struct StraightLine {
    /// One `let` per node.
    pub statements: TokenStream,
    /// The outputs in order.
    pub outputs: Vec<TokenStream>,
}

/// The statements of a kernel one by one.
pub(super) struct Lines {
    pub(super) statements: Vec<Statement>,
    /// The nodes that statements refer to, see [`Statement::operands`].
    operands: Vec<usize>,
    /// The statement of each node that has one.
    statement_of: Vec<Option<usize>>,
    /// Statements behind all others: the numbers and negatives that are outputs more than once.
    pub(super) repeated: TokenStream,
    /// The outputs by name.
    pub(super) outputs: Vec<TokenStream>,
}

pub(super) struct Statement {
    pub(super) name: Ident,
    pub(super) value: Value,
    operands: Range<usize>,
    /// Whether it reads an argument, so that it can be written again elsewhere.
    pub(super) is_load: bool,
}

/// Names and what they stand for, to statements: elements first.
pub(super) fn write_all<'a>(
    statements: impl Iterator<Item = (&'a Ident, &'a Value)>,
) -> TokenStream {
    let mut elements = Vec::new();
    let mut lets = TokenStream::new();
    for (name, value) in statements {
        match value {
            Value::Expression(value) => lets.extend(quote!(let #name = #value;)),
            Value::Element(element) => elements.push((*element, name)),
        }
    }
    let elements = unpack(elements);
    quote!(#elements #lets)
}

fn in_one_block(statements: &[Statement]) -> TokenStream {
    write_all(
        statements
            .iter()
            .map(|statement| (&statement.name, &statement.value)),
    )
}

impl Lines {
    /// The statements that a statement refers to.
    pub(super) fn operands(&self, statement: &Statement) -> impl Iterator<Item = usize> + '_ {
        let places = self.operands[statement.operands.clone()].iter();
        places.filter_map(|&place| self.statement_of[place])
    }

    /// The statement of a node; none of a number.
    pub(super) fn statement_of(&self, place: usize) -> Option<usize> {
        self.statement_of[place]
    }

    /// All statements; in blocks where they are many.
    pub(super) fn in_one_function(self, outputs: &[Expr]) -> StraightLine {
        let mut statements = if self.statements.len() <= LONG {
            in_one_block(&self.statements)
        } else {
            in_blocks(&self, outputs)
        };
        statements.extend(self.repeated);
        StraightLine {
            statements,
            outputs: self.outputs,
        }
    }

    /// The last statement that refers to the value of each; `usize::MAX` of an output.
    fn last_uses(&self, outputs: &[Expr]) -> Vec<usize> {
        let mut last = vec![0; self.statements.len()];
        for (number, statement) in self.statements.iter().enumerate() {
            for operand in self.operands(statement) {
                last[operand] = number;
            }
        }
        let outputs = outputs.iter().map(|output| output.node());
        for statement in outputs.filter_map(|place| self.statement_of[place]) {
            last[statement] = usize::MAX;
        }
        last
    }
}

/// The function that evaluates a spline or a derivative of it.
pub(super) fn of_spline(Curve { spline, derivative }: Curve) -> Ident {
    quote::format_ident!("__spline_{spline}_{derivative}")
}

struct Writer<'a, E> {
    arena: &'a Arena,
    environment: &'a mut E,
    fused: Fused,
    /// The nodes that stand where they are used.
    is_nested: Vec<bool>,
    /// Those of them that are written: tokens, what they refer to, and their operations.
    nested: BTreeMap<usize, (TokenStream, Vec<usize>, usize)>,
    lines: Lines,
    /// What the statement at hand refers to.
    operands: Vec<usize>,
    /// The operations that stand in it besides its own.
    inner: usize,
}

/// The statements of one block of a long kernel.
///
/// Every `let` opens a scope that ends with the block it stands in. The compiler walks scopes by
/// recursion when it writes debug information and overflows its stack after some thousands of them.
const BLOCK: usize = 60;
/// Kernels of up to so many statements are written without blocks.
const LONG: usize = 600;
/// A statement holds no more operations that are used once.
const NESTED: usize = 6;
/// Nor does it hold one that is so many operations away: its operands would wait for it.
const NEAR: usize = 40;

/// Writes the nodes that the outputs need and that are known no earlier than `from`.
pub fn write(
    arena: &Arena,
    outputs: &[Expr],
    from: Stage,
    environment: &mut impl Environment,
) -> StraightLine {
    let lines = lines(arena, outputs, from, environment);
    lines.in_one_function(outputs)
}

/// The statements of the nodes that the outputs need and that are known no earlier than `from`.
pub(super) fn lines(
    arena: &Arena,
    outputs: &[Expr],
    from: Stage,
    environment: &mut impl Environment,
) -> Lines {
    let live = arena.live(outputs, from);
    let uses = Uses::new(arena, &live, outputs);
    let mut writer = Writer {
        arena,
        environment,
        fused: uses.fused_products(),
        is_nested: nested(&uses),
        nested: BTreeMap::new(),
        lines: Lines {
            statements: Vec::with_capacity(live.len()),
            operands: Vec::new(),
            statement_of: vec![None; arena.len()],
            repeated: TokenStream::new(),
            outputs: Vec::new(),
        },
        operands: Vec::new(),
        inner: 0,
    };
    for &place in &live {
        writer.operands.clear();
        writer.inner = 0;
        writer.node(place);
    }
    writer.outputs(outputs);
    writer.lines
}

/// Statements in blocks, each of which hands on the values that are needed later.
fn in_blocks(lines: &Lines, outputs: &[Expr]) -> TokenStream {
    let last_uses = lines.last_uses(outputs);
    let blocks = lines.statements.chunks(BLOCK).enumerate();
    blocks
        .map(|(number, block)| {
            let end = BLOCK * number + block.len();
            let last = last_uses[BLOCK * number..].iter();
            let used_later: Vec<&Ident> = block
                .iter()
                .zip(last)
                .filter(|(_, last)| **last >= end)
                .map(|(statement, _)| &statement.name)
                .collect();
            let lets = in_one_block(block);
            quote!(let (#(#used_later,)*) = { #lets (#(#used_later,)*) };)
        })
        .collect()
}

/// Operations without a name of their own that one node alone uses, which is near.
fn nested(uses: &Uses<'_>) -> Vec<bool> {
    let arena = uses.arena;
    let mut number = vec![0; arena.len()];
    for (k, &place) in uses.live.iter().enumerate() {
        number[place] = k;
    }
    let mut is_nested = vec![false; arena.len()];
    for (k, &place) in uses.live.iter().enumerate() {
        for operand in arena.node(place).operands() {
            let operand = operand.node();
            is_nested[operand] = uses.is_own[operand]
                && uses.uses[operand] == 1
                && k - number[operand] <= NEAR
                && arena.node(operand).is_operation()
                && arena.label(operand).is_none();
        }
    }
    is_nested
}

impl<E: Environment> Writer<'_, E> {
    fn node(&mut self, place: usize) {
        let value = match self.arena.node(place) {
            Node::Multiply(..) if self.fused.contains(place) => return,
            Node::Constant(_) => return,
            Node::Input(input) => {
                let value = self.environment.input(input);
                return self.bind(place, Value::Expression(value), true);
            }
            Node::Add(a, b) => self.sum(a, b),
            Node::Multiply(a, b) => {
                let (a, b) = (self.reference(a), self.reference(b));
                quote!(#a * #b)
            }
            Node::Reciprocal(a) => {
                let a = self.reference(a);
                quote!(__S::reciprocal(#a))
            }
            Node::SquareRoot(a) => {
                let a = self.reference(a);
                quote!(__S::sqrt(#a))
            }
            Node::Clamp(a) => {
                let a = self.reference(a);
                let (zero, one) = (quote!(__S::constant(0.0)), quote!(__S::constant(1.0)));
                quote!(__S::select(#a, #zero, #zero, __S::select(#one, #a, #one, #a)))
            }
            Node::Round(a) => self.function("round", a),
            Node::Sine(a) => self.function("sin", a),
            Node::Cosine(a) => self.function("cos", a),
            Node::Exponential(a) => self.function("exp", a),
            Node::Curve(curve, a) => {
                let (function, constants) = (of_spline(curve), local("constants"));
                let a = self.reference(a);
                quote!(#function(&#constants[..], #a))
            }
            Node::Side(a, b) => self.of_two("__side", a, b),
            Node::Above(a, b) => self.of_two("__above", a, b),
            Node::Below(a, b) => self.of_two("__below", a, b),
            Node::Angle(sine, cosine) => {
                let (sine, cosine) = (self.reference(sine), self.reference(cosine));
                quote!(__S::atan2(#sine, #cosine))
            }
            Node::Sign(a) => {
                let a = self.reference(a);
                quote!(__S::select(#a, __S::constant(0.0), __S::constant(-1.0), __S::constant(1.0)))
            }
        };
        if self.is_nested[place] && self.inner < NESTED {
            let operands = std::mem::take(&mut self.operands);
            let operations = self.inner + 1;
            self.nested
                .insert(place, (quote!((#value)), operands, operations));
            return;
        }
        self.bind(place, Value::Expression(value), false);
    }

    /// The outputs. A number, most often 0, or a negative gets a name where it is one more than
    /// once: each would be looked up, and called, again.
    fn outputs(&mut self, outputs: &[Expr]) {
        let is_written =
            |output: Expr| output.is_negative() || self.arena.literal(output).is_some();
        let place = |output: Expr| 2 * output.node() + usize::from(output.is_negative());
        let mut uses = vec![0_u32; 2 * self.arena.len()];
        for &output in outputs.iter().filter(|output| is_written(**output)) {
            uses[place(output)] += 1;
        }
        let mut names: Vec<Option<Ident>> = vec![None; uses.len()];
        for &output in outputs {
            let place = place(output);
            if uses[place] > 1 && names[place].is_none() {
                let (name, value) = (local(&format!("repeated_{place}")), self.reference(output));
                self.lines.repeated.extend(quote!(let #name = #value;));
                names[place] = Some(name);
            }
            let value = match &names[place] {
                Some(name) => quote!(#name),
                None => self.reference(output),
            };
            self.lines.outputs.push(value);
        }
    }

    fn function(&mut self, name: &str, argument: Expr) -> TokenStream {
        let name = quote::format_ident!("{name}");
        let argument = self.reference(argument);
        quote!(__S::#name(#argument))
    }

    fn of_two(&mut self, name: &str, first: Expr, second: Expr) -> TokenStream {
        let name = quote::format_ident!("{name}");
        let (first, second) = (self.reference(first), self.reference(second));
        quote!(#name(#first, #second))
    }

    fn bind(&mut self, place: usize, value: Value, is_load: bool) {
        let label = self.arena.label(place).unwrap_or("n");
        let name = local(&format!("{label}_{place}"));
        let lines = &mut self.lines;
        let first = lines.operands.len();
        if !is_load {
            lines.operands.append(&mut self.operands);
        }
        lines.statement_of[place] = Some(lines.statements.len());
        lines.statements.push(Statement {
            name,
            value,
            operands: first..lines.operands.len(),
            is_load,
        });
    }

    fn sum(&mut self, a: Expr, b: Expr) -> TokenStream {
        if let Some((product, other)) = self.fused.operand(a, b)
            && let Node::Multiply(x, y) = self.arena.get(product)
        {
            let x = if product.is_negative() { -x } else { x };
            let (x, y, other) = (self.reference(x), self.reference(y), self.reference(other));
            return quote!(__S::fused(#x, #y, #other));
        }
        let first = self.reference(a);
        let second = self.reference(b.abs());
        if b.is_negative() {
            quote!(#first - #second)
        } else {
            quote!(#first + #second)
        }
    }

    fn reference(&mut self, expr: Expr) -> TokenStream {
        if let Some(value) = self.arena.literal(expr) {
            return quote!(__S::constant(#value));
        }
        let place = expr.node();
        if let Some((value, operands, operations)) = self.nested.remove(&place) {
            self.operands.extend(operands);
            self.inner += operations;
            return if expr.is_negative() {
                quote!((-#value))
            } else {
                value
            };
        }
        let statement = self.lines.statement_of[place].unwrap_or_else(|| {
            let value = self.environment.earlier(self.arena, expr.abs());
            self.bind(place, value, true);
            self.lines.statements.len() - 1
        });
        self.operands.push(place);
        let name = &self.lines.statements[statement].name;
        if expr.is_negative() {
            quote!((-#name))
        } else {
            quote!(#name)
        }
    }
}
