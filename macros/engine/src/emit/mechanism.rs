//! The implementation of a mechanism.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::construction::of_mechanism;
use super::coordinates;
use super::documentation::documentation;
use super::inputs::{Inputs, inputs_of, taken};
use super::limits;
use super::parameters;
use super::parts::Frame;
use super::report::{report, watched};
use super::solver::is_short;
use super::splines;
use super::straight_line::StraightLine;
use super::switches;
use super::writer::Writer;
use crate::coordinates::kernels::JointKernels;
use crate::model::{Body, Coordinates, Model};
use crate::plan::kernels::Kernels;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// The comments of the struct and of its fields, where there are any.
fn comments(model: &Model, facade: &TokenStream) -> TokenStream {
    if model.comments.is_empty() {
        return TokenStream::new();
    }
    let comments = model.comments.iter();
    let comments = comments
        .map(|(field, text)| quote!(#facade::mechanism::Comment { field: #field, text: #text }));
    quote!(const COMMENTS: &'static [#facade::mechanism::Comment] = &[#(#comments),*];)
}

/// Writes everything that is generated for a mechanism.
#[must_use]
pub fn emit(model: &Model, facade: &TokenStream) -> TokenStream {
    let kernels = Kernels::new(model);
    Writer::new(model, &kernels, facade).write()
}

/// What a kernel returns.
enum Returned {
    /// Its one output.
    Number,
    /// All outputs, in an array of this type.
    Array(TokenStream),
}

impl Returned {
    /// The type, and the value over the outputs.
    fn written(&self, outputs: &[TokenStream]) -> (TokenStream, TokenStream) {
        match self {
            Self::Number => (quote!(__S), quote!(#(#outputs)*)),
            Self::Array(kind) => (kind.clone(), quote!([#(#outputs),*])),
        }
    }
}

impl Writer<'_> {
    fn write(mut self) -> TokenStream {
        let (model, kernels, facade) = (self.model, self.kernels, self.facade);
        let name = &model.name;
        let state_kernels = self.state_kernels();
        let evaluations = self.evaluations();
        let dispatch = self.dispatch();
        let rate_columns = self.rate_columns();
        let choice_of_columns = self.choice_of_columns();
        let (solving, solvers, factors) = self.solving_by_bodies();
        let readouts = self.readouts();
        let initial = self.initial_state();
        let likes = self.likes();
        // What every kernel asks for is known now.
        let stages = self.stages();
        let (handles_type, handles) = self.handles();
        let Inputs {
            declared: inputs_type,
            kind: inputs_kind,
            functions: inputs,
        } = inputs_of(model, facade);
        let types = self.types(&factors, &inputs_kind);
        let (report, documentation) = (
            report(model, kernels, facade),
            documentation(model, kernels),
        );
        let (watched, comments) = (watched(model), comments(model, facade));
        let assertions = parameters::assertions(model, facade);
        let splines = splines::functions(model, facade);
        let sides = switches::functions(model, facade);
        let parameters = parameters::parameters(model, facade);
        let construction = of_mechanism(model, facade);
        let beside = limits::beside(model, facade);
        let limits = limits::members(model, facade);
        let vector_rows = &kernels.vector_rows;
        let joints = self.in_joint_coordinates();
        let default_coordinates = match model.coordinates {
            Coordinates::Joints => quote!(#facade::__private::Relative),
            Coordinates::Bodies | Coordinates::Both => quote!(#facade::__private::Absolute),
        };
        let parts = &self.parts;
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
                use #facade::__private::Array as _;
                use #facade::{Scalar as _, StateParts as _};

                #handles_type
                #inputs_type
                #watched
                #assertions
                #splines
                #sides

                #[automatically_derived]
                #documentation
                impl #facade::Mechanism for #name {
                    #types
                    type Coordinates = #default_coordinates;
                    type Handles = __Handles;

                    const HANDLES: __Handles = #handles;
                    const REPORT: #facade::Report = #report;
                    const VECTOR_ROWS: &'static [usize] = &[#(#vector_rows),*];
                    #comments

                    #limits
                    #parameters
                    #inputs
                    #likes
                    #stages
                    #state_kernels
                    #dispatch
                    #choice_of_columns
                    #solving
                    #initial
                    #readouts
                }

                #evaluations
                #rate_columns
                #solvers
                #parts

                #joints
                #beside
            };

            #construction
        }
    }

    /// The arrays that kernels take and give.
    fn types(&self, factors: &TokenStream, inputs: &TokenStream) -> TokenStream {
        let facade = self.facade;
        let layout = self.model.layout();
        let (q, u, m) = (layout.stored(), layout.velocities, layout.rows);
        let angles = layout.turns;
        let values = self.model.parameters();
        let jacobian_size = self.kernels.jacobian.outputs.len();
        let (c, k) = (self.store.constants(), self.store.coefficients());
        quote! {
            type State<__S: #facade::Scalar> = #facade::__private::State<__S, #q, #u, #angles>;
            type Velocities<__S: #facade::Scalar> = [__S; #u];
            type Multipliers<__S: #facade::Scalar> = [__S; #m];
            type Jacobian<__S: #facade::Scalar> = [__S; #jacobian_size];
            type Parameters<__S: #facade::Scalar> = [__S; #values];
            type Inputs<__S: #facade::Scalar> = #inputs;
            type Constants<__S: #facade::Scalar> = [__S; #c];
            type Coefficients<__S: #facade::Scalar> = [__S; #k];
            type Factors<__S: #facade::Scalar> = #factors;
        }
    }

    /// What is computed before the state is known: complete when every kernel is written.
    fn stages(&mut self) -> TokenStream {
        let (model, facade) = (self.model, self.facade);
        let coefficients = self.store.write_coefficients();
        let (coefficient_statements, coefficient_outputs) =
            (coefficients.statements, coefficients.outputs);
        let taken = taken(model, &mut self.store);
        let prepared = splines::prepared(model, self.store.write_constants(&model.symbols));
        let names = ["constants", "stabilisation", "compliances", "parameters"];
        let [constants, stabilisation, compliances, given] = names.map(local);
        quote! {
            fn prepare<__S: #facade::Scalar>(
                #given: &Self::Parameters<__S>,
            ) -> Self::Constants<__S> {
                #prepared
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
                #stabilisation: &#facade::__private::Stabilisation<__S>,
                #compliances: &Self::Multipliers<__S>,
            ) -> Self::Coefficients<__S> {
                #coefficient_statements
                [#(#coefficient_outputs),*]
            }
        }
    }

    /// What is read of bodies, joints and forces.
    fn readouts(&mut self) -> TokenStream {
        let mut tokens = self.angles();
        tokens.extend(self.points());
        tokens.extend(self.markers());
        tokens.extend(self.named_points());
        tokens.extend(self.shapes());
        tokens.extend(self.two_angles());
        tokens.extend(self.displacements());
        tokens.extend(self.contacts());
        tokens.extend(self.sides());
        tokens.extend(self.rewrap());
        tokens.extend(self.force_readouts());
        tokens.extend(self.user_axes());
        tokens
    }

    /// The same mechanism in joint coordinates, where these are asked for.
    fn in_joint_coordinates(&self) -> Option<TokenStream> {
        let (model, facade) = (self.model, self.facade);
        let is_wanted = model.coordinates.have_joints();
        is_wanted.then(|| coordinates::implementation(model, &JointKernels::new(model), facade))
    }

    fn state_kernels(&mut self) -> TokenStream {
        let facade = self.facade;
        let kernels = self.kernels;
        let constants = local("constants");
        let mut tokens = TokenStream::new();
        let rows = Returned::Array(quote!(Self::Multipliers<__S>));
        let velocities = Returned::Array(quote!(Self::Velocities<__S>));
        let jacobian = Returned::Array(quote!(Self::Jacobian<__S>));
        let number = Returned::Number;
        for (name, kernel, result) in [
            ("constraints", &kernels.constraints, &rows),
            ("constraint_rates", &kernels.constraint_rates, &rows),
            ("jacobian", &kernels.jacobian, &jacobian),
            ("gamma", &kernels.gamma, &rows),
            ("forces", &kernels.forces, &velocities),
            ("potential_energy", &kernels.potential_energy, &number),
            ("power", &kernels.power, &number),
        ] {
            let time = local("time");
            tokens.extend(self.function(name, kernel, &quote!(#time: __S,), result));
        }
        let coordinates = self.model.layout().stored();
        let coordinates = Returned::Array(quote!([__S; #coordinates]));
        for (name, kernel, result) in [
            ("kinetic_energy", &kernels.kinetic_energy, &number),
            ("coordinate_rates", &kernels.coordinate_rates, &coordinates),
        ] {
            tokens.extend(self.function(name, kernel, &TokenStream::new(), result));
        }
        tokens.extend(self.state_rates());
        tokens.extend(self.switches());
        tokens.extend(self.separations());
        let StraightLine {
            statements,
            outputs,
        } = self.line(&kernels.mass);
        let (kind, value) = velocities.written(&outputs);
        tokens.extend(quote! {
            #[inline]
            fn mass<__S: #facade::Scalar>(#constants: &Self::Constants<__S>) -> #kind {
                #statements
                #value
            }
        });
        if self.model.bodies.iter().any(|body| body.as_given) {
            let given = self.places(|body| body.as_given);
            tokens.extend(quote!(const AS_GIVEN: &'static [usize] = #given;));
        }
        let Some(metric) = &kernels.metric else {
            return tokens;
        };
        let StraightLine {
            statements,
            outputs,
        } = self.line(metric);
        let (kind, value) = velocities.written(&outputs);
        let without = self.places(|body| !body.has_inertia());
        tokens.extend(quote! {
            const WITHOUT_INERTIA: &'static [usize] = #without;

            fn metric<__S: #facade::Scalar>(#constants: &Self::Constants<__S>) -> #kind {
                #statements
                #value
            }
        });
        tokens
    }

    /// The places of some bodies.
    fn places(&self, wanted: impl Fn(&Body) -> bool) -> TokenStream {
        let bodies = self.model.bodies.iter().enumerate();
        let places = bodies.filter(|(_, body)| wanted(body));
        let places = places.map(|(place, _)| place);
        quote!(&[#(#places),*])
    }

    /// The function of a kernel of constants, time (if it is declared) and state.
    pub(super) fn frame_of_state(&self, name: &str, time: &TokenStream) -> Frame {
        let (facade, mechanism) = (self.facade, &self.model.name);
        let (constants, state) = (local("constants"), local("state"));
        let passed_time = (!time.is_empty()).then(|| local("time")).into_iter();
        self.frame(
            format!("__{name}"),
            quote! {
                #constants: &<#mechanism as #facade::Mechanism>::Constants<__S>,
                #time
                #state: &<#mechanism as #facade::Mechanism>::State<__S>,
            },
            quote!(#constants, #(#passed_time,)* #state,),
        )
    }

    /// A function of constants, time (if it is declared) and state.
    fn function(
        &mut self,
        name: &str,
        kernel: &Kernel,
        time: &TokenStream,
        result: &Returned,
    ) -> TokenStream {
        let facade = self.facade;
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        if let Returned::Array(kind) = result
            && let Some(called) = self.repeated(name, kernel, !time.is_empty())
        {
            let (statements, gathered) = (called.statements, called.gathered);
            let name = format_ident!("{name}");
            return quote! {
                #[inline(never)]
                fn #name<__S: #facade::Scalar>(
                    #constants: &Self::Constants<__S>,
                    #time
                    #state: &Self::State<__S>,
                ) -> #kind {
                    #unpack
                    #statements
                    #gathered
                }
            };
        }
        let frame = self.frame_of_state(name, time);
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(kernel, &frame);
        let (kind, value) = result.written(&outputs);
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
            ) -> #kind {
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
        let (coordinates, velocities) = outputs.split_at(layout.stored());
        let constants = local("constants");
        quote! {
            fn initial_state<__S: #facade::Scalar>(#constants: &Self::Constants<__S>) -> Self::State<__S> {
                #statements
                #facade::__private::State::of_parts([#(#coordinates),*], [#(#velocities),*])
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
}
