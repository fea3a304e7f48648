//! The solver in joint coordinates: its evaluations, which may leave the multipliers out.

use std::ops::Range;

use proc_macro2::TokenStream;
use quote::quote;

use super::store::{Store, load_input};
use super::straight_line::{Environment, StraightLine, Value};
use super::writer::{Described, Writer, function};
use crate::coordinates::kernels::JointKernels;
use crate::plan::kernels::Solver;
use crate::plan::system::Terms;
use crate::symbolic::arena::{Arena, Expr, Input};
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

impl Described for JointKernels {
    const IMPLEMENTED: &'static str = "JointCoordinates";
    const TYPES: [&'static str; 6] = [
        "JointState",
        "JointConstants",
        "JointCoefficients",
        "JointFactors",
        "JointVelocities",
        "ClosingMultipliers",
    ];
    const SUFFIX: &'static str = "_joints";
    const IS_JUDGED: bool = false;

    fn unpack() -> TokenStream {
        let state = local("state");
        let (pairs, rest, rates) = (local("pairs"), local("rest"), local("velocities"));
        quote! {
            let #pairs = #state.pairs();
            let #rest = #state.rest();
            let #rates = #state.rates();
        }
    }

    fn environment<'a>(&self, store: &'a mut Store) -> impl Environment + 'a {
        Arguments {
            store,
            turns: self.turns,
        }
    }

    fn rates(&self, facade: &TokenStream, outputs: &[TokenStream]) -> TokenStream {
        let (angles, others) = outputs.split_at(self.turns);
        let (coordinates, velocities) = others.split_at(self.rest);
        quote! {
            #facade::__private::JointState::of_parts(
                [#([#angles, __S::constant(0.0)]),*],
                [#(#coordinates),*],
                [#(#velocities),*],
            )
        }
    }

    fn multipliers(&self) -> Range<usize> {
        let first = self.turns + self.rest + self.velocities;
        first..first + self.rows.len()
    }

    fn omits_multipliers(&self) -> bool {
        !self.rows.is_empty()
    }

    fn velocities(&self) -> usize {
        self.velocities
    }

    fn solvers(&self) -> &[Solver] {
        &self.solvers
    }
}

impl Writer<'_, JointKernels> {
    /// The fused evaluations.
    pub(super) fn evaluations(&mut self) -> TokenStream {
        let kernels = self.kernels;
        let evaluations = kernels.evaluations.iter().map(|evaluation| {
            let function = function::<JointKernels>("evaluate", evaluation.terms);
            self.evaluation(&function, (&evaluation.kernel, &evaluation.checks))
        });
        evaluations.collect()
    }

    /// The choice among evaluations.
    pub(super) fn dispatch(&self) -> TokenStream {
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
        let [plain, stabilised, compliant] =
            Terms::ALL.map(|terms| function::<JointKernels>("evaluate", terms));
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
                fn joint_rates_into<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                    #constants: &Self::JointConstants<__S>,
                    #coefficients: &Self::JointCoefficients<__S>,
                    #time: __S,
                    #state: &Self::JointState<__S>,
                    #rates: &mut Self::JointState<__S>,
                ) -> #facade::__private::Pivot<__S> {
                    let #multipliers = &mut [__S::constant(0.0); #rows];
                    #body
                }
            }
        });
        quote! {
            #rates_alone

            #[inline(always)]
            fn evaluate_joints_into<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::JointConstants<__S>,
                #coefficients: &Self::JointCoefficients<__S>,
                #time: __S,
                #state: &Self::JointState<__S>,
                #rates: &mut Self::JointState<__S>,
                #multipliers: &mut Self::ClosingMultipliers<__S>,
            ) -> #facade::__private::Pivot<__S> {
                #body
            }
        }
    }

    /// The rates of the coordinates alone, which a method needs that moves them by velocities of
    /// the end of a step.
    pub(super) fn coordinate_rates(&mut self) -> TokenStream {
        let (facade, kernels) = (self.facade, self.kernels);
        let [constants, time, state] = ["constants", "time", "state"].map(local);
        let [plain, ..] = &kernels.evaluations[..] else {
            unreachable!("there is an evaluation without stabilisation")
        };
        let kernel = Kernel {
            arena: plain.kernel.arena.clone(),
            outputs: plain.kernel.outputs[..kernels.turns + kernels.rest].to_vec(),
        };
        let unpack = Self::unpack();
        let [of_state, of_constants, ..] = self.types_outside();
        let frame = self.frame(
            "__joint_coordinate_rates".into(),
            quote!(#constants: &#of_constants, #time: __S, #state: &#of_state,),
            quote!(#constants, #time, #state,),
        );
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&kernel, &frame);
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
                #facade::__private::JointState::of_parts(
                    [#([#angles, __S::constant(0.0)]),*],
                    [#(#others),*],
                    [__S::constant(0.0); #velocities],
                )
            }
        }
    }
}
