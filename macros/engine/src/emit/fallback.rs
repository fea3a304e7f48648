//! A stub implementation beside the errors, so that the user sees those and no others.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::check::mechanism::{Definition, Definitions, definition};
use crate::syntax::mechanism::{Field, MechanismSyntax, Role, carrier_path};

/// Writes the stub of a faulty mechanism.
#[must_use]
pub fn emit(syntax: &MechanismSyntax, types: &Definitions, facade: &TokenStream) -> TokenStream {
    let name = &syntax.name;
    let (declared, arguments, clause) = syntax.generics.split_for_impl();
    let bounds = clause.map(|clause| &clause.predicates);
    let handles = syntax.fields.iter().map(|field| {
        let (name, handle) = (&field.name, handle(field, types));
        quote!(#name: #handle,)
    });
    quote! {
        #facade::__stub_mechanism! { [#declared] [#name #arguments] [#bounds] #(#handles)* }
    }
}

/// `body`, `joint` with its type, or `joint` where the type is none.
fn handle(field: &Field, types: &Definitions) -> TokenStream {
    match (definition(field, types), &field.role) {
        (Some(Definition::Joint(_) | Definition::Faulty), _) => match carrier_path(&field.ty) {
            Some(path) => quote!(joint #path),
            None => quote!(joint),
        },
        (Some(Definition::Body(_)), _) | (None, Some((Role::Body, _))) => quote!(body),
        (None, Some((Role::Joint, _))) => quote!(joint),
        // Not described, and of a type that no other field has: its name is all there is to go by.
        (None, None) => {
            let text = field.ty.to_token_stream().to_string();
            let last = text.rsplit(' ').next();
            if matches!(last, Some("Body" | "Particle")) {
                quote!(body)
            } else {
                quote!(joint)
            }
        }
    }
}
