//! Mechanisms: bodies, joints between them, and what belongs to neither.

use std::collections::HashSet;

use proc_macro2::{Ident, TokenStream};
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, Lit};

use super::between::{Between, Mentioned};
use super::bodies;
use super::definition::{Definition, Definitions, definition};
use super::joints::JointChecker;
use super::number::Numbers;
use super::pairs::Pairs;
use super::readings::Readings;
use super::states;
use super::switches;
use super::{asked, kinds, parts, points, redundant};
use crate::diag::{Faults, code, did_you_mean};
use crate::model::name::Step;
use crate::model::{
    Body, Coordinates, ElementDef, ElementKind, Independence, Model, Name, Number, Part, Redundant,
};
use crate::syntax::array::{is_constant, is_index};
use crate::syntax::mechanism::{Field, MechanismSyntax, Role};
use crate::syntax::ungroup;

/// A mechanism that is sound as far as can be read from what was written.
pub struct Checked<'a> {
    /// What it means.
    pub model: Model,
    wish: Wish<'a>,
}

impl Checked<'_> {
    /// Whether redundant equations are to be left out.
    #[must_use]
    pub fn drops(&self) -> bool {
        self.wish.0 == Redundant::Drop
    }

    /// The model, whose redundant equations are refused, left out or kept, as was wished: what they
    /// are was found by numbers.
    pub fn judged(mut self, found: Independence, faults: &mut Faults) -> Model {
        self.model.independence = found;
        redundant::check(&mut self.model, self.wish, faults);
        self.model
    }
}

/// Checks a mechanism, but for its redundant equations. `None` if anything is wrong with its parts;
/// the faults say what.
pub fn check<'a>(
    syntax: &'a MechanismSyntax,
    types: &Definitions,
    definitions: Vec<ElementDef>,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<Checked<'a>> {
    for field in &syntax.fields {
        if let Some((Role::Port, word)) = &field.role {
            faults.at(
                word,
                "a port is a body of an assembly, which is named where the assembly is a part; this is a mechanism, whose bodies are described by `#[body(..)]`",
            );
        }
    }
    described(syntax, types, definitions, (facade, false), faults)
}

/// Checks an assembly by itself: its ports are bodies of which nothing is known. What numbers tell
/// is asked of the mechanisms that have it.
pub fn check_assembly(
    syntax: &MechanismSyntax,
    types: &Definitions,
    definitions: Vec<ElementDef>,
    facade: &TokenStream,
    faults: &mut Faults,
) -> Option<Model> {
    let is_length = |key: &Ident| syntax.lengths.iter().any(|(length, _)| length == key);
    let mut others = syntax
        .list
        .pairs
        .iter()
        .filter(|pair| !is_length(&pair.key));
    if let Some(other) = others.next() {
        faults.at(
            &other.key,
            format!(
                "`{}` is an assembly: what `#[mechanism(..)]` says is said of the mechanism that it is a part of",
                syntax.name
            ),
        );
    }
    for field in &syntax.fields {
        let Some((Role::Port, _)) = &field.role else {
            continue;
        };
        let name = &field.name;
        if name.index().is_some() {
            faults.at_name(
                name,
                format!("`{}` is an array; a port is one body", name.field()),
            );
        }
        if parts::KEYS.iter().any(|key| name.field() == key) {
            faults.at_name(
                name,
                format!("`{name}` says where a part is; take another name for this port"),
            );
        }
    }
    described(syntax, types, definitions, (facade, true), faults).map(|checked| checked.model)
}

fn described<'a>(
    syntax: &'a MechanismSyntax,
    types: &Definitions,
    definitions: Vec<ElementDef>,
    (facade, is_assembly): (&TokenStream, bool),
    faults: &mut Faults,
) -> Option<Checked<'a>> {
    let owner = Name::from(syntax.name.clone());
    let mut numbers = Numbers::new(owner, &syntax.unmeasured, facade);
    numbers.values = super::values::values(syntax, is_assembly, facade, faults);
    refuse_index(syntax, faults);
    let Attributes {
        gravity,
        wish,
        coordinates,
        kernels,
    } = attributes(syntax, &mut numbers, faults);
    numbers.scopes = scopes(syntax, facade);
    let parts = parts::parts(syntax, &mut numbers, faults);
    let part_of = |field: &Field| field.origin.map(|origin| &parts[origin.part]);
    let mut names: Vec<&Name> = Vec::new();
    let mut bodies = Vec::new();
    for field in &syntax.fields {
        if may_be_body(field, types) {
            if field.name.field() == "ground" {
                faults.at_name(
                    &field.name,
                    "`ground` is the body that does not move; take another name",
                );
            }
            names.push(&field.name);
            let body = |faults: &mut Faults| {
                let mut body = body(field, types, &mut numbers, faults)?;
                if let Some(part) = part_of(field) {
                    part.placement.as_ref()?.body(&mut body, &mut numbers);
                }
                Some(body)
            };
            bodies.push(faults.within(&field.name, body));
        }
    }
    let mut mentioned = Mentioned {
        bodies: vec![false; names.len()],
        is_certain: true,
    };
    let mut between = Between {
        names,
        ports: Vec::new(),
        unmeasured: &syntax.unmeasured,
    };
    parts::ports(&parts, &mut between, faults);
    let points = points::points(syntax, &parts, &between, &bodies, &mut numbers, faults);
    let mut joints = Vec::new();
    let mut forces = Vec::new();
    for field in &syntax.fields {
        let Some((role, word)) = &field.role else {
            mentioned.is_certain = false;
            faults.at_name(
                &field.name,
                format!(
                    "field `{}` is not described; write `#[body(..)]`, `#[joint(..)]`, `#[force(..)]`, `#[point(..)]`, `#[param]`, \
                     `#[input]` or `#[state(..)]` above it",
                    field.name.field()
                ),
            );
            continue;
        };
        let kind = match role {
            Role::Joint => ElementKind::Joint,
            Role::Force => ElementKind::Force,
            Role::Part => {
                mentioned.is_certain = false;
                refuse_part(field, faults);
                continue;
            }
            Role::Body | Role::Port | Role::Point | Role::Param | Role::Input | Role::State => {
                continue;
            }
        };
        let checker = JointChecker {
            field,
            kind,
            word: word.span(),
            path: syntax.type_path(&field.ty, field.origin, facade),
            part: part_of(field),
            between: &between,
            points: &points,
            bodies: &bodies,
            definitions: &definitions,
            coordinates,
        };
        let element = faults.within(&field.name, |faults| {
            checker.check(types, &mut mentioned, &mut numbers, faults)
        });
        match kind {
            ElementKind::Joint => joints.push(element),
            ElementKind::Force => forces.push(element),
        }
    }
    if !is_assembly {
        bodies::coordinates(&bodies, coordinates, faults);
    }
    let names = between.names;
    refuse_alone(syntax, (&names, &bodies), &mentioned, faults);
    let with_role = |wanted: Role| {
        let fields = syntax.fields.iter();
        let fields =
            fields.filter(move |field| matches!(&field.role, Some((role, _)) if *role == wanted));
        fields.map(|field| &field.name)
    };
    let readings = Readings {
        names: with_role(Role::Joint)
            .chain(with_role(Role::Force))
            .collect(),
        elements: joints.iter().chain(&forces).map(Option::as_ref).collect(),
        definitions: &definitions,
        bodies: &names,
        unmeasured: &syntax.unmeasured,
    };
    let states = states::states(syntax, &readings, &mut numbers, faults);
    if is_ambiguous(syntax) {
        return None;
    }
    let are_placed = parts.iter().all(|part| part.placement.is_some());
    let parts = syntax.parts.iter().map(|part| {
        Some(Part {
            name: part.name.clone(),
            path: syntax.type_path(&part.ty, part.origin, facade)?,
            fingerprint: part.fingerprint,
        })
    });
    let parts: Vec<_> = parts.collect::<Option<_>>().filter(|_| are_placed)?;
    let bodies: Vec<_> = bodies.into_iter().collect::<Option<_>>()?;
    let mut joints: Vec<_> = joints.into_iter().collect::<Option<_>>()?;
    let mut forces: Vec<_> = forces.into_iter().collect::<Option<_>>()?;
    let states: Vec<_> = states.into_iter().collect::<Option<_>>()?;
    let mut elements: Vec<_> = joints.iter_mut().chain(&mut forces).collect();
    states::tell(&states, &mut elements);
    let points: Option<Vec<_>> = points.into_iter().map(|(_, point)| point).collect();
    let switches = switches::switches((joints.len(), &forces), &definitions, &states, &mut numbers);
    let values = std::mem::take(&mut numbers.values);
    let symbols = std::mem::take(&mut numbers.symbols);
    let splines = std::mem::take(&mut numbers.splines);
    let mut known = HashSet::new();
    let mut constants = std::mem::take(&mut numbers.constants);
    constants.retain(|constant| known.insert(constant.to_string()));
    let model = Model {
        name: syntax.name.clone(),
        gravity: gravity?,
        bodies,
        joints,
        forces,
        states,
        points: points?,
        parts,
        values,
        definitions,
        symbols,
        splines,
        switches,
        independence: Independence::default(),
        coordinates,
        asked: kernels.asked,
        derived_by: kernels.derived_by,
        constants,
        lengths: syntax.lengths.clone(),
        comments: syntax.comments.clone(),
    };
    Some(Checked { model, wish })
}

/// Refuses a mechanism without a body, and a body that no joint names.
fn refuse_alone(
    syntax: &MechanismSyntax,
    (names, bodies): (&[&Name], &[Option<Body>]),
    mentioned: &Mentioned,
    faults: &mut Faults,
) {
    if names.is_empty() {
        faults.at(
            &syntax.name,
            format!(
                "mechanism `{}` has no body; a field becomes one by `#[body(..)]`",
                syntax.name
            ),
        );
    }
    for (place, name) in names.iter().enumerate() {
        let free = bodies[place].as_ref().is_none_or(|body| body.free);
        if mentioned.is_certain && !mentioned.bodies[place] && !free {
            faults.at_name(
                name,
                format!(
                    "no joint names the body `{name}`; connect it, or mark it free: `#[body(free, ..)]`"
                ),
            );
        }
    }
}

/// The types of parts, by the way to each.
fn scopes(syntax: &MechanismSyntax, facade: &TokenStream) -> Vec<(Vec<Step>, TokenStream)> {
    let parts = syntax.parts.iter();
    let scopes = parts.filter_map(|part| {
        let owner = syntax.type_path(&part.ty, part.origin, facade)?;
        Some((part.name.steps().collect(), owner))
    });
    scopes.collect()
}

/// A field that is described as a part, and whose type is no assembly.
fn refuse_part(field: &Field, faults: &mut Faults) {
    let (name, found) = (&field.name, code(&field.ty));
    faults.at(
        &field.ty,
        format!(
            "`{name}` is described as a part, but `{found}` is no assembly; an assembly is a struct with `#[derive(Assembly)]`"
        ),
    );
}

/// Reads `#[mechanism(..)]`.
fn attributes<'a>(
    syntax: &'a MechanismSyntax,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Attributes<'a> {
    let mut pairs = Pairs::new(
        "`#[mechanism(..)]`".into(),
        syntax.name.span(),
        &syntax.list,
    );
    numbers.attribute = "gravity".into();
    let gravity = match pairs.optional("gravity", faults) {
        Some(expr) => numbers.vector(expr, faults),
        None => Some([Number::ZERO; 3]),
    };
    let redundant = pairs.optional("redundant", faults);
    let wish = redundant.map(|expr| {
        // What was meant by something else is unknown: nothing is refused on top.
        choice("redundant", expr, &Redundant::ALL, faults).unwrap_or(Redundant::Keep)
    });
    let wanted = pairs.optional("coordinates", faults);
    let coordinates =
        wanted.and_then(|expr| choice("coordinates", expr, &Coordinates::ALL, faults));
    // What was meant by something else is unknown.
    let known =
        (wanted.is_none() || coordinates.is_some()).then(|| coordinates.unwrap_or_default());
    let kernels = asked::read(pairs.optional(asked::KEY, faults), known, numbers, faults);
    kinds::read(pairs.optional(kinds::KEY, faults), faults);
    // They are read with the arrays.
    for pair in &syntax.list.pairs {
        if is_constant(&pair.key) && pairs.has(&pair.key.to_string()) {
            pairs.known_elsewhere(&pair.key.to_string(), faults);
        }
    }
    pairs.finish(faults);
    Attributes {
        gravity,
        wish: (wish.unwrap_or_default(), redundant),
        coordinates: coordinates.unwrap_or_default(),
        kernels,
    }
}

/// What to do with redundant equations, and where that is said.
type Wish<'a> = (Redundant, Option<&'a Expr>);

/// What `#[mechanism(..)]` says.
struct Attributes<'a> {
    gravity: Option<[Number; 3]>,
    wish: Wish<'a>,
    coordinates: Coordinates,
    kernels: asked::Kernels,
}

/// One of some words in quotes.
fn choice<T: Copy>(key: &str, expr: &Expr, all: &[(&str, T)], faults: &mut Faults) -> Option<T> {
    let text = match ungroup(expr) {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) => text.value(),
        _ => String::new(),
    };
    let known = all.iter().find(|(name, _)| *name == text);
    if known.is_none() {
        let near = did_you_mean(&text, all.iter().map(|(name, _)| *name));
        let names: Vec<String> = all
            .iter()
            .map(|(name, _)| format!("`\"{name}\"`"))
            .collect();
        let names = match names.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, others)) => format!("{} or {last}", others.join(", ")),
            None => String::new(),
        };
        faults.at(expr, format!("`{key}` takes {names}{near}"));
    }
    known.map(|(_, meaning)| *meaning)
}

/// Whether two fields have one name: what speaks of it would speak of the first. The compiler
/// reports it.
#[must_use]
pub fn is_ambiguous(syntax: &MechanismSyntax) -> bool {
    let mut before = HashSet::new();
    let fields = syntax.fields.iter().map(|field| &field.name);
    let parts = syntax.parts.iter().map(|part| &part.name);
    // What is in a part is asked where the assembly is described.
    let own = fields.chain(parts).filter(|name| name.parts().is_empty());
    let mut names = own.filter(|name| name.is_first());
    names.any(|name| !before.insert(name.field().unraw()))
}

/// Refuses a field of the index's name beside an array: in its attributes nobody could tell them
/// apart.
fn refuse_index(syntax: &MechanismSyntax, faults: &mut Faults) {
    let names = || syntax.fields.iter().map(|field| &field.name);
    let has_arrays = |scope: &Name| {
        let mut beside = names().filter(|name| name.parts() == scope.parts());
        beside.any(|name| name.index().is_some())
    };
    for name in names().filter(|name| is_index(name.field()) && has_arrays(name)) {
        faults.at_name(
            name,
            "`k` is the number of an element, in the attributes of a field that is an array; take another name for this field",
        );
    }
}

/// Whether joints may name the field, even if something is wrong with its description.
fn may_be_body(field: &Field, types: &Definitions) -> bool {
    match (&field.role, definition(field, types)) {
        (Some((Role::Body | Role::Port, _)), _) | (_, Some(Definition::Body(_))) => true,
        (Some(_), _) => false,
        (None, definition) => definition.is_none(),
    }
}

fn body(
    field: &Field,
    types: &Definitions,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Option<crate::model::Body> {
    let name = &field.name;
    let word = match &field.role {
        Some((Role::Body, word)) => word,
        Some((Role::Port, _)) => return Some(bodies::port(name)),
        _ => return None,
    };
    let found = code(&field.ty);
    match definition(field, types) {
        Some(Definition::Body(kind)) => {
            numbers.no_inputs =
                Some("a body is what it is for the whole run; make it a `#[param]`");
            let body = bodies::check(name, *kind, word.span(), &field.list, numbers, faults);
            numbers.no_inputs = None;
            body
        }
        Some(Definition::Assembly) => {
            faults.at(
                word,
                format!("`{found}` is an assembly: describe `{name}` by `#[part(at = [..], ..)]`"),
            );
            None
        }
        Some(Definition::Element(_) | Definition::Faulty) => {
            faults.at(
                word,
                format!(
                    "`{found}` is no body: describe `{name}` by `#[joint(between = [..], ..)]` or `#[force(between = [..], ..)]`"
                ),
            );
            None
        }
        None => {
            faults.at(
                &field.ty,
                format!(
                    "`{name}` is described as a body, but `{found}` is none; a body is a `Body` or a `Particle`"
                ),
            );
            None
        }
    }
}
