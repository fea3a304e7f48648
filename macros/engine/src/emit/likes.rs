//! What is asked at run time of what was decided where parameters are what they are said to be
//! like.

use proc_macro2::TokenStream;
use quote::quote;

use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::model::Model;
use crate::symbolic::left_out::left_out;
use crate::syntax::words::local;

impl Writer<'_> {
    /// The check of given parameters, and the equations that were left out; nothing where all was
    /// decided by what is written.
    pub(super) fn likes(&mut self) -> TokenStream {
        let (model, facade) = (self.model, self.facade);
        if model.independence.likes.is_empty() {
            return TokenStream::new();
        }
        let count = model.parameters();
        let likes = model.independence.likes.iter().filter_map(|&place| {
            let value = &model.values[place];
            let (name, like) = (value.name.to_string(), value.like?);
            Some(quote!(#facade::__private::Like { place: #place, field: #name, value: #like }))
        });
        let left_out = if model.independence.dropped {
            self.left_out()
        } else {
            TokenStream::new()
        };
        let [since, given] = ["since", "given"].map(local);
        quote! {
            fn check_likes<__S: #facade::Real>(
                &self,
                #since: ::core::option::Option<&Self::Parameters<__S>>,
            ) -> ::core::result::Result<(), #facade::ParameterError> {
                let #given: [f64; #count] = self.parameters::<f64>()?;
                #facade::__private::check_likes::<__S, Self, #count>(#since, &#given, &[#(#likes),*])
            }

            #left_out
        }
    }

    fn left_out(&mut self) -> TokenStream {
        let facade = self.facade;
        let kernel = left_out(self.model);
        let size = self.model.layout().velocities;
        let [constants, time, state, number] = ["constants", "time", "state", "number"].map(local);
        let unpack = Self::unpack();
        let frame = self.frame_of_state("left_out", &quote!(#time: __S,));
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&kernel, &frame);
        let rows = outputs.chunks(1 + size).enumerate().map(|(place, row)| {
            let (value, gradient) = (&row[0], &row[1..]);
            quote!(#place => ::core::option::Option::Some((#value, [#(#gradient),*])),)
        });
        quote! {
            #[inline(never)]
            fn left_out<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #number: usize,
            ) -> ::core::option::Option<(__S, Self::Velocities<__S>)> {
                #unpack
                #statements
                match #number {
                    #(#rows)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    }
}

/// What every parameter is like, in the order of the fields; `None` where one of them does not say.
pub(super) fn defaults(model: &Model) -> Option<Vec<f64>> {
    let parameters = model.values.iter().filter(|value| value.is_parameter());
    parameters.map(|value| value.like).collect()
}
