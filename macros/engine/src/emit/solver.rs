//! The solver of a mechanism, in either kind of coordinates: fused evaluations, factorisation and
//! back-substitution, and the choice among them.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::parts::{Frame, write_in_parts};
use super::rows::{WIDTH, array, pack};
use super::store::BackSubstitution;
use super::straight_line::StraightLine;
use super::writer::{Described, Writer, function};
use crate::plan::kernels::{PivotCheck, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Stage};
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// Operations up to which a kernel becomes part of its caller, which saves moving the results
/// twice.
const INLINE: usize = 300;

impl<K: Described> Writer<'_, K> {
    /// A fused evaluation.
    pub(super) fn evaluation(
        &mut self,
        function: &Ident,
        (kernel, checks): (&Kernel, &[PivotCheck]),
    ) -> TokenStream {
        let facade = self.facade;
        let arguments = self.arguments();
        let frame = self.frame(function.to_string(), arguments.clone(), Self::passed());
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(kernel, &frame);
        let places = self.kernels.multipliers();
        let rates_of_state = self.kernels.rates(facade, &outputs[..places.start]);
        let (multipliers, pivots) = (&outputs[places.clone()], &outputs[places.end..]);
        let pivot = verdict(facade, checks, pivots);
        let inline = inline(&kernel.arena, &kernel.outputs);
        let (rates, forces) = (local("rates"), local("multipliers"));
        let results = self.results();
        let unpack = K::unpack();
        let mut generic = TokenStream::new();
        let mut written = quote!(*#forces = [#(#multipliers),*];);
        if self.kernels.omits_multipliers() {
            // What they alone need is then left out by the compiler.
            generic = quote!(, const __MULTIPLIERS: bool);
            written = quote!(if __MULTIPLIERS { #written });
        }
        quote! {
            #inline
            fn #function<__S: #facade::Scalar #generic>(#arguments #results) -> #facade::__private::Pivot<__S> {
                #unpack
                #statements
                *#rates = #rates_of_state;
                #written
                #pivot
            }
        }
    }

    /// Factorisations and back-substitutions, and the array that passes between them.
    pub(super) fn solvers(&mut self) -> (TokenStream, TokenStream) {
        let mut solvers = TokenStream::new();
        let mut most = 0;
        let kernels = self.kernels;
        for solver in kernels.solvers() {
            let (tokens, factors) = self.solver(solver);
            solvers.extend(tokens);
            most = most.max(factors);
        }
        (solvers, array(most))
    }

    /// Factorisation and back-substitution, and the number of values that pass between them.
    fn solver(&mut self, solver: &Solver) -> (TokenStream, usize) {
        let (name, facade) = (&self.model.name, self.facade);
        let factor_name = function::<K>("factor", solver.terms);
        let solve_name = function::<K>("solve", solver.terms);
        let names = ["constants", "coefficients", "factors", "upper", "lower"];
        let names = names.map(local);
        let [constants, coefficients, factors, upper, lower] = &names;
        let [
            _,
            of_constants,
            of_coefficients,
            of_factors,
            of_velocities,
            of_multipliers,
        ] = self.types_outside();
        let given = quote! {
            #constants: &#of_constants,
            #coefficients: &#of_coefficients,
            #factors: &#of_factors,
            #upper: &<#name as #facade::Mechanism>::Velocities<__S>,
            #lower: &#of_multipliers,
        };
        let mut back = BackSubstitution::new(&mut self.store);
        let (solved, parts) = write_in_parts(
            (&solver.arena, &solver.solution),
            Stage::RightHandSide,
            &mut back,
            &Frame {
                name: solve_name.to_string(),
                facade: facade.clone(),
                declared: given.clone(),
                passed: quote!(#(#names,)*),
                unpack: TokenStream::new(),
            },
        );
        let handed_on = back.factors;
        self.parts.extend(parts);
        let kernel = Kernel {
            arena: solver.arena.clone(),
            outputs: [&handed_on[..], &solver.pivots].concat(),
        };
        let arguments = self.arguments();
        let frame = self.frame(factor_name.to_string(), arguments.clone(), Self::passed());
        let factored = self.line_of(&kernel, &frame);
        let (values, pivots) = factored.outputs.split_at(handed_on.len());
        let pivot = verdict(facade, &solver.checks, pivots);
        let (accelerations, multipliers) = solved.outputs.split_at(self.kernels.velocities());
        let (factor_statements, solve_statements) = (factored.statements, solved.statements);
        let never = quote!(#[inline(never)]);
        let (inline_factor, inline_solve) = if K::IS_JUDGED {
            (
                inline(&solver.arena, &kernel.outputs),
                inline(&solver.arena, &solver.solution),
            )
        } else {
            (never.clone(), never)
        };
        let (kind, result) = judged::<K>(facade, &of_factors, &quote!(#factors), &pivot);
        let packed = pack(values);
        let rows = 0..packed.len();
        let unpack = K::unpack();
        let tokens = quote! {
            #inline_factor
            fn #factor_name<__S: #facade::Scalar>(#arguments) -> #kind {
                #unpack
                #factor_statements
                let mut #factors: #of_factors = [[__S::constant(0.0); #WIDTH]; _];
                #( #factors[#rows] = #packed; )*
                #result
            }

            #inline_solve
            fn #solve_name<__S: #facade::Scalar>(#given) -> (#of_velocities, #of_multipliers,) {
                #solve_statements
                ([#(#accelerations),*], [#(#multipliers),*])
            }
        };
        (tokens, handed_on.len())
    }

    /// The choice among factorisations and back-substitutions.
    pub(super) fn solving(&self) -> TokenStream {
        let facade = self.facade;
        let names = ["constants", "coefficients", "time", "state"];
        let [constants, coefficients, time, state] = names.map(local);
        let [factors, upper, lower] = ["factors", "upper", "lower"].map(local);
        let has_choice = self.kernels.solvers().len() > 1;
        let choose = |verb: &str, passed: &TokenStream| {
            let [plain, compliant] =
                [Terms::Plain, Terms::Compliant].map(|terms| function::<K>(verb, terms));
            if has_choice {
                quote! {
                    if __T::COMPLIANT {
                        #compliant(#passed)
                    } else {
                        #plain(#passed)
                    }
                }
            } else {
                quote!(#plain(#passed))
            }
        };
        let factored = choose("factor", &quote!(#constants, #coefficients, #time, #state));
        let solved = choose(
            "solve",
            &quote!(#constants, #coefficients, #factors, #upper, #lower),
        );
        let [
            of_state,
            of_constants,
            of_coefficients,
            of_factors,
            of_velocities,
            of_multipliers,
        ] = K::TYPES.map(|kind| {
            let kind = format_ident!("{kind}");
            quote!(Self::#kind<__S>)
        });
        let [factor, solve] = ["factor", "solve"].map(|verb| format_ident!("{verb}{}", K::SUFFIX));
        let (kind, _) = judged::<K>(facade, &of_factors, &factored, &factored);
        quote! {
            #[inline(always)]
            fn #factor<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &#of_constants,
                #coefficients: &#of_coefficients,
                #time: __S,
                #state: &#of_state,
            ) -> #kind {
                #factored
            }

            #[inline(always)]
            fn #solve<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &#of_constants,
                #coefficients: &#of_coefficients,
                #factors: &#of_factors,
                #upper: &Self::Velocities<__S>,
                #lower: &#of_multipliers,
            ) -> (#of_velocities, #of_multipliers) {
                #solved
            }
        }
    }
}

/// The type and the value of a factorisation: factors, and beside them the verdict on the pivots
/// where there is one.
fn judged<K: Described>(
    facade: &TokenStream,
    of_factors: &TokenStream,
    factors: &TokenStream,
    pivot: &TokenStream,
) -> (TokenStream, TokenStream) {
    if K::IS_JUDGED {
        (
            quote!((#of_factors, #facade::__private::Pivot<__S>)),
            quote!((#factors, #pivot)),
        )
    } else {
        (of_factors.clone(), factors.clone())
    }
}

fn inline(arena: &Arena, outputs: &[Expr]) -> TokenStream {
    if is_short(arena, outputs) {
        quote!(#[inline(always)])
    } else {
        quote!(#[inline(never)])
    }
}

/// Whether a kernel is so short that a call of it costs.
pub(super) fn is_short(arena: &Arena, outputs: &[Expr]) -> bool {
    crate::symbolic::count::count(arena, outputs, Stage::State).total() <= INLINE
}

/// The verdict on recorded pivots.
fn verdict(facade: &TokenStream, checks: &[PivotCheck], values: &[TokenStream]) -> TokenStream {
    let mut pivot = quote!(#facade::__private::Pivot::unchecked());
    for (check, value) in checks.iter().zip(values) {
        pivot = match check {
            PivotCheck::Relative(joint) => quote!(#pivot.and(__S::abs(#value), #joint)),
            PivotCheck::Nonzero(joint) => quote!(#pivot.and_nonzero(#value, #joint)),
        };
    }
    pivot
}
