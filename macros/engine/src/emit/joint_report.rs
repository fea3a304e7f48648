//! What is told of a mechanism in joint coordinates: its coordinates, what remains of the joints,
//! and what an evaluation costs.

use proc_macro2::TokenStream;
use quote::quote;

use super::report::{evaluation_name, kernel, state_infos, terms_name};
use super::writer::Writer;
use crate::coordinates::kernels::{JointKernels, Meaning};
use crate::model::Asked;
use crate::symbolic::arena::Stage;
use crate::symbolic::equations::Kernel;
use crate::symbolic::time::Cost;

/// An index that may not be.
pub(super) fn option(index: Option<usize>) -> TokenStream {
    match index {
        Some(index) => quote!(::core::option::Option::Some(#index)),
        None => quote!(::core::option::Option::None),
    }
}

impl Writer<'_, JointKernels> {
    /// The coordinates, what remains of the joints, and what an evaluation costs.
    pub(super) fn documentation(&self) -> TokenStream {
        let (model, kernels) = (self.model, self.kernels);
        let joint = |joint: usize| model.joints[joint].name.to_string();
        let mut text = String::from("| body | joint | moves by | measured |\n|---|---|---|---|\n");
        for link in &kernels.links {
            let by = link
                .joint
                .map_or("moves freely".into(), |place| format!("`{}`", joint(place)));
            let motion = match link.meaning {
                Meaning::Turn(_) => "a turn",
                Meaning::Slide => "a slide",
                Meaning::Screw(..) => "a screw",
                Meaning::Ball => "every rotation",
            };
            let body = &model.bodies[link.body].name;
            let measured = match link.against.map(|place| kernels.links[place].joint) {
                Some(Some(place)) => format!("with `{}`", joint(place)),
                _ => String::from("by itself"),
            };
            text += &format!("| `{body}` | {by} | {motion} | {measured} |\n");
        }
        let mut closing: Vec<String> = kernels.rows.iter().map(|&row| joint(row)).collect();
        closing.dedup();
        if !closing.is_empty() {
            let rows = kernels.rows.len();
            let names: Vec<String> = closing.iter().map(|name| format!("`{name}`")).collect();
            let names = names.join(", ");
            text += &format!("\nEquations that remain: {rows}, of {names}.\n");
        }
        text += "\n| kernel | operations | longest chain | cycles (x86-64, AVX2) |\n|---|---|---|---|\n";
        for (name, cost) in self.costs().into_iter().chain(self.asked_costs()) {
            let Cost { count, cycles } = cost;
            text += &format!(
                "| {name} | {} | {} | {cycles} |\n",
                count.total(),
                count.depth
            );
        }
        quote!(#[doc = #text])
    }

    /// Name and cost of each evaluation, and then of each without multipliers, if there are any.
    fn costs(&self) -> Vec<(String, Cost)> {
        let kernels = self.kernels;
        let rates = kernels.turns + kernels.rest + kernels.velocities;
        let rows = kernels.rows.len();
        let evaluations = kernels.evaluations.iter().map(|evaluation| {
            let Kernel { arena, outputs } = &evaluation.kernel;
            let name = evaluation_name(evaluation.terms);
            (name, Cost::of(arena, outputs, Stage::State))
        });
        let with_rows = kernels.evaluations.iter().filter(|_| rows > 0);
        let alone = with_rows.map(|evaluation| {
            let Kernel { arena, outputs } = &evaluation.kernel;
            let needed = [&outputs[..rates], &outputs[rates + rows..]].concat();
            let name = format!("rates {}", terms_name(evaluation.terms));
            (name, Cost::of(arena, &needed, Stage::State))
        });
        evaluations.chain(alone).collect()
    }

    /// Word and cost of what is asked for.
    fn asked_costs(&self) -> Vec<(String, Cost)> {
        let asked = self.kernels.joint_rates.iter().flat_map(|of| &of.asked);
        let asked = asked.map(|(asked, kernel)| (*asked, kernel));
        let derivatives = self.kernels.derivatives.iter();
        let derivatives = derivatives.map(|found| (Asked::Derivatives, &found.kernel));
        let adjoint = self.kernels.adjoint.iter();
        let adjoint = adjoint.filter_map(|found| Some((Asked::Adjoint, &found.kernels.first()?.1)));
        let rates = self.kernels.joint_rates.iter();
        let forward = rates.filter_map(|of| Some((Asked::Forward, of.forward.as_ref()?)));
        let all = asked.chain(forward).chain(derivatives).chain(adjoint);
        let costs = all.map(|(asked, Kernel { arena, outputs })| {
            let name = asked.word().into();
            (name, Cost::of(arena, outputs, Stage::State))
        });
        costs.collect()
    }

    pub(super) fn report(&self) -> TokenStream {
        let (facade, kernels) = (self.facade, self.kernels);
        let joint = |joint: Option<usize>| {
            let joints = &self.model.joints;
            joint.map_or(String::new(), |joint| joints[joint].name.to_string())
        };
        let links = kernels.links.iter().map(|link| {
            let joint = joint(link.joint);
            let body = self.model.bodies[link.body].name.to_string();
            let motion = match link.meaning {
                Meaning::Turn(is_reversed) => quote!(Turn { is_reversed: #is_reversed }),
                Meaning::Slide => quote!(Slide),
                Meaning::Screw(is_reversed, counter) => {
                    quote!(Screw { is_reversed: #is_reversed, counter: #counter })
                }
                Meaning::Ball => quote!(Ball),
            };
            let (coordinate, velocity, zero) = (link.coordinate, link.velocity, link.zero);
            let against = option(link.against);
            quote! {
                #facade::__private::JointMotion {
                    joint: #joint, body: #body, freedom: #facade::__private::Freedom::#motion, coordinate: #coordinate, velocity: #velocity,
                    against: #against, zero: #zero,
                }
            }
        });
        let closing = kernels.rows.iter().map(|&row| joint(Some(row)));
        let rows = kernels.rows_of_bodies.iter().map(|&row| option(row));
        let first = kernels.rest - kernels.auxiliaries - kernels.states;
        let elements: Vec<_> = self.model.elements().collect();
        let counters = self.model.counters().into_iter().enumerate();
        let counters = counters.map(|(place, counter)| {
            let (place, element) = (first + place, elements[counter.element].name.to_string());
            quote!(#facade::__private::JointCounter { element: #element, coordinate: #place })
        });
        let states = state_infos(self.model, first + kernels.auxiliaries, facade);
        let costs = self.costs().into_iter();
        let costs = costs.map(|(name, cost)| kernel(&name, cost, facade));
        let asked = self.asked_costs().into_iter();
        let asked = asked.map(|(name, cost)| kernel(&name, cost, facade));
        let balls = &kernels.balls;
        let (auxiliaries, rewraps) = (kernels.auxiliaries, kernels.rewraps);
        let determines = kernels.determines;
        quote! {
            #facade::__private::JointReport {
                motions: &[#(#links),*],
                closing: &[#(#closing),*],
                rows: &[#(#rows),*],
                kernels: &[#(#costs),*],
                asked: &[#(#asked),*],
                euler_parameters: &[#(#balls),*],
                counters: &[#(#counters),*],
                auxiliaries: #auxiliaries,
                states: &[#(#states),*],
                rewraps: #rewraps,
                determines: #determines,
            }
        }
    }
}
