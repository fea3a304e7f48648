//! The bodies of a mechanism that runs by its joints: they are read, and their equations of motion
//! solved seldom. What the loops over rows in the run-time crate are told, and kernels of joints as
//! calls.

use proc_macro2::TokenStream;
use quote::quote;

use super::repeated::{Calls, Given, of_body, written, written_each};
use super::writer::Writer;
use crate::plan::kernels::ByRows;
use crate::symbolic::equations::Kernel;
use crate::symbolic::repeated::Repeated;
use crate::syntax::words::local;

impl Writer<'_> {
    /// The members that factorise and solve, the functions beside them, and the type of factors.
    pub(super) fn solving_by_bodies(&mut self) -> (TokenStream, TokenStream, TokenStream) {
        let kernels = self.kernels;
        if let Some(by_rows) = &kernels.by_rows {
            return self.solving_by_rows(by_rows);
        }
        let solving = self.solving();
        let (solvers, factors) = self.solvers();
        (solving, solvers, factors)
    }

    fn solving_by_rows(&mut self, by_rows: &ByRows) -> (TokenStream, TokenStream, TokenStream) {
        let facade = self.facade;
        let given = self.line(&by_rows.compliances);
        let (statements, given) = (given.statements, given.outputs);
        let [constants, coefficients, time, state] =
            ["constants", "coefficients", "time", "state"].map(local);
        let [factors, upper, lower] = ["factors", "upper", "lower"].map(local);
        let compliances = local("compliances");
        let (places, ends) = (&by_rows.profile.places, &by_rows.profile.ends);
        let entries = by_rows.profile.entries();
        let solving = quote! {
            fn factor<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #time: __S,
                #state: &Self::State<__S>,
            ) -> (Self::Factors<__S>, #facade::__private::Pivot<__S>) {
                #statements
                let #compliances = &[#(#given),*];
                #facade::__private::factor_by_rows::<__S, Self, __T, _>(
                    __PROFILE, #constants, #compliances, #time, #state,
                )
            }

            fn solve<__S: #facade::Scalar, __T: #facade::__private::Terms>(
                #constants: &Self::Constants<__S>,
                #coefficients: &Self::Coefficients<__S>,
                #factors: &Self::Factors<__S>,
                #upper: &Self::Velocities<__S>,
                #lower: &Self::Multipliers<__S>,
            ) -> (Self::Velocities<__S>, Self::Multipliers<__S>) {
                #facade::__private::solve_by_rows::<__S, Self, _>(__PROFILE, #factors, #upper, #lower)
            }
        };
        let beside = quote! {
            const __PROFILE: #facade::__private::Profile = #facade::__private::Profile {
                places: &[#(#places),*],
                ends: &[#(#ends),*],
            };
        };
        let factors = quote! {
            #facade::__private::RowFactors<
                Self::Jacobian<__S>, Self::Velocities<__S>, [__S; #entries],
            >
        };
        (solving, beside, factors)
    }

    /// A kernel of the joints or the bodies by a function for each thing that is done, where bodies
    /// are read and not run.
    pub(super) fn repeated(
        &mut self,
        name: &str,
        kernel: &Kernel,
        has_time: bool,
    ) -> Option<Calls> {
        self.kernels.by_rows.as_ref()?;
        let layout = self.model.layout();
        let groups = match name {
            "jacobian" => self.entries_of_joints(),
            "coordinate_rates" => {
                let ends = layout
                    .coordinate
                    .iter()
                    .skip(1)
                    .chain([&layout.coordinates]);
                let bodies = layout.coordinate.iter().zip(ends);
                bodies
                    .map(|(&first, &end)| (first..end).collect())
                    .collect()
            }
            "constraints" | "constraint_rates" | "gamma" => {
                let joints = self.model.joints.iter().zip(&layout.row);
                let rows = joints.map(|(joint, &row)| row..row + self.model.equations(joint));
                rows.map(Iterator::collect).collect()
            }
            _ => return None,
        };
        let repeated = Repeated::new(kernel, groups, of_body(&layout))?;
        let given = Given::of_bodies(has_time);
        let calls = (&kernel.arena, &repeated);
        let calls = written(name, calls, &given, &mut self.store, self.facade)?;
        self.parts.extend(calls.functions.clone());
        Some(calls)
    }

    /// Kernels of single joints, likewise.
    pub(super) fn repeated_each(
        &mut self,
        name: &str,
        kernels: &[(usize, Kernel)],
    ) -> Option<Calls> {
        self.kernels.by_rows.as_ref()?;
        let (places, kernels): (Vec<usize>, Vec<&Kernel>) = { kernels.iter() }
            .map(|(place, kernel)| (*place, kernel))
            .unzip();
        let layout = self.model.layout();
        let of_body = of_body(&layout);
        let repeated = Repeated::each(&kernels, &of_body)?;
        let given = Given::of_bodies(false);
        let calls = (&places[..], &kernels[..]);
        let calls = written_each(name, calls, &repeated, &given, &mut self.store, self.facade)?;
        self.parts.extend(calls.functions.clone());
        Some(calls)
    }

    /// The places of the entries of the Jacobian, joint by joint.
    fn entries_of_joints(&self) -> Vec<Vec<usize>> {
        let blocks = &self.kernels.blocks;
        let mut groups = vec![Vec::new(); self.model.joints.len()];
        let ends = blocks.iter().skip(1).map(|block| block.offset);
        let ends = ends.chain([self.kernels.jacobian.outputs.len()]);
        for (block, end) in blocks.iter().zip(ends) {
            groups[block.joint].extend(block.offset..end);
        }
        groups
    }
}
