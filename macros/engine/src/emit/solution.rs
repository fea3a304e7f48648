//! The solver in absolute coordinates: its evaluations for both normalisations of Euler parameters.

use std::ops::Range;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::solver::OfRotations;
use super::store::{Kernel as Arguments, Store};
use super::straight_line::{Environment, Given, StraightLine, write};
use super::writer::{Described, Writer, function, name};
use crate::plan::kernels::{Evaluation, Kernels, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::symbolic::scene::Normalisation;
use crate::syntax::words::local;

/// Operations up to which an evaluation is written for each normalisation of Euler parameters:
/// matrices need not pass through memory.
const SHARED: usize = 3000;
/// The entries of a rotation matrix.
const ENTRIES: usize = 9;

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
        quote!(#facade::__private::State::from_parts([#(#coordinates),*], [#(#velocities),*]))
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
                tokens.extend(self.one_evaluation(raw));
                tokens.extend(self.one_evaluation(normalised));
                continue;
            }
            tokens.extend(self.by_rotations(raw));
            tokens.extend(self.by_rotations(normalised));
            tokens.extend(self.of_rotations(raw));
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
        let frame = self.frame(function.to_string(), self.arguments(), Self::passed());
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
            fn #function<__S: #facade::Scalar>(#arguments #results) -> #facade::__private::Pivot<__S> {
                #of_rotations(#passed &#rotations(#passed), #rates, #multipliers)
            }
        }
    }

    /// An evaluation for one normalisation.
    fn one_evaluation(&mut self, evaluation: &Evaluation) -> TokenStream {
        let function = evaluation_function(evaluation.terms, evaluation.normalisation);
        self.evaluation(&function, (&evaluation.kernel, &evaluation.checks), None)
    }

    /// An evaluation as a function of the rotation matrices, for both normalisations.
    fn of_rotations(&mut self, evaluation: &Evaluation) -> TokenStream {
        let (array, bodies) = (local("rotations"), evaluation.rotations.len() / ENTRIES);
        let given = Given::rows(&evaluation.rotations, ENTRIES, "rotations");
        let function = of_rotations(evaluation.terms);
        let rotations = OfRotations {
            declared: quote!(#array: &[[__S; #ENTRIES]; #bodies],),
            passed: quote!(#array,),
            given,
        };
        self.evaluation(
            &function,
            (&evaluation.kernel, &evaluation.checks),
            Some(rotations),
        )
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
            fn evaluate_into<__S: #facade::Scalar, __T: #facade::__private::Terms, __P: #facade::__private::Orientation>(
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

fn rotations_function(normalisation: Normalisation) -> Ident {
    match normalisation {
        Normalisation::Raw => format_ident!("__rotations"),
        Normalisation::Normalised => format_ident!("__rotations_normalised"),
    }
}

fn of_rotations(terms: Terms) -> Ident {
    format_ident!("__evaluate_{}_of_rotations", name(terms))
}

fn evaluation_function(terms: Terms, normalisation: Normalisation) -> Ident {
    let plain = function::<Kernels>("evaluate", terms);
    match normalisation {
        Normalisation::Raw => plain,
        Normalisation::Normalised => format_ident!("{plain}_normalised"),
    }
}
