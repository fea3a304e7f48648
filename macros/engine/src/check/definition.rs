//! What the types of fields turned out to be.

use crate::model::BodyKind;
use crate::syntax::mechanism::{Field, carrier_path};

/// What a field's type turned out to be.
#[derive(Clone, Debug)]
pub enum Definition {
    /// A rigid body or a particle.
    Body(BodyKind),
    /// A joint or force by its place among the definitions.
    Element(usize),
    /// An assembly.
    Assembly,
    /// A joint or force with a fault in its definition, which is reported where it is defined.
    Faulty,
}

/// The definitions behind the field types, by context and path as it was written.
pub type Definitions = Vec<(String, Definition)>;

/// What the type of a field turned out to be.
#[must_use]
pub fn definition<'a>(field: &Field, types: &'a Definitions) -> Option<&'a Definition> {
    let path = format!("{}{}", field.context, carrier_path(&field.ty)?);
    types
        .iter()
        .find(|(known, _)| *known == path)
        .map(|(_, definition)| definition)
}
