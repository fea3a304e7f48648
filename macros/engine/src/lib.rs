//! The code generator of `holonom`: from a described mechanism to straight-line Rust.
//!
//! An ordinary library over tokens, so that every pass can be tested, counted and fuzzed without a
//! compiler session; the crate of the procedural macros is a shim. The passes:
//!
//! ```text
//! syntax       tokens            -> what was written, with spans; every fault collected
//! mesh         files of triangles -> what they enclose
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
pub mod mesh;
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
use syntax::mechanism::{Assemblies, AssemblySyntax, MechanismSyntax};
use wire::Carried;

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
    sent(&tokens, false)
}

/// `#[derive(Assembly)]`: the same for a part of mechanisms.
#[must_use]
pub fn derive_assembly(tokens: TokenStream) -> TokenStream {
    sent(&tokens, true)
}

fn sent(tokens: &TokenStream, is_assembly: bool) -> TokenStream {
    guarded(|| {
        let mut faults = Faults::new();
        let Some(input) = item(tokens, &mut faults) else {
            return faults.into_tokens();
        };
        let mut paths = syntax::mechanism::carrier_paths(&input);
        let syntax = syntax::mechanism::parse(&input, &Vec::new(), &mut faults);
        if !paths.is_empty() {
            // They are found again at the end of the way.
            drop(faults.into_tokens());
            if kinds::too_many(&syntax, paths.len()).is_some() {
                paths.truncate(1);
            }
            if is_assembly {
                let (mark, tokens) = (wire::assembly_mark(), syntax::files::placed(tokens.clone()));
                return wire::call(&paths, &quote!(#mark #tokens));
            }
            return wire::call(&paths, tokens);
        }
        // Nobody can tell where the run-time crate is: say what can be said without it.
        if syntax.is_plain {
            let facade = TokenStream::new();
            Known::default().model(&syntax, is_assembly, &facade, &mut faults);
        }
        faults.into_tokens()
    })
}

/// The annotated struct.
fn item(tokens: &TokenStream, faults: &mut Faults) -> Option<DeriveInput> {
    faults.accept(syntax::depth::of_input(tokens))?;
    faults.accept(syn::parse2(syntax::words::raw(tokens.clone())))
}

/// `assemble!`: the end of the way; all definitions are there.
#[must_use]
pub fn assemble(tokens: TokenStream) -> TokenStream {
    guarded(|| {
        let mut faults = Faults::new();
        let delivery = faults
            .accept(syntax::depth::of_input(&tokens))
            .and_then(|()| faults.accept(wire::unpack(tokens)));
        let Some(delivery) = delivery else {
            return faults.into_tokens();
        };
        let Some(input) = item(&delivery.payload, &mut faults) else {
            return faults.into_tokens();
        };
        let (facade, is_assembly) = (&delivery.facade, delivery.is_assembly);
        let mut known = Known::default();
        let paths = known.read(&delivery.carried, &input, "", &mut faults);
        let syntax = syntax::mechanism::parse(&input, &known.assemblies, &mut faults);
        let mut model = None;
        if let Some(message) = kinds::too_many(&syntax, paths.len()) {
            faults.at(&syntax.name, message);
            let unknown = paths.iter().map(ToString::to_string);
            known.types = unknown.map(|path| (path, Definition::Faulty)).collect();
        } else {
            model = known.model(&syntax, is_assembly, facade, &mut faults);
        }
        let model = model.filter(|_| !faults.any());
        let items = match &model {
            model if is_assembly => {
                emit::assembly::emit(&input, &syntax, &delivery, model.as_ref())
            }
            Some(model) => emit::mechanism::emit(model, facade),
            None => emit::fallback::emit(&syntax, &known.types, facade),
        };
        let errors = faults.into_tokens();
        quote!(#errors #items)
    })
}

/// What the carriers brought.
#[derive(Default)]
struct Known {
    types: Definitions,
    definitions: Vec<model::ElementDef>,
    assemblies: Assemblies,
}

impl Known {
    /// What a struct means. `None` if anything is wrong with it; then the faults say what, here or
    /// where something that it needs is defined.
    fn model(
        &mut self,
        syntax: &MechanismSyntax,
        is_assembly: bool,
        facade: &TokenStream,
        faults: &mut Faults,
    ) -> Option<model::Model> {
        let are_parts_sound = syntax.parts.iter().all(|part| part.is_sound);
        let mut model = None;
        if syntax.is_plain && are_parts_sound {
            let definitions = std::mem::take(&mut self.definitions);
            let pass = if is_assembly {
                check::mechanism::check_assembly
            } else {
                passes::mechanism
            };
            model = pass(syntax, &self.types, definitions, facade, faults);
        }
        let is_faulty = |definition: &Definition| matches!(definition, Definition::Faulty);
        let is_told = faults.any()
            || !are_parts_sound
            || self
                .types
                .iter()
                .any(|(_, definition)| is_faulty(definition))
            || check::mechanism::is_ambiguous(syntax);
        if model.is_none() && !is_told {
            let name = &syntax.name;
            let message = format!("holonom's generator failed on `{name}`; please report this");
            faults.at(name, message);
        }
        model
    }

    /// Reads what the field types of a struct turned out to be; their paths.
    fn read(
        &mut self,
        carried: &[Carried],
        input: &DeriveInput,
        context: &str,
        faults: &mut Faults,
    ) -> Vec<TokenStream> {
        let paths = syntax::mechanism::carrier_paths(input);
        for (path, carried) in paths.iter().zip(carried) {
            let key = format!("{context}{path}");
            let definition = match carried {
                Carried::Body => Definition::Body(BodyKind::Rigid),
                Carried::Particle => Definition::Body(BodyKind::Particle),
                Carried::Faulty => Definition::Faulty,
                Carried::Element(kind, body) => self.element(*kind, body, path, faults),
                Carried::Assembly(assembly) => self.assembly(assembly, &key, path, faults),
            };
            self.types.push((key, definition));
        }
        paths
    }

    fn element(
        &mut self,
        kind: ElementKind,
        body: &TokenStream,
        path: &TokenStream,
        faults: &mut Faults,
    ) -> Definition {
        // It was checked where it is defined.
        let mut known = Faults::new();
        let joint = syntax::joint::parse_transported(body.clone(), kind, &mut known)
            .and_then(|syntax| check::joint::check(&syntax, &mut known));
        drop(known.into_tokens());
        match joint {
            Some(joint) => {
                self.definitions.push(joint);
                Definition::Element(self.definitions.len() - 1)
            }
            None => unreadable(path, faults),
        }
    }

    fn assembly(
        &mut self,
        assembly: &wire::Assembly,
        key: &str,
        path: &TokenStream,
        faults: &mut Faults,
    ) -> Definition {
        let mut known = Faults::new();
        let input = item(&assembly.item, &mut known);
        drop(known.into_tokens());
        let Some(input) = input else {
            return unreadable(path, faults);
        };
        self.read(&assembly.carried, &input, &format!("{key}/"), faults);
        let syntax = AssemblySyntax {
            input,
            fingerprint: assembly.fingerprint,
            is_sound: assembly.is_sound,
        };
        self.assemblies.push((key.to_owned(), syntax));
        Definition::Assembly
    }
}

fn unreadable(path: &TokenStream, faults: &mut Faults) -> Definition {
    let name = diag::code(path);
    faults.at(
        path,
        format!("the definition of `{name}` cannot be read; use one version of holonom throughout"),
    );
    Definition::Faulty
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
