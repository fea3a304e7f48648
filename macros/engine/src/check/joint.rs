//! Definitions of joints and forces: names, statements.

use std::cell::Cell;

use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::spanned::Spanned;

use super::expression::{Context, Shaped, extent, too_large};
use super::motion::{must_count, must_turn};
use super::moves;
use super::rates::{has_rate, is_constant, is_linear};
use super::signature::{RESERVED, signature};
use crate::diag::Faults;
use crate::model::{Action, Comparison, ElementDef, ElementKind, Extent, Motion, Row, Term, Turn};
use crate::syntax::joint::{JointSyntax, ParameterSyntax, Statement};
use crate::syntax::motion::MotionSyntax;
use crate::wire;

/// A sound definition where it stands.
pub struct Defined<'a> {
    syntax: &'a JointSyntax,
    /// What it means.
    pub joint: ElementDef,
    /// Where its constraints are written.
    places: Vec<Span>,
}

impl Defined<'_> {
    /// The definition, if the motions that it states are those that its equations leave: how they
    /// compare was found by numbers.
    pub fn compared(self, found: &Comparison, faults: &mut Faults) -> Option<ElementDef> {
        moves::refuse(self.syntax, &self.joint, &self.places, found, faults).then_some(self.joint)
    }
}

/// Checks a definition that may have come from elsewhere, where its motions were looked at. `None`
/// if anything is wrong; the faults say what.
pub fn check(syntax: &JointSyntax, faults: &mut Faults) -> Option<ElementDef> {
    define(syntax, faults).map(|defined| defined.joint)
}

/// Checks a definition where it stands, but for its motions. `None` if anything is wrong; the
/// faults say what.
pub fn define<'a>(syntax: &'a JointSyntax, faults: &mut Faults) -> Option<Defined<'a>> {
    if !syntax.is_complete {
        return None;
    }
    let before = faults.any();
    let mut fresh = Faults::new();
    let (parameters, ambiguous) = signature(syntax, &mut fresh);
    let mut reader = Reader {
        syntax,
        context: Context {
            kind: syntax.kind,
            bodies: &syntax.bodies,
            parameters: &parameters,
            ambiguous,
            names: Vec::new(),
            left: Cell::new(Extent::MOST.size),
        },
        rows: Vec::new(),
        places: Vec::new(),
        actions: Vec::new(),
        angle: None,
        angles: None,
        displacement: None,
        contact: None,
        requirements: Vec::new(),
        motions: None,
        drive: None,
    };
    let given = syntax.parameters.iter();
    let defaults: Vec<_> = given.map(|it| reader.default(it, &mut fresh)).collect();
    for statement in &syntax.statements {
        reader.statement(statement, &mut fresh);
    }
    reader.must_count(&mut fresh);
    reader.must_turn(&mut fresh);
    let Reader {
        rows,
        places,
        actions,
        angle,
        angles,
        displacement,
        contact,
        requirements,
        motions,
        drive,
        ..
    } = reader;
    if rows.is_empty() && actions.is_empty() && !before && !fresh.any() {
        let name = &syntax.name;
        let message = match syntax.kind {
            ElementKind::Joint => format!(
                "joint `{name}` has no equation; write an expression that is zero, as in `j.origin - i.origin;`"
            ),
            ElementKind::Force => format!(
                "force `{name}` does nothing; write for instance `potential 0.5 * stiffness * squared(j.tail - i.head);`"
            ),
        };
        fresh.at(name, message);
    }
    let terms = rows.iter().map(Row::term);
    let terms = terms.chain(actions.iter().flat_map(Action::terms));
    if !fresh.any() && extent(terms).is_too_large() {
        let (word, name) = (syntax.kind.word(), &syntax.name);
        fresh.at(name, too_large(&format!("{word} `{name}` is")));
    }
    let sound = !fresh.any() && !before;
    faults.append(fresh);
    let mut parameters = parameters;
    for (parameter, default) in parameters.iter_mut().zip(defaults) {
        parameter.default = default;
    }
    sound.then(|| {
        let mut joint = ElementDef {
            kind: syntax.kind,
            name: syntax.name.clone(),
            bodies: syntax.bodies.clone(),
            parameters,
            rows,
            actions,
            angle,
            angles,
            displacement,
            contact,
            requirements,
            motions,
            drive,
            turns: Vec::new(),
            fingerprint: fingerprint(&syntax.body.to_string()),
            span: syntax.name.span(),
        };
        joint.turns = turns(joint.terms());
        Defined {
            syntax,
            joint,
            places,
        }
    })
}

/// The angles over many turns that a definition speaks of outside the reference configuration,
/// where they are zero.
fn turns<'t>(terms: impl Iterator<Item = &'t Term>) -> Vec<Turn> {
    fn find(term: &Term, turns: &mut Vec<Turn>) {
        match term {
            Term::Angle(turn) if !turns.contains(turn) => turns.push(*turn),
            Term::Sum(terms) => terms.iter().for_each(|(_, term)| find(term, turns)),
            Term::Product(a, b) | Term::Dot(a, b) | Term::Cross(a, b) | Term::Direction(a, b) => {
                find(a, turns);
                find(b, turns);
            }
            Term::Components(components) => components.iter().for_each(|c| find(c, turns)),
            Term::Function(_, term) | Term::Rate(term) => find(term, turns),
            Term::Law { arguments, .. } => arguments.iter().for_each(|term| find(term, turns)),
            _ => {}
        }
    }
    let mut turns = Vec::new();
    terms.for_each(|term| find(term, &mut turns));
    turns
}

/// The velocity of the material of the second body at a point against that of the first there.
fn slip(point: &Term) -> Term {
    let of = |body: usize, is_minus: bool| {
        let origin = Term::Origin(body);
        let arm = Term::Sum(vec![(false, point.clone()), (true, origin.clone())]);
        let spin = Term::Spin {
            from: None,
            to: body,
        };
        [
            (is_minus, Term::Rate(Box::new(origin))),
            (is_minus, Term::Cross(Box::new(spin), Box::new(arm))),
        ]
    };
    Term::Sum([of(1, false), of(0, true)].concat())
}

/// Tells definitions apart, by their text without spaces.
fn fingerprint(text: &str) -> u64 {
    wire::hash(text.bytes().filter(|byte| !byte.is_ascii_whitespace()))
}

/// Reads the statements of a definition.
struct Reader<'a> {
    syntax: &'a JointSyntax,
    context: Context<'a>,
    rows: Vec<Row>,
    /// Where they are written.
    places: Vec<Span>,
    actions: Vec<Action>,
    angle: Option<Turn>,
    angles: Option<[usize; 2]>,
    displacement: Option<Term>,
    contact: Option<[Term; 3]>,
    requirements: Vec<Term>,
    motions: Option<Vec<Motion>>,
    drive: Option<usize>,
}

impl Reader<'_> {
    /// What stands behind `=` in the signature.
    fn default(&self, parameter: &ParameterSyntax, faults: &mut Faults) -> Option<Term> {
        let expr = parameter.default.as_ref()?;
        let name = &parameter.name;
        let parameters = self.context.parameters;
        let place = parameters.iter().position(|p| p.name == *name)?;
        let known = &parameters[place];
        if !known.kind.is_number() {
            faults.at(
                expr,
                format!(
                    "`{name}` has no default: only a `Length`, an `Angle` or a `Number` has one"
                ),
            );
            return None;
        }
        let term = self.context.scalar(expr, faults)?;
        if !is_constant(&term) {
            faults.at(
                expr,
                format!(
                    "the default of `{name}` depends on the motion; write `initial(..)` for its value in the reference \
                     configuration"
                ),
            );
            return None;
        }
        let behind = (place..parameters.len())
            .find(|&p| term.has(|term| matches!(term, Term::Scalar(found) if *found == p)));
        if let Some(behind) = behind {
            let behind = &parameters[behind].name;
            faults.at(
                expr,
                format!("a default speaks of parameters that stand before it; `{behind}` does not stand before `{name}`"),
            );
            return None;
        }
        Some(term)
    }

    /// Refuses what no motion changes, where it has to.
    fn must_move(&self, term: &Term, at: impl ToTokens, what: &str, faults: &mut Faults) -> bool {
        // Without bodies there is one fault, and it is another one.
        let moves = self.syntax.bodies.is_empty() || term.moves();
        if !moves {
            faults.at(
                at,
                format!("{what} depends on no body; nothing that moves stands in it"),
            );
        }
        moves
    }

    fn statement(&mut self, statement: &Statement, faults: &mut Faults) {
        match statement {
            Statement::Let(name, expr) => self.bind(name, expr.as_deref(), faults),
            Statement::Zero(expr) => {
                if let Some(shaped) = self.context.expression(expr, faults)
                    && self.joint_only(expr, "an equation", faults)
                    && shaped.terms.iter().all(|term| {
                        self.must_move(term, expr, "this equation", faults)
                            && is_linear(term, expr, faults)
                    })
                {
                    self.rows.extend(shaped.rows());
                    self.places.resize(self.rows.len(), expr.span());
                }
            }
            Statement::Angle { keyword, axes } => self.read_angle(keyword, axes, faults),
            Statement::Displacement(keyword, expr) => self.read_displacement(keyword, expr, faults),
            Statement::Contact(word, at, normal) => self.read_contact(word, [at, normal], faults),
            Statement::Require(keyword, written) => self.require(keyword, written, faults),
            Statement::Motion {
                keyword, motions, ..
            } => self.read_motions(keyword, motions, faults),
            Statement::Drive(keyword, written, law) => {
                let driven = self.context.scalar(written, faults);
                let law = self.context.scalar(law, faults);
                if self.drive.is_some() {
                    faults.at(
                        keyword,
                        "a joint drives once; write a second joint for this",
                    );
                } else if self.joint_only(keyword, "a driver", faults)
                    && let (Some(driven), Some(law)) = (driven, law)
                    && self.must_move(&driven, written, "what is driven", faults)
                    && let difference = Term::Sum(vec![(false, driven), (true, law)])
                    && is_linear(&difference, written, faults)
                {
                    self.drive = Some(self.rows.iter().map(Row::equations).sum());
                    self.rows.push(Row::Scalar(difference));
                    self.places.push(keyword.span());
                }
            }
            Statement::Potential(keyword, written) => {
                let energy = self.context.scalar(written, faults);
                if self.force_only(keyword, faults)
                    && let Some(energy) = energy
                    && !has_rate(
                        &energy,
                        written,
                        "a potential depends on positions alone; write `-damping * rate(d) along d` for what depends on a rate",
                        faults,
                    )
                    && self.must_move(&energy, written, "this potential", faults)
                {
                    self.actions.push(Action::Potential(energy));
                }
            }
            Statement::Along(effort, keyword, written) => {
                let effort = self.context.scalar(effort, faults);
                let coordinate = self.context.scalar(written, faults);
                if self.force_only(keyword, faults)
                    && let (Some(effort), Some(coordinate)) = (effort, coordinate)
                    && !has_rate(
                        &coordinate,
                        written,
                        "a force acts along a length or an angle, not along a rate",
                        faults,
                    )
                    && self.must_move(&coordinate, written, "the coordinate of a force", faults)
                {
                    self.actions.push(Action::Along { effort, coordinate });
                }
            }
            Statement::Force(keyword, vector, point) => {
                let vector = self.context.vector(vector, faults);
                let at = self.context.vector(point, faults);
                if self.force_only(keyword, faults)
                    && let (Some(vector), Some(at)) = (vector, at)
                {
                    if !matches!(at, Term::Point { .. } | Term::Origin(_)) {
                        faults.at(
                            point,
                            "a force acts at a point of a body, such as `j.point` or `j.origin`",
                        );
                        return;
                    }
                    self.actions.push(Action::Force { vector, point: at });
                }
            }
            Statement::Moment(keyword, vector, body) => {
                let vector = self.context.vector(vector, faults);
                let body = self.context.body(body, faults);
                if self.force_only(keyword, faults)
                    && let (Some(vector), Some(body)) = (vector, body)
                {
                    self.actions.push(Action::Moment { vector, body });
                }
            }
        }
    }

    fn read_displacement(&mut self, keyword: &Ident, expr: &syn::Expr, faults: &mut Faults) {
        let term = self.context.scalar(expr, faults);
        if self.displacement.is_some() {
            faults.at(keyword, "a joint has one displacement; this is the second");
        } else if self.joint_only(keyword, "a displacement", faults)
            && let Some(term) = term
            && !has_rate(
                &term,
                expr,
                "a displacement depends on positions alone; its rate is read by `displacement_rate`",
                faults,
            )
        {
            self.displacement = Some(term);
        }
    }

    fn read_contact(&mut self, keyword: &Ident, written: [&syn::Expr; 2], faults: &mut Faults) {
        let [point, normal] = written.map(|expr| self.context.vector(expr, faults));
        let (name, count) = (&self.syntax.name, self.syntax.bodies.len());
        if self.contact.is_some() {
            faults.at(keyword, "a joint has one contact; this is the second");
        } else if count < 2 {
            let message = format!("a contact needs two bodies; `{name}` has {count}");
            faults.at(keyword, message);
        } else if self.joint_only(keyword, "a contact", faults)
            && let (Some(point), Some(normal)) = (point, normal)
        {
            let message = "a contact depends on positions alone; its slip is read with it";
            let mut is_sound = true;
            for (term, written) in [(&point, written[0]), (&normal, written[1])] {
                // Its kernel knows neither the counters of turns nor the states in laws.
                if term.has(|term| matches!(term, Term::Law { .. } | Term::Angle(_))) {
                    is_sound = false;
                    faults.at(
                        written,
                        "a contact depends on points and directions: no law, no angle over many turns",
                    );
                }
                is_sound &= !has_rate(term, written, message, faults);
            }
            if is_sound {
                let slip = slip(&point);
                self.contact = Some([point, normal, slip]);
            }
        }
    }

    /// What is positive on the side that is meant: a function of the configuration alone.
    fn require(&mut self, keyword: &Ident, written: &syn::Expr, faults: &mut Faults) {
        let term = self.context.scalar(written, faults);
        if !self.joint_only(keyword, "what tells a side", faults) {
            return;
        }
        let Some(term) = term else { return };
        let not_of_places = term.has(|term| {
            term.is_rate() || matches!(term, Term::Time | Term::Law { .. } | Term::Angle(_))
        });
        if not_of_places {
            faults.at(
                written,
                "what tells a side depends on points and directions alone: no rate, no time, no law, no angle over many turns",
            );
        } else if self.must_move(&term, written, "this requirement", faults) {
            self.requirements.push(term);
        }
    }

    fn bind(&mut self, name: &Ident, expr: Option<&syn::Expr>, faults: &mut Faults) {
        let mut value = expr.and_then(|expr| self.context.expression(expr, faults));
        if value
            .as_ref()
            .is_some_and(|value| extent(&value.terms).is_too_large())
        {
            faults.at(expr, too_large("this is"));
            value = None;
        }
        if RESERVED.contains(&name.to_string().as_str()) {
            faults.at(
                name,
                format!("`{name}` is a word of the language; take another name"),
            );
        } else if self.context.is_known(name) {
            faults.at(name, format!("`{name}` is taken; take another name"));
            // Nobody can tell which of two is meant later.
            for (known, value) in &mut self.context.names {
                if known == name {
                    *value = None;
                }
            }
        } else {
            self.context.names.push((name.clone(), value));
        }
    }

    fn joint_only(&self, at: impl ToTokens, what: &str, faults: &mut Faults) -> bool {
        let fits = self.syntax.kind == ElementKind::Joint;
        if !fits {
            faults.at(
                at,
                format!(
                    "{what} belongs in `joint!`; a force is `potential ..`, `.. along ..`, `force .. at ..` or \
                     `moment .. on ..`"
                ),
            );
        }
        fits
    }

    fn force_only(&self, at: impl ToTokens, faults: &mut Faults) -> bool {
        let fits = self.syntax.kind == ElementKind::Force;
        if !fits {
            faults.at(
                at,
                "a joint exerts no force of its own; this belongs in `force!`",
            );
        }
        fits
    }

    fn read_motions(&mut self, keyword: &Ident, written: &[MotionSyntax], faults: &mut Faults) {
        let motions = self.context.motions(written, faults);
        if self.motions.is_some() {
            faults.at(
                keyword,
                "a joint says once how it moves; this is the second time",
            );
        } else if self.joint_only(keyword, "how something moves", faults) {
            let count = self.syntax.bodies.len();
            // Without bodies there is one fault, and it is another one.
            if count != 2 && count != 0 {
                let name = &self.syntax.name;
                faults.at(
                    keyword,
                    format!(
                        "a motion is that of a second body against a first; `{name}` has {count}"
                    ),
                );
            }
            self.motions = Some(motions);
        }
    }

    /// Refuses screws whose turns are not counted, once all equations are known.
    fn must_count(&self, faults: &mut Faults) {
        let mut statements = self.syntax.statements.iter();
        let written = statements.find_map(|statement| match statement {
            Statement::Motion { motions, .. } => Some(motions.as_slice()),
            _ => None,
        });
        if let (Some(motions), Some(written)) = (&self.motions, written)
            && motions.len() == written.len()
        {
            let counted = turns(self.rows.iter().map(Row::term));
            must_count(motions, written, &counted, &self.context, faults);
        }
    }

    /// Refuses two angles that are not those of the joint's motion, once that is known.
    fn must_turn(&self, faults: &mut Faults) {
        let Some(angles) = self.angles else { return };
        for statement in &self.syntax.statements {
            if let Statement::Angle { axes, .. } = statement {
                must_turn(angles, self.motions.as_deref(), axes, faults);
            }
        }
    }

    fn read_angle(&mut self, keyword: &Ident, axes: &[Ident], faults: &mut Faults) {
        if self.angle.is_some() || self.angles.is_some() {
            faults.at(keyword, "a joint has one angle; this is the second");
        } else if self.syntax.bodies.len() != 2 {
            let (name, count) = (&self.syntax.name, self.syntax.bodies.len());
            faults.at(
                keyword,
                format!("an angle needs two bodies; `{name}` has {count}"),
            );
        } else if self.joint_only(keyword, "an angle to read", faults) {
            let places: Vec<Option<usize>> = axes
                .iter()
                .map(|axis| self.context.axis(axis, faults))
                .collect();
            match places[..] {
                [Some(axis)] => self.angle = Some(Turn::of_joint(axis)),
                [Some(first), Some(second)] => self.angles = Some([first, second]),
                _ => {}
            }
        }
    }
}

impl Shaped {
    /// The equations that it stands for.
    fn rows(self) -> impl Iterator<Item = Row> {
        let vector = self.vector;
        self.terms.into_iter().map(move |term| {
            if vector {
                Row::Vector(term)
            } else {
                Row::Scalar(term)
            }
        })
    }
}
