//! An assembly: construction, the types and values of its fields, its carrier.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Attribute, Data, DeriveInput, Field};

use super::construction::of_assembly;
use super::parameters::{lengths, read};
use crate::model::{Model, Table};
use crate::syntax::array::element_type;
use crate::syntax::mechanism::{MechanismSyntax, carrier_path};
use crate::wire::{self, Delivery};

/// What the fields of an assembly are described by.
const WITH_TYPES: [&str; 4] = ["body", "joint", "force", "part"];

/// Writes an assembly. A faulty one still has its carrier, so that its users see one error and not
/// many.
#[must_use]
pub fn emit(
    input: &DeriveInput,
    syntax: &MechanismSyntax,
    delivery: &Delivery,
    model: Option<&Model>,
) -> TokenStream {
    let (name, facade) = (&input.ident, &delivery.facade);
    let fingerprint = wire::fingerprint([&delivery.payload, &delivery.definitions]);
    let carrier = wire::carrier(wire::Carrier {
        name,
        visibility: &input.vis,
        facade,
        fingerprint,
        definition: wire::assembly(&delivery.payload, &delivery.definitions, model.is_some()),
        word: "assembly",
    });
    let fields = fields(input);
    let (generics, arguments, clause) = input.generics.split_for_impl();
    let types = fields.iter().enumerate().filter_map(|(number, field)| {
        let is_typed = field.attrs.iter().any(has_type);
        let path = carrier_path(element_type(&field.ty)).filter(|_| is_typed)?;
        Some(quote! {
            #[automatically_derived]
            impl #generics #facade::__private::FieldOf<#number> for #name #arguments #clause {
                type Type = #path;
            }
        })
    });
    let Some(model) = model else {
        let construction = super::fallback::construction(syntax, &quote!(Self));
        return quote! {
            #[automatically_derived]
            impl #generics #facade::__private::Element for #name #arguments #clause {}
            #[allow(warnings, clippy::all)]
            const _: () = {
                impl #generics #facade::__private::Assembly for #name #arguments #clause {
                    const FINGERPRINT: ::core::primitive::u64 = #fingerprint;
                    fn value(&self, _: ::core::primitive::usize) -> ::core::primitive::f64 { loop {} }
                }
                impl #generics ::core::default::Default for #name #arguments #clause {
                    fn default() -> Self { loop {} }
                }
                #(#types)*
                #construction
            };
            #carrier
        };
    };
    let values = model.values.iter().enumerate().map(|(number, value)| {
        let value = read(model, &value.name, facade);
        quote!(#number => #value,)
    });
    let used = fields.iter().filter_map(|field| field.ident.as_ref());
    let constants = model.constants.iter().map(|constant| {
        let number = wire::fingerprint([constant]);
        quote! {
            #[automatically_derived]
            impl #facade::__private::ConstantOf<#number> for #name {
                const VALUE: f64 = #constant;
            }
        }
    });
    let splines = model.splines.iter().filter_map(|spline| {
        let Table::Constant(path, table) = &spline.table else {
            return None;
        };
        let number = wire::fingerprint([path]);
        Some(quote! {
            #[automatically_derived]
            impl #facade::__private::TableOf<#number> for #name {
                const TABLE: #facade::__private::Table<'static> = #table;
            }
        })
    });
    let (lengths, construction) = (lengths(model), of_assembly(model));
    quote! {
        const _: () = {
            use ::core::primitive::{f64, u64, usize};

            #[automatically_derived]
            impl #facade::__private::Element for #name {}

            #[automatically_derived]
            impl #facade::__private::Assembly for #name {
                const FINGERPRINT: u64 = #fingerprint;

                fn value(&self, number: usize) -> f64 {
                    #( let _ = &self.#used; )*
                    match number {
                        #(#values)*
                        _ => 0.0,
                    }
                }
            }

            #(#types)*
            #(#constants)*
            #(#splines)*
            #lengths
        };

        #construction
        #carrier
    }
}

/// The named fields.
fn fields(input: &DeriveInput) -> Vec<&Field> {
    match &input.data {
        Data::Struct(data) => data
            .fields
            .iter()
            .filter(|field| field.ident.is_some())
            .collect(),
        _ => Vec::new(),
    }
}

fn has_type(attribute: &Attribute) -> bool {
    WITH_TYPES
        .iter()
        .any(|word| attribute.path().is_ident(word))
}
