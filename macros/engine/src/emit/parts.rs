//! Long kernels in parts: functions one after the other over rows of the values that pass between
//! them.
//!
//! Much of what a compiler does to a function grows faster than its length. A part is short enough
//! for that not to matter, and long enough that what it loads and stores is little beside what it
//! computes: in one long function, most values wait in memory as well.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::rows::{ArrayElement, WIDTH, pack};
use super::straight_line::{Environment, Lines, StraightLine, Value, lines, write_all};
use crate::symbolic::arena::{Arena, Expr, Stage};
use crate::syntax::words::local;

/// Kernels of up to so many statements are one function: of some more than a thousand, one that is
/// not divided is a little faster.
const MANY: usize = 1800;
/// The statements of a part.
const PART: usize = 160;

/// The function that a kernel is written for.
pub(super) struct Frame {
    /// Its name, which those of the parts begin with.
    pub(super) name: String,
    /// The path of the run-time crate.
    pub(super) facade: TokenStream,
    /// Its parameters, which are those of the parts, declared and passed on.
    pub(super) declared: TokenStream,
    pub(super) passed: TokenStream,
    /// The statements that it begins with.
    pub(super) unpack: TokenStream,
}

/// Writes the nodes that the outputs need and that are known no earlier than `from`: like
/// [`write`](super::straight_line::write) where they are few; else in parts, which stand beside the
/// function.
pub(super) fn write_in_parts(
    (arena, outputs): (&Arena, &[Expr]),
    from: Stage,
    environment: &mut impl Environment,
    frame: &Frame,
) -> (StraightLine, TokenStream) {
    let lines = lines(arena, outputs, from, environment);
    if lines.statements.len() <= MANY {
        return (lines.in_one_function(outputs), TokenStream::new());
    }
    let passed = Passed::new(&lines, outputs);
    let parts = lines.statements.len().div_ceil(PART);
    let functions = (0..parts).map(|part| passed.part(&lines, part, frame));
    let functions = functions.collect();
    let values = local("values");
    let (width, rows) = (WIDTH, passed.rows);
    let names = (0..parts).map(|part| name(frame, part));
    let arguments = &frame.passed;
    let needed: BTreeSet<usize> = outputs
        .iter()
        .filter_map(|output| lines.statement_of(output.node()))
        .collect();
    let needed = passed.load(&lines, needed);
    let repeated = &lines.repeated;
    let statements = quote! {
        let mut #values = [[__S::constant(0.0); #width]; #rows];
        #( #names(#arguments &mut #values); )*
        #needed
        #repeated
    };
    let line = StraightLine {
        statements,
        outputs: lines.outputs,
    };
    (line, functions)
}

fn name(frame: &Frame, part: usize) -> Ident {
    format_ident!("{}_part_{part}", frame.name)
}

/// The values that pass between parts.
struct Passed {
    /// The place of each statement's value in the array, if another part or an output needs it.
    places: Vec<Option<ArrayElement>>,
    /// The rows that each part writes: where, and the statements.
    written: Vec<Vec<(usize, Vec<usize>)>>,
    /// The length of the array.
    rows: usize,
}

impl Passed {
    /// Rows are used again for other values when nothing needs the first any more.
    fn new(lines: &Lines, outputs: &[Expr]) -> Self {
        let count = lines.statements.len();
        // The last part that needs a value.
        let mut last: Vec<usize> = (0..count).map(|statement| statement / PART).collect();
        for (number, statement) in lines.statements.iter().enumerate() {
            for operand in lines.operands(statement) {
                last[operand] = number / PART;
            }
        }
        for output in outputs {
            if let Some(statement) = lines.statement_of(output.node()) {
                last[statement] = usize::MAX;
            }
        }
        let mut passed = Self {
            places: vec![None; count],
            written: Vec::new(),
            rows: 0,
        };
        let mut free: Vec<usize> = Vec::new();
        // Rows, and the last part that needs a value of theirs.
        let mut held: Vec<(usize, usize)> = Vec::new();
        for part in 0..count.div_ceil(PART) {
            // Parts load before they store.
            held.retain(|&(row, last)| {
                if last <= part {
                    free.push(row);
                }
                last > part
            });
            let own = PART * part..count.min(PART * (part + 1));
            let mut own: Vec<usize> = own
                .filter(|&statement| !lines.statements[statement].is_load && last[statement] > part)
                .collect();
            own.sort_by_key(|&statement| last[statement]);
            let mut written = Vec::new();
            for statements in own.chunks(WIDTH) {
                let row = free.pop().unwrap_or(passed.rows);
                passed.rows = passed.rows.max(row + 1);
                for (column, &statement) in statements.iter().enumerate() {
                    passed.places[statement] = Some(ArrayElement::new("values", row, column));
                }
                held.push((row, last[statements[statements.len() - 1]]));
                written.push((row, statements.to_vec()));
            }
            passed.written.push(written);
        }
        passed
    }

    /// Statements that load the values of others: those that were passed, and arguments.
    fn load(&self, lines: &Lines, statements: BTreeSet<usize>) -> TokenStream {
        let loaded: Vec<(usize, Value)> = statements
            .into_iter()
            .map(|statement| {
                let value = match self.places[statement] {
                    Some(element) => Value::Element(element),
                    None => lines.statements[statement].value.clone(),
                };
                (statement, value)
            })
            .collect();
        let names = |statement: usize| &lines.statements[statement].name;
        write_all(
            loaded
                .iter()
                .map(|(statement, value)| (names(*statement), value)),
        )
    }

    /// The function of a part.
    fn part(&self, lines: &Lines, part: usize, frame: &Frame) -> TokenStream {
        let count = lines.statements.len();
        let own = PART * part..count.min(PART * (part + 1));
        let mut loaded = BTreeSet::new();
        for statement in &lines.statements[own.clone()] {
            let is_loaded = |k: &usize| lines.statements[*k].is_load || !own.contains(k);
            loaded.extend(lines.operands(statement).filter(is_loaded));
        }
        let mut body = self.load(lines, loaded);
        let computed = lines.statements[own].iter();
        let computed = computed.filter(|statement| !statement.is_load);
        body.extend(write_all(
            computed.map(|statement| (&statement.name, &statement.value)),
        ));
        let values = local("values");
        for (row, statements) in &self.written[part] {
            let names = statements.iter().map(|&statement| {
                let name = &lines.statements[statement].name;
                quote!(#name)
            });
            let names: Vec<TokenStream> = names.collect();
            let packed = pack(&names);
            body.extend(quote!(#values[#row] = #(#packed)*;));
        }
        let Frame {
            facade,
            declared,
            unpack,
            ..
        } = frame;
        let (name, width, rows) = (name(frame, part), WIDTH, self.rows);
        quote! {
            #[inline(never)]
            fn #name<__S: #facade::Scalar>(#declared #values: &mut [[__S; #width]; #rows]) {
                #unpack
                #body
            }
        }
    }
}
