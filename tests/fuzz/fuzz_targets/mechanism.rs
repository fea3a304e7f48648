//! A definition and an annotated struct that uses it, with a line of `===` between them: what is
//! not refused where it is defined can be assembled, and nothing panics.
#![no_main]

use libfuzzer_sys::fuzz_target;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;

/// Whether a number stands behind a `;` that has more than one figure: the length of an array whose
/// kernels nobody would wait for.
fn has_long_array(tokens: TokenStream) -> bool {
    let mut behind = false;
    tokens.into_iter().any(|token| {
        let before = std::mem::replace(&mut behind, false);
        match token {
            TokenTree::Punct(punct) => {
                behind = punct.as_char() == ';';
                false
            }
            TokenTree::Literal(literal) => before && literal.to_string().len() > 1,
            TokenTree::Group(group) => has_long_array(group.stream()),
            TokenTree::Ident(_) => false,
        }
    })
}

fuzz_target!(|text: &str| {
    let Some((definition, item)) = text.split_once("\n===\n") else {
        return;
    };
    let (Ok(definition), Ok(item)) = (
        definition.parse::<TokenStream>(),
        item.parse::<TokenStream>(),
    ) else {
        return;
    };
    if has_long_array(item.clone()) {
        return;
    }
    // The carriers of a compiler session: a body, a particle, then whatever is defined as a joint
    // and as a force.
    let delivery = quote! {
        [::holonom] [[body] [particle] [joint { #definition }] [force { #definition }]] { #item }
    };
    for output in [
        holonom_engine::derive(item),
        holonom_engine::assemble(delivery),
    ] {
        assert!(!output.to_string().contains("generator failed"), "{text}");
    }
});
