//! The definitions of the run-time crate, as they reach a mechanism.

use std::path::Path;

use holonom_engine::model::ElementKind;
use proc_macro2::{TokenStream, TokenTree};

/// The kind and the text of a joint or a force of the library.
pub(crate) fn definition(name: &str) -> Option<(ElementKind, TokenStream)> {
    [
        ("joints", "joint", ElementKind::Joint),
        ("forces", "force", ElementKind::Force),
    ]
    .into_iter()
    .find_map(|(folder, word, kind)| Some((kind, text(folder, word, name)?)))
}

fn text(folder: &str, word: &str, name: &str) -> Option<TokenStream> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../runtime/src")
        .join(folder);
    let files = std::fs::read_dir(folder).expect("the library");
    files
        .map(|file| file.expect("a file").path())
        .find_map(|file| {
            let text = std::fs::read_to_string(file).expect("text");
            let items = syn::parse_file(&text).expect("Rust").items.into_iter();
            items
                .filter_map(|item| match item {
                    syn::Item::Macro(item) => Some(item.mac.tokens),
                    _ => None,
                })
                .find_map(|tokens| behind(tokens, word, name))
        })
}

/// What stands behind the word, if the name does.
fn behind(tokens: TokenStream, word: &str, name: &str) -> Option<TokenStream> {
    let is = |token: &TokenTree, wanted: &str| matches!(token, TokenTree::Ident(ident) if ident == wanted);
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let at = tokens.iter().position(|token| is(token, word))? + 1;
    is(tokens.get(at)?, name).then(|| tokens[at..].iter().cloned().collect())
}
