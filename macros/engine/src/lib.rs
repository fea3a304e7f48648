//! The code generator of `holonom`: from a described mechanism to straight-line Rust.
//!
//! An ordinary library over tokens, so that every pass can be tested, counted and fuzzed without a
//! compiler session; the crate of the procedural macros is a shim. The passes:
//!
//! ```text
//! syntax       tokens            -> what was written, with spans; every fault collected
//! check        what was written  -> the model, or refusals, each a sentence at the user's token
//! symbolic     the model         -> vectors that know their frame, an arena of scalars
//! rank         the equations     -> by numbers, which of them follow from others
//! plan         symbols           -> axes, order of elimination, kernels as outputs over arenas
//! coordinates  symbols           -> the same by joint coordinates
//! emit         kernels           -> Rust; cannot fail
//! ```
#![forbid(unsafe_code)]

pub mod check;
pub mod coordinates;
pub mod diag;
pub mod emit;
pub mod model;
pub mod passes;
pub mod plan;
pub mod rank;
pub mod symbolic;
pub mod syntax;
pub mod wire;

use std::panic::{AssertUnwindSafe, catch_unwind};

use proc_macro2::TokenStream;
use quote::quote;
use syn::DeriveInput;

use check::definition::{Definition, Definitions};
use check::kinds;
use diag::Faults;
use model::{BodyKind, ElementKind};
use wire::{Carried, Delivery};

/// `joint!`: the tokens are the path of the run-time crate in brackets, then the definition.
#[must_use]
pub fn joint(tokens: TokenStream) -> TokenStream {
    element(tokens, ElementKind::Joint)
}

/// `force!`: the tokens are the path of the run-time crate in brackets, then the definition.
#[must_use]
pub fn force(tokens: TokenStream) -> TokenStream {
    element(tokens, ElementKind::Force)
}

fn element(tokens: TokenStream, kind: ElementKind) -> TokenStream {
    guarded(|| {
        if let Err(error) = syntax::depth::of_input(&tokens) {
            return error.into_compile_error();
        }
        let mut tokens = tokens.into_iter();
        let Some(proc_macro2::TokenTree::Group(facade)) = tokens.next() else {
            return quote!(
                ::core::compile_error! { "this macro is called by `joint!` and `force!` only" }
            );
        };
        let facade = facade.stream();
        let mut faults = Faults::new();
        let Some(syntax) = syntax::joint::parse(tokens.collect(), kind, &mut faults) else {
            return faults.into_tokens();
        };
        let definition = passes::definition(&syntax, &mut faults);
        let items = emit::joint::emit(&syntax, definition.as_ref(), &facade);
        let errors = faults.into_tokens();
        quote!(#errors #items)
    })
}

/// `#[derive(Mechanism)]`: sends the struct on its way through the carriers of its field types.
#[must_use]
pub fn derive(tokens: TokenStream) -> TokenStream {
    guarded(|| {
        let mut faults = Faults::new();
        let input = faults
            .accept(syntax::depth::of_input(&tokens))
            .and_then(|()| {
                let tokens = syntax::words::raw(tokens.clone());
                faults.accept(syn::parse2::<DeriveInput>(tokens))
            });
        let Some(input) = input else {
            return faults.into_tokens();
        };
        let mut paths = syntax::mechanism::carrier_paths(&input);
        if !paths.is_empty() {
            let syntax = syntax::mechanism::parse(&input, &mut faults);
            // They are found again at the end of the way.
            drop(faults.into_tokens());
            if kinds::too_many(&syntax, paths.len()).is_some() {
                paths.truncate(1);
            }
            return wire::call(&paths, &tokens);
        }
        // Nobody can tell where the run-time crate is: say what can be said without it.
        let syntax = syntax::mechanism::parse(&input, &mut faults);
        if syntax.is_plain {
            let facade = TokenStream::new();
            passes::mechanism(&syntax, &Vec::new(), Vec::new(), &facade, &mut faults);
        }
        faults.into_tokens()
    })
}

/// `assemble!`: the end of the way; all definitions are there.
#[must_use]
pub fn assemble(tokens: TokenStream) -> TokenStream {
    guarded(|| {
        let mut faults = Faults::new();
        let delivery = faults
            .accept(syntax::depth::of_input(&tokens))
            .and_then(|()| faults.accept(wire::unpack(tokens)));
        let Some(Delivery {
            facade,
            carried,
            payload,
        }) = delivery
        else {
            return faults.into_tokens();
        };
        let payload = syntax::words::raw(payload);
        let Some(input) = faults.accept(syn::parse2::<DeriveInput>(payload)) else {
            return faults.into_tokens();
        };
        let syntax = syntax::mechanism::parse(&input, &mut faults);
        let paths = syntax::mechanism::carrier_paths(&input);
        if let Some(message) = kinds::too_many(&syntax, paths.len()) {
            faults.at(&syntax.name, message);
            let unknown = paths
                .iter()
                .map(|path| (path.to_string(), Definition::Faulty));
            let items = emit::fallback::emit(&syntax, &unknown.collect(), &facade);
            let errors = faults.into_tokens();
            return quote!(#errors #items);
        }
        let mut definitions = Vec::new();
        let types: Definitions = paths
            .iter()
            .zip(carried)
            .map(|(path, carried)| {
                (
                    path.to_string(),
                    resolve(carried, path, &mut definitions, &mut faults),
                )
            })
            .collect();
        let model = if syntax.is_plain {
            passes::mechanism(&syntax, &types, definitions, &facade, &mut faults)
        } else {
            None
        };
        let is_faulty = types
            .iter()
            .any(|(_, definition)| matches!(definition, Definition::Faulty));
        let is_ambiguous = check::mechanism::is_ambiguous(&syntax);
        if model.is_none() && !faults.any() && !is_faulty && !is_ambiguous {
            faults.at(
                &syntax.name,
                format!(
                    "holonom's generator failed on `{}`; please report this",
                    syntax.name
                ),
            );
        }
        let items = match &model {
            Some(model) if !faults.any() => emit::mechanism::emit(model, &facade),
            _ => emit::fallback::emit(&syntax, &types, &facade),
        };
        let errors = faults.into_tokens();
        quote!(#errors #items)
    })
}

fn resolve(
    carried: Carried,
    path: &TokenStream,
    definitions: &mut Vec<model::ElementDef>,
    faults: &mut Faults,
) -> Definition {
    match carried {
        Carried::Body => Definition::Body(BodyKind::Rigid),
        Carried::Particle => Definition::Body(BodyKind::Particle),
        Carried::Faulty => Definition::Faulty,
        Carried::Element(kind, body) => {
            // It was checked where it is defined.
            let mut known = Faults::new();
            let joint = syntax::joint::parse_transported(body, kind, &mut known)
                .and_then(|syntax| check::joint::check(&syntax, &mut known));
            drop(known.into_tokens());
            match joint {
                Some(joint) => {
                    definitions.push(joint);
                    Definition::Element(definitions.len() - 1)
                }
                None => {
                    let name = diag::code(path);
                    faults.at(
                        path,
                        format!("the definition of `{name}` cannot be read; use one version of holonom throughout"),
                    );
                    Definition::Faulty
                }
            }
        }
    }
}

/// A panic is our mistake: it becomes an error that says so instead of a broken compiler session.
fn guarded(pass: impl FnOnce() -> TokenStream) -> TokenStream {
    catch_unwind(AssertUnwindSafe(pass)).unwrap_or_else(|payload| {
        let reason = payload
            .downcast_ref::<&str>()
            .map(ToString::to_string)
            .or_else(|| payload.downcast_ref::<String>().cloned())
            .unwrap_or_default();
        let message = format!(
            "holonom's generator failed, please report this with the description above: {reason}"
        );
        quote!(::core::compile_error! { #message })
    })
}
