//! The kernels that solve: the fused evaluations, factorisation and back-substitution.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::local;
use super::mechanism::Writer;
use super::store::BackSubstitution;
use super::straight_line::{StraightLine, write};
use crate::plan::kernels::{Evaluation, Kernel, PivotCheck, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Stage};
use crate::symbolic::scene::Reading;

/// Operations up to which a kernel becomes part of its caller, which saves moving the results twice.
const INLINE: usize = 300;

impl Writer<'_> {
    fn arguments(&self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (constants, coefficients, state) =
            (local("constants"), local("coefficients"), local("state"));
        let time = local("time");
        quote! {
            #constants: &<#name as #facade::Mechanism>::Constants<__S>,
            #coefficients: &<#name as #facade::Mechanism>::Coefficients<__S>,
            #time: __S,
            #state: &<#name as #facade::Mechanism>::State<__S>,
        }
    }

    fn pivots(&self, checks: &[PivotCheck], values: &[TokenStream]) -> TokenStream {
        let facade = self.facade;
        let mut pivot = quote!(#facade::Pivot::unchecked());
        for (check, value) in checks.iter().zip(values) {
            pivot = match check {
                PivotCheck::Relative(joint) => quote!(#pivot.and(__S::abs(#value), #joint)),
                PivotCheck::Nonzero(joint) => quote!(#pivot.and_nonzero(#value, #joint)),
            };
        }
        pivot
    }

    pub(super) fn evaluation(&mut self, evaluation: &Evaluation) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let layout = self.model.layout();
        let StraightLine {
            statements,
            outputs,
        } = self.line(&evaluation.kernel);
        let (coordinates, rest) = outputs.split_at(layout.coordinates + layout.auxiliaries);
        let (velocities, rest) = rest.split_at(layout.velocities);
        let (multipliers, pivots) = rest.split_at(layout.rows);
        let pivot = self.pivots(&evaluation.checks, pivots);
        let function = evaluation_function(evaluation.terms, evaluation.reading);
        let unpack = Self::unpack();
        let inline = inline(&evaluation.kernel.arena, &evaluation.kernel.outputs);
        let arguments = self.arguments();
        quote! {
            #inline
            fn #function<__S: #facade::Scalar>(#arguments) -> #facade::Evaluation<__S, #name> {
                #unpack
                #statements
                #facade::Evaluation {
                    rates: #facade::State::from_parts([#(#coordinates),*], [#(#velocities),*]),
                    multipliers: [#(#multipliers),*],
                    pivot: #pivot,
                }
            }
        }
    }

    pub(super) fn dispatch(&self) -> TokenStream {
        let facade = self.facade;
        let (constants, coefficients, state) =
            (local("constants"), local("coefficients"), local("state"));
        let (factors, upper, lower) = (local("factors"), local("upper"), local("lower"));
        let time = local("time");
        let arms = self.kernels.evaluations.iter().map(|evaluation| {
            let (stabilised, compliant) = match evaluation.terms {
                Terms::Plain => (quote!(false), quote!(false)),
                Terms::Stabilised => (quote!(true), quote!(false)),
                Terms::Compliant => (quote!(_), quote!(true)),
            };
            let normalised = evaluation.reading == Reading::Normalised;
            let function = evaluation_function(evaluation.terms, evaluation.reading);
            quote!((#normalised, #stabilised, #compliant) => #function(#constants, #coefficients, #time, #state),)
        });
        quote! {
            #[inline(always)]
            fn evaluate<__S: #facade::Scalar, __T: #facade::Terms, __P: #facade::Orientation>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
            ) -> #facade::Evaluation<__S, Self> {
                match (__P::NORMALISED, __T::STABILISED, __T::COMPLIANT) {
                    #(#arms)*
                }
            }

            #[inline(always)]
            fn factor<__S: #facade::Scalar, __T: #facade::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
            ) -> (Self::Factors<__S>, #facade::Pivot<__S>) {
                if __T::COMPLIANT {
                    __factor_compliant(#constants, #coefficients, #time, #state)
                } else {
                    __factor_plain(#constants, #coefficients, #time, #state)
                }
            }

            #[inline(always)]
            fn solve<__S: #facade::Scalar, __T: #facade::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #factors: &Self::Factors<__S>,
                #upper: &Self::Velocities<__S>,
                #lower: &Self::Multipliers<__S>,
            ) -> (Self::Velocities<__S>, Self::Multipliers<__S>) {
                if __T::COMPLIANT {
                    __solve_compliant(#constants, #coefficients, #factors, #upper, #lower)
                } else {
                    __solve_plain(#constants, #coefficients, #factors, #upper, #lower)
                }
            }
        }
    }

    /// Factorisation and back-substitution, and the number of values that pass between them.
    pub(super) fn solver(&mut self, solver: &Solver) -> (TokenStream, usize) {
        let (name, facade) = (&self.model.name, self.facade);
        let mut back = BackSubstitution {
            store: &mut self.store,
            factors: Vec::new(),
        };
        let solve = write(
            &solver.arena,
            &solver.solution,
            Stage::RightHandSide,
            &mut back,
        );
        let factors = back.factors;
        let mut outputs = factors.clone();
        outputs.extend(&solver.pivots);
        let factor = self.line(&Kernel {
            arena: solver.arena.clone(),
            outputs: outputs.clone(),
        });
        let (values, pivots) = factor.outputs.split_at(factors.len());
        let pivot = self.pivots(&solver.checks, pivots);
        let (accelerations, multipliers) = solve.outputs.split_at(self.model.layout().velocities);
        let suffix = if solver.terms == Terms::Compliant {
            "compliant"
        } else {
            "plain"
        };
        let (factor_name, solve_name) = (
            format_ident!("__factor_{suffix}"),
            format_ident!("__solve_{suffix}"),
        );
        let unpack = Self::unpack();
        let arguments = self.arguments();
        let (constants, coefficients) = (local("constants"), local("coefficients"));
        let (factors_name, upper, lower) = (local("factors"), local("upper"), local("lower"));
        let (factor_statements, solve_statements) = (factor.statements, solve.statements);
        let inline_factor = inline(&solver.arena, &outputs);
        let inline_solve = inline(&solver.arena, &solver.solution);
        let places = 0..factors.len();
        let tokens = quote! {
            #inline_factor
            fn #factor_name<__S: #facade::Scalar>(
                #arguments
            ) -> (<#name as #facade::Mechanism>::Factors<__S>, #facade::Pivot<__S>) {
                #unpack
                #factor_statements
                let mut #factors_name: <#name as #facade::Mechanism>::Factors<__S> = #facade::Array::zeros();
                #( #factors_name[#places] = #values; )*
                (#factors_name, #pivot)
            }

            #inline_solve
            fn #solve_name<__S: #facade::Scalar>(
                #constants: &<#name as #facade::Mechanism>::Constants<__S>,
                #coefficients: &<#name as #facade::Mechanism>::Coefficients<__S>,
                #factors_name: &<#name as #facade::Mechanism>::Factors<__S>,
                #upper: &<#name as #facade::Mechanism>::Velocities<__S>,
                #lower: &<#name as #facade::Mechanism>::Multipliers<__S>,
            ) -> (
                <#name as #facade::Mechanism>::Velocities<__S>,
                <#name as #facade::Mechanism>::Multipliers<__S>,
            ) {
                #solve_statements
                ([#(#accelerations),*], [#(#multipliers),*])
            }
        };
        (tokens, factors.len())
    }
}

fn evaluation_function(terms: Terms, reading: Reading) -> proc_macro2::Ident {
    let terms = match terms {
        Terms::Plain => "plain",
        Terms::Stabilised => "stabilised",
        Terms::Compliant => "compliant",
    };
    match reading {
        Reading::Raw => format_ident!("__evaluate_{terms}"),
        Reading::Normalised => format_ident!("__evaluate_{terms}_normalised"),
    }
}

fn inline(arena: &Arena, outputs: &[Expr]) -> TokenStream {
    let operations = crate::symbolic::count::count(arena, outputs, Stage::State).total();
    if operations <= INLINE {
        quote!(#[inline(always)])
    } else {
        quote!(#[inline(never)])
    }
}
