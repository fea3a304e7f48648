//! The annotated struct.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use syn::{Attribute, Data, DeriveInput, Fields, Type};

pub use super::field::{Field, Origin, Role};
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
    for field in named_fields(input) {
        if let Some(name) = field.ident.clone() {
            let written = parse_field(name.clone(), field, faults);
            let (elements, is_measured) = array::elements(written, faults);
            for element in elements {
                part::expand(element, assemblies, &mut result);
            }
            if !is_measured {
                result.unmeasured.push(name);
            }
        }
    }
    result
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

/// The fields of a struct with named fields; none of anything else.
pub(super) fn named_fields(input: &DeriveInput) -> impl Iterator<Item = &syn::Field> {
    match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => Some(fields.named.iter()),
            _ => None,
        },
        _ => None,
    }
    .into_iter()
    .flatten()
}

fn role(attribute: &Attribute) -> Option<Role> {
    let mut roles = Role::ALL.into_iter();
    let known = roles.find(|(word, _)| attribute.path().is_ident(word));
    known.map(|(_, role)| role)
}

pub(super) fn parse_field(name: Ident, field: &syn::Field, faults: &mut Faults) -> Field {
    let mut result = Field {
        name: name.into(),
        written: field.ty.clone(),
        ty: array::element_type(&field.ty).clone(),
        role: None,
        list: List::default(),
        context: String::new(),
        origin: None,
    };
    for attribute in &field.attrs {
        if attribute.path().is_ident("mechanism") {
            faults.at(
                attribute.path(),
                "`#[mechanism(..)]` describes the struct, not a field",
            );
        }
        let Some(role) = role(attribute) else {
            continue;
        };
        if result.role.is_some() {
            faults.at(
                attribute.path(),
                format!(
                    "`{}` is described twice; one attribute says what it is",
                    result.name
                ),
            );
            continue;
        }
        result.role = Some((role, attribute.path().clone()));
        if role.has_carrier() || role == Role::Param {
            result.list = super::list(attribute, faults);
        } else if !matches!(attribute.meta, syn::Meta::Path(_)) {
            let word = attribute.path().to_token_stream();
            let what = match role {
                Role::Port => {
                    "it stands above a `Body`, which is named where the assembly is a part"
                }
                _ => "it stands above a field of type `f64`, and it is 0 until the field is set",
            };
            faults.at(
                attribute,
                format!("`#[{word}]` takes nothing besides: {what}"),
            );
        }
    }
    result
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

/// The path by which a type's carrier is called; `None` for a type that cannot be that of a joint
/// or body.
#[must_use]
pub fn carrier_path(ty: &Type) -> Option<TokenStream> {
    // What is surely neither: calling it as a macro would only hide our own sentence.
    const OTHERS: [&str; 28] = [
        "Arc",
        "Box",
        "Cell",
        "HashMap",
        "Option",
        "PhantomData",
        "Rc",
        "RefCell",
        "Result",
        "String",
        "Vec",
        "bool",
        "char",
        "f32",
        "f64",
        "i128",
        "i16",
        "i32",
        "i64",
        "i8",
        "isize",
        "str",
        "u128",
        "u16",
        "u32",
        "u64",
        "u8",
        "usize",
    ];
    match ty {
        Type::Group(group) => carrier_path(&group.elem),
        Type::Paren(paren) => carrier_path(&paren.elem),
        Type::Path(path) if path.qself.is_none() => {
            let last = path.path.segments.last()?;
            if OTHERS.iter().any(|other| last.ident == other) {
                return None;
            }
            let mut path = path.path.clone();
            for segment in &mut path.segments {
                segment.arguments = syn::PathArguments::None;
            }
            Some(path.into_token_stream())
        }
        _ => None,
    }
}
