//! Fields that are assemblies: each field of the assembly becomes one of the mechanism, with the
//! name of the part before its own.
//!
//! What the names in its attributes mean stays with the part: they are looked up there first.

use syn::{DeriveInput, Type};

use super::List;
use super::array;
use super::attributes::{named_fields, parse_field};
use super::field::{Field, Origin, Role, carrier_path};
use crate::diag::Faults;
use crate::model::Name;

/// An assembly as written.
#[derive(Clone, Debug)]
pub struct AssemblySyntax {
    /// The annotated struct.
    pub input: DeriveInput,
    /// The fingerprint of its definition.
    pub fingerprint: u64,
    /// Whether it has no faults.
    pub is_sound: bool,
}

/// Assemblies by their types: context and path.
pub type Assemblies = Vec<(String, AssemblySyntax)>;

/// A field that is an assembly, or an element of one.
#[derive(Clone, Debug)]
pub struct PartSyntax {
    /// Its name.
    pub name: Name,
    /// The type as it stands in the struct.
    pub written: Type,
    /// The type, of an element if it is one.
    pub ty: Type,
    /// Context and path of the type: parts of one assembly have one.
    key: String,
    /// The word of its attribute.
    pub word: syn::Path,
    /// The list of its attribute.
    pub list: List,
    /// The part whose field it is.
    pub origin: Option<Origin>,
    /// The bodies that its user names.
    pub ports: Vec<Name>,
    /// The fingerprint of the assembly.
    pub fingerprint: u64,
    /// Whether the assembly has no faults.
    pub is_sound: bool,
}

/// Fields, and the parts that some of them belong to.
#[derive(Debug, Default)]
pub(super) struct Expanded {
    pub(super) fields: Vec<Field>,
    pub(super) parts: Vec<PartSyntax>,
}

impl PartSyntax {
    /// Whether another part is of the same assembly.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

/// Adds a field, or in its place the fields of the assembly that it is.
pub(super) fn expand(field: Field, assemblies: &Assemblies, result: &mut Expanded) {
    let Some((Role::Part, word)) = &field.role else {
        result.fields.push(field);
        return;
    };
    let key = carrier_path(&field.ty).map(|path| format!("{}{path}", field.context));
    let found = assemblies
        .iter()
        .find(|(known, _)| Some(known) == key.as_ref());
    let Some((key, assembly)) = found else {
        result.fields.push(field);
        return;
    };
    let part = result.parts.len();
    result.parts.push(PartSyntax {
        name: field.name.clone(),
        written: field.written.clone(),
        ty: field.ty.clone(),
        key: key.clone(),
        word: word.clone(),
        list: field.list.clone(),
        origin: field.origin,
        ports: Vec::new(),
        fingerprint: assembly.fingerprint,
        is_sound: assembly.is_sound,
    });
    // They are reported where the assembly is described.
    let mut known = Faults::new();
    let mut list = List::default();
    for attribute in &assembly.input.attrs {
        if attribute.path().is_ident("mechanism") {
            list.pairs.extend(super::list(attribute, &mut known).pairs);
        }
    }
    let lengths = array::lengths(&list, &mut known);
    for (number, written) in named_fields(&assembly.input).enumerate() {
        let Some(name) = written.ident.clone() else {
            continue;
        };
        let mut inner = parse_field(name, written, &mut known);
        inner.context = format!("{key}/");
        inner.origin = Some(Origin { part, number });
        for mut element in array::elements(inner, &lengths, &mut known).0 {
            element.name = element.name.within(&field.name);
            match element.role {
                Some((Role::Port, _)) => result.parts[part].ports.push(element.name),
                _ => expand(element, assemblies, result),
            }
        }
    }
    drop(known.into_tokens());
}
