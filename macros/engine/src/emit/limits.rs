//! The limits of joints, as a run takes them.

use proc_macro2::TokenStream;
use quote::quote;

use super::store::of_symbol;
use crate::model::{Model, Number};
use crate::syntax::words::local;

/// Only where there are limits.
pub(super) fn limits(model: &Model, facade: &TokenStream) -> Option<TokenStream> {
    let number = |number: Number| match number {
        Number::Literal(value) => quote!(__S::constant(#value)),
        Number::Symbol(place) | Number::Varying(place) => of_symbol(&model.symbols[place as usize]),
    };
    let (name, parameters) = (&model.name, local("parameters"));
    let joints = model.joints.iter().enumerate();
    let limited: Vec<TokenStream> = joints
        .filter_map(|(place, joint)| {
            let limits = joint.limits.as_ref()?;
            let path = &joint.path;
            let quantity = match model.definition(joint).angle {
                Some(_) => quote!(angle),
                None => quote!(displacement),
            };
            let [lower, upper] = limits.bounds.map(number);
            let restitution = number(limits.restitution);
            Some(quote! {
                #facade::run::Interaction::limits(
                    #facade::JointHandle::<#name, #path>::new(#place).#quantity(),
                    [#lower, #upper],
                )
                .restitution(#restitution)
            })
        })
        .collect();
    let count = limited.len();
    (count > 0).then(|| {
        quote! {
            #[automatically_derived]
            impl #facade::run::Limited<#count> for #name {
                fn limits_of<__S: #facade::Real>(
                    #parameters: &Self::Parameters<__S>,
                ) -> [#facade::run::Interaction<__S, Self>; #count] {
                    [#(#limited),*]
                }
            }
        }
    })
}
