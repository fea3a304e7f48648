//! Long kernels are written in blocks: whatever is used later leaves its block.

use std::collections::HashSet;

use holonom_engine::emit::straight_line::{Environment, StraightLine, Value, write};
use holonom_engine::symbolic::arena::{Arena, Expr, Input, Stage};
use proc_macro2::{TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::{Block, Local, Pat, Stmt};

/// Inputs and earlier values from arrays.
struct Arrays;

impl Environment for Arrays {
    fn input(&mut self, input: Input) -> TokenStream {
        let text = format!("{input:?}");
        quote!(input[#text])
    }

    fn earlier(&mut self, _: &Arena, value: Expr) -> Value {
        let place = value.node();
        Value::Expression(quote!(earlier[#place]))
    }
}

/// The names of values, which begin with `n_`, among some tokens.
fn names(tokens: TokenStream) -> Vec<String> {
    let mut found = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Ident(ident) if ident.to_string().starts_with("n_") => {
                found.push(ident.to_string());
            }
            TokenTree::Group(group) => found.extend(names(group.stream())),
            _ => (),
        }
    }
    found
}

/// Walks the statements of a scope and the blocks within; returns what is used but not defined.
fn undefined(statements: &[Stmt], known: &mut HashSet<String>) -> Vec<String> {
    let mut missing = Vec::new();
    for statement in statements {
        match statement {
            Stmt::Local(Local { pat, init, .. }) => {
                let value = &init.as_ref().expect("a value").expr;
                if let syn::Expr::Block(block) = &**value {
                    missing.extend(undefined(&block.block.stmts, &mut known.clone()));
                } else {
                    let used = names(value.to_token_stream());
                    missing.extend(used.into_iter().filter(|name| !known.contains(name)));
                }
                assert!(matches!(pat, Pat::Ident(_) | Pat::Tuple(_)));
                known.extend(names(pat.to_token_stream()));
            }
            other => {
                let used = names(other.to_token_stream());
                missing.extend(used.into_iter().filter(|name| !known.contains(name)));
            }
        }
    }
    missing
}

/// A kernel with so many operations on the state that hands out values of all stages.
fn kernel(length: usize, earlier: u32) -> StraightLine {
    let mut arena = Arena::new();
    let symbols: Vec<Expr> = (0..earlier)
        .map(|place| arena.input(Input::Symbol(place)))
        .collect();
    let (x, y) = (
        arena.input(Input::Coordinate(0)),
        arena.input(Input::Velocity(0)),
    );
    let mut outputs = Vec::new();
    let mut value = x;
    for k in 0..length {
        let factor = symbols.get(k % 50).copied().unwrap_or(y);
        let product = arena.mul(value, factor);
        value = arena.sin(product);
        if k % 97 == 0 {
            outputs.push(value);
        }
    }
    // Values that are known before the state is, of which some serve in the kernel, too.
    outputs.extend(symbols.iter().map(|&symbol| -symbol));
    outputs.push(arena.square(symbols[0]));
    outputs.push(value);
    outputs.push(Arena::ONE);
    write(&arena, &outputs, Stage::State, &mut Arrays)
}

#[test]
fn nothing_is_lost_between_blocks() {
    for (length, earlier) in [(20, 3), (600, 1), (600, 7), (600, 250), (3000, 40)] {
        let StraightLine {
            statements,
            outputs,
        } = kernel(length, earlier);
        let block: Block = syn::parse2(quote!({ #statements })).expect("statements");
        let mut known = HashSet::new();
        let missing = undefined(&block.stmts, &mut known);
        assert!(missing.is_empty(), "{length}, {earlier}: {missing:?}");
        let lost: Vec<String> = names(outputs.into_iter().collect());
        let lost: Vec<&String> = lost.iter().filter(|name| !known.contains(*name)).collect();
        assert!(lost.is_empty(), "{length}, {earlier}: outputs {lost:?}");
    }
}
