//! The kernels that solve: the fused evaluations, factorisation and back-substitution.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::parts::{Frame, write_in_parts};
use super::rows::{WIDTH, pack};
use super::store::BackSubstitution;
use super::straight_line::{Given, StraightLine};
use super::writer::Writer;
use crate::plan::kernels::{Evaluation, PivotCheck, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Stage};
use crate::symbolic::equations::Kernel;
use crate::symbolic::scene::Normalisation;
use crate::syntax::words::local;

/// Operations up to which a kernel becomes part of its caller, which saves moving the results
/// twice.
const INLINE: usize = 300;
/// Operations up to which an evaluation is written for each normalisation of Euler parameters:
/// matrices need not pass through memory.
const SHARED: usize = 3000;
/// The entries of a rotation matrix.
const ENTRIES: usize = 9;

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

    /// Where an evaluation writes its results.
    fn results(&self) -> TokenStream {
        let (name, facade) = (&self.model.name, self.facade);
        let (rates, multipliers) = (local("rates"), local("multipliers"));
        quote! {
            #rates: &mut <#name as #facade::Mechanism>::State<__S>,
            #multipliers: &mut <#name as #facade::Mechanism>::Multipliers<__S>,
        }
    }

    /// The names of the arguments.
    fn passed() -> TokenStream {
        let names = ["constants", "coefficients", "time", "state"].map(local);
        quote!(#(#names,)*)
    }

    /// The fused evaluations. Where they are long, both normalisations of Euler parameters call one
    /// function of the rotation matrices: [`Evaluation::normalised`] made the second so.
    pub(super) fn evaluations(&mut self) -> TokenStream {
        if self.kernels.evaluations.is_empty() {
            return TokenStream::new();
        }
        let (raw, normalised) = self.kernels.evaluations.split_at(Terms::ALL.len());
        let operations = |evaluation: &Evaluation| {
            let Kernel { arena, outputs } = &evaluation.kernel;
            arena.live(outputs, Stage::State).len()
        };
        let mut tokens = TokenStream::new();
        let mut matrices = None;
        for pair in raw.iter().zip(normalised) {
            let (raw, normalised) = pair;
            if operations(raw) <= SHARED {
                tokens.extend(self.evaluation(raw, None));
                tokens.extend(self.evaluation(normalised, None));
                continue;
            }
            tokens.extend(self.by_rotations(raw));
            tokens.extend(self.by_rotations(normalised));
            tokens.extend(self.evaluation(raw, Some(&raw.rotations)));
            matrices.get_or_insert(pair);
        }
        if let Some((raw, normalised)) = matrices {
            tokens.extend(self.rotations(raw));
            tokens.extend(self.rotations(normalised));
        }
        tokens
    }

    /// The rotation matrices of one normalisation.
    fn rotations(&mut self, evaluation: &Evaluation) -> TokenStream {
        let facade = self.facade;
        let function = rotations_function(evaluation.normalisation);
        let bodies = evaluation.rotations.len() / ENTRIES;
        let frame = Frame {
            name: function.to_string(),
            facade: facade.clone(),
            declared: self.arguments(),
            passed: Self::passed(),
            unpack: Self::unpack(),
        };
        let kernel = Kernel {
            arena: evaluation.kernel.arena.clone(),
            outputs: evaluation
                .rotations
                .iter()
                .map(|entry| entry.abs())
                .collect(),
        };
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&kernel, &Given::default(), &frame);
        let (arguments, unpack) = (self.arguments(), Self::unpack());
        let matrices = outputs
            .chunks(ENTRIES)
            .map(|entries| quote!([#(#entries),*]));
        quote! {
            #[inline(never)]
            fn #function<__S: #facade::Scalar>(#arguments) -> [[__S; #ENTRIES]; #bodies] {
                #unpack
                #statements
                [#(#matrices),*]
            }
        }
    }

    /// An evaluation that is a function of the rotation matrices.
    fn by_rotations(&self, evaluation: &Evaluation) -> TokenStream {
        let facade = self.facade;
        let function = evaluation_function(evaluation.terms, evaluation.normalisation);
        let of_rotations = of_rotations(evaluation.terms);
        let rotations = rotations_function(evaluation.normalisation);
        let (arguments, passed) = (self.arguments(), Self::passed());
        let (rates, multipliers) = (local("rates"), local("multipliers"));
        let results = self.results();
        quote! {
            #[inline]
            fn #function<__S: #facade::Scalar>(#arguments #results) -> #facade::Pivot<__S> {
                #of_rotations(#passed &#rotations(#passed), #rates, #multipliers)
            }
        }
    }

    /// An evaluation; as a function of rotation matrices, if these are given.
    fn evaluation(&mut self, evaluation: &Evaluation, given: Option<&[Expr]>) -> TokenStream {
        let facade = self.facade;
        let layout = self.model.layout();
        let mut function = evaluation_function(evaluation.terms, evaluation.normalisation);
        let (mut arguments, mut passed) = (self.arguments(), Self::passed());
        let mut elements = Given::default();
        if let Some(rotations) = given {
            let (array, bodies) = (local("rotations"), rotations.len() / ENTRIES);
            function = of_rotations(evaluation.terms);
            arguments.extend(quote!(#array: &[[__S; #ENTRIES]; #bodies],));
            passed.extend(quote!(#array,));
            elements = Given::rows(rotations, ENTRIES, "rotations");
        }
        let frame = Frame {
            name: function.to_string(),
            facade: facade.clone(),
            declared: arguments.clone(),
            passed,
            unpack: Self::unpack(),
        };
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&evaluation.kernel, &elements, &frame);
        let (coordinates, rest) = outputs.split_at(layout.coordinates + layout.auxiliaries);
        let (velocities, rest) = rest.split_at(layout.velocities);
        let (multipliers, pivots) = rest.split_at(layout.rows);
        let pivot = verdict(facade, &evaluation.checks, pivots);
        let unpack = Self::unpack();
        let inline = inline(&evaluation.kernel.arena, &evaluation.kernel.outputs);
        let (rates, forces) = (local("rates"), local("multipliers"));
        let results = self.results();
        quote! {
            #inline
            fn #function<__S: #facade::Scalar>(#arguments #results) -> #facade::Pivot<__S> {
                #unpack
                #statements
                *#rates = #facade::State::from_parts([#(#coordinates),*], [#(#velocities),*]);
                *#forces = [#(#multipliers),*];
                #pivot
            }
        }
    }

    pub(super) fn dispatch(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, coefficients, state) =
            (local("constants"), local("coefficients"), local("state"));
        let (factors, upper, lower) = (local("factors"), local("upper"), local("lower"));
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
                #facade::__private::evaluate_in_parts::<__S, Self, __T, __P>(
                    #constants, #coefficients, [#(#outputs),*], #time, #state, #rates, #multipliers,
                )
            }
        });
        let arms = self.kernels.evaluations.iter().map(|evaluation| {
            let (stabilised, compliant) = match evaluation.terms {
                Terms::Plain => (quote!(false), quote!(false)),
                Terms::Stabilised => (quote!(true), quote!(false)),
                Terms::Compliant => (quote!(_), quote!(true)),
            };
            let normalised = evaluation.normalisation == Normalisation::Normalised;
            let function = evaluation_function(evaluation.terms, evaluation.normalisation);
            quote! {
                (#normalised, #stabilised, #compliant) => #function(#constants, #coefficients, #time, #state, #rates, #multipliers),
            }
        });
        let evaluate = evaluate.unwrap_or_else(|| {
            quote! {
                match (__P::NORMALISED, __T::STABILISED, __T::COMPLIANT) {
                    #(#arms)*
                }
            }
        });
        quote! {
            #[inline(always)]
            fn evaluate_into<__S: #facade::Scalar, __T: #facade::Terms, __P: #facade::Orientation>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
                #rates: &mut Self::State<__S>,
                #multipliers: &mut Self::Multipliers<__S>,
            ) -> #facade::Pivot<__S> {
                #evaluate
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
        let given_to_solve = quote! {
            #constants: &<#name as #facade::Mechanism>::Constants<__S>,
            #coefficients: &<#name as #facade::Mechanism>::Coefficients<__S>,
            #factors_name: &<#name as #facade::Mechanism>::Factors<__S>,
            #upper: &<#name as #facade::Mechanism>::Velocities<__S>,
            #lower: &<#name as #facade::Mechanism>::Multipliers<__S>,
        };
        let mut back = BackSubstitution::new(&mut self.store);
        let (solve, parts) = write_in_parts(
            (&solver.arena, &solver.solution),
            Stage::RightHandSide,
            &Given::default(),
            &mut back,
            &Frame {
                name: solve_name.to_string(),
                facade: facade.clone(),
                declared: given_to_solve.clone(),
                passed: quote!(#constants, #coefficients, #factors_name, #upper, #lower,),
                unpack: TokenStream::new(),
            },
        );
        let factors = back.factors;
        self.parts.extend(parts);
        let mut outputs = factors.clone();
        outputs.extend(&solver.pivots);
        let frame = Frame {
            name: factor_name.to_string(),
            facade: facade.clone(),
            declared: arguments.clone(),
            passed: Self::passed(),
            unpack: unpack.clone(),
        };
        let kernel = Kernel {
            arena: solver.arena.clone(),
            outputs: outputs.clone(),
        };
        let factor = self.line_of(&kernel, &Given::default(), &frame);
        let (values, pivots) = factor.outputs.split_at(factors.len());
        let pivot = verdict(facade, &solver.checks, pivots);
        let (accelerations, multipliers) = solve.outputs.split_at(self.model.layout().velocities);
        let (factor_statements, solve_statements) = (factor.statements, solve.statements);
        let inline_factor = inline(&solver.arena, &outputs);
        let inline_solve = inline(&solver.arena, &solver.solution);
        let packed = pack(values);
        let rows = 0..packed.len();
        let tokens = quote! {
            #inline_factor
            fn #factor_name<__S: #facade::Scalar>(
                #arguments
            ) -> (<#name as #facade::Mechanism>::Factors<__S>, #facade::Pivot<__S>) {
                #unpack
                #factor_statements
                let mut #factors_name: <#name as #facade::Mechanism>::Factors<__S> = [[__S::constant(0.0); #WIDTH]; _];
                #( #factors_name[#rows] = #packed; )*
                (#factors_name, #pivot)
            }

            #inline_solve
            fn #solve_name<__S: #facade::Scalar>(
                #given_to_solve
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

fn rotations_function(normalisation: Normalisation) -> Ident {
    match normalisation {
        Normalisation::Raw => format_ident!("__rotations"),
        Normalisation::Normalised => format_ident!("__rotations_normalised"),
    }
}

fn of_rotations(terms: Terms) -> Ident {
    format_ident!("__evaluate_{}_of_rotations", name(terms))
}

pub(super) fn name(terms: Terms) -> &'static str {
    match terms {
        Terms::Plain => "plain",
        Terms::Stabilised => "stabilised",
        Terms::Compliant => "compliant",
    }
}

fn evaluation_function(terms: Terms, normalisation: Normalisation) -> Ident {
    let terms = name(terms);
    match normalisation {
        Normalisation::Raw => format_ident!("__evaluate_{terms}"),
        Normalisation::Normalised => format_ident!("__evaluate_{terms}_normalised"),
    }
}

pub(super) fn inline(arena: &Arena, outputs: &[Expr]) -> TokenStream {
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
pub(super) fn verdict(
    facade: &TokenStream,
    checks: &[PivotCheck],
    values: &[TokenStream],
) -> TokenStream {
    let mut pivot = quote!(#facade::Pivot::unchecked());
    for (check, value) in checks.iter().zip(values) {
        pivot = match check {
            PivotCheck::Relative(joint) => quote!(#pivot.and(__S::abs(#value), #joint)),
            PivotCheck::Nonzero(joint) => quote!(#pivot.and_nonzero(#value, #joint)),
        };
    }
    pivot
}
