//! The limits of joints, as a run takes them.

use proc_macro2::TokenStream;
use quote::quote;

use super::store::of_symbol;
use crate::model::{Limits, Model, Number};
use crate::syntax::words::local;

/// So many interactions a run takes beside limits of the description.
const BESIDE: usize = 32;

/// Joints with limits, by their places in the model.
fn limited(model: &Model) -> Vec<(usize, &Limits)> {
    let joints = model.joints.iter().enumerate();
    joints
        .filter_map(|(place, joint)| Some((place, joint.limits.as_ref()?)))
        .collect()
}

/// What every mechanism has of its limits.
pub(super) fn members(model: &Model, facade: &TokenStream) -> TokenStream {
    let number = |number: Number| match number {
        Number::Literal(value) => quote!(__S::constant(#value)),
        Number::Symbol(place) | Number::Varying(place) => of_symbol(&model.symbols[place as usize]),
    };
    let [parameters, make] = ["parameters", "make"].map(local);
    let limits: Vec<TokenStream> = limited(model)
        .into_iter()
        .map(|(place, limits)| {
            let is_angle = model.definition(&model.joints[place]).angle.is_some();
            let [lower, upper] = limits.bounds.map(number);
            let restitution = number(limits.restitution);
            quote! {
                #make(#facade::mechanism::JointLimits {
                    joint: #place,
                    is_angle: #is_angle,
                    bounds: [#lower, #upper],
                    restitution: #restitution,
                })
            }
        })
        .collect();
    let count = limits.len();
    let (kind, value, by_ref) = if count == 0 {
        let nothing = quote!(#facade::mechanism::Nothing);
        (nothing.clone(), nothing, quote!())
    } else {
        (quote!([__T; #count]), quote!([#(#limits),*]), quote!(mut))
    };
    quote! {
        type PerLimit<__T: ::core::clone::Clone> = #kind;

        fn limits_of<__S: #facade::Scalar, __T: ::core::clone::Clone>(
            #parameters: &Self::Parameters<__S>,
            #by_ref #make: impl ::core::ops::FnMut(#facade::mechanism::JointLimits<__S>) -> __T,
        ) -> Self::PerLimit<__T> {
            #value
        }
    }
}

/// How many interactions a run has beside those that it is given.
pub(super) fn beside(model: &Model, facade: &TokenStream) -> TokenStream {
    let (name, parameters) = (&model.name, local("parameters"));
    let count = limited(model).len();
    if count == 0 {
        return quote! {
            #[automatically_derived]
            impl<const __K: usize> #facade::run::Beside<__K, __K> for #name {}
        };
    }
    let own = 0..=BESIDE;
    let all = own.clone().map(|own| own + count);
    quote! {
        #[automatically_derived]
        impl #facade::run::Limited<#count> for #name {
            fn described<__S: #facade::Real>(
                #parameters: &Self::Parameters<__S>,
            ) -> [#facade::run::Interaction<__S, Self>; #count] {
                <Self as #facade::Mechanism>::limits_of(
                    #parameters,
                    #facade::run::Interaction::of_description,
                )
            }
        }
        #(
            #[automatically_derived]
            impl #facade::run::Beside<#own, #all> for #name {}
        )*
    }
}
