//! The implementation of a mechanism.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::documentation::documentation;
use super::inputs::{Inputs, inputs_of, taken};
use super::parameters;
use super::parts::{Frame, write_in_parts};
use super::report::report;
use super::rows;
use super::solution::is_short;
use super::store::{Kernel as Arguments, Store};
use super::straight_line::{Given, StraightLine, write};
use crate::coordinates::kernels::JointKernels;
use crate::model::name::fields;
use crate::model::{Model, Name};
use crate::plan::kernels::Kernels;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// Writes everything that is generated for a mechanism.
#[must_use]
pub fn emit(model: &Model, facade: &TokenStream) -> TokenStream {
    let kernels = Kernels::new(model);
    let writer = Writer {
        model,
        kernels: &kernels,
        facade,
        store: Store::default(),
        parts: TokenStream::new(),
    };
    writer.write()
}

/// What the parts of an implementation are written from.
pub(super) struct Writer<'a> {
    pub(super) model: &'a Model,
    pub(super) kernels: &'a Kernels,
    pub(super) facade: &'a TokenStream,
    pub(super) store: Store,
    /// The functions that long kernels are written in.
    pub(super) parts: TokenStream,
}

impl Writer<'_> {
    fn write(mut self) -> TokenStream {
        let (model, facade, kernels) = (self.model, self.facade, self.kernels);
        let name = &model.name;
        let layout = model.layout();
        let (q, u, m) = (
            layout.coordinates + layout.auxiliaries,
            layout.velocities,
            layout.rows,
        );
        let values = model.values.len();
        let jacobian_size = kernels.jacobian.outputs.len();
        let report = report(model, kernels, facade);
        let documentation = documentation(model, kernels);
        let (handles_type, handles) = self.handles();
        let state_kernels = self.state_kernels();
        let evaluations = self.evaluations();
        let dispatch = self.dispatch();
        let mut sizes = [0, 0];
        let mut solvers = TokenStream::new();
        for (size, solver) in sizes.iter_mut().zip(&kernels.solvers) {
            let (tokens, factors) = self.solver(solver);
            solvers.extend(tokens);
            *size = factors;
        }
        let [plain_size, compliant_size] = sizes;
        let factors = rows::array(plain_size.max(compliant_size));
        let angles = self.angles();
        let points = self.points();
        let displacements = self.displacements();
        let sides = self.sides();
        let recount = self.recount();
        let forces = self.force_readouts();
        let user_axes = self.user_axes();
        let initial = self.initial_state();
        let likes = self.likes();
        let coefficients = self.store.write_coefficients();
        let (coefficient_statements, coefficient_outputs) =
            (coefficients.statements, coefficients.outputs);
        let taken = taken(model, &mut self.store);
        let prepared = self.store.write_constants(&model.symbols);
        let (constant_statements, constant_outputs) = (prepared.statements, prepared.outputs);
        let (c, k) = (self.store.constants(), self.store.coefficients());
        let parameters = parameters::parameters(model, facade);
        let Inputs {
            declared: inputs_type,
            kind: inputs_kind,
            functions: inputs,
        } = inputs_of(model, facade);
        let assertions = parameters::assertions(model, facade);
        let construction = parameters::construction(model, facade);
        let (constants, stabilisation) = (local("constants"), local("stabilisation"));
        let compliances = local("compliances");
        let vector_rows = &kernels.vector_rows;
        let joints = model
            .coordinates
            .have_joints()
            .then(|| super::coordinates::implementation(model, &JointKernels::new(model), facade));
        let parts = &self.parts;
        let given = local("parameters");
        quote! {
            #[allow(
                clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction,
                dead_code, non_snake_case, unused, missing_docs, unreachable_pub, single_use_lifetimes,
                trivial_numeric_casts, unused_qualifications, variant_size_differences, elided_lifetimes_in_paths
            )]
            const _: () = {
                // Types of the same names may stand beside the struct.
                use ::core::primitive::{f64, usize};
                use ::core::assert as __holonom_assert;
                use #facade::{Array as _, Scalar as _, StateParts as _};

                #handles_type
                #inputs_type
                #assertions

                #[automatically_derived]
                #documentation
                impl #facade::Mechanism for #name {
                    type State<__S: #facade::Scalar> = #facade::State<__S, #q, #u>;
                    type Velocities<__S: #facade::Scalar> = [__S; #u];
                    type Multipliers<__S: #facade::Scalar> = [__S; #m];
                    type Jacobian<__S: #facade::Scalar> = [__S; #jacobian_size];
                    type Parameters<__S: #facade::Scalar> = [__S; #values];
                    type Inputs<__S: #facade::Scalar> = #inputs_kind;
                    type Constants<__S: #facade::Scalar> = [__S; #c];
                    type Coefficients<__S: #facade::Scalar> = [__S; #k];
                    type Factors<__S: #facade::Scalar> = #factors;
                    type Handles = __Handles;

                    const HANDLES: __Handles = #handles;
                    const REPORT: #facade::Report = #report;
                    const VECTOR_ROWS: &'static [usize] = &[#(#vector_rows),*];

                    #parameters
                    #inputs
                    #likes

                    fn prepare<__S: #facade::Scalar>(
                        #given: &Self::Parameters<__S>,
                    ) -> Self::Constants<__S> {
                        #constant_statements
                        [#(#constant_outputs),*]
                    }

                    #[inline]
                    fn take_inputs<__S: #facade::Scalar>(
                        #given: &Self::Parameters<__S>,
                        #constants: &mut Self::Constants<__S>,
                    ) {
                        #taken
                    }

                    #[inline]
                    fn coefficients_by_row<__S: #facade::Scalar>(
                        #constants: &Self::Constants<__S>,
                        #stabilisation: &#facade::Stabilisation<__S>,
                        #compliances: &Self::Multipliers<__S>,
                    ) -> Self::Coefficients<__S> {
                        #coefficient_statements
                        [#(#coefficient_outputs),*]
                    }

                    #state_kernels
                    #dispatch
                    #initial
                    #angles
                    #points
                    #displacements
                    #sides
                    #recount
                    #forces
                    #user_axes
                }

                #evaluations
                #solvers
                #parts

                #joints

                #construction
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

    /// A kernel that may be long.
    pub(super) fn line_of(
        &mut self,
        kernel: &Kernel,
        given: &Given,
        frame: &Frame,
    ) -> StraightLine {
        let (line, parts) = write_in_parts(
            (&kernel.arena, &kernel.outputs),
            Stage::State,
            given,
            &mut Arguments {
                store: &mut self.store,
            },
            frame,
        );
        self.parts.extend(parts);
        line
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
        let constants = local("constants");
        let mut tokens = TokenStream::new();
        let (rows, velocities) = (
            quote!(Self::Multipliers<__S>),
            quote!(Self::Velocities<__S>),
        );
        for (name, kernel, result) in [
            ("constraints", &kernels.constraints, &rows),
            ("constraint_rates", &kernels.constraint_rates, &rows),
            ("jacobian", &kernels.jacobian, &quote!(Self::Jacobian<__S>)),
            ("gamma", &kernels.gamma, &rows),
            ("forces", &kernels.forces, &velocities),
            ("potential_energy", &kernels.potential_energy, &quote!(__S)),
            ("power", &kernels.power, &quote!(__S)),
        ] {
            let time = local("time");
            tokens.extend(self.function(name, kernel, &quote!(#time: __S,), result));
        }
        let coordinates = self.model.layout().coordinates + self.model.layout().auxiliaries;
        for (name, kernel, result) in [
            ("kinetic_energy", &kernels.kinetic_energy, quote!(__S)),
            (
                "coordinate_rates",
                &kernels.coordinate_rates,
                quote!([__S; #coordinates]),
            ),
        ] {
            tokens.extend(self.function(name, kernel, &TokenStream::new(), &result));
        }
        let (statements, value) = self.body(&kernels.mass, &velocities);
        tokens.extend(quote! {
            #[inline]
            fn mass<__S: #facade::Scalar>(#constants: &Self::Constants<__S>) -> Self::Velocities<__S> {
                #statements
                #value
            }
        });
        tokens
    }

    /// Statements and value of a kernel: one number where the result is `S`, else an array.
    fn body(&mut self, kernel: &Kernel, result: &TokenStream) -> (TokenStream, TokenStream) {
        let line = self.line(kernel);
        Self::value(line, result)
    }

    fn value(line: StraightLine, result: &TokenStream) -> (TokenStream, TokenStream) {
        let StraightLine {
            statements,
            outputs,
        } = line;
        let value = if result.to_string() == "__S" {
            quote!(#(#outputs)*)
        } else {
            quote!([#(#outputs),*])
        };
        (statements, value)
    }

    /// A function of constants, time (if it is declared) and state.
    fn function(
        &mut self,
        name: &str,
        kernel: &Kernel,
        time: &TokenStream,
        result: &TokenStream,
    ) -> TokenStream {
        let facade = self.facade;
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        let mechanism = &self.model.name;
        let passed_time = (!time.is_empty()).then(|| local("time")).into_iter();
        let frame = Frame {
            name: format!("__{name}"),
            facade: facade.clone(),
            declared: quote! {
                #constants: &<#mechanism as #facade::Mechanism>::Constants<__S>,
                #time
                #state: &<#mechanism as #facade::Mechanism>::State<__S>,
            },
            passed: quote!(#constants, #(#passed_time,)* #state,),
            unpack: unpack.clone(),
        };
        let line = self.line_of(kernel, &Given::default(), &frame);
        let (statements, value) = Self::value(line, result);
        let name = format_ident!("{name}");
        // A long kernel is compiled once, and not wherever something is read or goes wrong.
        let inline = if is_short(&kernel.arena, &kernel.outputs) {
            quote!(#[inline])
        } else {
            quote!(#[inline(never)])
        };
        quote! {
            #inline
            fn #name<__S: #facade::Scalar>(
                #constants: &Self::Constants<__S>,
                #time
                #state: &Self::State<__S>,
            ) -> #result {
                #unpack
                #statements
                #value
            }
        }
    }

    fn initial_state(&mut self) -> TokenStream {
        let facade = self.facade;
        let StraightLine {
            statements,
            outputs,
        } = self.line(&self.kernels.initial_state);
        let layout = self.model.layout();
        let (coordinates, velocities) = outputs.split_at(layout.coordinates + layout.auxiliaries);
        let constants = local("constants");
        quote! {
            fn initial_state<__S: #facade::Scalar>(#constants: &Self::Constants<__S>) -> Self::State<__S> {
                #statements
                #facade::State::from_parts([#(#coordinates),*], [#(#velocities),*])
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
        let mut declare = |handles: Vec<(&Name, TokenStream, TokenStream)>| {
            let names = handles.iter().map(|(name, ..)| *name);
            let mut rest = handles.iter();
            for (field, length) in fields(names) {
                let (_, kind, value) = rest.next().expect("a handle of every field");
                let Some(length) = length else {
                    declared.extend(quote!(pub #field: #kind,));
                    values.extend(quote!(#field: #value,));
                    continue;
                };
                let others = rest.by_ref().take(length - 1).map(|(.., value)| value);
                declared.extend(quote!(pub #field: [#kind; #length],));
                values.extend(quote!(#field: [#value, #(#others),*],));
            }
        };
        let bodies = self.model.bodies.iter().enumerate().map(|(place, body)| {
            let kind = quote!(#facade::BodyHandle<#name>);
            (&body.name, kind, quote!(#facade::BodyHandle::new(#place)))
        });
        declare(bodies.collect());
        let joints = self.model.joints.iter().enumerate().map(|(place, joint)| {
            let path = &joint.path;
            let kind = quote!(#facade::JointHandle<#name, #path>);
            (&joint.name, kind, quote!(#facade::JointHandle::new(#place)))
        });
        declare(joints.collect());
        let forces = self.model.forces.iter().enumerate().map(|(place, force)| {
            let path = &force.path;
            let kind = quote!(#facade::ForceHandle<#name, #path>);
            (&force.name, kind, quote!(#facade::ForceHandle::new(#place)))
        });
        declare(forces.collect());
        let documentation = format!("The handles of [`{name}`], one per field.");
        let declared = quote! {
            #[doc = #documentation]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            pub struct __Handles { #declared }
        };
        (declared, quote!(__Handles { #values }))
    }
}
