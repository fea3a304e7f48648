//! A stub implementation beside the errors, so that the user sees those and no others.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::ext::IdentExt;

use super::nested::{Fields, Nested, nested};
use crate::check::definition::{Definition, Definitions, definition};
use crate::syntax::array::array;
use crate::syntax::mechanism::{Field, MechanismSyntax, PartSyntax, Role};

/// Writes the stub of a faulty mechanism.
#[must_use]
pub fn emit(syntax: &MechanismSyntax, types: &Definitions, facade: &TokenStream) -> TokenStream {
    let name = &syntax.name;
    let (declared, arguments, clause) = syntax.generics.split_for_impl();
    let bounds = clause.map(|clause| &clause.predicates);
    let own: Vec<&Field> = own_fields(syntax).collect();
    let is_handled = |field: &&&Field| {
        let role = field.role.as_ref().map(|(role, _)| *role);
        role.is_none_or(has_handle)
    };
    let handles = own.iter().filter(is_handled).map(|field| {
        let (name, handle) = (&field.name, handle(syntax, field, types, facade));
        match array(&field.written) {
            Some(array) => {
                let length = &array.len;
                quote!(#name: [#length] #handle,)
            }
            None => quote!(#name: #handle,),
        }
    });
    let (parts, parts_of_handles) = parts(syntax, types, facade);
    let is_other = |part: &Ident| own.iter().all(|field| field.name.field() != part);
    let of_parts = parts_of_handles.into_iter();
    let of_parts = of_parts.filter(|(field, _)| is_other(field));
    let handles = handles.chain(of_parts.map(|(field, handle)| quote!(#field: #handle,)));
    let handles: TokenStream = handles.collect();
    let inputs: Vec<TokenStream> = own
        .iter()
        .filter(|field| matches!(field.role, Some((Role::Input, _))))
        .map(|field| {
            let name = &field.name;
            let kind = if is_number(field) {
                quote!(__S)
            } else {
                quote!(#facade::mechanism::Setpoint<__S>)
            };
            match array(&field.written).map(|array| &array.len) {
                Some(length) => quote!(pub #name: [#kind; #length]),
                None => quote!(pub #name: #kind),
            }
        })
        .collect();
    let (inputs_kind, inputs_type) = inputs_of(&inputs, facade);
    let result = quote!(::core::result::Result<Self, #facade::ParameterError>);
    let construction = construction(syntax, &result);
    quote! {
        #construction
        #[allow(warnings, clippy::all, clippy::pedantic)]
        const _: () = {
            #inputs_type
            #parts
            #facade::__stub_mechanism! { [#declared] [#name #arguments] [#bounds] [#inputs_kind] #handles }
        };
    }
}

/// Whether a field of a role has a handle.
const fn has_handle(role: Role) -> bool {
    match role {
        Role::Body
        | Role::Joint
        | Role::Force
        | Role::Point
        | Role::Param
        | Role::Input
        | Role::State => true,
        Role::Part | Role::Port => false,
    }
}

/// `new`, where there are parameters.
pub(super) fn construction(syntax: &MechanismSyntax, result: &TokenStream) -> Option<TokenStream> {
    let (name, parameters) = (&syntax.name, parameters(syntax));
    let (declared, arguments, clause) = syntax.generics.split_for_impl();
    (!parameters.is_empty()).then(|| {
        quote! {
            impl #declared #name #arguments #clause {
                #[allow(warnings, missing_docs)]
                pub fn new(#(#parameters),*) -> #result {
                    loop {}
                }
            }
        }
    })
}

/// The fields that are of no part. The compiler itself reports fields of one name.
fn own_fields(syntax: &MechanismSyntax) -> impl Iterator<Item = &Field> {
    let mut before = HashSet::new();
    let fields = syntax.fields.iter();
    let own = fields.filter(|field| field.origin.is_none());
    own.filter(move |field| before.insert(field.name.field().unraw()))
}

/// Whether a run-time value is a number; one of an unknown type is taken for one.
fn is_number(field: &Field) -> bool {
    let ty = field.ty.to_token_stream().to_string();
    !["Setpoint", "Spline"]
        .iter()
        .any(|other| ty.contains(other))
}

/// The type of a parameter.
fn kind(field: &Field) -> TokenStream {
    if is_number(field) {
        quote!(::core::primitive::f64)
    } else {
        field.ty.to_token_stream()
    }
}

/// The arguments of `new`.
fn parameters(syntax: &MechanismSyntax) -> Vec<TokenStream> {
    let own = own_fields(syntax).filter(|field| matches!(field.role, Some((Role::Param, _))));
    let own = own.map(|field| match array(&field.written) {
        Some(array) => {
            let (name, length, kind) = (&field.name, &array.len, kind(field));
            quote!(#name: [#kind; #length])
        }
        None => {
            let (name, kind) = (&field.name, kind(field));
            quote!(#name: #kind)
        }
    });
    let has_parameters = |part: &&PartSyntax| {
        let is_in = |field: &Field| field.name.parts().first() == part.name.steps().next().as_ref();
        let mut fields = syntax.fields.iter();
        let is_own = part.origin.is_none() && part.name.is_first();
        is_own && fields.any(|field| matches!(field.role, Some((Role::Param, _))) && is_in(field))
    };
    let parts = syntax.parts.iter().filter(has_parameters).map(|part| {
        let (name, ty) = (&part.name, &part.written);
        quote!(#name: #ty)
    });
    own.chain(parts).collect()
}

/// The structs of the handles of parts, and the handle of each.
fn parts(
    syntax: &MechanismSyntax,
    types: &Definitions,
    facade: &TokenStream,
) -> (TokenStream, Vec<(Ident, TokenStream)>) {
    let fields = syntax.fields.iter().filter(|field| {
        let role = field.role.as_ref().map(|(role, _)| *role);
        field.origin.is_some() && role.is_some_and(has_handle)
    });
    let all = fields.map(|field| (&field.name, handle(syntax, field, types, facade)));
    let mut declared = TokenStream::new();
    let mut count = 0;
    let handles = part_fields(&nested(all), facade, &mut declared, &mut count);
    (declared, handles)
}

fn part_fields(
    fields: &Fields<TokenStream>,
    facade: &TokenStream,
    declared: &mut TokenStream,
    count: &mut usize,
) -> Vec<(Ident, TokenStream)> {
    let fields = fields.0.iter();
    let written =
        fields.map(|(field, nested)| (field.clone(), part_field(nested, facade, declared, count)));
    written.collect()
}

fn part_field(
    nested: &Nested<TokenStream>,
    facade: &TokenStream,
    declared: &mut TokenStream,
    count: &mut usize,
) -> TokenStream {
    match nested {
        Nested::One(handle) => handle.clone(),
        // All have the type of the first.
        Nested::Elements(elements) => {
            let length = elements.len();
            let first = elements.first();
            let first = first.map(|first| part_field(first, facade, declared, count));
            quote!([#length] #first)
        }
        Nested::Part(fields) => {
            let name = format_ident!("__Part{count}");
            *count += 1;
            let handles = part_fields(fields, facade, declared, count);
            let handles = handles
                .iter()
                .map(|(field, handle)| quote!(#field: #handle,));
            declared.extend(quote!(#facade::__stub_part! { #name #(#handles)* }));
            quote!(part #name<__M>)
        }
    }
}

/// The type of the inputs, and its declaration.
fn inputs_of(fields: &[TokenStream], facade: &TokenStream) -> (TokenStream, TokenStream) {
    if fields.is_empty() {
        return (quote!(()), TokenStream::new());
    }
    let declared = quote! {
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
        pub struct __Inputs<__S> { #(#fields),* }

        impl<__S: #facade::Scalar> ::core::default::Default for __Inputs<__S> {
            fn default() -> Self {
                loop {}
            }
        }
    };
    (quote!(__Inputs<__S>), declared)
}

/// `body`, `joint` or `force` with its type, or `joint` or `force` where the type is none.
fn handle(
    syntax: &MechanismSyntax,
    field: &Field,
    types: &Definitions,
    facade: &TokenStream,
) -> TokenStream {
    match (definition(field, types), &field.role) {
        (_, Some((Role::Point, _))) => quote!(point),
        (_, Some((Role::Param | Role::Input, _))) => quote!(value),
        (_, Some((Role::State, _))) => quote!(state),
        (Some(Definition::Body(_)), _) | (None, Some((Role::Body, _))) => quote!(body),
        (Some(Definition::Element(_) | Definition::Faulty | Definition::Assembly), role) => {
            let path = syntax.type_path(&field.ty, field.origin, facade);
            match role {
                Some((Role::Force, _)) => quote!(force #path),
                _ => quote!(joint #path),
            }
        }
        (None, Some((Role::Force, _))) => quote!(force),
        (None, Some(_)) => quote!(joint),
        // Not described, and of a type that no other field has: its name is all there is to go by.
        (None, None) => {
            let text = field.ty.to_token_stream().to_string();
            let last = text.rsplit(' ').next();
            if matches!(last, Some("Body" | "Particle")) {
                quote!(body)
            } else {
                quote!(joint)
            }
        }
    }
}
