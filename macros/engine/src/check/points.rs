//! Named points: the body that each is fixed on, and where it is at the start.

use quote::ToTokens;
use syn::Expr;
use syn::spanned::Spanned;

use super::apart;
use super::between::Between;
use super::elements::{Found, Reference};
use super::number::Numbers;
use super::pairs::Pairs;
use super::parts::Part;
use crate::diag::{Faults, code};
use crate::model::number::literals;
use crate::model::{Body, BodyKind, Name, NamedPoint, Number};
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};

/// The names of points, with what they mean; `None` for one that was refused.
pub(super) type NamedPoints<'a> = Vec<(&'a Name, Option<NamedPoint>)>;

/// The named points in the order of the fields.
pub(super) fn points<'a>(
    syntax: &'a MechanismSyntax,
    parts: &[Part<'_>],
    between: &Between<'_>,
    bodies: &[Option<Body>],
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> NamedPoints<'a> {
    let fields = syntax.fields.iter();
    let points = fields.filter(|field| matches!(field.role, Some((Role::Point, _))));
    points
        .map(|field| {
            let point = faults.within(&field.name, |faults| {
                let part = field.origin.map(|origin| &parts[origin.part]);
                point(field, part, between, bodies, numbers, faults)
            });
            (&field.name, point)
        })
        .collect()
}

fn point(
    field: &Field,
    part: Option<&Part<'_>>,
    between: &Between<'_>,
    bodies: &[Option<Body>],
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Option<NamedPoint> {
    let (_, word) = field.role.as_ref()?;
    let name = &field.name;
    let text = field.ty.to_token_stream().to_string();
    if text.rsplit(' ').next() != Some("Point") {
        let found = code(&field.ty);
        faults.at(
            &field.ty,
            format!("`{name}` is described as a point, but `{found}` is none; a named point is a `Point`"),
        );
    }
    let mut pairs = Pairs::new(format!("point `{name}`"), word.span(), &field.list);
    let on = pairs.required(
        "on",
        "the body that it is fixed on, as in `on = rod`",
        faults,
    );
    let at = pairs.required(
        "at",
        "a point such as `[0.0, 0.5, 0.0]` (m, global)",
        faults,
    );
    pairs.finish(faults);
    let body = on.and_then(|expr| between.body(expr, name, faults));
    numbers.field = name.clone();
    numbers.attribute = "at".into();
    numbers.no_inputs = Some("a point is fixed on its body; make it a `#[param]`");
    let position = at.and_then(|expr| numbers.vector(expr, faults));
    numbers.no_inputs = None;
    let (body, mut position) = (body?, position?);
    if let Some(part) = part {
        position = part.placement.as_ref()?.point(position, numbers);
    }
    if let Some(particle) = body.and_then(|body| bodies[body].as_ref())
        && particle.kind == BodyKind::Particle
        && particle.position != position
    {
        faults.at(
            at?,
            format!(
                "point `{name}` is fixed on the particle `{}`, which has no orientation: only a point at the particle's own position can be \
                 fixed on it{}",
                particle.name,
                apart::beside(literals(&position), literals(&particle.position))
            ),
        );
        return None;
    }
    Some(NamedPoint {
        name: name.clone(),
        body,
        position,
    })
}

/// Where the named point that an expression is lies at the start; `None` in it if that was refused.
pub(super) fn position_of(
    expr: &Expr,
    points: &NamedPoints<'_>,
    field: &Field,
    faults: &mut Faults,
) -> Option<Option<[Number; 3]>> {
    let reference = Reference::of(expr)?;
    let names = points.iter().map(|(name, _)| *name);
    match reference.find(names, &[], &field.name, faults) {
        Found::At(place) => Some(points[place].1.as_ref().map(|point| point.position)),
        Found::Refused => Some(None),
        Found::Nothing => None,
    }
}
