//! Names that are words of the language in later editions than that of their crate.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};

/// Names like others in the edition of 2015, of which generated code, and the parser, would make something else.
const LATER: [&str; 3] = ["async", "await", "try"];

/// The same tokens with such names written raw, which means the same in every edition.
#[must_use]
pub fn raw(tokens: TokenStream) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Ident(name) if LATER.iter().any(|word| name == word) => {
                Ident::new_raw(&name.to_string(), name.span()).into()
            }
            TokenTree::Group(group) => {
                let mut within = Group::new(group.delimiter(), raw(group.stream()));
                within.set_span(group.span());
                within.into()
            }
            other => other,
        })
        .collect()
}
