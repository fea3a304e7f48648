//! The two normalisations of Euler parameters, where long kernels share what they can.

mod common;

use std::collections::HashSet;

use common::{chain, generated, tokens};
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;

/// The names of functions of the generator: those that are defined, and all that are mentioned.
fn functions(stream: TokenStream, defined: &mut HashSet<String>, mentioned: &mut HashSet<String>) {
    let mut is_definition = false;
    for token in stream {
        match token {
            TokenTree::Ident(ident) => {
                let name = ident.to_string();
                if name.starts_with("__evaluate") || name.starts_with("__rotations_") {
                    if is_definition {
                        defined.insert(name.clone());
                    }
                    mentioned.insert(name.clone());
                }
                is_definition = name == "fn";
            }
            TokenTree::Group(group) => functions(group.stream(), defined, mentioned),
            _ => {}
        }
    }
}

/// Of a chain of four parallel hinges one normalisation has some operations more, and the other
/// some less, than what is divided.
#[test]
fn what_is_called_is_written() {
    let mut shared = 0;
    for rods in [2, 3, 4, 5] {
        let item = tokens(&chain("Revolute", rods, false));
        let (mut defined, mut mentioned) = (HashSet::new(), HashSet::new());
        let tokens = generated(&item).to_token_stream();
        functions(tokens, &mut defined, &mut mentioned);
        let missing: Vec<_> = mentioned.difference(&defined).collect();
        assert!(missing.is_empty(), "{rods} rods: {missing:?}");
        shared += usize::from(defined.contains("__rotations_normalised"));
    }
    assert!(shared > 0, "none of these is long");
}
