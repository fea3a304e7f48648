//! The names of bodies, joints, forces and values: a field, or an element of a field that is an
//! array, of the mechanism or of one of its parts.

use std::cmp::Ordering;
use std::fmt::{self, Display};

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

/// A field and the element of it, on the way into a part.
pub type Step = (Ident, Option<usize>);

/// A field, or an element of one, of the mechanism or of a part of it. As tokens it is the field's
/// name, where the user wrote it; in words it is `rod`, `links[3]` or `left.rod`.
#[derive(Clone, Debug)]
pub struct Name {
    /// The parts that it lies in, the outermost first.
    parts: Vec<Step>,
    field: Ident,
    /// All but the number of the element: asking an identifier for it again and again costs time.
    text: String,
    index: Option<usize>,
}

impl Name {
    /// An element of a field that is an array.
    #[must_use]
    pub fn element(field: Ident, index: usize) -> Self {
        let name = Self::from(field);
        Self {
            index: Some(index),
            ..name
        }
    }

    /// The same field in a part.
    #[must_use]
    pub fn within(&self, part: &Self) -> Self {
        let parts = part.steps().chain(self.parts.iter().cloned());
        Self {
            parts: parts.collect(),
            text: format!("{part}.{}", self.text),
            ..self.clone()
        }
    }

    /// The parts that it lies in, the outermost first.
    #[must_use]
    pub fn parts(&self) -> &[Step] {
        &self.parts
    }

    /// The way to it: its parts, then itself.
    pub fn steps(&self) -> impl Iterator<Item = Step> {
        let own = (self.field.clone(), self.index);
        self.parts.iter().cloned().chain(std::iter::once(own))
    }

    /// The field.
    #[must_use]
    pub const fn field(&self) -> &Ident {
        &self.field
    }

    /// The field with its parts in words, without the number of the element.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Which element it is; `None` of a field that is no array.
    #[must_use]
    pub const fn index(&self) -> Option<usize> {
        self.index
    }

    /// Whether the field appears here first: what is said once for each field is said here.
    #[must_use]
    pub const fn is_first(&self) -> bool {
        matches!(self.index, None | Some(0))
    }

    /// How a field of the struct is read: `rod`, `links[3]` or `left.rod`.
    #[must_use]
    pub fn place(&self) -> TokenStream {
        let steps = self.steps().map(|(field, index)| match index {
            Some(index) => {
                let index = Literal::usize_unsuffixed(index);
                quote!(#field[#index])
            }
            None => quote!(#field),
        });
        quote!(#(#steps).*)
    }

    /// One word for it, for local names: `rod`, `links_3` or `left__rod`.
    #[must_use]
    pub fn word(&self) -> String {
        let word = |(field, index): Step| {
            let field = field.to_string();
            let field = field.trim_start_matches("r#");
            index.map_or(field.into(), |index| format!("{field}_{index}"))
        };
        self.steps().map(word).collect::<Vec<_>>().join("__")
    }
}

impl From<Ident> for Name {
    fn from(field: Ident) -> Self {
        Self {
            parts: Vec::new(),
            text: field.to_string(),
            field,
            index: None,
        }
    }
}

impl Display for Name {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.index {
            Some(index) => write!(formatter, "{}[{index}]", self.text),
            None => formatter.write_str(&self.text),
        }
    }
}

impl ToTokens for Name {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        self.field.to_tokens(tokens);
    }
}

/// By the name of the field, then by the number of the element: `links[2]` before `links[10]`.
impl Ord for Name {
    fn cmp(&self, other: &Self) -> Ordering {
        (&self.text, self.index).cmp(&(&other.text, other.index))
    }
}

impl PartialOrd for Name {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Name {}

/// The fields of some names in order, each once and by its first element, with the number of
/// elements of arrays.
pub fn fields<'a>(names: impl IntoIterator<Item = &'a Name>) -> Vec<(&'a Name, Option<usize>)> {
    let mut fields: Vec<(&Name, Option<usize>)> = Vec::new();
    for name in names {
        match (name.index, fields.last_mut()) {
            (Some(1..), Some((_, Some(length)))) => *length += 1,
            (index, _) => fields.push((name, index.map(|_| 1))),
        }
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::{Name, fields};
    use quote::format_ident;

    #[test]
    fn elements_are_in_the_order_of_their_numbers() {
        let links = |index| Name::element(format_ident!("links"), index);
        let rod = Name::from(format_ident!("rod"));
        assert!(links(2) < links(10) && links(10) < rod);
        assert_eq!(links(10).to_string(), "links[10]");
        assert_eq!(links(10).word(), "links_10");
        assert!(rod == rod.clone() && links(0) != links(1));
        let names = [links(0), links(1), rod, links(0)];
        let lengths: Vec<_> = fields(&names).iter().map(|(_, length)| *length).collect();
        assert_eq!(lengths, [Some(2), None, Some(1)]);
    }

    #[test]
    fn a_part_stands_before_its_fields() {
        let wheel = Name::element(format_ident!("wheels"), 2);
        let left = Name::element(format_ident!("axles"), 1).within(&format_ident!("car").into());
        let wheel = wheel.within(&left);
        assert_eq!(wheel.to_string(), "car.axles[1].wheels[2]");
        assert_eq!(wheel.word(), "car__axles_1__wheels_2");
        let place = wheel.place().to_string().replace(' ', "");
        assert_eq!(place, wheel.to_string());
    }
}
