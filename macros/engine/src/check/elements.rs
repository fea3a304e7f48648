//! What `rod` and `links[3]` name.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use syn::{Expr, Member};

use crate::diag::{Faults, code};
use crate::model::Name;
use crate::model::name::Step;
use crate::syntax::array::INDEX;
use crate::syntax::integer::integer;
use crate::syntax::ungroup;

/// A field, or an element of one, as it is written: by itself or behind the parts that it lies in.
#[derive(Clone)]
pub(super) struct Reference<'a> {
    /// The parts, with what stands in their brackets.
    parts: Vec<(&'a Ident, Option<&'a Expr>)>,
    /// The field.
    pub(super) field: &'a Ident,
    /// All that is written, and what stands in the last brackets.
    element: Option<(&'a Expr, &'a Expr)>,
    /// All that is written.
    whole: &'a Expr,
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
        let alone = |field, element| Self {
            parts: Vec::new(),
            field,
            element,
            whole: expr,
        };
        match ungroup(expr) {
            Expr::Path(path) => path.path.get_ident().map(|field| alone(field, None)),
            Expr::Index(index) => {
                let inner = Self::of(&index.expr)?;
                let element = Some((expr, &*index.index));
                let is_single = inner.element.is_none();
                is_single.then_some(Self {
                    element,
                    whole: expr,
                    ..inner
                })
            }
            Expr::Field(field) => {
                let Member::Named(name) = &field.member else {
                    return None;
                };
                let mut inner = Self::of(&field.base)?;
                let index = inner.element.map(|(_, index)| index);
                inner.parts.push((inner.field, index));
                Some(Self {
                    field: name,
                    element: None,
                    whole: expr,
                    ..inner
                })
            }
            _ => None,
        }
    }

    /// Where a message about its name belongs.
    pub(super) fn at(&self) -> TokenStream {
        match self.parts[..] {
            [] => self.field.to_token_stream(),
            _ => self.whole.to_token_stream(),
        }
    }

    /// Whether it is a field of a part.
    pub(super) const fn is_in_part(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The name without the number of its last element, for messages.
    pub(super) fn text(&self) -> String {
        let parts = self.parts.iter().map(|(field, index)| match index {
            Some(index) => format!("{field}[{}].", code(index)),
            None => format!("{field}."),
        });
        parts.collect::<String>() + &self.field.to_string()
    }

    /// The way to the parts, seen from where it is written.
    fn steps(&self, by: &Name, faults: &mut Faults) -> Option<Vec<Step>> {
        let mut steps = by.parts().to_vec();
        for (field, index) in &self.parts {
            let index = match index {
                Some(index) => usize::try_from(faults.accept(integer(index))?).ok(),
                None => None,
            };
            steps.push(((*field).clone(), index));
        }
        Some(steps)
    }

    /// Finds it among names; `by` is the field or element whose attribute speaks of it.
    pub(super) fn find<'n>(
        &self,
        names: impl IntoIterator<Item = &'n Name>,
        unmeasured: &[Ident],
        by: &Name,
        faults: &mut Faults,
    ) -> Found {
        let Some(steps) = self.steps(by, faults) else {
            return Found::Refused;
        };
        let by = by.index();
        let names = names.into_iter().enumerate();
        let own: Vec<(usize, &Name)> = names
            .filter(|(_, name)| name.field() == self.field && name.parts() == steps)
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

    fn outside(&self, length: usize, index: i64, by: Option<usize>) -> String {
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

/// The fields of some names, for a list of what there is, seen from one of them: `rod`,
/// `links[0..16]`, `left.rod`.
pub(super) fn known<'a>(names: impl IntoIterator<Item = &'a Name>, by: &Name) -> Vec<String> {
    let scope = by.parts();
    let depth: usize = scope
        .iter()
        .map(|(field, index)| {
            let index = index.map_or(0, |index| format!("[{index}]").len());
            field.to_string().len() + index + 1
        })
        .sum();
    let names = names
        .into_iter()
        .filter(|name| name.parts().starts_with(scope));
    let fields = crate::model::name::fields(names).into_iter();
    let written = |(name, length): (&Name, Option<usize>)| {
        let text = &name.text()[depth..];
        match length {
            Some(length) => format!("{text}[0..{length}]"),
            None => text.to_owned(),
        }
    };
    fields.map(written).collect()
}

/// The name of the field alone, of one of these.
pub(super) fn bare(known: &str) -> &str {
    known.split('[').next().unwrap_or(known)
}
