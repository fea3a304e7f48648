//! What a mechanism is written from.

use std::ops::Range;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::parts::{Frame, write_in_parts};
use super::store::Store;
use super::straight_line::{Environment, StraightLine};
use crate::model::Model;
use crate::plan::kernels::{Kernels, Solver};
use crate::plan::system::Terms;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

/// What the parts of an implementation are written from: in absolute coordinates by [`Kernels`], in
/// joint coordinates by [`JointKernels`](crate::coordinates::kernels::JointKernels).
pub(super) struct Writer<'a, K = Kernels> {
    pub(super) model: &'a Model,
    pub(super) kernels: &'a K,
    pub(super) facade: &'a TokenStream,
    pub(super) store: Store,
    /// The functions that long kernels are written in.
    pub(super) parts: TokenStream,
}

impl<'a, K> Writer<'a, K> {
    /// Nothing is written yet.
    pub(super) fn new(model: &'a Model, kernels: &'a K, facade: &'a TokenStream) -> Self {
        Self {
            model,
            kernels,
            facade,
            store: Store::new(model.all_spline_numbers()),
            parts: TokenStream::new(),
        }
    }
}

/// The kernels of a mechanism in one kind of coordinates, as its solver is written from them.
pub(super) trait Described {
    /// The trait that is implemented.
    const IMPLEMENTED: &'static str;
    /// Its types of states, constants, coefficients, factors, accelerations and multipliers.
    const TYPES: [&'static str; 6];
    /// What its functions have behind their verbs.
    const SUFFIX: &'static str;
    /// Whether the factorisation gives a verdict on its pivots, and is inlined where it is short.
    const IS_JUDGED: bool;

    /// Statements that give a kernel the arrays of its state.
    fn unpack() -> TokenStream;

    /// Inputs of a kernel from its arguments, earlier values from the store.
    fn environment<'a>(&self, store: &'a mut Store) -> impl Environment + 'a;

    /// The outputs of an evaluation that are rates of the state, as the rates of a state.
    fn rates(&self, facade: &TokenStream, outputs: &[TokenStream]) -> TokenStream;

    /// The places of the multipliers among the outputs of an evaluation. They stand behind the
    /// rates, and before the recorded pivots.
    fn multipliers(&self) -> Range<usize>;

    /// Whether an evaluation leaves the multipliers out where they are not asked for.
    fn omits_multipliers(&self) -> bool;

    /// The number of velocities.
    fn velocities(&self) -> usize;

    /// Factorisations and back-substitutions: the plain one, and the compliant one if there is a
    /// row.
    fn solvers(&self) -> &[Solver];
}

impl<K: Described> Writer<'_, K> {
    /// The types of [`Described::TYPES`] outside the implementation.
    pub(super) fn types_outside(&self) -> [TokenStream; 6] {
        let (name, facade) = (&self.model.name, self.facade);
        let implemented = format_ident!("{}", K::IMPLEMENTED);
        K::TYPES.map(|kind| {
            let kind = format_ident!("{kind}");
            quote!(<#name as #facade::#implemented>::#kind<__S>)
        })
    }

    /// A kernel that may be long.
    pub(super) fn line_of(&mut self, kernel: &Kernel, frame: &Frame) -> StraightLine {
        let (line, parts) = write_in_parts(
            (&kernel.arena, &kernel.outputs),
            Stage::State,
            &mut self.kernels.environment(&mut self.store),
            frame,
        );
        self.parts.extend(parts);
        line
    }

    /// Statements that give a kernel its arrays.
    pub(super) fn unpack() -> TokenStream {
        K::unpack()
    }

    /// The arguments of an evaluation and of a factorisation.
    pub(super) fn arguments(&self) -> TokenStream {
        let names = ["constants", "coefficients", "time", "state"];
        let [constants, coefficients, time, state] = names.map(local);
        let [of_state, of_constants, of_coefficients, ..] = self.types_outside();
        quote! {
            #constants: &#of_constants,
            #coefficients: &#of_coefficients,
            #time: __S,
            #state: &#of_state,
        }
    }

    /// The names of the arguments.
    pub(super) fn passed() -> TokenStream {
        let names = ["constants", "coefficients", "time", "state"].map(local);
        quote!(#(#names,)*)
    }

    /// Where an evaluation writes its results.
    pub(super) fn results(&self) -> TokenStream {
        let (rates, multipliers) = (local("rates"), local("multipliers"));
        let [of_state, .., of_multipliers] = self.types_outside();
        quote! {
            #rates: &mut #of_state,
            #multipliers: &mut #of_multipliers,
        }
    }

    /// The function of a kernel that reads a state.
    pub(super) fn frame(&self, name: String, declared: TokenStream, passed: TokenStream) -> Frame {
        Frame {
            name,
            facade: self.facade.clone(),
            declared,
            passed,
            unpack: K::unpack(),
        }
    }
}

/// The function that a kernel is written as.
pub(super) fn function<K: Described>(verb: &str, terms: Terms) -> Ident {
    format_ident!("__{verb}{}_{}", K::SUFFIX, name(terms))
}

pub(super) fn name(terms: Terms) -> &'static str {
    match terms {
        Terms::Plain => "plain",
        Terms::Stabilised => "stabilised",
        Terms::Compliant => "compliant",
    }
}
