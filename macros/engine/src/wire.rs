//! How a definition travels from the crate that defines a joint to the crate that uses it.
//!
//! Every joint is a type and a macro of one name. The macro, the carrier, takes a queue of further
//! carriers, the definitions gathered so far and the annotated struct; it appends its own
//! definition and calls the next carrier, after asking by a trait whether the next is a body or a
//! joint at all, and the last one calls `assemble!` through its own `$crate`. Bodies carry in the
//! same way. So nobody guesses the name of a crate, renames and re-exports work, and no state lives
//! between invocations.
//!
//! The word behind `@` names the version of this protocol; it changes with every incompatible
//! change.
//!
//! The derive asserts that type and definition have one fingerprint, in case one of the two names
//! was shadowed. A definition of another protocol version lands in an arm of its own, with one
//! sentence.
//!
//! Names in generated code. Local names have the hygiene of the macro and begin with two
//! underscores, because hygiene does not separate a pattern from a constant of its name. Types of
//! the language are imported into an anonymous constant. Words of later editions are written raw
//! (`syntax/words.rs`). Handles are in a struct inside that constant, under the names of the
//! user's fields: nothing can collide. One case is left. `new` names its arguments after the
//! parameters, so the compiler refuses a lower-case constant of a parameter's name beside the
//! struct.
//!
//! A field whose type is no carrier ends the chain:
//! `docs/decisions/002-no-stub-for-missing-types.md`.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{format_ident, quote, quote_spanned};
use syn::parse::{ParseStream, Parser};

use crate::model::ElementKind;
use crate::syntax::joint::JointSyntax;

/// The version of the protocol.
#[must_use]
pub fn version() -> Ident {
    Ident::new("holonom1", Span::call_site())
}

/// The call of the first carrier.
pub fn call(paths: &[TokenStream], payload: &TokenStream) -> TokenStream {
    let version = version();
    match paths {
        [] => TokenStream::new(),
        [first, rest @ ..] => quote! {
            #first! { @ #version [ #( [ #rest ] )* ] [] { #payload } }
        },
    }
}

/// What a carrier hands on, and under which name.
pub struct Carrier<'a> {
    /// The name of the type, which is that of the carrier.
    pub name: &'a Ident,
    /// Its visibility, which is that of the carrier.
    pub visibility: &'a syn::Visibility,
    /// The path of the run-time crate.
    pub facade: &'a TokenStream,
    /// The fingerprint of the definition.
    pub fingerprint: u64,
    /// The definition in brackets.
    pub definition: TokenStream,
    /// What it is, for messages.
    pub word: &'a str,
}

/// The definition of a joint or force, as it is handed on.
pub fn element(joint: &JointSyntax, is_sound: bool) -> TokenStream {
    let (word, body) = (format_ident!("{}", joint.kind.word()), &joint.body);
    if is_sound {
        quote!([#word { #body }])
    } else {
        quote!([faulty])
    }
}

/// The definition of an assembly, as it is handed on, with the definitions that it needs.
pub fn assembly(item: &TokenStream, carried: &TokenStream, is_sound: bool) -> TokenStream {
    let word = format_ident!(
        "{}",
        if is_sound {
            "assembly"
        } else {
            "faulty_assembly"
        }
    );
    quote!([#word { #item } [#carried]])
}

/// Writes a carrier.
pub fn carrier(carrier: Carrier<'_>) -> TokenStream {
    let Carrier {
        name,
        visibility,
        facade,
        fingerprint,
        definition,
        word,
    } = carrier;
    let place = place(name.span());
    let carrier = format_ident!(
        "__holonom_part_{}_{:016x}",
        name,
        fingerprint ^ place,
        span = Span::call_site()
    );
    let version = version();
    let exported = matches!(visibility, syn::Visibility::Public(_));
    let export = exported.then(|| quote!(#[macro_export]));
    let article = if word == "assembly" { "an" } else { "a" };
    let message = format!(
        "`{name}` is {article} {word}: name it as the type of a field in a struct with `#[derive(Mechanism)]`"
    );
    let other = format!(
        "this {word} was defined with another version of holonom; use one version throughout"
    );
    // Where the compiler speaks of it, it stands where the definition does.
    let at = name.span().resolved_at(Span::call_site());
    quote_spanned! {at=>
        #[doc(hidden)]
        #export
        macro_rules! #carrier {
            (@ #version [] [$($definitions:tt)*] $payload:tt) => {
                #facade::__private::assemble! { [#facade] [$($definitions)* #definition] $payload }
            };
            (@ #version [[$($next:tt)+] $($rest:tt)*] [$($definitions:tt)*] $payload:tt) => {
                const _: () = #facade::__private::part::<$($next)+>();
                $($next)+ ! { @ #version [$($rest)*] [$($definitions)* #definition] $payload }
            };
            (@ $($other:tt)*) => { ::core::compile_error! { #other } };
            ($($other:tt)*) => { ::core::compile_error! { #message } };
        }
        #[doc(hidden)]
        #[allow(unused_imports, clippy::pub_use, clippy::useless_attribute)]
        #visibility use #carrier as #name;
    }
}

/// Tells places in the source apart: exported macros live at the root of their crate, where the
/// carriers of equal joints in two modules must not meet.
fn place(span: Span) -> u64 {
    let start = span.start();
    hash(format!("{}:{}:{}", span.file(), start.line, start.column).bytes())
}

/// FNV-1a.
pub fn hash(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Stands before an annotated struct that is an assembly.
#[must_use]
pub fn assembly_mark() -> TokenStream {
    quote!(@)
}

/// What a carrier says of its type.
#[derive(Clone, Debug)]
pub enum Carried {
    /// A rigid body.
    Body,
    /// A particle.
    Particle,
    /// A joint or force: what stands behind the word.
    Element(ElementKind, TokenStream),
    /// An assembly.
    Assembly(Assembly),
    /// A joint or force with faults, reported where it is defined.
    Faulty,
}

/// What the carrier of an assembly says.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The annotated struct.
    pub item: TokenStream,
    /// The definitions of its field types, in the order of the carriers.
    pub carried: Vec<Carried>,
    /// The fingerprint of all of it.
    pub fingerprint: u64,
    /// Whether it has no faults; they are reported where it is described.
    pub is_sound: bool,
}

/// The fingerprint of tokens, as of an assembly and the definitions that it needs, but for
/// invisible groups and spaces, which change on the way through a macro.
#[must_use]
pub fn fingerprint<const N: usize>(parts: [&TokenStream; N]) -> u64 {
    let mut words = String::new();
    for tokens in parts {
        write_words(tokens.clone(), &mut words);
    }
    hash(words.bytes())
}

fn write_words(tokens: TokenStream, words: &mut String) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                words.push_str(open);
                write_words(group.stream(), words);
                words.push_str(close);
            }
            other => {
                words.push(' ');
                words.push_str(&other.to_string());
            }
        }
    }
}

/// What reaches `assemble!`.
#[derive(Clone, Debug)]
pub struct Delivery {
    /// The path of the run-time crate.
    pub facade: TokenStream,
    /// The definitions in the order of the carriers.
    pub carried: Vec<Carried>,
    /// The same as tokens.
    pub definitions: TokenStream,
    /// The annotated struct.
    pub payload: TokenStream,
    /// Whether it is an assembly.
    pub is_assembly: bool,
}

/// Unpacks what reaches `assemble!`.
///
/// # Errors
/// If the tokens do not follow the protocol.
pub fn unpack(tokens: TokenStream) -> syn::Result<Delivery> {
    let parser = |input: ParseStream<'_>| {
        let facade = group(input, Delimiter::Bracket)?.stream();
        let definitions = group(input, Delimiter::Bracket)?.stream();
        let payload = group(input, Delimiter::Brace)?.stream();
        let mut rest = payload.clone().into_iter();
        let is_assembly =
            matches!(rest.next(), Some(TokenTree::Punct(mark)) if mark.as_char() == '@');
        let payload = if is_assembly { rest.collect() } else { payload };
        Ok(Delivery {
            is_assembly,
            facade,
            carried: unpack_definitions(definitions.clone())?,
            definitions,
            payload,
        })
    };
    parser.parse2(tokens)
}

fn group(input: ParseStream<'_>, delimiter: Delimiter) -> syn::Result<Group> {
    match input.parse::<TokenTree>()? {
        TokenTree::Group(group) if group.delimiter() == delimiter => Ok(group),
        // A fragment of `macro_rules` may come in an invisible group.
        TokenTree::Group(outer) if outer.delimiter() == Delimiter::None => {
            (|input: ParseStream<'_>| group(input, delimiter)).parse2(outer.stream())
        }
        other => Err(syn::Error::new(
            other.span(),
            "this macro is called by holonom's own macros only",
        )),
    }
}

fn unpack_definitions(tokens: TokenStream) -> syn::Result<Vec<Carried>> {
    let parser = |input: ParseStream<'_>| {
        let mut carried = Vec::new();
        while !input.is_empty() {
            let definition = group(input, Delimiter::Bracket)?;
            carried.push(unpack_definition.parse2(definition.stream())?);
        }
        Ok(carried)
    };
    parser.parse2(tokens)
}

fn unpack_definition(input: ParseStream<'_>) -> syn::Result<Carried> {
    let kind: Ident = input.parse()?;
    match kind.to_string().as_str() {
        "body" => Ok(Carried::Body),
        "particle" => Ok(Carried::Particle),
        "faulty" => Ok(Carried::Faulty),
        "joint" => Ok(Carried::Element(
            ElementKind::Joint,
            group(input, Delimiter::Brace)?.stream(),
        )),
        "force" => Ok(Carried::Element(
            ElementKind::Force,
            group(input, Delimiter::Brace)?.stream(),
        )),
        word @ ("assembly" | "faulty_assembly") => {
            let item = group(input, Delimiter::Brace)?.stream();
            let carried = group(input, Delimiter::Bracket)?.stream();
            Ok(Carried::Assembly(Assembly {
                fingerprint: fingerprint([&item, &carried]),
                carried: unpack_definitions(carried)?,
                item,
                is_sound: word == "assembly",
            }))
        }
        _ => Err(syn::Error::new(kind.span(), "unknown definition")),
    }
}
