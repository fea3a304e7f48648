//! Functions that read joints and forces.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

impl Writer<'_> {
    pub(super) fn angles(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, state, joint) = (local("constants"), local("state"), local("joint"));
        let unpack = Self::unpack();
        let kernels = self.kernels;
        let angles = &kernels.readouts.angles;
        if let Some(calls) = self.repeated_each("joint_angle", angles) {
            let (statements, gathered) = (calls.statements, calls.gathered);
            return quote! {
                fn joint_angle<__S: #facade::Scalar>(
                    #constants: &Self::Constants<__S>,
                    #state: &Self::State<__S>,
                    #joint: usize,
                ) -> #facade::__private::AngleParts<__S> {
                    #unpack
                    #statements
                    #facade::__private::angle_of(#gathered)
                }
            };
        }
        let mut arms = TokenStream::new();
        for (place, kernel) in angles {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let [cosine, sine, rate, counter @ ..] = &outputs[..] else {
                unreachable!("an angle has a cosine, a sine and a rate");
            };
            let turns = match counter {
                [counter] => quote!(::core::option::Option::Some(#counter)),
                _ => quote!(::core::option::Option::None),
            };
            arms.extend(quote! {
                #place => {
                    #statements
                    #facade::__private::AngleParts { cosine: #cosine, sine: #sine, rate: #rate, turns: #turns }
                }
            });
        }
        quote! {
            fn joint_angle<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #state: &Self::State<__S>,
                #joint: usize,
            ) -> #facade::__private::AngleParts<__S> {
                #unpack
                match #joint {
                    #arms
                    _ => #facade::__private::AngleParts {
                        cosine: __S::one(),
                        sine: __S::zero(),
                        rate: __S::zero(),
                        turns: ::core::option::Option::None,
                    },
                }
            }
        }
    }

    /// Nothing where no joint has two angles: the trait knows that.
    pub(super) fn two_angles(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, state, joint) = (local("constants"), local("state"), local("joint"));
        let unpack = Self::unpack();
        let mut arms = TokenStream::new();
        for (place, kernel) in &self.kernels.readouts.two_angles {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let angles = outputs.chunks_exact(3).map(|angle| {
                let (cosine, sine, rate) = (&angle[0], &angle[1], &angle[2]);
                quote! {
                    #facade::__private::AngleParts {
                        cosine: #cosine, sine: #sine, rate: #rate, turns: ::core::option::Option::None,
                    }
                }
            });
            arms.extend(quote! {
                #place => {
                    #statements
                    [#(#angles),*]
                }
            });
        }
        if arms.is_empty() {
            return arms;
        }
        quote! {
            fn joint_angles<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #state: &Self::State<__S>,
                #joint: usize,
            ) -> [#facade::__private::AngleParts<__S>; 2] {
                #unpack
                match #joint {
                    #arms
                    _ => [#facade::__private::AngleParts::none(); 2],
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
        for (place, kernel) in &self.kernels.readouts.displacements {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            if let [value, rate] = &outputs[..] {
                arms.extend(quote! {
                    #place => {
                        #statements
                        #facade::__private::DisplacementParts { value: #value, rate: #rate }
                    }
                });
            }
        }
        quote! {
            fn joint_displacement<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #joint: usize,
            ) -> #facade::__private::DisplacementParts<__S> {
                #unpack
                match #joint {
                    #arms
                    _ => #facade::__private::DisplacementParts { value: __S::zero(), rate: __S::zero() },
                }
            }
        }
    }

    /// Only where joints have contacts.
    pub(super) fn contacts(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let mut arms = TokenStream::new();
        for (place, kernel) in &kernels.readouts.contacts {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let vectors = outputs.chunks(3).map(|vector| quote!([#(#vector),*]));
            arms.extend(quote!(#place => { #statements [#(#vectors),*] }));
        }
        if arms.is_empty() {
            return arms;
        }
        let facade = self.facade;
        let (constants, time, state, joint) = (
            local("constants"),
            local("time"),
            local("state"),
            local("joint"),
        );
        let unpack = Self::unpack();
        quote! {
            fn joint_contact<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #joint: usize,
            ) -> [[__S; 3]; 3] {
                #unpack
                match #joint {
                    #arms
                    _ => [[__S::zero(); 3]; 3],
                }
            }
        }
    }

    /// Only where joints tell a side; the trait says that all is well by default.
    pub(super) fn sides(&mut self) -> TokenStream {
        if self.kernels.readouts.sides.is_empty() {
            return TokenStream::new();
        }
        let facade = self.facade;
        let (constants, state, joint) = (local("constants"), local("state"), local("joint"));
        let unpack = Self::unpack();
        let kernels = self.kernels;
        let sides = &kernels.readouts.sides;
        if let Some(calls) = self.repeated_each("joint_side", sides) {
            let (statements, gathered) = (calls.statements, calls.gathered);
            return quote! {
                fn joint_side<__S: #facade::Scalar>(
                    #constants: &Self::Constants<__S>,
                    #state: &Self::State<__S>,
                    #joint: usize,
                ) -> __S {
                    #unpack
                    #statements
                    #facade::__private::least(#gathered)
                }
            };
        }
        let mut arms = TokenStream::new();
        for (place, kernel) in sides {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let least = outputs
                .iter()
                .map(|output| quote!(#output))
                .reduce(|least, output| quote!(<__S as #facade::Scalar>::min(#least, #output)));
            arms.extend(quote!(#place => { #statements #least }));
        }
        quote! {
            fn joint_side<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #state: &Self::State<__S>,
                #joint: usize,
            ) -> __S {
                #unpack
                match #joint {
                    #arms
                    _ => __S::one(),
                }
            }
        }
    }

    pub(super) fn points(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, joint, place) = (local("constants"), local("joint"), local("place"));
        let mut arms = TokenStream::new();
        for (at, body, kernel) in &self.kernels.readouts.points {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            arms.extend(quote!((#at, #body) => { #statements [#(#outputs),*] }));
        }
        quote! {
            fn joint_point<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #joint: usize,
                #place: usize,
            ) -> [__S; 3] {
                match (#joint, #place) {
                    #arms
                    _ => [__S::zero(); 3],
                }
            }
        }
    }

    /// Only where joints or forces name points or directions.
    pub(super) fn markers(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let markers = kernels.readouts.markers.iter();
        self.three_by_place("marker", markers.map(|marker| &marker.components))
    }

    /// Only where there are named points.
    pub(super) fn named_points(&mut self) -> TokenStream {
        let kernels = self.kernels;
        self.three_by_place("named_point", kernels.readouts.named_points.iter())
    }

    /// Only where bodies are described by shapes.
    pub(super) fn shapes(&mut self) -> TokenStream {
        let kernels = self.kernels;
        self.three_by_place("shape", kernels.readouts.shapes.iter())
    }

    /// A function of constants and a place, with three numbers at each; nothing without a place.
    fn three_by_place<'k>(
        &mut self,
        name: &str,
        kernels: impl Iterator<Item = &'k Kernel>,
    ) -> TokenStream {
        let mut arms = TokenStream::new();
        for (at, kernel) in kernels.enumerate() {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            arms.extend(quote!(#at => { #statements [#(#outputs),*] }));
        }
        if arms.is_empty() {
            return arms;
        }
        let (facade, constants, place) = (self.facade, local("constants"), local(name));
        let function = format_ident!("{name}");
        quote! {
            fn #function<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #place: usize,
            ) -> [__S; 3] {
                match #place {
                    #arms
                    _ => [__S::zero(); 3],
                }
            }
        }
    }

    /// Only where there are auxiliary variables; the trait does nothing by default.
    pub(super) fn rewrap(&mut self) -> TokenStream {
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
            fn rewrap<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #state: &mut Self::State<__S>,
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
    pub(super) fn force_readouts(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, time, state) = (local("constants"), local("time"), local("state"));
        let (force, place) = (local("force"), local("place"));
        if self.model.forces.is_empty() {
            return TokenStream::new();
        }
        let unpack = Self::unpack();
        let (mut energies, mut loads) = (TokenStream::new(), TokenStream::new());
        for (at, kernel) in self.kernels.readouts.energies.iter().enumerate() {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            if let [potential, power] = &outputs[..] {
                energies.extend(quote! {
                    #at => {
                        #statements
                        #facade::__private::ForceParts { potential: #potential, power: #power }
                    }
                });
            }
        }
        for (at, body, kernel) in &self.kernels.readouts.loads {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            loads.extend(quote!((#at, #body) => { #statements [#(#outputs),*] }));
        }
        quote! {
            fn force_parts<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #force: usize,
            ) -> #facade::__private::ForceParts<__S> {
                #unpack
                match #force {
                    #energies
                    _ => #facade::__private::ForceParts { potential: __S::zero(), power: __S::zero() },
                }
            }

            fn force_load<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #force: usize,
                #place: usize,
            ) -> [__S; 6] {
                #unpack
                match (#force, #place) {
                    #loads
                    _ => [__S::zero(); 6],
                }
            }
        }
    }
}
