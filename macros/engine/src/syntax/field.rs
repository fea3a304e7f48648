//! Fields of an annotated struct.

use proc_macro2::TokenStream;
use quote::ToTokens;
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
    /// `#[point(..)]`: a named point of a body.
    Point,
    /// `#[part(..)]`: an assembly.
    Part,
    /// `#[port]`: a body of an assembly that its user names.
    Port,
    /// `#[param]`.
    Param,
    /// `#[input]`.
    Input,
    /// `#[state(rate = ..)]`: a state of the user's own.
    State,
}

impl Role {
    pub(super) const ALL: [(&'static str, Self); 9] = [
        ("body", Self::Body),
        ("joint", Self::Joint),
        ("force", Self::Force),
        ("point", Self::Point),
        ("part", Self::Part),
        ("port", Self::Port),
        ("param", Self::Param),
        ("input", Self::Input),
        ("state", Self::State),
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

/// The path by which a type's carrier is called; `None` for a type that cannot be that of a joint
/// or body.
#[must_use]
pub fn carrier_path(ty: &Type) -> Option<TokenStream> {
    // What is surely neither: calling it as a macro would only hide our own sentence.
    const OTHERS: [&str; 28] = [
        "Arc",
        "Box",
        "Cell",
        "HashMap",
        "Option",
        "PhantomData",
        "Rc",
        "RefCell",
        "Result",
        "String",
        "Vec",
        "bool",
        "char",
        "f32",
        "f64",
        "i128",
        "i16",
        "i32",
        "i64",
        "i8",
        "isize",
        "str",
        "u128",
        "u16",
        "u32",
        "u64",
        "u8",
        "usize",
    ];
    match ty {
        Type::Group(group) => carrier_path(&group.elem),
        Type::Paren(paren) => carrier_path(&paren.elem),
        Type::Path(path) if path.qself.is_none() => {
            let last = path.path.segments.last()?;
            if OTHERS.iter().any(|other| last.ident == other) {
                return None;
            }
            let mut path = path.path.clone();
            for segment in &mut path.segments {
                segment.arguments = syn::PathArguments::None;
            }
            Some(path.into_token_stream())
        }
        _ => None,
    }
}
