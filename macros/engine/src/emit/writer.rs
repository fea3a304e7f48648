//! What a mechanism in coordinates of its bodies is written from.

use proc_macro2::TokenStream;
use quote::quote;

use super::parts::{Frame, write_in_parts};
use super::store::{Kernel as Arguments, Store};
use super::straight_line::{Given, StraightLine, write};
use crate::model::Model;
use crate::plan::kernels::Kernels;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::syntax::words::local;

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
}
