//! An arena to statements: one `let` per node, named after its origin.

use std::collections::{HashMap, HashSet};

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

struct Writer<'a, E> {
    arena: &'a Arena,
    environment: &'a mut E,
    names: HashMap<usize, Ident>,
    fused: HashSet<usize>,
    statements: Vec<Statement>,
    /// The statement that uses a node last.
    last_use: HashMap<usize, usize>,
    /// What the statement at hand refers to.
    operands: Vec<usize>,
}

struct Statement {
    place: usize,
    name: Ident,
    value: TokenStream,
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
    let live = arena.live(outputs, from);
    let fused = fused_products(arena, &live, outputs);
    let mut writer = Writer {
        arena,
        environment,
        names: HashMap::new(),
        fused,
        statements: Vec::new(),
        last_use: HashMap::new(),
        operands: Vec::new(),
    };
    for &place in &live {
        writer.operands.clear();
        writer.node(place);
    }
    let references = outputs
        .iter()
        .map(|&output| {
            writer.operands.clear();
            writer.reference(output)
        })
        .collect();
    // Behind all statements, also those that load an output.
    let used_last = outputs.iter().map(|output| (output.node(), usize::MAX));
    writer.last_use.extend(used_last);
    StraightLine {
        statements: writer.written(),
        outputs: references,
    }
}

/// Products that one sum alone uses, one for each sum: they are written there, as a fused multiply-add.
fn fused_products(arena: &Arena, live: &[usize], outputs: &[Expr]) -> HashSet<usize> {
    let mut uses: HashMap<usize, usize> = HashMap::new();
    for &place in live {
        for operand in arena.node(place).operands() {
            *uses.entry(operand.node()).or_default() += 1;
        }
    }
    for output in outputs {
        *uses.entry(output.node()).or_default() += 1;
    }
    let is_output: HashSet<usize> = outputs.iter().map(|output| output.node()).collect();
    let own: HashSet<usize> = live.iter().copied().collect();
    let fusible = |x: Expr| {
        matches!(arena.get(x), Node::Multiply(..))
            && own.contains(&x.node())
            && uses.get(&x.node()) == Some(&1)
            && !is_output.contains(&x.node())
    };
    live.iter()
        .filter_map(|&place| match arena.node(place) {
            Node::Add(_, b) if fusible(b) => Some(b.node()),
            Node::Add(a, _) if fusible(a) => Some(a.node()),
            _ => None,
        })
        .collect()
}

impl<E: Environment> Writer<'_, E> {
    fn node(&mut self, place: usize) {
        let value = match self.arena.node(place) {
            Node::Multiply(..) if self.fused.contains(&place) => return,
            Node::Constant(_) => return,
            Node::Input(input) => self.environment.input(input),
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
        self.bind(place, &value);
    }

    fn function(&mut self, name: &str, argument: Expr) -> TokenStream {
        let name = quote::format_ident!("{name}");
        let argument = self.reference(argument);
        quote!(__S::#name(#argument))
    }

    fn bind(&mut self, place: usize, value: &TokenStream) {
        let label = self
            .arena
            .label(place)
            .map(|label| label.trim_start_matches("r#"));
        let name = local(&format!("{}_{place}", label.unwrap_or("n")));
        self.names.insert(place, name.clone());
        for &operand in &self.operands {
            self.last_use.insert(operand, self.statements.len());
        }
        let value = value.clone();
        self.statements.push(Statement { place, name, value });
    }

    fn written(&self) -> TokenStream {
        let lets = |statements: &[Statement]| -> TokenStream {
            statements
                .iter()
                .map(|Statement { name, value, .. }| quote!(let #name = #value;))
                .collect()
        };
        if self.statements.len() <= LONG {
            return lets(&self.statements);
        }
        let blocks = self.statements.chunks(BLOCK).enumerate();
        blocks
            .map(|(number, block)| {
                let end = BLOCK * number + block.len();
                let used_later: Vec<&Ident> = block
                    .iter()
                    .filter(|statement| {
                        self.last_use
                            .get(&statement.place)
                            .is_some_and(|&last| last >= end)
                    })
                    .map(|statement| &statement.name)
                    .collect();
                let lets = lets(block);
                quote!(let (#(#used_later,)*) = { #lets (#(#used_later,)*) };)
            })
            .collect()
    }

    /// The operand of a sum that is fused into it, and the other one.
    fn fused_operand(&self, a: Expr, b: Expr) -> Option<(Expr, Expr)> {
        if self.fused.contains(&b.node()) {
            Some((b, a))
        } else if self.fused.contains(&a.node()) {
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
        if !self.names.contains_key(&place) {
            let value = self.environment.earlier(self.arena, expr.abs());
            self.bind(place, &value);
        }
        self.operands.push(place);
        let name = &self.names[&place];
        if expr.is_negative() {
            quote!((-#name))
        } else {
            quote!(#name)
        }
    }
}
