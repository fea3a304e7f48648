//! The implementation of a mechanism in joint coordinates.

use proc_macro2::TokenStream;
use quote::quote;

use super::inputs::taken;
use super::parts::{Frame, write_in_parts};
use super::repeated::{Calls, Given, of_body, of_joint, written};
use super::splines::prepared;
use super::store;
use super::straight_line::StraightLine;
use super::writer::Writer;
use crate::coordinates::kernels::{JointKernels, Meaning};
use crate::model::{BodyKind, Model};
use crate::symbolic::arena::Stage;
use crate::symbolic::repeated::Repeated;
use crate::syntax::words::local;

/// The implementation, and the functions beside it.
pub(super) fn implementation(
    model: &Model,
    kernels: &JointKernels,
    facade: &TokenStream,
) -> TokenStream {
    Writer::new(model, kernels, facade).write()
}

impl Writer<'_, JointKernels> {
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
        let angles = model.layout().turns;
        let read = kernels.bodies.outputs.len();
        let evaluations = self.evaluations();
        let dispatch = self.dispatch();
        let (solvers, factors) = self.solvers();
        let solving = self.solving();
        let bodies = self.bodies();
        let joints = self.joints();
        let coordinate_rates = self.coordinate_rates();
        let derivatives = self.derivatives();
        let adjoint = self.adjoint();
        let forward = self.forward();
        let joint_rates = self.joint_rates();
        let coefficients = self.store.write_coefficients();
        let taken = taken(model, &mut self.store);
        let prepared = prepared(model, self.store.write_constants(&model.symbols));
        let (c, k) = (self.store.constants(), self.store.coefficients());
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
                type JointState<__S: #facade::Scalar> = #facade::__private::JointState<__S, #turns, #rest, #velocities, #angles>;
                type ClosingMultipliers<__S: #facade::Scalar> = [__S; #rows];
                type JointConstants<__S: #facade::Scalar> = [__S; #c];
                type JointCoefficients<__S: #facade::Scalar> = [__S; #k];
                type BodyMotions<__S: #facade::Scalar> = [__S; #read];
                type JointFactors<__S: #facade::Scalar> = #factors;
                type JointVelocities<__S: #facade::Scalar> = [__S; #velocities];

                const JOINT_REPORT: #facade::__private::JointReport = #report;

                fn prepare_joints<__S: #facade::Scalar>(
                    #given: &Self::Parameters<__S>,
                ) -> Self::JointConstants<__S> {
                    #prepared
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
                    #stabilisation: &#facade::__private::Stabilisation<__S>,
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
                #derivatives

                #adjoint

                #forward
            }

            #joint_rates
            #evaluations
            #solvers
            #parts
        }
    }

    fn bodies(&mut self) -> TokenStream {
        let facade = self.facade;
        let (constants, state) = (local("constants"), local("state"));
        let unpack = Self::unpack();
        let [of_state, of_constants, ..] = self.types_outside();
        let frame = self.frame(
            "__body_motions".into(),
            quote!(#constants: &#of_constants, #state: &#of_state,),
            quote!(#constants, #state,),
        );
        let kernels = self.kernels;
        if let Some(calls) = self.repeated_bodies() {
            let (statements, gathered) = (calls.statements, calls.gathered);
            return quote! {
                fn body_motions<__S: #facade::Scalar>(
                    #constants: &Self::JointConstants<__S>,
                    #state: &Self::JointState<__S>,
                ) -> Self::BodyMotions<__S> {
                    #unpack
                    #statements
                    #gathered
                }
            };
        }
        let StraightLine {
            statements,
            outputs,
        } = self.line_of(&kernels.bodies, &frame);
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
        let StraightLine {
            statements,
            outputs,
        } = self.repeated_joints().unwrap_or_else(|| {
            let (line, parts) = write_in_parts(
                (&kernels.joints.arena, &kernels.joints.outputs),
                Stage::State,
                &mut store::Kernel {
                    store: &mut self.store,
                },
                &frame,
            );
            self.parts.extend(parts);
            line
        });
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
                #facade::__private::JointState::of_parts([#(#pairs),*], [#(#rest),*], [#(#rates),*])
            }
        }
    }

    /// How the bodies stand and move, link by link.
    fn repeated_bodies(&mut self) -> Option<Calls> {
        let (model, kernels) = (self.model, self.kernels);
        if model.coordinates.fuse_bodies() {
            return None;
        }
        let mut first = 0;
        let mut groups: Vec<(usize, Vec<usize>)> = Vec::new();
        for (body, described) in model.bodies.iter().enumerate() {
            let numbers = match described.kind {
                BodyKind::Rigid => 18,
                BodyKind::Particle => 6,
            };
            // What carries a body stands before it.
            let link = kernels.links.iter().position(|link| link.body == body);
            let link = link.unwrap_or(kernels.links.len());
            groups.push((link, (first..first + numbers).collect()));
            first += numbers;
        }
        groups.sort_by_key(|&(link, _)| link);
        let groups = groups.into_iter().map(|(_, group)| group).collect();
        let repeated = Repeated::new(&kernels.bodies, groups, of_joint(kernels.turns))?;
        let given = Given::of_joints(kernels.turns);
        let calls = (&kernels.bodies.arena, &repeated);
        let calls = written("body_motions", calls, &given, &mut self.store, self.facade)?;
        self.parts.extend(calls.functions.clone());
        Some(calls)
    }

    /// Joint coordinates of the bodies, link by link.
    fn repeated_joints(&mut self) -> Option<StraightLine> {
        let (model, kernels) = (self.model, self.kernels);
        if model.coordinates.fuse_bodies() {
            return None;
        }
        let groups = kernels.links.iter().map(|link| {
            let further = 2 * kernels.turns;
            let (coordinates, rates) = match link.meaning {
                Meaning::Turn(_) => (2 * link.coordinate..2 * link.coordinate + 2, 1),
                Meaning::Screw(..) => (2 * link.coordinate..2 * link.coordinate + 2, 1),
                Meaning::Slide => (further + link.coordinate..further + link.coordinate + 1, 1),
                Meaning::Ball => (further + link.coordinate..further + link.coordinate + 4, 3),
            };
            let velocity = further + kernels.rest + link.velocity;
            coordinates.chain(velocity..velocity + rates).collect()
        });
        let layout = model.layout();
        let repeated = Repeated::new(&kernels.joints, groups.collect(), of_body(&layout))?;
        let given = Given::of_bodies(false);
        let calls = (&kernels.joints.arena, &repeated);
        let calls = written("joint_state", calls, &given, &mut self.store, self.facade)?;
        self.parts.extend(calls.functions);
        let gathered = calls.gathered;
        Some(StraightLine {
            statements: calls.statements,
            outputs: (0..kernels.joints.outputs.len())
                .map(|k| quote!(#gathered[#k]))
                .collect(),
        })
    }
}
