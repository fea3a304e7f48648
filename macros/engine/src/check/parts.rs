//! The attributes of parts: where each is, and which bodies its ports are.

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use super::between::Between;
use super::bodies;
use super::number::Numbers;
use super::pairs::Pairs;
use super::placement::Placement;
use super::turning::Turn;
use crate::diag::Faults;
use crate::model::name::Step;
use crate::model::{Name, Number};
use crate::syntax::mechanism::{MechanismSyntax, PartSyntax};
use crate::syntax::ungroup;

/// What the attribute of a part takes besides its ports.
pub(super) const KEYS: [&str; 3] = ["at", "rotation", "mirror"];
/// What `mirror` takes.
const MIRRORS: [(&str, Option<usize>); 4] = [
    ("x", Some(0)),
    ("y", Some(1)),
    ("z", Some(2)),
    ("none", None),
];

/// A part whose attribute was read.
pub(super) struct Part<'a> {
    syntax: &'a PartSyntax,
    steps: Vec<Step>,
    /// Where it is; `None` if that was refused.
    pub(super) placement: Option<Placement>,
    mirror: Option<Span>,
    /// Its ports, and what is given for each.
    ports: Vec<(&'a Name, Option<&'a Expr>)>,
}

impl<'a> Part<'a> {
    /// Its name.
    pub(super) const fn name(&self) -> &'a Name {
        &self.syntax.name
    }

    /// The way to it, with which the names in it begin.
    pub(super) fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Where it is said that it is mirrored.
    pub(super) fn mirror_span(&self) -> Span {
        self.mirror.unwrap_or_else(|| self.syntax.word.span())
    }
}

/// Reads the attributes of all parts, each before those in it.
pub(super) fn parts<'a>(
    syntax: &'a MechanismSyntax,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Vec<Part<'a>> {
    let mut parts: Vec<Part<'a>> = Vec::new();
    for written in &syntax.parts {
        let part = faults.within(&written.name, |faults| {
            let mut part = part(written, numbers, faults);
            if let Some(origin) = written.origin {
                let outer = &parts[origin.part];
                part.mirror = part.mirror.or(outer.mirror);
                part.placement = match (&outer.placement, part.placement) {
                    (Some(outer), Some(own)) => Some(outer.of_part(&own, numbers)),
                    _ => None,
                };
            }
            part
        });
        parts.push(part);
    }
    parts
}

fn part<'a>(written: &'a PartSyntax, numbers: &mut Numbers<'_>, faults: &mut Faults) -> Part<'a> {
    let name = &written.name;
    let mut pairs = Pairs::new(format!("part `{name}`"), written.word.span(), &written.list);
    numbers.field = name.clone();
    numbers.no_inputs = Some("a part is what it is for the whole run; make it a `#[param]`");
    numbers.attribute = "at".into();
    let at = match pairs.optional("at", faults) {
        Some(expr) => numbers.vector(expr, faults),
        None => Some([Number::ZERO; 3]),
    };
    let rotation = match pairs.optional("rotation", faults) {
        Some(expr) => bodies::rotation(name, "rotation", expr, numbers, faults),
        None => Some(Turn::NONE),
    };
    let written_mirror = pairs.optional("mirror", faults);
    let mirror = written_mirror.map_or(Some(None), |expr| mirror(expr, faults));
    numbers.no_inputs = None;
    let ports = written.ports.iter().map(|port| {
        let key = port.field().to_string();
        let example = format!("a body or `ground`, as in `{key} = ground`");
        (port, pairs.required(&key, &example, faults))
    });
    let ports = ports.collect();
    pairs.finish(faults);
    let placement = match (at, rotation, mirror) {
        (Some(at), Some(rotation), Some(mirror)) => Some(Placement {
            mirror,
            rotation,
            at,
        }),
        _ => None,
    };
    Part {
        syntax: written,
        steps: name.steps().collect(),
        placement,
        mirror: written_mirror.map(Spanned::span),
        ports,
    }
}

/// The axis across the plane of a mirror.
fn mirror(expr: &Expr, faults: &mut Faults) -> Option<Option<usize>> {
    if let Expr::Path(path) = ungroup(expr) {
        let known = MIRRORS.iter().find(|(word, _)| path.path.is_ident(word));
        if let Some((_, axis)) = known {
            return Some(*axis);
        }
    }
    faults.at(
        expr,
        "`mirror` takes the axis across the plane of the mirror, `x`, `y` or `z`, or `none`",
    );
    None
}

/// Finds the bodies that ports are; an outer part comes before those in it.
pub(super) fn ports<'a>(parts: &[Part<'a>], between: &mut Between<'a>, faults: &mut Faults) {
    for part in parts {
        for (port, expr) in &part.ports {
            let body = faults.within(part.name(), |faults| {
                expr.and_then(|expr| between.body(expr, part.name(), faults))
            });
            between.ports.push((port, body));
        }
    }
}
