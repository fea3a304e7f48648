//! What `rod` and `links[3]` name.

use proc_macro2::Ident;
use syn::Expr;

use crate::diag::Faults;
use crate::model::Name;
use crate::syntax::array::INDEX;
use crate::syntax::integer::integer;
use crate::syntax::ungroup;

/// A field, or an element of one, as it is written.
#[derive(Clone, Copy)]
pub(super) struct Reference<'a> {
    /// The field.
    pub(super) field: &'a Ident,
    /// All that is written, and what stands in the brackets.
    element: Option<(&'a Expr, &'a Expr)>,
}

/// What a reference names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// By its place among the names.
    At(usize),
    /// Nothing: no field of these has that name.
    Nothing,
    /// Something that was reported.
    Refused,
}

impl<'a> Reference<'a> {
    /// The reference that an expression is; `None` if it is another expression.
    pub(super) fn of(expr: &'a Expr) -> Option<Self> {
        let field = |expr: &'a Expr| match ungroup(expr) {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        match ungroup(expr) {
            Expr::Index(index) => Some(Self {
                field: field(&index.expr)?,
                element: Some((expr, &index.index)),
            }),
            _ => Some(Self {
                field: field(expr)?,
                element: None,
            }),
        }
    }

    /// Finds it among names; `by` is the element whose attribute speaks of it.
    pub(super) fn find<'n>(
        self,
        names: impl IntoIterator<Item = &'n Name>,
        unmeasured: &[Ident],
        by: Option<usize>,
        faults: &mut Faults,
    ) -> Found {
        let names = names.into_iter().enumerate();
        let own: Vec<(usize, &Name)> = names
            .filter(|(_, name)| name.field() == self.field)
            .collect();
        let Some(&(first, name)) = own.first() else {
            return Found::Nothing;
        };
        if unmeasured.contains(self.field) {
            return Found::Refused;
        }
        match (name.index(), self.element) {
            (None, None) => Found::At(first),
            (None, Some((whole, _))) => {
                faults.at(whole, format!("`{name}` is no array; write `{name}` alone"));
                Found::Refused
            }
            (Some(_), None) => {
                let (field, length) = (self.field, own.len());
                let example = if by.is_some() { INDEX } else { "0" };
                faults.at(
                    field,
                    format!("`{field}` is an array of {length}; name one of them, as in `{field}[{example}]`"),
                );
                Found::Refused
            }
            (Some(_), Some((whole, index))) => {
                let Some(index) = faults.accept(integer(index)) else {
                    return Found::Refused;
                };
                let element = usize::try_from(index).ok();
                match element.and_then(|index| own.get(index)) {
                    Some(&(place, _)) => Found::At(place),
                    None => {
                        faults.at(whole, self.outside(own.len(), index, by));
                        Found::Refused
                    }
                }
            }
        }
    }

    fn outside(self, length: usize, index: i64, by: Option<usize>) -> String {
        let (field, last) = (self.field, length - 1);
        let elements = match length {
            1 => format!("1 element, `{field}[0]`"),
            _ => format!("{length} elements, `{field}[0]` to `{field}[{last}]`"),
        };
        let advice = by.map_or(String::new(), |by| {
            format!(
                " where `{INDEX}` is {by}; what stands there instead is said by `if {INDEX} == {by} {{ .. }} else {{ .. }}`"
            )
        });
        format!("`{field}` has {elements}; this is `{field}[{index}]`{advice}")
    }
}

/// The fields of some names, for a list of what there is: `rod`, `links[0..16]`.
pub(super) fn known<'a>(names: impl IntoIterator<Item = &'a Name>) -> Vec<String> {
    let fields = crate::model::name::fields(names).into_iter();
    let written = |(field, length): (&Ident, Option<usize>)| match length {
        Some(length) => format!("{field}[0..{length}]"),
        None => field.to_string(),
    };
    fields.map(written).collect()
}

/// The name of the field alone, of one of these.
pub(super) fn bare(known: &str) -> &str {
    known.split('[').next().unwrap_or(known)
}
