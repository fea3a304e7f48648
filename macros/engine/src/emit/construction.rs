//! How a struct is made: `Default`, and `new` where it has parameters.
//!
//! It stands outside the anonymous constant of all else: there the compiler calls `new` by no name
//! that a user could write, where it advises it in the place of a `default` that is not there.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::model::name::fields;
use crate::model::{Model, Name, RunTimeValue, ValueKind};
use crate::syntax::words::local;

/// `Default` without parameters, else `new` with one argument for each, which checks them.
pub(super) fn of_mechanism(model: &Model, facade: &TokenStream) -> TokenStream {
    let mechanism = local("mechanism");
    let (checked, refused) = if model.independence.likes.is_empty() {
        (
            quote!(parameters::<::core::primitive::f64>(&#mechanism)?),
            TokenStream::new(),
        )
    } else {
        let refused = " A value with which the mechanism cannot be assembled, or with which its equations do not depend on each other \
             as they do at the typical values of the parameters.";
        (
            quote!(check_likes::<::core::primitive::f64>(&#mechanism, ::core::option::Option::None)?),
            quote!(#[doc = #refused]),
        )
    };
    construction(model, "mechanism", |arguments, value| {
        quote! {
            ///
            /// # Errors
            /// A number that is not finite, or a mass, inertia, axis or orientation made of it that
            /// is not acceptable.
            #refused
            pub fn new(#arguments) -> ::core::result::Result<Self, #facade::ParameterError> {
                let #mechanism = #value;
                <Self as #facade::Mechanism>::#checked;
                ::core::result::Result::Ok(#mechanism)
            }
        }
    })
}

/// The same of an assembly. Its parameters are checked where the mechanism is made.
pub(super) fn of_assembly(model: &Model) -> TokenStream {
    construction(model, "part", |arguments, value| {
        quote! {
            #[must_use]
            pub fn new(#arguments) -> Self {
                #value
            }
        }
    })
}

fn construction(
    model: &Model,
    what: &str,
    new: impl FnOnce(TokenStream, TokenStream) -> TokenStream,
) -> TokenStream {
    let name = &model.name;
    let parts = parts(model).into_iter();
    let parts: Vec<_> = parts
        .map(|(part, length)| match length {
            // The standard library has a default of short arrays only.
            Some(_) => {
                quote!(#part: ::core::array::from_fn(|_| ::core::default::Default::default()),)
            }
            None => quote!(#part: ::core::default::Default::default(),),
        })
        .collect();
    let inputs = model.values.iter().filter(|value| value.is_input);
    let inputs = inputs.filter(|value| value.name.parts().is_empty());
    let is_number = |name: &Name| {
        let is_other = |value: &&RunTimeValue| value.kind != ValueKind::Number;
        let mut others = model.values.iter().filter(is_other);
        !others.any(|value| value.name.text() == name.text())
    };
    let inputs = fields(inputs.map(|value| &value.name)).into_iter();
    let inputs = inputs.map(|(input, length)| match length {
        Some(length) if is_number(input) => quote!(#input: [0.0; #length],),
        None if is_number(input) => quote!(#input: 0.0,),
        Some(length) => quote!(#input: [::core::default::Default::default(); #length],),
        None => quote!(#input: ::core::default::Default::default(),),
    });
    let inputs: Vec<_> = inputs.chain(starts(model)).collect();
    let has_inputs = model.values.iter().any(|value| value.is_input);
    let given = given(model);
    let default = |values: TokenStream| {
        quote! {
            #[automatically_derived]
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self {
                        #(#parts)*
                        #values
                        #(#inputs)*
                    }
                }
            }
        }
    };
    if given.is_empty() {
        return default(TokenStream::new());
    }
    let likes = super::likes::defaults(model).map(|_| {
        let values = given.iter().filter_map(|argument| {
            let (name, like) = (&argument.name, argument.like.as_ref()?);
            Some(quote!(#name: #like,))
        });
        default(values.collect())
    });
    let arguments: Vec<_> = given
        .iter()
        .map(|argument| {
            let (name, kind) = (&argument.name, &argument.kind);
            quote!(#name: #kind)
        })
        .collect();
    let given: Vec<_> = given.iter().map(|argument| &argument.name).collect();
    let documentation = format!(
        " The {what} with these parameters, in the order of its fields{}.",
        if has_inputs { "; inputs are zero" } else { "" }
    );
    let value = quote! {
        Self {
            #(#parts)*
            #( #given, )*
            #(#inputs)*
        }
    };
    let new = new(quote!(#(#arguments),*), value);
    quote! {
        #likes

        #[automatically_derived]
        #[allow(
            clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction, unused,
            unreachable_pub, unused_qualifications
        )]
        impl #name {
            #[doc = #documentation]
            #new
        }
    }
}

/// The user's own states at their starts.
fn starts(model: &Model) -> Vec<TokenStream> {
    let starts = || {
        let starts = model.values.iter().filter(|value| value.is_start);
        starts.filter(|value| value.name.parts().is_empty())
    };
    let fields = fields(starts().map(|value| &value.name)).into_iter();
    let written = fields.map(|(name, length)| {
        let own = starts().filter(|value| value.name.text() == name.text());
        let own = own.map(|value| value.like.unwrap_or_default());
        let field = name.field();
        match length {
            Some(_) => quote!(#field: [#(#own),*],),
            None => quote!(#field: #(#own)*,),
        }
    });
    written.collect()
}

/// An argument of `new`: its type, and its value where all parameters are what they are like.
struct Given {
    name: Ident,
    kind: TokenStream,
    like: Option<TokenStream>,
}

/// What `new` takes, in the order of the fields.
fn given(model: &Model) -> Vec<Given> {
    let mut parts = given_parts(model);
    let mut given: Vec<Given> = Vec::new();
    let own = model.values.iter().filter(|value| value.is_parameter());
    let mut own = own.peekable();
    while let Some(value) = own.next() {
        if let Some((top, _)) = value.name.parts().first() {
            if let Some(place) = parts.iter().position(|(field, ..)| field == top) {
                let (name, length, kind) = parts.swap_remove(place);
                let kind = length.map_or_else(|| kind.clone(), |length| quote!([#kind; #length]));
                let like = length.map_or_else(
                    || quote!(::core::default::Default::default()),
                    |_| {
                        quote!(::core::array::from_fn(|_| {
                            ::core::default::Default::default()
                        }))
                    },
                );
                given.push(Given {
                    name,
                    kind,
                    like: Some(like),
                });
            }
            continue;
        }
        let mut likes = vec![value.like];
        if value.name.index().is_some() {
            while let Some(other) = own.next_if(|other| other.name.text() == value.name.text()) {
                likes.push(other.like);
            }
        }
        let kind = match value.kind {
            ValueKind::Number => quote!(::core::primitive::f64),
            _ => value.written.clone(),
        };
        let length = likes.len();
        let likes: Option<Vec<f64>> = likes.into_iter().collect();
        let is_array = value.name.index().is_some();
        given.push(Given {
            name: value.name.field().clone(),
            kind: if is_array {
                quote!([#kind; #length])
            } else {
                kind
            },
            like: likes.map(|likes| {
                if is_array {
                    quote!([#(#likes),*])
                } else {
                    quote!(#(#likes)*)
                }
            }),
        });
    }
    given
}

/// The fields that are bodies, joints, forces and parts without parameters, and the lengths of
/// those that are arrays.
pub(super) fn parts(model: &Model) -> Vec<(&Ident, Option<usize>)> {
    let elements = model.elements().map(|element| &element.name);
    let bodies = model.bodies.iter().map(|body| &body.name);
    let points = model.points.iter().map(|point| &point.name);
    let own = bodies.chain(elements).chain(points);
    let parts = model.parts.iter().map(|part| &part.name);
    let parts = parts.filter(|part| !has_parameters(model, part));
    let own = own.chain(parts).filter(|name| name.parts().is_empty());
    let own = fields(own).into_iter();
    own.map(|(name, length)| (name.field(), length)).collect()
}

/// The parts with parameters, whose values are given; with their lengths and types.
pub(super) fn given_parts(model: &Model) -> Vec<(Ident, Option<usize>, TokenStream)> {
    let parts = model.parts.iter().filter(|part| {
        part.name.parts().is_empty() && part.name.is_first() && has_parameters(model, &part.name)
    });
    let length = |name: &Name| {
        let same = model.parts.iter().map(|part| &part.name);
        let same = same.filter(|other| other.parts().is_empty() && other.text() == name.text());
        name.index().map(|_| same.count())
    };
    parts
        .map(|part| {
            let field = part.name.field().clone();
            (field, length(&part.name), part.path.clone())
        })
        .collect()
}

/// Whether a parameter belongs to a field of the struct that is a part.
fn has_parameters(model: &Model, part: &Name) -> bool {
    let top = |value: &Name| {
        let first = value.parts().first();
        first.is_some_and(|(field, _)| field == part.field())
    };
    let mut parameters = model.values.iter().filter(|value| value.is_parameter());
    parameters.any(|value| top(&value.name))
}
