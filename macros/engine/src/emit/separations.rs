//! The separations with whose direction a force turns round.

use proc_macro2::TokenStream;
use quote::quote;

use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::syntax::words::local;

impl Writer<'_> {
    /// Only where there are such forces; the trait has none by default.
    pub(super) fn separations(&mut self) -> TokenStream {
        let (model, facade) = (self.model, self.facade);
        let separations = &self.kernels.separations;
        if separations.forces.is_empty() {
            return TokenStream::new();
        }
        let forces = separations.forces.iter();
        let forces = forces.map(|&force| model.forces[force].name.to_string());
        let names = ["constants", "time", "state", "visit", "ends"];
        let [constants, time, state, visit, ends] = names.map(local);
        let unpack = Self::unpack();
        let frame = self.frame_of_state("separations", &quote!(#time: __S,));
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&separations.kernel, &frame);
        let vectors = outputs.chunks(3);
        let places = 0..separations.forces.len();
        quote! {
            const SEPARATIONS: &'static [&'static str] = &[#(#forces),*];

            fn separations<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #ends: [(__S, &Self::State<__S>); 2],
                #visit: &mut impl FnMut(usize, [[__S; 3]; 2]),
            ) {
                let #ends = #ends.map(|(#time, #state)| {
                    #unpack
                    #statements
                    [#([#(#vectors),*]),*]
                });
                #( #visit(#places, [#ends[0][#places], #ends[1][#places]]); )*
            }
        }
    }
}
