//! The names of bodies, joints, forces and values: a field, or an element of a field that is an
//! array.

use std::cmp::Ordering;
use std::fmt::{self, Display};

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

/// A field, or an element of one. As tokens it is the field's name, where the user wrote it; in
/// words it is `rod` or `links[3]`.
#[derive(Clone, Debug)]
pub struct Name {
    field: Ident,
    /// The field's name: asking an identifier for it again and again costs time.
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

    /// The field.
    #[must_use]
    pub const fn field(&self) -> &Ident {
        &self.field
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

    /// How a field of the struct is read: `rod` or `links[3]`.
    #[must_use]
    pub fn place(&self) -> TokenStream {
        let field = &self.field;
        match self.index {
            Some(index) => {
                let index = Literal::usize_unsuffixed(index);
                quote!(#field[#index])
            }
            None => quote!(#field),
        }
    }

    /// One word for it, for local names: `rod` or `links_3`.
    #[must_use]
    pub fn word(&self) -> String {
        let text = self.text.trim_start_matches("r#");
        match self.index {
            Some(index) => format!("{text}_{index}"),
            None => text.into(),
        }
    }
}

impl From<Ident> for Name {
    fn from(field: Ident) -> Self {
        Self {
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

/// The fields of some names in order, each once, with the number of elements of arrays.
pub fn fields<'a>(names: impl IntoIterator<Item = &'a Name>) -> Vec<(&'a Ident, Option<usize>)> {
    let mut fields: Vec<(&Ident, Option<usize>)> = Vec::new();
    for name in names {
        match (name.index, fields.last_mut()) {
            (Some(1..), Some((_, Some(length)))) => *length += 1,
            (index, _) => fields.push((&name.field, index.map(|_| 1))),
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
}
