//! The implementation of a mechanism in joint coordinates.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::inputs::taken;
use super::parts::{Frame, write_in_parts};
use super::rows::{WIDTH, array, pack};
use super::solution::{inline, name, verdict};
use super::store::{BackSubstitution, Store, load_input};
use super::straight_line::{Environment, Given, StraightLine, Value};
use crate::coordinates::kernels::{Evaluation, JointKernels, Solver};
use crate::model::Model;
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input, Stage};
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// The environment of a kernel that reads a state in joint coordinates.
struct Arguments<'a> {
    store: &'a mut Store,
    turns: usize,
}

impl Environment for Arguments<'_> {
    fn input(&mut self, input: Input) -> TokenStream {
        let (pairs, rest, rates) = (local("pairs"), local("rest"), local("velocities"));
        match input {
            Input::Coordinate(place) if (place as usize) < 2 * self.turns => {
                let (pair, element) = (place as usize / 2, place as usize % 2);
                quote!(#pairs[#pair][#element])
            }
            Input::Coordinate(place) => {
                let place = place as usize - 2 * self.turns;
                quote!(#rest[#place])
            }
            Input::Velocity(place) => {
                let place = place as usize;
                quote!(#rates[#place])
            }
            other => load_input(other),
        }
    }

    fn earlier(&mut self, arena: &Arena, value: Expr) -> Value {
        Value::Expression(self.store.load(arena, value))
    }
}

pub(super) struct Writer<'a> {
    pub(super) model: &'a Model,
    pub(super) kernels: &'a JointKernels,
    pub(super) facade: &'a TokenStream,
    store: Store,
    /// The functions that long kernels are written in.
    parts: TokenStream,
}

/// The implementation, and the functions beside it.
pub(super) fn implementation(
    model: &Model,
    kernels: &JointKernels,
    facade: &TokenStream,
) -> TokenStream {
    let writer = Writer {
        model,
        kernels,
        facade,
        store: Store::default(),
        parts: TokenStream::new(),
    };
    writer.write()
}

impl Writer<'_> {
    fn write(mut self) -> TokenStream {
        let (model, facade, kernels) = (self.model, self.facade, self.kernels);
        let name = &model.name;
        let JointKernels {
            turns,
            rest,
            velocities,
            ..
        } = *kernels;
        let rows = kernels.rows.len();
        let read = kernels.bodies.outputs.len();
        let evaluations: TokenStream = kernels
            .evaluations
            .iter()
            .map(|evaluation| self.evaluation(evaluation))
            .collect();
        let dispatch = self.dispatch();
        let mut factors = 0;
        let mut solvers = TokenStream::new();
        for solver in &kernels.solvers {
            let (tokens, size) = self.solver(solver);
            solvers.extend(tokens);
            factors = factors.max(size);
        }
        let factors = array(factors);
        let solving = self.solving();
        let bodies = self.bodies();
        let joints = self.joints();
        let coordinate_rates = self.coordinate_rates();
        let coefficients = self.store.write_coefficients();
        let taken = taken(model, &mut self.store);
        let prepared = self.store.write_constants(&model.symbols);
        let (c, k) = (self.store.constants(), self.store.coefficients());
        let (constant_statements, constant_outputs) = (prepared.statements, prepared.outputs);
        let (coefficient_statements, coefficient_outputs) =
            (coefficients.statements, coefficients.outputs);
        let (constants, stabilisation) = (local("constants"), local("stabilisation"));
        let (compliances, given) = (local("compliances"), local("parameters"));
        let report = self.report();
        let documentation = self.documentation();
        let parts = &self.parts;
        quote! {
            #[automatically_derived]
            #documentation
            impl #facade::JointCoordinates for #name {
                type JointState<__S: #facade::Scalar> = #facade::JointState<__S, #turns, #rest, #velocities>;
                type ClosingMultipliers<__S: #facade::Scalar> = [__S; #rows];
                type JointConstants<__S: #facade::Scalar> = [__S; #c];
                type JointCoefficients<__S: #facade::Scalar> = [__S; #k];
                type BodyMotions<__S: #facade::Scalar> = [__S; #read];
                type JointFactors<__S: #facade::Scalar> = #factors;
                type JointVelocities<__S: #facade::Scalar> = [__S; #velocities];

                const JOINT_REPORT: #facade::JointReport = #report;

                fn prepare_joints<__S: #facade::Scalar>(
                    #given: &Self::Parameters<__S>,
                ) -> Self::JointConstants<__S> {
                    #constant_statements
                    [#(#constant_outputs),*]
                }

                #[inline]
                fn take_joint_inputs<__S: #facade::Scalar>(
                    #given: &Self::Parameters<__S>,
                    #constants: &mut Self::JointConstants<__S>,
                ) {
                    #taken
                }

                fn joint_coefficients<__S: #facade::Scalar>(
                    #constants: &Self::JointConstants<__S>,
                    #stabilisation: &#facade::Stabilisation<__S>,
                    #compliances: &Self::ClosingMultipliers<__S>,
                ) -> Self::JointCoefficients<__S> {
                    #coefficient_statements
                    [#(#coefficient_outputs),*]
                }

                #dispatch
                #solving
                #bodies
                #joints
                #coordinate_rates
            }

            #evaluations
            #solvers
            #parts
        }
    }

    fn line(&mut self, kernel: &Kernel, frame: &Frame) -> StraightLine {
        let turns = self.kernels.turns;
        let (line, parts) = write_in_parts(
            (&kernel.arena, &kernel.outputs),
            Stage::State,
            &Given::default(),
            &mut Arguments {
                store: &mut self.store,
                turns,
            },
            frame,
        );
        self.parts.extend(parts);
        line
    }

    fn unpack() -> TokenStream {
        let state = local("state");
        let (pairs, rest, rates) = (local("pairs"), local("rest"), local("velocities"));
        quote! {
            let #pairs = #state.pairs();
            let #rest = #state.rest();
            let #rates = #state.rates();
        }
    }

    fn arguments(&self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (constants, coefficients, state) =
            (local("constants"), local("coefficients"), local("state"));
        let time = local("time");
        quote! {
            #constants: &<#name as #facade::JointCoordinates>::JointConstants<__S>,
            #coefficients: &<#name as #facade::JointCoordinates>::JointCoefficients<__S>,
            #time: __S,
            #state: &<#name as #facade::JointCoordinates>::JointState<__S>,
        }
    }

    fn evaluation(&mut self, evaluation: &Evaluation) -> TokenStream {
        let (model, facade, kernels) = (&self.model.name, self.facade, self.kernels);
        let function = function(evaluation.terms);
        let arguments = self.arguments();
        let names = ["constants", "coefficients", "time", "state"].map(local);
        let frame = Frame {
            name: function.to_string(),
            facade: facade.clone(),
            declared: arguments.clone(),
            passed: quote!(#(#names,)*),
            unpack: Self::unpack(),
        };
        let StraightLine {
            statements,
            outputs,
        } = self.line(&evaluation.kernel, &frame);
        let (angles, others) = outputs.split_at(kernels.turns);
        let (coordinates, others) = others.split_at(kernels.rest);
        let (velocities, others) = others.split_at(kernels.velocities);
        let (multipliers, recorded) = others.split_at(kernels.rows.len());
        let pivot = verdict(facade, &evaluation.checks, recorded);
        let inline = inline(&evaluation.kernel.arena, &evaluation.kernel.outputs);
        let unpack = Self::unpack();
        let (rates, forces) = (local("rates"), local("multipliers"));
        let (generic, wanted) = if multipliers.is_empty() {
            (TokenStream::new(), TokenStream::new())
        } else {
            // What they alone need is then left out by the compiler.
            (
                quote!(, const __MULTIPLIERS: bool),
                quote!(if __MULTIPLIERS),
            )
        };
        quote! {
            #inline
            fn #function<__S: #facade::Scalar #generic>(
                #arguments
                #rates: &mut <#model as #facade::JointCoordinates>::JointState<__S>,
                #forces: &mut <#model as #facade::JointCoordinates>::ClosingMultipliers<__S>,
            ) -> #facade::Pivot<__S> {
                #unpack
                #statements
                *#rates = #facade::JointState::from_parts(
                    [#([#angles, __S::constant(0.0)]),*],
                    [#(#coordinates),*],
                    [#(#velocities),*],
                );
                #wanted {
                    *#forces = [#(#multipliers),*];
                }
                #pivot
            }
        }
    }

    fn dispatch(&self) -> TokenStream {
        let facade = self.facade;
        let names = [
            "constants",
            "coefficients",
            "time",
            "state",
            "rates",
            "multipliers",
        ];
        let [constants, coefficients, time, state, rates, multipliers] = names.map(local);
        let passed = quote!(#constants, #coefficients, #time, #state, #rates, #multipliers);
        let [plain, stabilised, compliant] = Terms::ALL.map(function);
        let has_rows = !self.kernels.rows.is_empty();
        let choice = |wanted: bool| {
            quote! {
                match (__T::STABILISED, __T::COMPLIANT) {
                    (_, true) => #compliant::<__S, #wanted>(#passed),
                    (true, false) => #stabilised::<__S, #wanted>(#passed),
                    (false, false) => #plain::<__S, #wanted>(#passed),
                }
            }
        };
        let body = if has_rows {
            choice(true)
        } else {
            quote!(#plain(#passed))
        };
        let rates_alone = has_rows.then(|| {
            let body = choice(false);
            let rows = self.kernels.rows.len();
            quote! {
                #[inline(always)]
                fn joint_rates_into<__S: #facade::Scalar, __T: #facade::Terms>(
                    #constants: &Self::JointConstants<__S>,
                    #coefficients: &Self::JointCoefficients<__S>,
                    #time: __S,
                    #state: &Self::JointState<__S>,
                    #rates: &mut Self::JointState<__S>,
                ) -> #facade::Pivot<__S> {
                    let #multipliers = &mut [__S::constant(0.0); #rows];
                    #body
                }
            }
        });
        quote! {
            #rates_alone

            #[inline(always)]
            fn evaluate_joints_into<__S: #facade::Scalar, __T: #facade::Terms>(
                #constants: &Self::JointConstants<__S>,
                #coefficients: &Self::JointCoefficients<__S>,
                #time: __S,
                #state: &Self::JointState<__S>,
                #rates: &mut Self::JointState<__S>,
                #multipliers: &mut Self::ClosingMultipliers<__S>,
            ) -> #facade::Pivot<__S> {
                #body
            }
        }
    }

    /// The rates of the coordinates alone, which a method needs that moves them by velocities of
    /// the end of a step.
    fn coordinate_rates(&mut self) -> TokenStream {
        let (name, facade, kernels) = (&self.model.name, self.facade, self.kernels);
        let [constants, time, state] = ["constants", "time", "state"].map(local);
        let [plain, ..] = &kernels.evaluations[..] else {
            unreachable!("there is an evaluation without stabilisation")
        };
        let kernel = Kernel {
            arena: plain.kernel.arena.clone(),
            outputs: plain.kernel.outputs[..kernels.turns + kernels.rest].to_vec(),
        };
        let unpack = Self::unpack();
        let frame = Frame {
            name: "__joint_coordinate_rates".into(),
            facade: facade.clone(),
            declared: quote! {
                #constants: &<#name as #facade::JointCoordinates>::JointConstants<__S>,
                #time: __S,
                #state: &<#name as #facade::JointCoordinates>::JointState<__S>,
            },
            passed: quote!(#constants, #time, #state,),
            unpack: unpack.clone(),
        };
        let StraightLine {
            statements,
            outputs,
        } = self.line(&kernel, &frame);
        let (angles, others) = outputs.split_at(kernels.turns);
        let velocities = kernels.velocities;
        quote! {
            #[inline]
            fn joint_coordinate_rates<__S: #facade::Scalar>(
                #constants: &Self::JointConstants<__S>,
                #time: __S,
                #state: &Self::JointState<__S>,
            ) -> Self::JointState<__S> {
                #unpack
                #statements
                #facade::JointState::from_parts(
                    [#([#angles, __S::constant(0.0)]),*],
                    [#(#others),*],
                    [__S::constant(0.0); #velocities],
                )
            }
        }
    }

    /// The arguments of a back-substitution.
    fn given(&self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let names = ["constants", "coefficients", "factors", "upper", "lower"];
        let [constants, coefficients, factors, upper, lower] = names.map(local);
        quote! {
            #constants: &<#name as #facade::JointCoordinates>::JointConstants<__S>,
            #coefficients: &<#name as #facade::JointCoordinates>::JointCoefficients<__S>,
            #factors: &<#name as #facade::JointCoordinates>::JointFactors<__S>,
            #upper: &<#name as #facade::Mechanism>::Velocities<__S>,
            #lower: &<#name as #facade::JointCoordinates>::ClosingMultipliers<__S>,
        }
    }

    /// Factorisation and back-substitution, and the number of values that pass between them.
    fn solver(&mut self, solver: &Solver) -> (TokenStream, usize) {
        let (name, facade) = (&self.model.name, self.facade);
        let (factor_name, solve_name) = (factor(solver.terms), solve(solver.terms));
        let Kernel { arena, outputs } = &solver.solution;
        let passed = ["constants", "coefficients", "factors", "upper", "lower"].map(local);
        let given = self.given();
        let mut back = BackSubstitution::new(&mut self.store);
        let (line, parts) = write_in_parts(
            (arena, outputs),
            Stage::RightHandSide,
            &Given::default(),
            &mut back,
            &Frame {
                name: solve_name.to_string(),
                facade: facade.clone(),
                declared: given.clone(),
                passed: quote!(#(#passed,)*),
                unpack: TokenStream::new(),
            },
        );
        let factors = Kernel {
            arena: arena.clone(),
            outputs: back.factors,
        };
        self.parts.extend(parts);
        let arguments = self.arguments();
        let names = ["constants", "coefficients", "time", "state"].map(local);
        let unpack = Self::unpack();
        let frame = Frame {
            name: factor_name.to_string(),
            facade: facade.clone(),
            declared: arguments.clone(),
            passed: quote!(#(#names,)*),
            unpack: unpack.clone(),
        };
        let factored = self.line(&factors, &frame);
        let packed = pack(&factored.outputs);
        let rows = 0..packed.len();
        let (factor_statements, solve_statements) = (factored.statements, line.statements);
        let (accelerations, multipliers) = line.outputs.split_at(self.kernels.velocities);
        let factors_name = local("factors");
        let tokens = quote! {
            #[inline(never)]
            fn #factor_name<__S: #facade::Scalar>(
                #arguments
            ) -> <#name as #facade::JointCoordinates>::JointFactors<__S> {
                #unpack
                #factor_statements
                let mut #factors_name: <#name as #facade::JointCoordinates>::JointFactors<__S> = [[__S::constant(0.0); #WIDTH]; _];
                #( #factors_name[#rows] = #packed; )*
                #factors_name
            }

            #[inline(never)]
            fn #solve_name<__S: #facade::Scalar>(
                #given
            ) -> (
                <#name as #facade::JointCoordinates>::JointVelocities<__S>,
                <#name as #facade::JointCoordinates>::ClosingMultipliers<__S>,
            ) {
                #solve_statements
                ([#(#accelerations),*], [#(#multipliers),*])
            }
        };
        (tokens, factors.outputs.len())
    }

    /// The choice among factorisations and back-substitutions.
    fn solving(&self) -> TokenStream {
        let facade = self.facade;
        let names = ["constants", "coefficients", "time", "state"];
        let [constants, coefficients, time, state] = names.map(local);
        let [factors, upper, lower] = ["factors", "upper", "lower"].map(local);
        let choose = |function: fn(Terms) -> Ident, passed: &TokenStream| {
            let [plain, compliant] = [Terms::Plain, Terms::Compliant].map(function);
            if self.kernels.rows.is_empty() {
                quote!(#plain(#passed))
            } else {
                quote! {
                    if __T::COMPLIANT {
                        #compliant(#passed)
                    } else {
                        #plain(#passed)
                    }
                }
            }
        };
        let factored = choose(factor, &quote!(#constants, #coefficients, #time, #state));
        let passed = quote!(#constants, #coefficients, #factors, #upper, #lower);
        let solved = choose(solve, &passed);
        quote! {
            #[inline(always)]
            fn factor_joints<__S: #facade::Scalar, __T: #facade::Terms>(
                #constants: &Self::JointConstants<__S>,
                #coefficients: &Self::JointCoefficients<__S>,
                #time: __S,
                #state: &Self::JointState<__S>,
            ) -> Self::JointFactors<__S> {
                #factored
            }

            #[inline(always)]
            fn solve_joints<__S: #facade::Scalar, __T: #facade::Terms>(
                #constants: &Self::JointConstants<__S>,
                #coefficients: &Self::JointCoefficients<__S>,
                #factors: &Self::JointFactors<__S>,
                #upper: &Self::Velocities<__S>,
                #lower: &Self::ClosingMultipliers<__S>,
            ) -> (Self::JointVelocities<__S>, Self::ClosingMultipliers<__S>) {
                #solved
            }
        }
    }

    fn bodies(&mut self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        let frame = Frame {
            name: "__body_motions".into(),
            facade: facade.clone(),
            declared: quote! {
                #constants: &<#name as #facade::JointCoordinates>::JointConstants<__S>,
                #state: &<#name as #facade::JointCoordinates>::JointState<__S>,
            },
            passed: quote!(#constants, #state,),
            unpack: unpack.clone(),
        };
        let kernels = self.kernels;
        let StraightLine {
            statements,
            outputs,
        } = self.line(&kernels.bodies, &frame);
        quote! {
            fn body_motions<__S: #facade::Scalar>(
                #constants: &Self::JointConstants<__S>,
                #state: &Self::JointState<__S>,
            ) -> Self::BodyMotions<__S> {
                #unpack
                #statements
                [#(#outputs),*]
            }
        }
    }

    fn joints(&mut self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (constants, state) = (local("constants"), local("state"));
        let (coordinates, velocities) = (local("coordinates"), local("velocities"));
        let unpack = quote! {
            let #coordinates = #state.coordinates();
            let #velocities = #state.velocities();
        };
        let frame = Frame {
            name: "__joint_state".into(),
            facade: facade.clone(),
            declared: quote! {
                #constants: &<#name as #facade::JointCoordinates>::JointConstants<__S>,
                #state: &<#name as #facade::Mechanism>::State<__S>,
            },
            passed: quote!(#constants, #state,),
            unpack: unpack.clone(),
        };
        let kernels = self.kernels;
        let (line, parts) = write_in_parts(
            (&kernels.joints.arena, &kernels.joints.outputs),
            Stage::State,
            &Given::default(),
            &mut super::store::Kernel {
                store: &mut self.store,
            },
            &frame,
        );
        self.parts.extend(parts);
        let StraightLine {
            statements,
            outputs,
        } = line;
        let (pairs, others) = outputs.split_at(2 * kernels.turns);
        let (rest, rates) = others.split_at(kernels.rest);
        let pairs = pairs.chunks(2).map(|pair| quote!([#(#pair),*]));
        quote! {
            fn joint_state<__S: #facade::Scalar>(
                #constants: &Self::JointConstants<__S>,
                #state: &Self::State<__S>,
            ) -> Self::JointState<__S> {
                #unpack
                #statements
                #facade::JointState::from_parts([#(#pairs),*], [#(#rest),*], [#(#rates),*])
            }
        }
    }
}

fn function(terms: Terms) -> Ident {
    format_ident!("__evaluate_joints_{}", name(terms))
}

fn factor(terms: Terms) -> Ident {
    format_ident!("__factor_joints_{}", name(terms))
}

fn solve(terms: Terms) -> Ident {
    format_ident!("__solve_joints_{}", name(terms))
}
