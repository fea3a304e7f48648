//! Fields of an annotated struct.

use syn::Type;

use super::List;
use crate::model::Name;

/// What a field is described as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// `#[body(..)]`.
    Body,
    /// `#[joint(..)]`.
    Joint,
    /// `#[force(..)]`.
    Force,
    /// `#[param]`.
    Param,
    /// `#[input]`.
    Input,
}

impl Role {
    pub(super) const ALL: [(&'static str, Self); 5] = [
        ("body", Self::Body),
        ("joint", Self::Joint),
        ("force", Self::Force),
        ("param", Self::Param),
        ("input", Self::Input),
    ];

    /// Whether the field's type is a body, a joint or a force.
    #[must_use]
    pub const fn is_part(self) -> bool {
        matches!(self, Self::Body | Self::Joint | Self::Force)
    }
}

/// A field of the struct, or an element of a field that is an array.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its name.
    pub name: Name,
    /// The type as it stands in the struct.
    pub written: Type,
    /// The type, of an element if it is one.
    pub ty: Type,
    /// What it is described as, and the attribute's word.
    pub role: Option<(Role, syn::Path)>,
    /// The list of its attribute.
    pub list: List,
}
