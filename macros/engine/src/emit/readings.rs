//! Functions that read joints and forces.

use proc_macro2::TokenStream;
use quote::quote;

use super::local;
use super::mechanism::Writer;
use super::straight_line::StraightLine;

impl Writer<'_> {
    pub(super) fn angles(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, state, joint) = (local("constants"), local("state"), local("joint"));
        let unpack = Self::unpack();
        let mut arms = TokenStream::new();
        for (place, kernel) in &self.kernels.readings.angles {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let [cosine, sine, rate, counter @ ..] = &outputs[..] else {
                continue;
            };
            let turns = match counter {
                [counter] => quote!(::core::option::Option::Some(#counter)),
                _ => quote!(::core::option::Option::None),
            };
            arms.extend(quote! {
                #place => {
                    #statements
                    #facade::AngleParts { cosine: #cosine, sine: #sine, rate: #rate, turns: #turns }
                }
            });
        }
        quote! {
            fn joint_angle<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #state: &Self::State<S>,
                #joint: usize,
            ) -> #facade::AngleParts<S> {
                #unpack
                match #joint {
                    #arms
                    _ => #facade::AngleParts {
                        cosine: S::one(),
                        sine: S::zero(),
                        rate: S::zero(),
                        turns: ::core::option::Option::None,
                    },
                }
            }
        }
    }

    pub(super) fn displacements(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, time, state, joint) = (
            local("constants"),
            local("time"),
            local("state"),
            local("joint"),
        );
        let unpack = Self::unpack();
        let mut arms = TokenStream::new();
        for (place, kernel) in &self.kernels.readings.displacements {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            if let [value, rate] = &outputs[..] {
                arms.extend(quote! {
                    #place => {
                        #statements
                        #facade::DisplacementParts { value: #value, rate: #rate }
                    }
                });
            }
        }
        quote! {
            fn joint_displacement<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #time: S,
                #state: &Self::State<S>,
                #joint: usize,
            ) -> #facade::DisplacementParts<S> {
                #unpack
                match #joint {
                    #arms
                    _ => #facade::DisplacementParts { value: S::zero(), rate: S::zero() },
                }
            }
        }
    }

    pub(super) fn points(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, joint, place) = (local("constants"), local("joint"), local("place"));
        let mut arms = TokenStream::new();
        for (at, body, kernel) in &self.kernels.readings.points {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            arms.extend(quote!((#at, #body) => { #statements [#(#outputs),*] }));
        }
        quote! {
            fn joint_point<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #joint: usize,
                #place: usize,
            ) -> [S; 3] {
                match (#joint, #place) {
                    #arms
                    _ => [S::zero(); 3],
                }
            }
        }
    }

    /// Only where there are auxiliary variables; the trait does nothing by default.
    pub(super) fn recount(&mut self) -> TokenStream {
        if self.kernels.counters.outputs.is_empty() {
            return TokenStream::new();
        }
        let facade = self.facade;
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        let StraightLine {
            statements,
            outputs,
        } = self.line(&self.kernels.counters);
        let first = self.model.layout().coordinates;
        let places = first..first + outputs.len();
        let counted = local("counted");
        let names: Vec<_> = places
            .clone()
            .map(|place| local(&format!("counted_{place}")))
            .collect();
        quote! {
            fn recount<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #state: &mut Self::State<S>,
            ) {
                let #counted = {
                    #unpack
                    #statements
                    [#(#outputs),*]
                };
                let [#(#names),*] = #counted;
                #( #state.coordinates_mut()[#places] = #names; )*
            }
        }
    }

    /// Energy, power and loads of single forces; only where there are forces.
    pub(super) fn force_readings(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, time, state) = (local("constants"), local("time"), local("state"));
        let (force, place) = (local("force"), local("place"));
        if self.model.forces.is_empty() {
            return TokenStream::new();
        }
        let unpack = Self::unpack();
        let (mut energies, mut loads) = (TokenStream::new(), TokenStream::new());
        for (at, kernel) in self.kernels.readings.energies.iter().enumerate() {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            if let [potential, power] = &outputs[..] {
                energies.extend(quote! {
                    #at => {
                        #statements
                        #facade::ForceParts { potential: #potential, power: #power }
                    }
                });
            }
        }
        for (at, body, kernel) in &self.kernels.readings.loads {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            loads.extend(quote!((#at, #body) => { #statements [#(#outputs),*] }));
        }
        quote! {
            fn force_parts<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #time: S,
                #state: &Self::State<S>,
                #force: usize,
            ) -> #facade::ForceParts<S> {
                #unpack
                match #force {
                    #energies
                    _ => #facade::ForceParts { potential: S::zero(), power: S::zero() },
                }
            }

            fn force_load<S: #facade::Scalar>(
                #constants: &Self::Constants<S>,
                #time: S,
                #state: &Self::State<S>,
                #force: usize,
                #place: usize,
            ) -> [S; 6] {
                #unpack
                match (#force, #place) {
                    #loads
                    _ => [S::zero(); 6],
                }
            }
        }
    }
}
