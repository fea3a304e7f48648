//! Inputs over the number type of a run: a struct with their names, and what is computed anew when
//! they are set.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::nested::{Structs, nested};
use super::parameters::read;
use super::store::Store;
use super::straight_line::StraightLine;
use crate::model::{Model, RunTimeValue, ValueKind, first_further};
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
    if inputs(model).next().is_none() {
        return Inputs {
            declared: TokenStream::new(),
            kind: quote!(()),
            functions: quote! {
                fn inputs<__S: #facade::Scalar>(&self) {}
            },
        };
    }
    let documentation = format!("The inputs of [`{}`], zero by default.", model.name);
    let head = quote! {
        #[doc = #documentation]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)]
    };
    let with = |value: &dyn Fn(usize, &RunTimeValue) -> TokenStream| {
        let values = inputs(model).map(|(number, input)| {
            let kind = match input.kind {
                ValueKind::Setpoint => quote!(#facade::mechanism::Setpoint<__S>),
                _ => quote!(__S),
            };
            (&input.name, (kind, value(number, input)))
        });
        let structs = Structs::new("__Inputs", head.clone(), quote!(<__S>));
        structs.written(&nested(values))
    };
    let (declared, zero) = with(&|_, input| match input.kind {
        ValueKind::Setpoint => quote!(#facade::mechanism::Setpoint::at_rest(__S::constant(0.0))),
        _ => quote!(__S::constant(0.0)),
    });
    let (_, read) = with(&|_, input| {
        if input.kind == ValueKind::Setpoint {
            let at = input.name.place();
            return quote!(#facade::mechanism::Setpoint::map(self.#at, __S::constant));
        }
        let value = read(model, &input.name, facade);
        quote!(__S::constant(#value))
    });
    let [given, parameters, values] = ["inputs", "parameters", "values"].map(local);
    let at = |number: usize| {
        let number = Literal::usize_unsuffixed(number);
        quote!(#parameters[#number])
    };
    let (_, held) = with(&|number, input| match input.kind {
        ValueKind::Setpoint => {
            let further = first_further(&model.values, number);
            let [value, rate, acceleration] = [number, further, further + 1].map(at);
            quote! {
                #facade::mechanism::Setpoint {
                    value: #value,
                    rate: #rate,
                    acceleration: #acceleration,
                }
            }
        }
        _ => at(number),
    });
    let place: Vec<TokenStream> = inputs(model)
        .flat_map(|(number, value)| {
            let (at, name) = (value.name.place(), value.name.to_string());
            let numbers = match value.kind {
                ValueKind::Setpoint => {
                    let further = first_further(&model.values, number);
                    let of = |part: TokenStream| quote!(.#part);
                    vec![
                        (number, of(quote!(value))),
                        (further, of(quote!(rate))),
                        (further + 1, of(quote!(acceleration))),
                    ]
                }
                _ => vec![(number, TokenStream::new())],
            };
            let numbers = numbers.into_iter().map(|(number, part)| {
                let number = Literal::usize_unsuffixed(number);
                quote!((#number, #name, #given.#at #part))
            });
            numbers.collect::<Vec<_>>()
        })
        .collect();
    let count = place.len();
    Inputs {
        declared: quote! {
            #declared

            #[automatically_derived]
            impl<__S: #facade::Scalar> ::core::default::Default for __Inputs<__S> {
                fn default() -> Self {
                    #zero
                }
            }
        },
        kind: quote!(__Inputs<__S>),
        functions: quote! {
            fn inputs<__S: #facade::Scalar>(&self) -> Self::Inputs<__S> {
                #read
            }

            #[inline]
            fn put_inputs<__S: #facade::Real>(
                #given: &Self::Inputs<__S>,
                #parameters: &mut Self::Parameters<__S>,
            ) -> ::core::result::Result<(), #facade::ParameterError> {
                let #values: [(usize, &'static str, __S); #count] = [#(#place),*];
                #facade::__private::put_inputs(&#values, #parameters)
            }

            #[inline]
            fn inputs_of<__S: #facade::Scalar>(#parameters: &Self::Parameters<__S>) -> Self::Inputs<__S> {
                #held
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
