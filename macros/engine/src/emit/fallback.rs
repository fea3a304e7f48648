//! A stub implementation beside the errors, so that the user sees those and no others.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::ext::IdentExt;

use crate::check::definition::{Definition, Definitions, definition};
use crate::syntax::array::array;
use crate::syntax::mechanism::{Field, MechanismSyntax, Role, carrier_path};

/// Writes the stub of a faulty mechanism.
#[must_use]
pub fn emit(syntax: &MechanismSyntax, types: &Definitions, facade: &TokenStream) -> TokenStream {
    let name = &syntax.name;
    let (declared, arguments, clause) = syntax.generics.split_for_impl();
    let bounds = clause.map(|clause| &clause.predicates);
    // The compiler itself reports fields of one name.
    let mut before = HashSet::new();
    let is_first = |field: &&Field| before.insert(field.name.field().unraw());
    let fields: Vec<&Field> = syntax.fields.iter().filter(is_first).collect();
    let is_part = |field: &&&Field| field.role.as_ref().is_none_or(|(role, _)| role.is_part());
    let handles = fields.iter().filter(is_part).map(|field| {
        let (name, handle) = (&field.name, handle(field, types));
        match array(&field.written) {
            Some(array) => {
                let length = &array.len;
                quote!(#name: [#length] #handle,)
            }
            None => quote!(#name: #handle,),
        }
    });
    let parameters = fields
        .iter()
        .filter(|field| matches!(field.role, Some((Role::Param, _))))
        .map(|field| match array(&field.written) {
            Some(array) => {
                let (name, length) = (&field.name, &array.len);
                quote!(#name: [::core::primitive::f64; #length])
            }
            None => {
                let name = &field.name;
                quote!(#name: ::core::primitive::f64)
            }
        })
        .collect::<Vec<_>>();
    let inputs: Vec<TokenStream> = fields
        .iter()
        .filter(|field| matches!(field.role, Some((Role::Input, _))))
        .map(|field| {
            let name = &field.name;
            match array(&field.written).map(|array| &array.len) {
                Some(length) => quote!(pub #name: [__S; #length]),
                None => quote!(pub #name: __S),
            }
        })
        .collect();
    let (inputs_kind, inputs_type) = inputs_of(&inputs, facade);
    let construction = (!parameters.is_empty()).then(|| {
        quote! {
            impl #declared #name #arguments #clause {
                #[allow(warnings, missing_docs)]
                pub fn new(
                    #(#parameters),*
                ) -> ::core::result::Result<Self, #facade::ParameterError> {
                    loop {}
                }
            }
        }
    });
    quote! {
        #construction
        const _: () = {
            #inputs_type
            #facade::__stub_mechanism! { [#declared] [#name #arguments] [#bounds] [#inputs_kind] #(#handles)* }
        };
    }
}

/// The type of the inputs, and its declaration.
fn inputs_of(fields: &[TokenStream], facade: &TokenStream) -> (TokenStream, TokenStream) {
    if fields.is_empty() {
        return (quote!(()), TokenStream::new());
    }
    let declared = quote! {
        #[allow(warnings, missing_docs)]
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
fn handle(field: &Field, types: &Definitions) -> TokenStream {
    match (definition(field, types), &field.role) {
        (Some(Definition::Body(_)), _) | (None, Some((Role::Body, _))) => quote!(body),
        (Some(Definition::Element(_) | Definition::Faulty), role) => {
            let path = carrier_path(&field.ty);
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
