//! An arena to statements: one `let` per node, named after its origin.

use std::ops::Range;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::local;
use crate::symbolic::arena::{Arena, Expr, Input, Node, Stage};

/// How values of an earlier stage, and inputs, reach the code.
pub trait Environment {
    /// The expression that loads an input of the stage at hand.
    fn input(&mut self, input: Input) -> TokenStream;

    /// The expression that loads a value known earlier.
    fn earlier(&mut self, arena: &Arena, value: Expr) -> TokenStream;
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
    /// The outputs by name.
    pub(super) outputs: Vec<TokenStream>,
}

pub(super) struct Statement {
    pub(super) name: Ident,
    pub(super) value: TokenStream,
    operands: Range<usize>,
    /// Whether it reads an argument, so that it can be written again elsewhere.
    pub(super) is_load: bool,
}

impl Statement {
    pub(super) fn tokens(&self) -> TokenStream {
        let Self { name, value, .. } = self;
        quote!(let #name = #value;)
    }
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
        let statements = if self.statements.len() <= LONG {
            self.statements.iter().map(Statement::tokens).collect()
        } else {
            in_blocks(&self, outputs)
        };
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

struct Writer<'a, E> {
    arena: &'a Arena,
    environment: &'a mut E,
    given: &'a Given,
    is_fused: Vec<bool>,
    lines: Lines,
    /// What the statement at hand refers to.
    operands: Vec<usize>,
}

/// Values that are computed elsewhere and reach a kernel as an argument.
#[derive(Debug, Default)]
pub(super) struct Given {
    nodes: Vec<(usize, TokenStream)>,
}

impl Given {
    /// The elements of an array.
    pub(super) fn elements(values: &[Expr], array: &Ident) -> Self {
        let places = values.iter().enumerate();
        let mut nodes: Vec<_> = places
            .map(|(place, value)| (value.node(), quote!(#array[#place])))
            .collect();
        nodes.sort_by_key(|(node, _)| *node);
        Self { nodes }
    }

    fn value(&self, node: usize) -> Option<&TokenStream> {
        let place = self.nodes.binary_search_by_key(&node, |(node, _)| *node);
        place.ok().map(|place| &self.nodes[place].1)
    }

    fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.nodes.iter().map(|(node, _)| *node)
    }
}

/// The statements of one block of a long kernel.
///
/// Every `let` opens a scope that ends with the block it stands in. The compiler walks scopes by recursion when it writes debug
/// information and overflows its stack after some thousands of them.
const BLOCK: usize = 100;
/// Kernels of up to so many statements are written without blocks.
const LONG: usize = 1000;

/// Writes the nodes that the outputs need and that are known no earlier than `from`.
pub fn write(
    arena: &Arena,
    outputs: &[Expr],
    from: Stage,
    environment: &mut impl Environment,
) -> StraightLine {
    let lines = lines(arena, outputs, from, &Given::default(), environment);
    lines.in_one_function(outputs)
}

/// The statements of the nodes that the outputs need, that are known no earlier than `from` and are not given.
pub(super) fn lines(
    arena: &Arena,
    outputs: &[Expr],
    from: Stage,
    given: &Given,
    environment: &mut impl Environment,
) -> Lines {
    let live = arena.live_above(outputs, from, given.nodes());
    let is_fused = fused_products(arena, &live, outputs);
    let mut writer = Writer {
        arena,
        environment,
        given,
        is_fused,
        lines: Lines {
            statements: Vec::with_capacity(live.len()),
            operands: Vec::new(),
            statement_of: vec![None; arena.len()],
            outputs: Vec::new(),
        },
        operands: Vec::new(),
    };
    for &place in &live {
        writer.operands.clear();
        writer.node(place);
    }
    writer.lines.outputs = outputs
        .iter()
        .map(|&output| writer.reference(output))
        .collect();
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
            let lets: TokenStream = block.iter().map(Statement::tokens).collect();
            quote!(let (#(#used_later,)*) = { #lets (#(#used_later,)*) };)
        })
        .collect()
}

/// Products that one sum alone uses, one for each sum: they are written there, as a fused multiply-add.
fn fused_products(arena: &Arena, live: &[usize], outputs: &[Expr]) -> Vec<bool> {
    let mut uses = vec![0_u32; arena.len()];
    let mut is_own = vec![false; arena.len()];
    for &place in live {
        is_own[place] = true;
        for operand in arena.node(place).operands() {
            uses[operand.node()] += 1;
        }
    }
    // What is an output is used besides.
    for output in outputs {
        uses[output.node()] += 2;
    }
    let fusible = |x: Expr| {
        matches!(arena.get(x), Node::Multiply(..)) && is_own[x.node()] && uses[x.node()] == 1
    };
    let mut is_fused = vec![false; arena.len()];
    for &place in live {
        match arena.node(place) {
            Node::Add(_, b) if fusible(b) => is_fused[b.node()] = true,
            Node::Add(a, _) if fusible(a) => is_fused[a.node()] = true,
            _ => {}
        }
    }
    is_fused
}

impl<E: Environment> Writer<'_, E> {
    fn node(&mut self, place: usize) {
        let value = match self.arena.node(place) {
            Node::Multiply(..) if self.is_fused[place] => return,
            Node::Constant(_) => return,
            Node::Input(input) => {
                let value = self.environment.input(input);
                return self.bind(place, value, true);
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
            Node::Angle(sine, cosine) => {
                let (sine, cosine) = (self.reference(sine), self.reference(cosine));
                quote!(__S::atan2(#sine, #cosine))
            }
            Node::Sign(a) => {
                let a = self.reference(a);
                quote!(__S::select(#a, __S::constant(0.0), __S::constant(-1.0), __S::constant(1.0)))
            }
        };
        self.bind(place, value, false);
    }

    fn function(&mut self, name: &str, argument: Expr) -> TokenStream {
        let name = quote::format_ident!("{name}");
        let argument = self.reference(argument);
        quote!(__S::#name(#argument))
    }

    fn bind(&mut self, place: usize, value: TokenStream, is_load: bool) {
        let label = self
            .arena
            .label(place)
            .map(|label| label.trim_start_matches("r#"));
        let name = local(&format!("{}_{place}", label.unwrap_or("n")));
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

    /// The operand of a sum that is fused into it, and the other one.
    fn fused_operand(&self, a: Expr, b: Expr) -> Option<(Expr, Expr)> {
        if self.is_fused[b.node()] {
            Some((b, a))
        } else if self.is_fused[a.node()] {
            Some((a, b))
        } else {
            None
        }
    }

    fn sum(&mut self, a: Expr, b: Expr) -> TokenStream {
        if let Some((product, other)) = self.fused_operand(a, b)
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
        let statement = self.lines.statement_of[place].unwrap_or_else(|| {
            let value = match self.given.value(place) {
                Some(value) => value.clone(),
                None => self.environment.earlier(self.arena, expr.abs()),
            };
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
