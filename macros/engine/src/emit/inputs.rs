//! Inputs over the number type of a run: a struct with their names, and what is computed anew when
//! they are set.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::store::Store;
use super::straight_line::StraightLine;
use crate::model::name::fields;
use crate::model::{Model, RunTimeValue};
use crate::syntax::words::local;

/// The type of the inputs, and the functions that read and place them.
pub(super) struct Inputs {
    /// The declaration of the type.
    pub(super) declared: TokenStream,
    /// The type.
    pub(super) kind: TokenStream,
    /// The functions of the implementation of a mechanism.
    pub(super) functions: TokenStream,
}

/// Inputs and their places among the run-time values.
fn inputs(model: &Model) -> impl Iterator<Item = (usize, &RunTimeValue)> {
    let values = model.values.iter().enumerate();
    values.filter(|(_, value)| value.is_input)
}

pub(super) fn inputs_of(model: &Model, facade: &TokenStream) -> Inputs {
    let fields = fields(inputs(model).map(|(_, value)| &value.name));
    if fields.is_empty() {
        return Inputs {
            declared: TokenStream::new(),
            kind: quote!(()),
            functions: quote! {
                fn inputs<__S: #facade::Scalar>(&self) {}
            },
        };
    }
    let (mut types, mut zeros, mut read) = (Vec::new(), Vec::new(), Vec::new());
    for (field, length) in &fields {
        if let Some(length) = length {
            types.push(quote!(pub #field: [__S; #length]));
            zeros.push(quote!(#field: [__S::constant(0.0); #length]));
            read.push(quote!(#field: self.#field.map(__S::constant)));
        } else {
            types.push(quote!(pub #field: __S));
            zeros.push(quote!(#field: __S::constant(0.0)));
            read.push(quote!(#field: __S::constant(self.#field)));
        }
    }
    let [given, parameters, values] = ["inputs", "parameters", "values"].map(local);
    let place = inputs(model).map(|(number, value)| {
        let (at, name) = (value.name.place(), value.name.to_string());
        let number = Literal::usize_unsuffixed(number);
        quote!((#number, #name, #given.#at))
    });
    let count = inputs(model).count();
    let documentation = format!("The inputs of [`{}`], zero by default.", model.name);
    Inputs {
        declared: quote! {
            #[doc = #documentation]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
            pub struct __Inputs<__S> { #(#types),* }

            #[automatically_derived]
            impl<__S: #facade::Scalar> ::core::default::Default for __Inputs<__S> {
                fn default() -> Self {
                    Self { #(#zeros),* }
                }
            }
        },
        kind: quote!(__Inputs<__S>),
        functions: quote! {
            fn inputs<__S: #facade::Scalar>(&self) -> Self::Inputs<__S> {
                __Inputs { #(#read),* }
            }

            #[inline]
            fn put_inputs<__S: #facade::Real>(
                #given: &Self::Inputs<__S>,
                #parameters: &mut Self::Parameters<__S>,
            ) -> ::core::result::Result<(), #facade::ParameterError> {
                let #values: [(usize, &'static str, __S); #count] = [#(#place),*];
                #facade::__private::put_inputs(&#values, #parameters)
            }
        },
    }
}

/// The body of the function that computes what depends on inputs.
pub(super) fn taken(model: &Model, store: &mut Store) -> TokenStream {
    let (line, places) = store.write_inputs(&model.symbols);
    let StraightLine {
        statements,
        outputs,
    } = line;
    let constants = local("constants");
    quote! {
        #statements
        #( #constants[#places] = #outputs; )*
    }
}
