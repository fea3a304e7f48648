//! The solver in absolute coordinates: its evaluations.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::quote;

use super::store::{Kernel as Arguments, Store};
use super::straight_line::{Environment, StraightLine, write};
use super::writer::{Described, Writer, function};
use crate::plan::derivatives::RateColumns;
use crate::plan::kernels::{Kernels, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

impl Described for Kernels {
    const IMPLEMENTED: &'static str = "Mechanism";
    const TYPES: [&'static str; 6] = [
        "State",
        "Constants",
        "Coefficients",
        "Factors",
        "Velocities",
        "Multipliers",
    ];
    const SUFFIX: &'static str = "";
    const IS_JUDGED: bool = true;

    fn unpack() -> TokenStream {
        let (state, coordinates, velocities) =
            (local("state"), local("coordinates"), local("velocities"));
        quote! {
            let #coordinates = #state.coordinates();
            let #velocities = #state.velocities();
        }
    }

    fn environment<'a>(&self, store: &'a mut Store) -> impl Environment + 'a {
        Arguments { store }
    }

    fn rates(&self, facade: &TokenStream, outputs: &[TokenStream]) -> TokenStream {
        let (coordinates, velocities) = outputs.split_at(outputs.len() - self.velocities());
        quote!(#facade::__private::State::of_parts([#(#coordinates),*], [#(#velocities),*]))
    }

    fn multipliers(&self) -> Range<usize> {
        let first = self.coordinate_rates.outputs.len() + self.velocities();
        first..first + self.constraints.outputs.len()
    }

    fn omits_multipliers(&self) -> bool {
        false
    }

    fn velocities(&self) -> usize {
        self.mass.outputs.len()
    }

    fn solvers(&self) -> &[Solver] {
        &self.solvers
    }
}

impl Writer<'_> {
    /// A short kernel.
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

    /// The fused evaluations.
    pub(super) fn evaluations(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let evaluations = kernels.evaluations.iter().map(|evaluation| {
            let function = function::<Kernels>("evaluate", evaluation.terms);
            self.evaluation(&function, (&evaluation.kernel, &evaluation.checks))
        });
        evaluations.collect()
    }

    /// The derivatives of their rates.
    pub(super) fn rate_columns(&mut self) -> TokenStream {
        let (facade, kernels) = (self.facade, self.kernels);
        let (put, arguments, unpack) = (local("put"), self.arguments(), Self::unpack());
        let [of_state, ..] = self.types_outside();
        let length = self.model.layout().stored() + kernels.velocities();
        let columns = kernels
            .rate_columns
            .iter()
            .map(|RateColumns { terms, kernel }| {
                let function = function::<Kernels>("rate_columns", *terms);
                let frame = self.frame(function.to_string(), arguments.clone(), Self::passed());
                let StraightLine {
                    statements,
                    outputs,
                } = self.line_of(kernel, &frame);
                let columns = outputs.chunks(length).enumerate();
                let columns = columns.map(|(place, column)| {
                    let column = kernels.rates(facade, column);
                    quote!(#put(#place, #column);)
                });
                quote! {
                    fn #function<__S: #facade::Scalar>(
                        #arguments
                        mut #put: impl ::core::ops::FnMut(usize, #of_state),
                    ) {
                        #unpack
                        #statements
                        #(#columns)*
                    }
                }
            });
        columns.collect()
    }

    /// The choice among these.
    pub(super) fn choice_of_columns(&self) -> TokenStream {
        let facade = self.facade;
        let columns = &self.kernels.rate_columns;
        if columns.is_empty() {
            return TokenStream::new();
        }
        let put = local("put");
        let names = ["constants", "coefficients", "time", "state"];
        let [constants, coefficients, time, state] = names.map(local);
        let arms = columns.iter().map(|RateColumns { terms, .. }| {
            let pattern = pattern(*terms);
            let function = function::<Kernels>("rate_columns", *terms);
            quote!(#pattern => #function(#constants, #coefficients, #time, #state, #put),)
        });
        quote! {
            const HAS_RATE_COLUMNS: bool = true;

            fn rate_columns<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #put: impl ::core::ops::FnMut(usize, Self::State<__S>),
            ) {
                match (__T::STABILISED, __T::COMPLIANT) {
                    #(#arms)*
                }
            }
        }
    }

    pub(super) fn dispatch(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, coefficients, state) =
            (local("constants"), local("coefficients"), local("state"));
        let (rates, multipliers) = (local("rates"), local("multipliers"));
        let time = local("time");
        let kernels = self.kernels;
        let evaluate = kernels.gains.as_ref().map(|gains| {
            let StraightLine {
                statements,
                outputs,
            } = self.line(gains);
            quote! {
                #statements
                #facade::__private::evaluate_in_parts::<__S, Self, __T>(
                    #constants, #coefficients, [#(#outputs),*], #time, #state, #rates, #multipliers,
                )
            }
        });
        let arms = self.kernels.evaluations.iter().map(|evaluation| {
            let pattern = pattern(evaluation.terms);
            let function = function::<Kernels>("evaluate", evaluation.terms);
            quote! {
                #pattern => #function(#constants, #coefficients, #time, #state, #rates, #multipliers),
            }
        });
        let evaluate = evaluate.unwrap_or_else(|| {
            quote! {
                match (__T::STABILISED, __T::COMPLIANT) {
                    #(#arms)*
                }
            }
        });
        quote! {
            #[inline(always)]
            fn evaluate_into<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #rates: &mut Self::State<__S>,
                #multipliers: &mut Self::Multipliers<__S>,
            ) -> #facade::__private::Pivot<__S> {
                #evaluate
            }
        }
    }
}

/// Which formulations have these terms: whether constraints are stabilised, and whether they yield.
fn pattern(terms: Terms) -> TokenStream {
    match terms {
        Terms::Plain => quote!((false, false)),
        Terms::Stabilised => quote!((true, false)),
        Terms::Compliant => quote!((_, true)),
    }
}
