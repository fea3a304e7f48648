//! The annotated struct.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::{Data, DeriveInput, Expr, ExprLit, Fields, Lit, Type};

use super::array::Lengths;
use super::attributes::{named_fields, parse_field, role};
pub use super::field::{Field, Origin, Role, carrier_path};
use super::part::Expanded;
pub use super::part::{Assemblies, AssemblySyntax, PartSyntax};
use super::{List, array, part};
use crate::diag::Faults;

/// An annotated struct as written.
#[derive(Clone, Debug)]
pub struct MechanismSyntax {
    /// The name of the struct.
    pub name: Ident,
    /// Its generic parameters, which it must not have.
    pub generics: syn::Generics,
    /// The list of `#[mechanism(..)]`.
    pub list: List,
    /// Its fields, and the elements of those that are arrays; in the place of a part its fields.
    pub fields: Vec<Field>,
    /// Its parts, each before those in it.
    pub parts: Vec<PartSyntax>,
    /// The lengths of arrays that are given by the names of constants.
    pub lengths: Lengths,
    /// The doc comments above fields, by their names, and that above the struct under none.
    pub comments: Vec<(String, String)>,
    /// Arrays of a length that was refused: only the first element is there, and nobody knows which
    /// others are meant.
    pub unmeasured: Vec<Ident>,
    /// Whether it is a struct with named fields and without parameters; if not, that was reported.
    pub is_plain: bool,
}

/// Parses the struct; what can be understood of a faulty one is kept. A part whose assembly is not
/// among these stays one field.
pub fn parse(input: &DeriveInput, assemblies: &Assemblies, faults: &mut Faults) -> MechanismSyntax {
    let mut result = MechanismSyntax {
        name: input.ident.clone(),
        generics: input.generics.clone(),
        list: List::default(),
        fields: Vec::new(),
        parts: Vec::new(),
        lengths: Lengths::new(),
        comments: comments(input),
        unmeasured: Vec::new(),
        is_plain: true,
    };
    if let Some((tokens, message)) = shape(input) {
        result.is_plain = false;
        faults.at(tokens, message);
    }
    if !input.generics.params.is_empty() {
        result.is_plain = false;
        faults.at(
            &input.generics,
            "a mechanism takes no generic parameters; its kernels are generic over the scalar by themselves",
        );
    }
    let mut seen = false;
    for attribute in &input.attrs {
        if attribute.path().is_ident("mechanism") {
            if seen {
                faults.at(
                    attribute.path(),
                    "`#[mechanism(..)]` stands here twice; write one list",
                );
            }
            seen = true;
            let list = super::list(attribute, faults);
            result.list.pairs.extend(list.pairs);
            result.list.unreadable |= list.unreadable;
        } else if role(attribute).is_some() {
            let word = attribute.path().to_token_stream();
            faults.at(
                attribute.path(),
                format!("`#[{word}(..)]` describes a field, not the struct"),
            );
        }
    }
    result.lengths = array::lengths(&result.list, faults);
    let mut expanded = Expanded::default();
    for field in named_fields(input) {
        if let Some(name) = field.ident.clone() {
            let written = parse_field(name.clone(), field, faults);
            let (elements, is_measured) = array::elements(written, &result.lengths, faults);
            for element in elements {
                part::expand(element, assemblies, &mut expanded);
            }
            if !is_measured {
                result.unmeasured.push(name);
            }
        }
    }
    (result.fields, result.parts) = (expanded.fields, expanded.parts);
    result
}

/// The doc comments of a struct and of its fields, as they were written.
fn comments(input: &DeriveInput) -> Vec<(String, String)> {
    let of_struct = std::iter::once((String::new(), &input.attrs));
    let fields = named_fields(input);
    let fields = fields.filter_map(|field| Some((field.ident.as_ref()?.to_string(), &field.attrs)));
    let all = of_struct.chain(fields);
    let all = all.map(|(field, attributes)| (field, comment(attributes)));
    all.filter(|(_, text)| !text.is_empty()).collect()
}

/// The text of a doc comment. What is included from a file is no part of it.
fn comment(attributes: &[syn::Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| {
        let value = attribute.meta.require_name_value().ok()?;
        match &value.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) if value.path.is_ident("doc") => Some(text.value()),
            _ => None,
        }
    });
    let lines = lines.map(|line| line.strip_prefix(' ').unwrap_or(&line).to_owned());
    let lines: Vec<String> = lines.collect();
    lines.join("\n").trim().to_owned()
}

/// What is wrong with the shape of an item that is not a struct with named fields.
fn shape(input: &DeriveInput) -> Option<(TokenStream, String)> {
    let name = &input.ident;
    let expected = "a mechanism is a struct with a named field for every body and joint";
    let (tokens, found) = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(_) => return None,
            Fields::Unnamed(fields) => {
                let message = format!("the fields of `{name}` have no names; {expected}");
                return Some((fields.to_token_stream(), message));
            }
            Fields::Unit => {
                return Some((
                    name.to_token_stream(),
                    format!("`{name}` has no fields; {expected}"),
                ));
            }
        },
        Data::Enum(data) => (data.enum_token.to_token_stream(), "an enum"),
        Data::Union(data) => (data.union_token.to_token_stream(), "a union"),
    };
    Some((tokens, format!("`{name}` is {found}; {expected}")))
}

/// The distinct types of described fields, as paths without generic arguments: bodies first, then
/// joints, forces and assemblies, each in the order of the fields.
///
/// The derive calls each of them as a macro. A carrier asks of the next whether it is a body or a
/// joint, so that what is surely one comes first.
#[must_use]
pub fn carrier_paths(input: &DeriveInput) -> Vec<TokenStream> {
    let mut paths: Vec<TokenStream> = Vec::new();
    let Data::Struct(data) = &input.data else {
        return paths;
    };
    for wanted in [Role::Body, Role::Joint, Role::Force, Role::Part] {
        for field in &data.fields {
            let ty = array::element_type(&field.ty);
            if field.attrs.iter().find_map(role) != Some(wanted) || is_parameter(ty, input) {
                continue;
            }
            if let Some(path) = carrier_path(ty) {
                let text = path.to_string();
                if paths.iter().all(|known| known.to_string() != text) {
                    paths.push(path);
                }
            }
        }
    }
    paths
}

/// Whether a type is a generic parameter of the struct.
fn is_parameter(ty: &Type, input: &DeriveInput) -> bool {
    let Type::Path(path) = ty else { return false };
    input
        .generics
        .type_params()
        .any(|parameter| path.path.is_ident(&parameter.ident))
}

impl MechanismSyntax {
    /// The type of a field, or of its elements, as the compiler finds it from the mechanism.
    #[must_use]
    pub fn type_path(
        &self,
        ty: &Type,
        origin: Option<Origin>,
        facade: &TokenStream,
    ) -> Option<TokenStream> {
        let Some(Origin { part, number }) = origin else {
            return carrier_path(ty);
        };
        // The first of its assembly, so that equal parts have equal handles.
        let part = &self.parts[part];
        let mut parts = self.parts.iter();
        let part = parts.find(|other| other.is_like(part)).unwrap_or(part);
        let outer = self.type_path(&part.ty, part.origin, facade)?;
        Some(quote!(<#outer as #facade::__private::FieldOf<#number>>::Type))
    }
}
