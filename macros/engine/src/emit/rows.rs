//! Arrays of rows of values: what long kernels hand on.
//!
//! To the type checker an index is dearer than an operation, and a store dearer still; a pattern
//! costs next to nothing while it is short. So values stand in rows, which are read by patterns and
//! written at once.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::syntax::words::local;

/// The length of rows.
pub(super) const WIDTH: usize = 16;

/// A value in an array of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ArrayElement {
    /// The name of the array.
    array: &'static str,
    row: usize,
    column: usize,
}

impl ArrayElement {
    pub(super) const fn new(array: &'static str, row: usize, column: usize) -> Self {
        Self { array, row, column }
    }

    /// The element at a place, in rows of [`WIDTH`].
    pub(super) const fn at(array: &'static str, place: usize) -> Self {
        Self::new(array, place / WIDTH, place % WIDTH)
    }
}

/// Statements that give elements their names.
pub(super) fn unpack<'a>(
    elements: impl IntoIterator<Item = (ArrayElement, &'a Ident)>,
) -> TokenStream {
    let mut rows: BTreeMap<(&str, usize), BTreeMap<usize, &Ident>> = BTreeMap::new();
    for (element, name) in elements {
        let row = rows.entry((element.array, element.row)).or_default();
        row.insert(element.column, name);
    }
    let rows = rows.into_iter().map(|((array, row), names)| {
        let array = local(array);
        let mut next = 0;
        let pattern: TokenStream = names
            .into_iter()
            .map(|(column, name)| {
                let skipped = std::iter::repeat_n(quote!(_,), column - next);
                next = column + 1;
                quote!(#(#skipped)* #name,)
            })
            .collect();
        quote!(let [#pattern ..] = #array[#row];)
    });
    rows.collect()
}

/// Rows of [`WIDTH`] of some values, the last one filled up.
pub(super) fn pack(values: &[TokenStream]) -> Vec<TokenStream> {
    let rows = values.chunks(WIDTH).map(|row| {
        let rest = std::iter::repeat_n(&row[row.len() - 1], WIDTH - row.len());
        let row = row.iter().chain(rest);
        quote!([#(#row),*])
    });
    rows.collect()
}

/// The type of an array of rows.
pub(super) fn array(values: usize) -> TokenStream {
    let rows = values.div_ceil(WIDTH);
    quote!([[__S; #WIDTH]; #rows])
}
