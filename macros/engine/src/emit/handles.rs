//! The handles of a mechanism.

use proc_macro2::TokenStream;
use quote::quote;

use super::nested::{Structs, nested};
use super::writer::Writer;

impl Writer<'_> {
    /// Their type, and its value.
    pub(super) fn handles(&self) -> (TokenStream, TokenStream) {
        let (name, facade) = (&self.model.name, self.facade);
        let bodies = self.model.bodies.iter().enumerate().map(|(place, body)| {
            let kind = quote!(#facade::BodyHandle<#name>);
            let value = quote!(#facade::BodyHandle::new(#place));
            (&body.name, (kind, value))
        });
        let joints = self.model.joints.iter().enumerate().map(|(place, joint)| {
            let path = &joint.path;
            let kind = quote!(#facade::JointHandle<#name, #path>);
            let value = quote!(#facade::JointHandle::new(#place));
            (&joint.name, (kind, value))
        });
        let forces = self.model.forces.iter().enumerate().map(|(place, force)| {
            let path = &force.path;
            let kind = quote!(#facade::ForceHandle<#name, #path>);
            let value = quote!(#facade::ForceHandle::new(#place));
            (&force.name, (kind, value))
        });
        let points = self.model.points.iter().enumerate().map(|(place, point)| {
            let kind = quote!(#facade::__private::PointHandle<#name>);
            let value = quote!(#facade::__private::PointHandle::new(#place));
            (&point.name, (kind, value))
        });
        let states = self.model.states.iter().enumerate().map(|(place, state)| {
            let kind = quote!(#facade::__private::StateHandle<#name>);
            let handle = quote!(#facade::__private::StateHandle::new(#place));
            (&state.name, (kind, handle))
        });
        // A spline is no number that something depends on.
        let values = self.model.values.iter().enumerate();
        let values = values.filter(|(_, value)| {
            !value.is_start && !matches!(value.kind, crate::model::ValueKind::Spline(_))
        });
        let values = values.map(|(place, value)| {
            let kind = quote!(#facade::__private::ValueHandle<#name>);
            let handle = quote!(#facade::__private::ValueHandle::new(#place));
            (&value.name, (kind, handle))
        });
        let documentation = format!("The handles of [`{name}`], one per field.");
        let head = quote! {
            #[doc = #documentation]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        };
        let structs = Structs::new("__Handles", head, TokenStream::new());
        let elements = bodies
            .chain(joints)
            .chain(forces)
            .chain(points)
            .chain(states);
        structs.written(&nested(elements.chain(values)))
    }
}
