//! The fields of a struct by their attributes, one after the other.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::{Attribute, Data, DeriveInput, Fields};

use super::field::{Field, Role};
use super::{List, array};
use crate::diag::Faults;

/// The fields of a struct with named fields; none of anything else.
pub(super) fn named_fields(input: &DeriveInput) -> impl Iterator<Item = &syn::Field> {
    match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => Some(fields.named.iter()),
            _ => None,
        },
        _ => None,
    }
    .into_iter()
    .flatten()
}

pub(super) fn role(attribute: &Attribute) -> Option<Role> {
    let mut roles = Role::ALL.into_iter();
    let known = roles.find(|(word, _)| attribute.path().is_ident(word));
    known.map(|(_, role)| role)
}

pub(super) fn parse_field(name: Ident, field: &syn::Field, faults: &mut Faults) -> Field {
    let mut result = Field {
        name: name.into(),
        written: field.ty.clone(),
        ty: array::element_type(&field.ty).clone(),
        role: None,
        list: List::default(),
        context: String::new(),
        origin: None,
    };
    for attribute in &field.attrs {
        if attribute.path().is_ident("mechanism") {
            faults.at(
                attribute.path(),
                "`#[mechanism(..)]` describes the struct, not a field",
            );
        }
        let Some(role) = role(attribute) else {
            continue;
        };
        if result.role.is_some() {
            faults.at(
                attribute.path(),
                format!(
                    "`{}` is described twice; one attribute says what it is",
                    result.name
                ),
            );
            continue;
        }
        result.role = Some((role, attribute.path().clone()));
        let has_list = matches!(role, Role::Param | Role::Input | Role::Point | Role::State);
        if role.has_carrier() || has_list {
            result.list = super::list(attribute, faults);
        } else if !matches!(attribute.meta, syn::Meta::Path(_)) {
            let word = attribute.path().to_token_stream();
            faults.at(
                attribute,
                format!(
                    "`#[{word}]` takes nothing besides: it stands above a `Body`, which is named where the assembly is a part"
                ),
            );
        }
    }
    result
}
