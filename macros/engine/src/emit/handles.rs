//! The handles of a mechanism.

use proc_macro2::TokenStream;
use quote::quote;

use super::writer::Writer;
use crate::model::Name;
use crate::model::name::fields;

impl Writer<'_> {
    /// Their type, and its value.
    pub(super) fn handles(&self) -> (TokenStream, TokenStream) {
        let (name, facade) = (&self.model.name, self.facade);
        let mut declared = TokenStream::new();
        let mut values = TokenStream::new();
        let mut declare = |handles: Vec<(&Name, TokenStream, TokenStream)>| {
            let names = handles.iter().map(|(name, ..)| *name);
            let mut rest = handles.iter();
            for (field, length) in fields(names) {
                let (_, kind, value) = rest.next().expect("a handle of every field");
                let Some(length) = length else {
                    declared.extend(quote!(pub #field: #kind,));
                    values.extend(quote!(#field: #value,));
                    continue;
                };
                let others = rest.by_ref().take(length - 1).map(|(.., value)| value);
                declared.extend(quote!(pub #field: [#kind; #length],));
                values.extend(quote!(#field: [#value, #(#others),*],));
            }
        };
        let bodies = self.model.bodies.iter().enumerate().map(|(place, body)| {
            let kind = quote!(#facade::BodyHandle<#name>);
            (&body.name, kind, quote!(#facade::BodyHandle::new(#place)))
        });
        declare(bodies.collect());
        let joints = self.model.joints.iter().enumerate().map(|(place, joint)| {
            let path = &joint.path;
            let kind = quote!(#facade::JointHandle<#name, #path>);
            (&joint.name, kind, quote!(#facade::JointHandle::new(#place)))
        });
        declare(joints.collect());
        let forces = self.model.forces.iter().enumerate().map(|(place, force)| {
            let path = &force.path;
            let kind = quote!(#facade::ForceHandle<#name, #path>);
            (&force.name, kind, quote!(#facade::ForceHandle::new(#place)))
        });
        declare(forces.collect());
        let documentation = format!("The handles of [`{name}`], one per field.");
        let declared = quote! {
            #[doc = #documentation]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            pub struct __Handles { #declared }
        };
        (declared, quote!(__Handles { #values }))
    }
}
