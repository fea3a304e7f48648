//! The implementation of a mechanism.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::documentation::documentation;
use super::local;
use super::parameters;
use super::report::report;
use super::store::{Kernel as Arguments, Store};
use super::straight_line::{StraightLine, write};
use crate::model::Model;
use crate::plan::kernels::{Kernel, Kernels};
use crate::symbolic::arena::Stage;

/// Writes everything that is generated for a mechanism.
#[must_use]
pub fn emit(model: &Model, facade: &TokenStream) -> TokenStream {
    let kernels = Kernels::new(model);
    let writer = Writer {
        model,
        kernels: &kernels,
        facade,
        store: Store::default(),
    };
    writer.write()
}

/// What the parts of an implementation are written from.
pub(super) struct Writer<'a> {
    pub(super) model: &'a Model,
    pub(super) kernels: &'a Kernels,
    pub(super) facade: &'a TokenStream,
    pub(super) store: Store,
}

impl Writer<'_> {
    fn write(mut self) -> TokenStream {
        let (model, facade, kernels) = (self.model, self.facade, self.kernels);
        let name = &model.name;
        let layout = model.layout();
        let (q, u, m) = (layout.coordinates, layout.velocities, layout.rows);
        let jacobian_size = kernels.jacobian.outputs.len();
        let report = report(model, kernels, facade);
        let documentation = documentation(model, kernels);
        let (handles_type, handles) = self.handles();
        let state_kernels = self.state_kernels();
        let evaluations: TokenStream = kernels
            .evaluations
            .iter()
            .map(|evaluation| self.evaluation(evaluation))
            .collect();
        let dispatch = self.dispatch();
        let mut sizes = [0, 0];
        let mut solvers = TokenStream::new();
        for (size, solver) in sizes.iter_mut().zip(&kernels.solvers) {
            let (tokens, factors) = self.solver(solver);
            solvers.extend(tokens);
            *size = factors;
        }
        let [plain_size, compliant_size] = sizes;
        let factor_size = plain_size.max(compliant_size);
        let angles = self.angles();
        let points = self.points();
        let user_axes = self.user_axes();
        let initial = self.initial_state();
        let coefficients = self.store.write_coefficients();
        let (coefficient_statements, coefficient_outputs) =
            (coefficients.statements, coefficients.outputs);
        let prepared = self.store.write_constants(&model.symbols);
        let (constant_statements, constant_outputs) = (prepared.statements, prepared.outputs);
        let (c, k) = (self.store.constants(), self.store.coefficients());
        let checks = parameters::checks(model, facade);
        let assertions = parameters::assertions(model, facade);
        let fields = model
            .bodies
            .iter()
            .map(|body| &body.name)
            .chain(model.joints.iter().map(|joint| &joint.name))
            .collect::<Vec<_>>();
        let (constants, stabilisation) = (local("constants"), local("stabilisation"));
        quote! {
            #[allow(
                clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction,
                dead_code, non_snake_case, unused, missing_docs, unreachable_pub, single_use_lifetimes,
                trivial_numeric_casts, unused_qualifications, variant_size_differences, elided_lifetimes_in_paths
            )]
            const _: () = {
                use ::core::iter::Iterator as _;
                use #facade::{Array as _, Scalar as _, StateParts as _};

                #handles_type
                #assertions

                #[automatically_derived]
                #documentation
                impl #facade::Mechanism for #name {
                    type State<S: #facade::Scalar> = #facade::State<S, #q, #u>;
                    type Velocities<S: #facade::Scalar> = [S; #u];
                    type Multipliers<S: #facade::Scalar> = [S; #m];
                    type Jacobian<S: #facade::Scalar> = [S; #jacobian_size];
                    type Parameters<S: #facade::Scalar> = ();
                    type Constants<S: #facade::Scalar> = [S; #c];
                    type Coefficients<S: #facade::Scalar> = [S; #k];
                    type Factors<S: #facade::Scalar> = [S; #factor_size];
                    type Handles = __Handles;

                    const HANDLES: __Handles = #handles;
                    const REPORT: #facade::Report = #report;

                    fn parameters<S: #facade::Scalar>(&self) -> Self::Parameters<S> {
                        #( let _ = &self.#fields; )*
                    }

                    fn prepare<S: #facade::Scalar>(
                        _: &Self::Parameters<S>,
                    ) -> ::core::result::Result<Self::Constants<S>, #facade::ParameterError> {
                        #checks
                        #constant_statements
                        ::core::result::Result::Ok([#(#constant_outputs),*])
                    }

                    #[inline]
                    fn coefficients<S: #facade::Scalar>(
                        #constants: &Self::Constants<S>,
                        #stabilisation: &#facade::Stabilisation<S>,
                    ) -> Self::Coefficients<S> {
                        #coefficient_statements
                        [#(#coefficient_outputs),*]
                    }

                    #state_kernels
                    #dispatch
                    #initial
                    #angles
                    #points
                    #user_axes
                }

                #evaluations
                #solvers

                #[automatically_derived]
                impl ::core::default::Default for #name {
                    fn default() -> Self {
                        Self { #( #fields: ::core::default::Default::default() ),* }
                    }
                }
            };
        }
    }

    pub(super) fn line(&mut self, kernel: &Kernel) -> StraightLine {
        write(
            &kernel.arena,
            &kernel.outputs,
            Stage::State,
            &mut Arguments {
                store: &mut self.store,
            },
        )
    }

    /// Statements that give a kernel its arrays.
    pub(super) fn unpack() -> TokenStream {
        let (state, coordinates, velocities) =
            (local("state"), local("coordinates"), local("velocities"));
        quote! {
            let #coordinates = #state.coordinates();
            let #velocities = #state.velocities();
        }
    }

    fn state_kernels(&mut self) -> TokenStream {
        let facade = self.facade;
        let kernels = self.kernels;
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        let mut tokens = TokenStream::new();
        for (name, kernel, result) in [
            (
                "constraints",
                &kernels.constraints,
                quote!(Self::Multipliers<S>),
            ),
            (
                "constraint_rates",
                &kernels.constraint_rates,
                quote!(Self::Multipliers<S>),
            ),
            ("jacobian", &kernels.jacobian, quote!(Self::Jacobian<S>)),
            ("gamma", &kernels.gamma, quote!(Self::Multipliers<S>)),
            ("forces", &kernels.forces, quote!(Self::Velocities<S>)),
        ] {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let name = format_ident!("{name}");
            tokens.extend(quote! {
                #[inline]
                fn #name<S: #facade::Scalar>(
                    #constants: &Self::Constants<S>,
                    _: S,
                    #state: &Self::State<S>,
                ) -> #result {
                    #unpack
                    #statements
                    [#(#outputs),*]
                }
            });
        }
        for (name, kernel, time) in [
            ("kinetic_energy", &kernels.kinetic_energy, None),
            (
                "potential_energy",
                &kernels.potential_energy,
                Some(quote!(_: S,)),
            ),
        ] {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            let name = format_ident!("{name}");
            tokens.extend(quote! {
                #[inline]
                fn #name<S: #facade::Scalar>(
                    #constants: &Self::Constants<S>,
                    #time
                    #state: &Self::State<S>,
                ) -> S {
                    #unpack
                    #statements
                    #(#outputs)*
                }
            });
        }
        let mass = self.line(&kernels.mass);
        let (statements, outputs) = (mass.statements, mass.outputs);
        let rates = self.line(&kernels.coordinate_rates);
        let (rate_statements, rate_outputs) = (rates.statements, rates.outputs);
        let coordinates = self.model.layout().coordinates;
        tokens.extend(quote! {
            #[inline]
            fn mass<S: #facade::Scalar>(#constants: &Self::Constants<S>) -> Self::Velocities<S> {
                #statements
                [#(#outputs),*]
            }

            #[inline]
            fn coordinate_rates<S: #facade::Scalar>(#state: &Self::State<S>) -> [S; #coordinates] {
                #unpack
                #rate_statements
                [#(#rate_outputs),*]
            }
        });
        tokens
    }

    fn initial_state(&mut self) -> TokenStream {
        let facade = self.facade;
        let StraightLine {
            statements,
            outputs,
        } = self.line(&self.kernels.initial_state);
        let (coordinates, velocities) = outputs.split_at(self.model.layout().coordinates);
        let constants = local("constants");
        quote! {
            fn initial_state<S: #facade::Scalar>(#constants: &Self::Constants<S>) -> Self::State<S> {
                #statements
                #facade::State::from_parts([#(#coordinates),*], [#(#velocities),*])
            }
        }
    }

    fn angles(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, state, joint) = (local("constants"), local("state"), local("joint"));
        let unpack = Self::unpack();
        let mut arms = TokenStream::new();
        for (place, kernel) in &self.kernels.angles {
            let StraightLine {
                statements,
                outputs,
            } = self.line(kernel);
            if let [cosine, sine, rate] = &outputs[..] {
                arms.extend(quote! {
                    #place => {
                        #statements
                        #facade::AngleParts { cosine: #cosine, sine: #sine, rate: #rate, turns: ::core::option::Option::None }
                    }
                });
            }
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
                    _ => #facade::AngleParts { cosine: S::one(), sine: S::zero(), rate: S::zero(), turns: ::core::option::Option::None },
                }
            }
        }
    }

    fn points(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, joint, place) = (local("constants"), local("joint"), local("place"));
        let mut arms = TokenStream::new();
        for (at, body, kernel) in &self.kernels.points {
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

    fn user_axes(&self) -> TokenStream {
        let body = local("body");
        let arms = self
            .model
            .bodies
            .iter()
            .enumerate()
            .filter_map(|(place, described)| {
                let p = described.user_axes;
                (p != crate::model::inertia::IDENTITY).then(|| quote!(#place => [#(#p),*],))
            });
        quote! {
            fn user_axes(#body: usize) -> [f64; 4] {
                match #body {
                    #(#arms)*
                    _ => [1.0, 0.0, 0.0, 0.0],
                }
            }
        }
    }

    fn handles(&self) -> (TokenStream, TokenStream) {
        let (name, facade) = (&self.model.name, self.facade);
        let mut declared = TokenStream::new();
        let mut values = TokenStream::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let field = &body.name;
            declared.extend(quote!(pub #field: #facade::BodyHandle<#name>,));
            values.extend(quote!(#field: #facade::BodyHandle::new(#place),));
        }
        for (place, joint) in self.model.joints.iter().enumerate() {
            let (field, path) = (&joint.name, &joint.path);
            declared.extend(quote!(pub #field: #facade::JointHandle<#name, #path>,));
            values.extend(quote!(#field: #facade::JointHandle::new(#place),));
        }
        let documentation = format!("The handles of [`{name}`], one per field.");
        let declared = quote! {
            #[doc = #documentation]
            #[derive(Clone, Copy, Debug)]
            pub struct __Handles { #declared }
        };
        (declared, quote!(__Handles { #values }))
    }
}
