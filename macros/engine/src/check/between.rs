//! Bodies by their names: those of the mechanism, of its parts, and the ports of parts.

use proc_macro2::Ident;
use syn::Expr;

use super::elements::{Found, Reference, bare, known};
use super::number::elements;
use crate::diag::{Faults, did_you_mean, list};
use crate::model::{ElementKind, Name};

/// The bodies that joints name, by their places.
pub(super) struct Mentioned {
    pub(super) bodies: Vec<bool>,
    /// Whether all names could be read; if not, the body that seems to be left alone may be meant
    /// by one of the others.
    pub(super) is_certain: bool,
}

/// What joints may name.
pub(super) struct Between<'a> {
    /// The bodies, in their order.
    pub(super) names: Vec<&'a Name>,
    /// The ports of parts, and the bodies that they are: `Some(None)` is the ground, and `None`
    /// something that was reported.
    pub(super) ports: Vec<(&'a Name, Option<Option<usize>>)>,
    /// Arrays whose length was refused.
    pub(super) unmeasured: &'a [Ident],
}

impl Between<'_> {
    /// Reads the list of `between`.
    pub(super) fn read(
        &self,
        expr: &Expr,
        kind: ElementKind,
        by: &Name,
        mentioned: &mut Mentioned,
        faults: &mut Faults,
    ) -> Option<Vec<Option<usize>>> {
        let Some(elements) = elements(expr) else {
            faults.at(
                expr,
                "`between` takes bodies in brackets, as in `[ground, rod]`",
            );
            mentioned.is_certain = false;
            return None;
        };
        let mut bodies: Vec<Option<Option<usize>>> = Vec::new();
        for element in &elements {
            let place = self.body(element, by, faults);
            match place {
                Some(Some(place)) => mentioned.bodies[place] = true,
                Some(None) => {}
                None => mentioned.is_certain = false,
            }
            if place.is_some() && bodies.contains(&place) {
                let twice = match place {
                    Some(Some(place)) => self.names[place].to_string(),
                    _ => "ground".into(),
                };
                faults.at(
                    element,
                    format!(
                        "a {} between `{twice}` and itself does nothing; name each body once",
                        kind.word()
                    ),
                );
            }
            bodies.push(place);
        }
        bodies.into_iter().collect()
    }

    /// A body by its name, as the attribute of the field `by` writes it; `None` in it is the
    /// ground.
    pub(super) fn body(
        &self,
        expr: &Expr,
        by: &Name,
        faults: &mut Faults,
    ) -> Option<Option<usize>> {
        let names = self.names.iter().copied();
        let ports = self.ports.iter().map(|(name, _)| *name);
        let known = || {
            let fields = names.clone().filter(|name| name.field() != "ground");
            let own = ports.clone().filter(|port| port.parts() == by.parts());
            let mut known = known(fields.chain(own), by);
            known.push("ground".into());
            known
        };
        let Some(reference) = Reference::of(expr) else {
            let known = list(known());
            faults.at(
                expr,
                format!("expected the name of a body; there are {known}"),
            );
            return None;
        };
        match reference.find(names.clone(), self.unmeasured, by, faults) {
            Found::At(place) => return Some(Some(place)),
            Found::Refused => return None,
            Found::Nothing => {}
        }
        match reference.find(ports.clone(), &[], by, faults) {
            Found::At(place) => return self.ports[place].1,
            Found::Refused => return None,
            Found::Nothing => {}
        }
        let ground = Name::from(Ident::new("ground", reference.field.span()));
        if !reference.is_in_part() {
            match reference.find([&ground], &[], &ground, faults) {
                Found::At(_) => return Some(None),
                Found::Refused => return None,
                Found::Nothing => {}
            }
        }
        let (found, known) = (reference.text(), known());
        let near = did_you_mean(&found, known.iter().map(|name| bare(name)));
        let whole = if by.parts().is_empty() {
            "mechanism"
        } else {
            "assembly"
        };
        faults.at(
            reference.at(),
            format!(
                "no body `{found}` in this {whole}; it has {}{near}",
                list(known.iter())
            ),
        );
        None
    }
}
