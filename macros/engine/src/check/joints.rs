//! The joints and forces of a mechanism: bodies by name, parameters by value.

use proc_macro2::{Ident, Span, TokenStream};
use syn::Expr;
use syn::spanned::Spanned;

use super::apart;
use super::between::{Between, Mentioned};
use super::definition::{Definition, Definitions, definition};
use super::expression::too_large;
use super::fixed::{turns, uses};
use super::laws::LawReader;
use super::mirror::pseudovectors;
use super::number::{AT_LIKES, Numbers, elements};
use super::pairs::Pairs;
use super::parts::Part;
use super::points::{NamedPoints, position_of};
use super::switching::no_switches;
use crate::diag::{Faults, code, list};
use crate::model::number::literals;
use crate::model::{
    Binding, Body, BodyKind, Coordinates, Element, ElementDef, ElementKind, Extent, Number,
    ParameterKind,
};
use crate::syntax::array::is_index;
use crate::syntax::mechanism::Field;
use crate::syntax::{Value, ungroup};

/// Checks one field that is described as a joint or a force.
pub(super) struct JointChecker<'a> {
    pub(super) field: &'a Field,
    pub(super) kind: ElementKind,
    /// The word of its attribute.
    pub(super) word: Span,
    /// How the field's type is named, from the mechanism.
    pub(super) path: Option<TokenStream>,
    /// Where the part is whose field it is.
    pub(super) part: Option<&'a Part<'a>>,
    /// What joints may name, and the bodies that they are.
    pub(super) between: &'a Between<'a>,
    pub(super) points: &'a NamedPoints<'a>,
    pub(super) bodies: &'a [Option<Body>],
    pub(super) definitions: &'a [ElementDef],
    /// Which kernels the mechanism has.
    pub(super) coordinates: Coordinates,
}

impl JointChecker<'_> {
    pub(super) fn check(
        &self,
        types: &Definitions,
        mentioned: &mut Mentioned,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<Element> {
        let name = &self.field.name;
        let found = code(&self.field.ty);
        let word = self.kind.word();
        let mut pairs = Pairs::new(format!("{word} `{name}`"), self.word, &self.field.list);
        let definition = match definition(self.field, types) {
            Some(Definition::Element(place)) if self.definitions[*place].kind == self.kind => {
                *place
            }
            Some(Definition::Element(place)) => {
                let other = self.definitions[*place].kind.word();
                faults.at_span(
                    self.word,
                    format!("`{found}` is a {other}: describe `{name}` by `#[{other}(between = [..], ..)]`"),
                );
                mentioned.is_certain = false;
                return None;
            }
            Some(Definition::Body(_)) => {
                faults.at_span(
                    self.word,
                    format!("`{found}` is a body: describe `{name}` by `#[body(mass = .., ..)]`"),
                );
                mentioned.is_certain = false;
                return None;
            }
            Some(Definition::Assembly) => {
                faults.at_span(
                    self.word,
                    format!(
                        "`{found}` is an assembly: describe `{name}` by `#[part(at = [..], ..)]`"
                    ),
                );
                mentioned.is_certain = false;
                return None;
            }
            other => {
                // A fault in a definition is reported there.
                if other.is_none() {
                    faults.at(
                        &self.field.ty,
                        format!(
                            "`{name}` is described as a {word}, but `{found}` is none; take one of `holonom::{word}s`, or \
                             define one with `{word}!`"
                        ),
                    );
                }
                match pairs.optional("between", faults) {
                    Some(expr) => _ = self.read_between(expr, mentioned, faults),
                    None => mentioned.is_certain = false,
                }
                return None;
            }
        };
        let joint = &self.definitions[definition];
        let formal = list(&joint.bodies);
        let verb = match self.kind {
            ElementKind::Joint => "connects",
            ElementKind::Force => "acts on",
        };
        let example = match joint.bodies.len() {
            1 => format!("the body that it {verb} ({formal}), as in `between = [rod]`"),
            2 => format!("the bodies that it {verb} ({formal}), as in `between = [ground, rod]`"),
            _ => {
                format!("the bodies that it {verb} ({formal}), as in `between = [ground, rod, ..]`")
            }
        };
        let between = pairs.required("between", &example, faults);
        mentioned.is_certain &= between.is_some();
        let bodies = between.and_then(|expr| self.read_between(expr, mentioned, faults));
        if let Some(expr) = between
            && let Some(found) = elements(expr).map(|elements| elements.len())
            && found != joint.bodies.len()
        {
            let (kind, count) = (&joint.name, plural(joint.bodies.len(), "body", "bodies"));
            faults.at(
                expr,
                format!("`{kind}` {verb} {count} ({formal}); found {found}"),
            );
        } else if let (Some(expr), Some([None])) = (between, bodies.as_deref()) {
            faults.at(
                expr,
                format!("a {word} of the `ground` alone does nothing; name a body"),
            );
        }
        let is_cut = self.cut(joint, &mut pairs, faults);
        let limits = self.limits(joint, &mut pairs, numbers, faults);
        let mut bindings = Vec::new();
        for (place, parameter) in joint.parameters.iter().enumerate() {
            let key = parameter.name.to_string();
            numbers.field = name.clone();
            numbers.attribute.clone_from(&key);
            if parameter.default.is_some() && !pairs.has(&key) {
                pairs.optional(&key, faults);
                bindings.push(Some((Binding::Default, false)));
                continue;
            }
            let expr = pairs.required(&key, parameter.kind.example(), faults);
            numbers.no_inputs = match (self.kind, parameter.kind) {
                (ElementKind::Joint, ParameterKind::Law) => Some(
                    "a driver needs its rate and acceleration, too; make it a `Setpoint` with `#[input(order = 2)]`, or a `#[param]`",
                ),
                (ElementKind::Joint, _) => {
                    Some("a joint is what it is for the whole run; make it a `#[param]`")
                }
                (_, ParameterKind::Point | ParameterKind::Axis) => {
                    Some("points and axes are fixed on their bodies; make it a `#[param]`")
                }
                _ => None,
            };
            bindings.push(expr.and_then(|expr| {
                if parameter.kind == ParameterKind::Law {
                    let arguments = &parameter.arguments;
                    self.refuse_index(arguments, expr, faults);
                    let words = arguments.iter().map(ToString::to_string);
                    numbers.words = std::iter::once("time".to_string()).chain(words).collect();
                    let law = LawReader {
                        arguments,
                        numbers,
                        readings: None,
                        no_switches: no_switches(joint, place),
                    }
                    .read(expr, faults);
                    numbers.words.clear();
                    return law.map(|law| (Binding::Law(law), false));
                }
                self.binding(
                    expr,
                    parameter.kind,
                    bodies.as_deref(),
                    joint,
                    numbers,
                    faults,
                )
            }));
            numbers.no_inputs = None;
        }
        pairs.finish(faults);
        let bodies = bodies.filter(|bodies| bodies.len() == joint.bodies.len())?;
        let bindings: Vec<(Binding, bool)> = bindings.into_iter().collect::<Option<_>>()?;
        let bindings = self.placed(joint, &bodies, bindings, numbers, faults)?;
        self.particles(joint, &bodies, &bindings, faults)?;
        let law = |parameter: usize, arguments: &[Extent]| match &bindings[parameter] {
            Binding::Law(law) => law.extent(arguments),
            _ => Extent::default(),
        };
        if joint.extent(&law).is_too_large() {
            faults.at_span(self.word, too_large(&format!("{word} `{name}` is")));
            return None;
        }
        Some(Element {
            name: name.clone(),
            path: self.path.clone()?,
            definition,
            bodies,
            bindings,
            dropped: Vec::new(),
            components: Vec::new(),
            is_cut,
            read: Vec::new(),
            limits,
        })
    }

    /// Whether the joint is to carry no body in joint coordinates: `cut`, unless that is a
    /// parameter of its own.
    fn cut(&self, joint: &ElementDef, pairs: &mut Pairs<'_>, faults: &mut Faults) -> bool {
        let key = "cut";
        let is_own = joint.parameters.iter().any(|own| own.name == key);
        if self.kind == ElementKind::Force || is_own || !pairs.has(key) {
            return false;
        }
        let written = self.field.list.pairs.iter().find(|pair| pair.key == key);
        let is_cut = pairs.flag(key, faults);
        let Some(written) = written else {
            return is_cut;
        };
        if !self.coordinates.have_joints() {
            faults.at(
                &written.key,
                "`cut` says which joint stays equations in joint coordinates, which this mechanism has not; write \
                 `#[mechanism(coordinates = \"joints\")]`, or leave it out",
            );
        } else if joint.motions.is_none() {
            let name = &joint.name;
            faults.at(
                &written.key,
                format!("`{name}` does not say how it moves (`motion ..`): it stays equations without `cut`"),
            );
        }
        is_cut
    }

    /// Refuses a law of an array with an argument of the index's name: nobody could tell which of
    /// them is meant.
    fn refuse_index(&self, arguments: &[Ident], expr: &Expr, faults: &mut Faults) {
        if self.field.name.index().is_some() && arguments.iter().any(is_index) {
            faults.at(
                expr,
                "this law has an argument `k`, which is the number of an element where the field is an array; take single fields, or another \
                 name in the definition",
            );
        }
    }

    /// The bodies of `between`.
    fn read_between(
        &self,
        expr: &Expr,
        mentioned: &mut Mentioned,
        faults: &mut Faults,
    ) -> Option<Vec<Option<usize>>> {
        self.between
            .read(expr, self.kind, &self.field.name, mentioned, faults)
    }

    /// What a joint or a force of a part is, seen from the mechanism.
    fn placed(
        &self,
        joint: &ElementDef,
        bodies: &[Option<usize>],
        bindings: Vec<(Binding, bool)>,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<Vec<Binding>> {
        let Some(part) = self.part else {
            return Some(bindings.into_iter().map(|(binding, _)| binding).collect());
        };
        let placement = part.placement.as_ref()?;
        let pseudovectors = match placement.mirror {
            Some(_) => pseudovectors(joint).or_else(|| {
                let (kind, name) = (&joint.name, &self.field.name);
                let word = self.kind.word();
                faults.at_span(
                    part.mirror_span(),
                    format!(
                        "the mirror image of {word} `{name}` is no `{kind}`: it has the other hand; take it out of the \
                         assembly, and write one for each side"
                    ),
                );
                None
            })?,
            None => vec![false; joint.parameters.len()],
        };
        let parameters = joint.parameters.iter().zip(pseudovectors);
        let placed = parameters.zip(bindings).map(|((parameter, odd), (binding, is_placed))| {
            if is_placed {
                return Some(binding);
            }
            numbers.attribute = parameter.name.to_string();
            let own = |body: &Option<usize>| {
                let body = body.and_then(|body| self.bodies[body].as_ref());
                body.is_some_and(|body| body.name.parts().starts_with(part.steps()))
            };
            if matches!(binding, Binding::Local(_)) && !bodies.iter().all(own) {
                let key = &parameter.name;
                let written = self.field.list.pairs.iter().find(|pair| pair.key == *key);
                faults.at_span(
                    written.map_or(self.word, |pair| pair.key.span()),
                    format!(
                        "`{key}` by `local(..)` needs the axes of a body outside the part `{}`; give it in the axes of \
                         the assembly, as in `[0.0, 0.5, 0.0]`",
                        part.name()
                    ),
                );
                return None;
            }
            Some(placement.binding(binding, parameter.kind, odd, numbers))
        });
        placed.collect()
    }

    /// What a parameter is, and whether that is already seen from the mechanism.
    fn binding(
        &self,
        expr: &Expr,
        kind: ParameterKind,
        bodies: Option<&[Option<usize>]>,
        joint: &ElementDef,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<(Binding, bool)> {
        if !kind.is_vector() {
            if elements(expr).is_some() {
                faults.at(
                    expr,
                    format!("`{}` takes {}", numbers.attribute, kind.example()),
                );
                return None;
            }
            let number = numbers.scalar(expr, faults);
            return number.map(|number| (Binding::Scalar(number), false));
        }
        if let Some(position) = position_of(expr, self.points, self.field, faults) {
            if kind == ParameterKind::Point {
                return position.map(|position| (Binding::Global(position), true));
            }
            let (key, found) = (&numbers.attribute, code(expr));
            faults.at(
                expr,
                format!("`{found}` is a point; `{key}` takes {}", kind.example()),
            );
            return None;
        }
        if let Expr::Call(call) = ungroup(expr)
            && matches!(ungroup(&call.func), Expr::Path(path) if path.path.is_ident("local"))
        {
            let copies: Vec<Option<[Number; 3]>> = call
                .args
                .iter()
                .map(|copy| self.vector(copy, kind, numbers, faults))
                .collect();
            let wanted = bodies.map_or(joint.bodies.len(), <[_]>::len);
            if copies.len() != wanted {
                let (key, wanted) = (&numbers.attribute, plural(wanted, "body", "bodies"));
                faults.at(
                    call,
                    format!(
                        "`{key}` by `local(..)` takes one vector for each of {wanted}; found {}",
                        copies.len()
                    ),
                );
                return None;
            }
            let copies = copies.into_iter().collect::<Option<_>>();
            return copies.map(|copies| (Binding::Local(copies), false));
        }
        let vector = self.vector(expr, kind, numbers, faults);
        vector.map(|vector| (Binding::Global(vector), false))
    }

    fn vector(
        &self,
        expr: &Expr,
        kind: ParameterKind,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<[Number; 3]> {
        if elements(expr).is_none() {
            let (key, example) = (&numbers.attribute, kind.example());
            faults.at(
                expr,
                format!("`{key}` takes {example}, or `local(..)` with one for each body"),
            );
            return None;
        }
        let vector = numbers.vector(expr, faults)?;
        if kind == ParameterKind::Axis && numbers.all_seen(&vector) == Some([0.0; 3]) {
            let place = match literals(&vector) {
                Some(_) => "",
                None => AT_LIKES,
            };
            faults.at(
                expr,
                format!(
                    "`{}` of `{}` is the zero vector{place}; an axis has a direction, as in `[1.0, 0.0, 0.0]`",
                    numbers.attribute, self.field.name
                ),
            );
            return None;
        }
        Some(vector)
    }

    /// A particle has no orientation: it carries a joint's points at its own place only.
    fn particles(
        &self,
        joint: &ElementDef,
        bodies: &[Option<usize>],
        bindings: &[Binding],
        faults: &mut Faults,
    ) -> Option<()> {
        let mut sound = Some(());
        for (place, body) in bodies.iter().enumerate() {
            let Some(body) = body.and_then(|body| self.bodies[body].as_ref()) else {
                continue;
            };
            if body.kind != BodyKind::Particle {
                continue;
            }
            if turns(joint, place) {
                faults.at_span(
                    self.word,
                    format!(
                        "{} `{}` needs the orientation of `{}`, and a particle has none; make it a `Body`",
                        self.kind.word(), self.field.name, body.name
                    ),
                );
                sound = None;
                continue;
            }
            for (parameter, uses) in uses(joint, place) {
                let at_centre = match (&bindings[parameter], uses) {
                    (Binding::Global(point), ParameterKind::Point) => *point == body.position,
                    (Binding::Local(points), ParameterKind::Point) => {
                        points[place] == [Number::ZERO; 3]
                    }
                    _ => false,
                };
                if !at_centre {
                    let [at, from] = match (&bindings[parameter], uses) {
                        (Binding::Global(point), ParameterKind::Point) => {
                            [literals(point), literals(&body.position)]
                        }
                        (Binding::Local(points), ParameterKind::Point) => {
                            [literals(&points[place]), Some([0.0; 3])]
                        }
                        _ => [None; 2],
                    };
                    let beside = apart::beside(at, from);
                    let parameter = &joint.parameters[parameter].name;
                    let key = parameter;
                    let written = self.field.list.pairs.iter().find(|pair| pair.key == *key);
                    faults.at_span(
                        written.map_or(self.word, |pair| match &pair.value {
                            Value::Expr(expr) => expr.span(),
                            _ => pair.key.span(),
                        }),
                        format!(
                            "{} `{}` fixes `{parameter}` on the particle `{}`, which has no orientation: only a point \
                             at the particle's own position can be fixed on it{beside}",
                            self.kind.word(), self.field.name, body.name
                        ),
                    );
                    sound = None;
                }
            }
        }
        sound
    }
}

/// "1 body", "2 bodies".
pub(super) fn plural(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
