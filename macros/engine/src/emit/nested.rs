//! Values by the names of fields, put together again as the struct has them: arrays and parts.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::model::Name;

/// What belongs to a field.
#[derive(Debug)]
pub(super) enum Nested<T> {
    One(T),
    Elements(Vec<Nested<T>>),
    Part(Fields<T>),
}

/// The fields of a struct in order, as far as something belongs to them.
#[derive(Debug)]
pub(super) struct Fields<T>(pub(super) Vec<(Ident, Nested<T>)>);

/// Some values as the fields have them.
pub(super) fn nested<'n, T>(values: impl IntoIterator<Item = (&'n Name, T)>) -> Fields<T> {
    let mut all = Fields(Vec::new());
    for (name, value) in values {
        let steps: Vec<_> = name.steps().collect();
        all.insert(&steps, value);
    }
    all
}

impl<T> Fields<T> {
    fn insert(&mut self, steps: &[(Ident, Option<usize>)], value: T) {
        let [(field, index), inner @ ..] = steps else {
            return;
        };
        let known = self.0.iter().position(|(known, _)| known == field);
        let place = known.unwrap_or_else(|| {
            let empty = index.map_or_else(|| Nested::Part(Self(Vec::new())), |_| Nested::NONE);
            self.0.push((field.clone(), empty));
            self.0.len() - 1
        });
        let Some((_, found)) = self.0.get_mut(place) else {
            return;
        };
        let own = match (found, index) {
            (Nested::Elements(elements), Some(index)) => {
                while elements.len() <= *index {
                    elements.push(Nested::Part(Self(Vec::new())));
                }
                &mut elements[*index]
            }
            (own, _) => own,
        };
        match own {
            Nested::Part(fields) if !inner.is_empty() => fields.insert(inner, value),
            own => *own = Nested::One(value),
        }
    }
}

impl<T> Nested<T> {
    const NONE: Self = Self::Elements(Vec::new());
}

/// Structs with a type and a value for every field. Parts of equal fields have one struct.
pub(super) struct Structs {
    /// The name of the outermost one; those of parts have a number behind it.
    name: &'static str,
    /// Attributes.
    head: TokenStream,
    /// Generic parameters.
    generics: TokenStream,
    /// The fields of each part so far.
    parts: Vec<TokenStream>,
}

impl Structs {
    pub(super) fn new(name: &'static str, head: TokenStream, generics: TokenStream) -> Self {
        Self {
            name,
            head,
            generics,
            parts: Vec::new(),
        }
    }

    /// The declarations of all of them, and the value of the outermost.
    pub(super) fn written(
        mut self,
        fields: &Fields<(TokenStream, TokenStream)>,
    ) -> (TokenStream, TokenStream) {
        let (types, values) = self.fields(fields);
        let name = format_ident!("{}", self.name);
        let (head, generics) = (&self.head, &self.generics);
        let parts = self.parts.iter().enumerate().map(|(place, types)| {
            let name = self.part(place);
            quote!(#head pub struct #name #generics { #types })
        });
        let declared = quote! {
            #head
            pub struct #name #generics { #types }
            #(#parts)*
        };
        (declared, quote!(#name { #values }))
    }

    fn part(&self, place: usize) -> Ident {
        format_ident!("{}{place}", self.name)
    }

    fn fields(
        &mut self,
        fields: &Fields<(TokenStream, TokenStream)>,
    ) -> (TokenStream, TokenStream) {
        let (mut types, mut values) = (TokenStream::new(), TokenStream::new());
        for (field, nested) in &fields.0 {
            let (kind, value) = self.one(nested);
            types.extend(quote!(pub #field: #kind,));
            values.extend(quote!(#field: #value,));
        }
        (types, values)
    }

    fn one(&mut self, nested: &Nested<(TokenStream, TokenStream)>) -> (TokenStream, TokenStream) {
        match nested {
            Nested::One(own) => own.clone(),
            Nested::Part(fields) => {
                let (types, values) = self.fields(fields);
                let text = types.to_string();
                let known = self
                    .parts
                    .iter()
                    .position(|known| known.to_string() == text);
                let place = known.unwrap_or_else(|| {
                    self.parts.push(types);
                    self.parts.len() - 1
                });
                let (name, generics) = (self.part(place), &self.generics);
                (quote!(#name #generics), quote!(#name { #values }))
            }
            Nested::Elements(elements) => {
                let count = elements.len();
                let elements: Vec<_> = elements.iter().map(|element| self.one(element)).collect();
                // The elements of an array have one type.
                let kind = elements.first().map(|(kind, _)| kind);
                let values = elements.iter().map(|(_, value)| value);
                (quote!([#kind; #count]), quote!([#(#values),*]))
            }
        }
    }
}
