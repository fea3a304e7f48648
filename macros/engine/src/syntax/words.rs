//! Names that mean the same wherever they stand: words of later editions, and names of the
//! generator's own.

use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};

/// Names like others in the edition of 2015, of which generated code, and the parser, would make
/// something else.
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

/// A local name that belongs to the generator: variables of users and of other macros cannot meet
/// it, by its hygiene. Constants, statics and unit structs could, because hygiene does not part
/// those from a pattern of the same name; hence the underscores.
#[must_use]
pub fn local(name: &str) -> Ident {
    Ident::new(&format!("__{name}"), Span::mixed_site())
}
