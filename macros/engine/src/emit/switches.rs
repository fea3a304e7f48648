//! The expressions whose signs decide in laws: what they are, and their values.

use proc_macro2::TokenStream;
use quote::quote;

use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::model::{Asked, Model};
use crate::syntax::words::local;

/// The functions by which kernels read sides; nothing where no law switches. Derivatives of
/// transitions have sides as well.
pub(super) fn functions(model: &Model, facade: &TokenStream) -> TokenStream {
    if !model.has_sides() && !differentiates(model) {
        return TokenStream::new();
    }
    quote! {
        use #facade::__private::{above as __above, below as __below, side as __side};
    }
}

fn differentiates(model: &Model) -> bool {
    let mut asked = model.asked.iter();
    asked.any(|asked| matches!(asked, Asked::Derivatives | Asked::Adjoint))
}

impl Writer<'_> {
    /// Only where there are such expressions; the trait has none by default.
    pub(super) fn switches(&mut self) -> TokenStream {
        let (model, kernels, facade) = (self.model, self.kernels, self.facade);
        if model.switches.is_empty() {
            return TokenStream::new();
        }
        let first = model.first_side();
        let infos = model.switches.iter().enumerate().map(|(number, switch)| {
            let (law, expression) = (switch.owner.to_string(), &switch.text);
            let (place, is_of_time) = (first + number, switch.is_of_time);
            let is_continuous = switch.is_continuous;
            quote! {
                #facade::mechanism::Switch {
                    law: #law,
                    expression: #expression,
                    is_of_time: #is_of_time,
                    is_continuous: #is_continuous,
                    place: #place,
                }
            }
        });
        let infos: Vec<_> = infos.collect();
        let [all, of_time] = &kernels.switches;
        let all = self.readings("switches_into", all, |_| true);
        let of_time = self.readings("switches_of_time_into", of_time, |number| {
            model.switches[number].is_of_time
        });
        quote! {
            const SWITCHES: &'static [#facade::mechanism::Switch] = &[#(#infos),*];
            #all
            #of_time
        }
    }

    fn readings(
        &mut self,
        name: &str,
        kernel: &crate::symbolic::equations::Kernel,
        is_wanted: impl Fn(usize) -> bool,
    ) -> TokenStream {
        let (model, facade) = (self.model, self.facade);
        let names = ["constants", "time", "state", "readings"];
        let [constants, time, state, readings] = names.map(local);
        let unpack = Self::unpack();
        let frame = self.frame_of_state(name, &quote!(#time: __S,));
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(kernel, &frame);
        let (first, count) = (model.first_side(), model.parameters());
        let places = (0..model.switches.len()).filter(|&number| is_wanted(number));
        let places = places.map(|number| first + number);
        let name = quote::format_ident!("{name}");
        quote! {
            fn #name<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #readings: &mut [__S; #count],
            ) {
                #unpack
                #statements
                #( #readings[#places] = #outputs; )*
            }
        }
    }
}
