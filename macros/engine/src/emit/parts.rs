//! Long kernels in parts: functions one after the other over an array of the values that pass between them.
//!
//! Much of what a compiler does to a function grows faster than its length. A part is short enough for that not to matter, and long enough
//! that what it loads and stores is little beside what it computes: in one long function, most values wait in memory as well.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::local;
use super::straight_line::{Environment, Given, Lines, Statement, StraightLine, lines};
use crate::symbolic::arena::{Arena, Expr, Stage};

/// Kernels of up to so many statements are one function: of some more than a thousand, one that is not divided is a little faster.
pub(super) const MANY: usize = 3000;
/// The statements of a part.
const PART: usize = 500;

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

/// Writes the nodes that the outputs need, that are known no earlier than `from` and are not given: like
/// [`write`](super::straight_line::write) where they are few; else in parts, which stand beside the function.
pub(super) fn write_in_parts(
    (arena, outputs): (&Arena, &[Expr]),
    from: Stage,
    given: &Given,
    environment: &mut impl Environment,
    frame: &Frame,
) -> (StraightLine, TokenStream) {
    let lines = lines(arena, outputs, from, given, environment);
    if lines.statements.len() <= MANY {
        return (lines.in_one_function(outputs), TokenStream::new());
    }
    let passed = Passed::new(&lines, outputs);
    let parts = lines.statements.len().div_ceil(PART);
    let functions = (0..parts).map(|part| passed.part(&lines, part, frame));
    let functions = functions.collect();
    let values = local("values");
    let size = passed.size;
    let names = (0..parts).map(|part| name(frame, part));
    let arguments = &frame.passed;
    let statements = quote! {
        let mut #values = [__S::constant(0.0); #size];
        #( #names(#arguments &mut #values); )*
    };
    let outputs = outputs.iter().zip(lines.outputs.iter());
    let outputs = outputs
        .map(
            |(output, written)| match lines.statement_of(output.node()) {
                None => written.clone(),
                Some(statement) => {
                    let value = passed.value(&lines, statement);
                    if output.is_negative() {
                        quote!((-#value))
                    } else {
                        value
                    }
                }
            },
        )
        .collect();
    let line = StraightLine {
        statements,
        outputs,
    };
    (line, functions)
}

fn name(frame: &Frame, part: usize) -> Ident {
    format_ident!("{}_part_{part}", frame.name)
}

/// The values that pass between parts.
struct Passed {
    /// The place of each statement's value in the array, if another part or an output needs it.
    slots: Vec<Option<usize>>,
    /// The length of the array.
    size: usize,
}

impl Passed {
    /// Places are used again for other values when nothing needs the first any more.
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
        let mut slots = vec![None; count];
        let mut free: Vec<usize> = Vec::new();
        let mut held: Vec<usize> = Vec::new();
        let mut size = 0;
        for part in 0..count.div_ceil(PART) {
            // Parts load before they store.
            held.retain(|&statement| {
                let is_needed = last[statement] > part;
                if !is_needed {
                    free.extend(slots[statement]);
                }
                is_needed
            });
            for statement in PART * part..count.min(PART * (part + 1)) {
                if lines.statements[statement].is_load || last[statement] <= part {
                    continue;
                }
                slots[statement] = Some(free.pop().unwrap_or_else(|| {
                    size += 1;
                    size - 1
                }));
                held.push(statement);
            }
        }
        Self { slots, size }
    }

    /// The expression of a statement's value behind its part.
    fn value(&self, lines: &Lines, statement: usize) -> TokenStream {
        let values = local("values");
        match self.slots[statement] {
            Some(slot) => quote!(#values[#slot]),
            None => lines.statements[statement].value.clone(),
        }
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
        let mut body = TokenStream::new();
        for statement in loaded {
            let (name, value) = (
                &lines.statements[statement].name,
                self.value(lines, statement),
            );
            body.extend(quote!(let #name = #value;));
        }
        let computed = lines.statements[own.clone()].iter();
        let computed = computed.filter(|statement| !statement.is_load);
        body.extend(computed.map(Statement::tokens));
        let values = local("values");
        for statement in own {
            if let Some(slot) = self.slots[statement] {
                let name = &lines.statements[statement].name;
                body.extend(quote!(#values[#slot] = #name;));
            }
        }
        let Frame {
            facade,
            declared,
            unpack,
            ..
        } = frame;
        let (name, size) = (name(frame, part), self.size);
        quote! {
            #[inline(never)]
            fn #name<__S: #facade::Scalar>(#declared #values: &mut [__S; #size]) {
                #unpack
                #body
            }
        }
    }
}
