//! The rates of the user's own states.

use proc_macro2::TokenStream;
use quote::quote;

use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::syntax::words::local;

impl Writer<'_> {
    /// Only where there are such states; the trait does nothing by default.
    pub(super) fn state_rates(&mut self) -> TokenStream {
        let kernels = self.kernels;
        if kernels.state_rates.outputs.is_empty() {
            return TokenStream::new();
        }
        let facade = self.facade;
        let [constants, time, state, rates] = ["constants", "time", "state", "rates"].map(local);
        let unpack = Self::unpack();
        let frame = self.frame_of_state("state_rates", &quote!(#time: __S,));
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&kernels.state_rates, &frame);
        let layout = self.model.layout();
        let stored = layout.stored();
        let places = stored - layout.states..stored;
        quote! {
            fn state_rates_into<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #rates: &mut [__S; #stored],
            ) {
                #unpack
                #statements
                #( #rates[#places] = #outputs; )*
            }
        }
    }
}
