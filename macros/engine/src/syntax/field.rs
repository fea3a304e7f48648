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
    /// `#[part(..)]`: an assembly.
    Part,
    /// `#[port]`: a body of an assembly that its user names.
    Port,
    /// `#[param]`.
    Param,
    /// `#[input]`.
    Input,
}

impl Role {
    pub(super) const ALL: [(&'static str, Self); 7] = [
        ("body", Self::Body),
        ("joint", Self::Joint),
        ("force", Self::Force),
        ("part", Self::Part),
        ("port", Self::Port),
        ("param", Self::Param),
        ("input", Self::Input),
    ];

    /// Whether the field's type is a body, a joint, a force or an assembly.
    #[must_use]
    pub const fn has_carrier(self) -> bool {
        matches!(self, Self::Body | Self::Joint | Self::Force | Self::Part)
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
    /// Where its type has its meaning: nothing in the mechanism itself, else the path of the part's
    /// type and `/`.
    pub context: String,
    /// The part whose field it is.
    pub origin: Option<Origin>,
}

/// A field of an assembly.
#[derive(Clone, Copy, Debug)]
pub struct Origin {
    /// The place of the part.
    pub part: usize,
    /// The number of the field in its struct.
    pub number: usize,
}
