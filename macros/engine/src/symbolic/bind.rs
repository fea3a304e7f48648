//! Definitions bound to the bodies and numbers of a mechanism.

use super::arena::{Arena, Expr, Input};
use super::expression::{AngleExpr, PairedAngles, ScalarExpr, VectorExpr};
use super::fixed::{Copies, axis_and_normals, copies, number, triple};
use super::start;
use super::vector::{Triple, ZERO};
use crate::model::law::Held;
use crate::model::{Action, Binding, Element, Function, LawTerm, Model, Term, Turn};

/// What a force does, bound to bodies.
#[derive(Clone, Debug)]
pub enum Effect {
    /// A potential energy.
    Potential(ScalarExpr),
    /// A generalised force along a coordinate: effort, coordinate.
    Along(ScalarExpr, ScalarExpr),
    /// A force at a point: force, point.
    Force(VectorExpr, VectorExpr),
    /// A moment on a body.
    Moment(VectorExpr, Option<usize>),
}

/// The copies of all vector parameters of joints, then forces; `None` for the others.
pub(super) fn all_copies(arena: &mut Arena, model: &Model) -> Vec<Vec<Option<Copies>>> {
    let elements = model.elements();
    elements
        .map(|element| copies_of(arena, model, element))
        .collect()
}

/// The copies of the vector parameters of a joint or force; `None` for the others.
fn copies_of(arena: &mut Arena, model: &Model, element: &Element) -> Vec<Option<Copies>> {
    let parameters = &model.definition(element).parameters;
    parameters
        .iter()
        .enumerate()
        .map(|(place, parameter)| {
            let is_vector = parameter.kind.is_vector();
            is_vector.then(|| copies(arena, model, element, place))
        })
        .collect()
}

/// The translation of a screw for a radian, from the parameter of a joint that is its translation
/// for a turn.
pub fn advance(arena: &mut Arena, model: &Model, joint: &Element, pitch: usize) -> Expr {
    let copies = copies_of(arena, model, joint);
    let binder = Binder {
        model,
        element: joint,
        copies: &copies,
        // Defaults are constant, and an angle is zero in the reference configuration.
        first_counter: 0,
        first_state: 0,
        paired: &|_, _, _| None,
    };
    let pitch = binder.number(arena, pitch);
    let pitch = start::scalar(arena, model, &pitch);
    let turn = arena.constant(std::f64::consts::TAU);
    arena.div(pitch, turn)
}

/// Replaces formal bodies and parameters of a definition by those of a joint or force.
pub(super) struct Binder<'a> {
    pub(super) model: &'a Model,
    pub(super) element: &'a Element,
    pub(super) copies: &'a [Option<Copies>],
    /// The place of its first auxiliary variable in the state.
    pub(super) first_counter: usize,
    /// The place of the first of the user's own states.
    pub(super) first_state: usize,
    /// Angles that the coordinates hold as pairs.
    pub(super) paired: &'a PairedAngles<'a>,
}

impl Binder<'_> {
    fn copy(&self, parameter: usize, body: usize) -> Triple {
        self.of(parameter).vector[body]
    }

    fn of(&self, parameter: usize) -> &Copies {
        let copies = self.copies[parameter].as_ref();
        copies.expect("a parameter that is used as a vector has copies")
    }

    fn normal(&self, parameter: usize, body: usize, which: usize) -> VectorExpr {
        let normal = self.of(parameter).normals[body][which];
        VectorExpr::Fixed(self.element.bodies[body], normal)
    }

    pub(super) fn vector(&self, arena: &mut Arena, term: &Term) -> VectorExpr {
        match term {
            Term::Point { body, parameter } => {
                VectorExpr::Point(self.element.bodies[*body], self.copy(*parameter, *body))
            }
            Term::Fixed { body, parameter } => {
                VectorExpr::Fixed(self.element.bodies[*body], self.copy(*parameter, *body))
            }
            Term::Normal {
                body,
                parameter,
                which,
            } => self.normal(*parameter, *body, *which),
            Term::Origin(body) => VectorExpr::Point(self.element.bodies[*body], ZERO),
            Term::Components(components) => {
                let parts = [0, 1, 2].map(|k| self.scalar(arena, &components[k]));
                if let [
                    ScalarExpr::Constant(x),
                    ScalarExpr::Constant(y),
                    ScalarExpr::Constant(z),
                ] = parts
                {
                    return VectorExpr::Fixed(None, [x, y, z]);
                }
                let mut k = 0;
                VectorExpr::Sum(
                    parts
                        .map(|part| {
                            let mut unit = ZERO;
                            unit[k] = Arena::ONE;
                            k += 1;
                            let unit = Box::new(VectorExpr::Fixed(None, unit));
                            (Arena::ONE, VectorExpr::Scaled(Box::new(part), unit))
                        })
                        .into(),
                )
            }
            Term::Onto(body, vector) => {
                let vector = self.vector(arena, vector);
                let body = self.element.bodies[*body];
                VectorExpr::Fixed(body, start::on_body(arena, self.model, &vector, body))
            }
            Term::Sum(terms) => VectorExpr::Sum(
                terms
                    .iter()
                    .map(|(minus, term)| (signed_one(*minus), self.vector(arena, term)))
                    .collect(),
            ),
            Term::Product(scalar, vector) => {
                let (scalar, vector) = (self.scalar(arena, scalar), self.vector(arena, vector));
                match scalar {
                    ScalarExpr::Constant(factor) => VectorExpr::Sum(vec![(factor, vector)]),
                    scalar => VectorExpr::Scaled(Box::new(scalar), Box::new(vector)),
                }
            }
            Term::Cross(a, b) => VectorExpr::Cross(
                Box::new(self.vector(arena, a)),
                Box::new(self.vector(arena, b)),
            ),
            Term::Rate(inner) => VectorExpr::Rate(Box::new(self.vector(arena, inner))),
            Term::Spin { from, to } => VectorExpr::Spin([
                from.and_then(|from| self.element.bodies[from]),
                self.element.bodies[*to],
            ]),
            Term::Number(_)
            | Term::Scalar(_)
            | Term::Time
            | Term::Dot(..)
            | Term::Function(..)
            | Term::Direction(..)
            | Term::Angle(_)
            | Term::Initial(_)
            | Term::Law { .. } => unreachable!("shapes are checked where the definition stands"),
        }
    }

    pub(super) fn scalar(&self, arena: &mut Arena, term: &Term) -> ScalarExpr {
        match term {
            Term::Number(value) => ScalarExpr::Constant(arena.constant(*value)),
            Term::Scalar(parameter) => self.number(arena, *parameter),
            Term::Time => ScalarExpr::Time,
            Term::Sum(terms) => {
                let terms = terms
                    .iter()
                    .map(|(minus, term)| (signed_one(*minus), self.scalar(arena, term)))
                    .collect();
                sum(arena, terms)
            }
            Term::Product(a, b) => {
                let (a, b) = (self.scalar(arena, a), self.scalar(arena, b));
                product(arena, a, b)
            }
            Term::Dot(a, b) => ScalarExpr::Dot(
                Box::new(self.vector(arena, a)),
                Box::new(self.vector(arena, b)),
            ),
            Term::Function(function, inner) => {
                let inner = self.scalar(arena, inner);
                of(arena, *function, inner)
            }
            Term::Direction(sine, cosine) => {
                let (sine, cosine) = (self.scalar(arena, sine), self.scalar(arena, cosine));
                direction(arena, sine, cosine)
            }
            Term::Angle(turn) => ScalarExpr::Angle(Box::new(self.angle(arena, *turn))),
            Term::Initial(inner) => {
                let inner = self.scalar(arena, inner);
                ScalarExpr::Constant(start::scalar(arena, self.model, &inner))
            }
            Term::Rate(inner) => ScalarExpr::Rate(Box::new(self.scalar(arena, inner))),
            Term::Law {
                parameter,
                arguments: terms,
            } => {
                let arguments: Vec<ScalarExpr> = terms
                    .iter()
                    .map(|argument| self.scalar(arena, argument))
                    .collect();
                match &self.element.bindings[*parameter] {
                    Binding::Law(law) => {
                        let reading = |_: &mut Arena, _: usize, _: &Term| {
                            unreachable!("the laws of forces read no other joint or force")
                        };
                        let first_state = self.first_state;
                        Law {
                            first_state,
                            arguments: &arguments,
                            reading: &reading,
                            held: &|of| self.held(terms, of),
                        }
                        .expand(arena, law)
                    }
                    other => unreachable!("a law is bound to a law, not to {other:?}"),
                }
            }
            Term::Point { .. }
            | Term::Fixed { .. }
            | Term::Normal { .. }
            | Term::Origin(_)
            | Term::Components(_)
            | Term::Onto(..)
            | Term::Spin { .. }
            | Term::Cross(..) => unreachable!("shapes are checked where the definition stands"),
        }
    }

    /// The side that is held of an expression of a law with these arguments.
    fn held(&self, arguments: &[Term], of: &LawTerm) -> Held {
        let mut elements = self.model.elements();
        let place = elements.position(|element| std::ptr::eq(element, self.element));
        self.model.held(place.map(|place| (place, arguments)), of)
    }

    fn number(&self, arena: &mut Arena, parameter: usize) -> ScalarExpr {
        let definition = self.model.definition(self.element);
        match (
            &self.element.bindings[parameter],
            &definition.parameters[parameter].default,
        ) {
            (Binding::Scalar(value), _) => ScalarExpr::Constant(number(arena, *value)),
            (_, Some(default)) => self.scalar(arena, default),
            (other, None) => unreachable!(
                "a number is given or has a default, but `{}` is {other:?}",
                definition.parameters[parameter].name
            ),
        }
    }

    /// The angle of a body against another: with axis and normals on either,
    /// `cosine = n1(i) . n1(j)`, `sine = n2(i) . n1(j)`.
    pub(super) fn angle(&self, arena: &mut Arena, turn: Turn) -> AngleExpr {
        let Turn { from, to, axis } = turn;
        let dot = |which| {
            ScalarExpr::Dot(
                Box::new(self.normal(axis, from, which)),
                Box::new(self.normal(axis, to, 0)),
            )
        };
        // Axes given body by body need not be parallel in the reference configuration.
        let paired = match self.element.bindings[axis] {
            Binding::Global(given) => {
                let given = triple(arena, given);
                let [axis, ..] = axis_and_normals(arena, given);
                let bodies = [from, to].map(|body| self.element.bodies[body]);
                (self.paired)(arena, bodies, axis)
            }
            _ => None,
        };
        AngleExpr {
            paired,
            sine: dot(1),
            cosine: dot(0),
            // An angle that stands within `initial` alone has none: it is zero there. Nor has one
            // whose value nobody reads.
            near: self
                .counter(turn)
                .map_or(Arena::ZERO, |place| arena.input(Input::Coordinate(place))),
        }
    }

    /// The place of the auxiliary variable of an angle in the state.
    fn counter(&self, turn: Turn) -> Option<u32> {
        let turns = self.model.counted(self.element);
        let place = turns.iter().position(|known| *known == turn)?;
        let place = u32::try_from(self.first_counter + place);
        Some(place.expect("fewer than 2^32 coordinates"))
    }

    pub(super) fn effect(&self, arena: &mut Arena, action: &Action) -> Effect {
        match action {
            Action::Potential(energy) => Effect::Potential(self.scalar(arena, energy)),
            Action::Along { effort, coordinate } => {
                Effect::Along(self.scalar(arena, effort), self.scalar(arena, coordinate))
            }
            Action::Force { vector, point } => {
                Effect::Force(self.vector(arena, vector), self.vector(arena, point))
            }
            Action::Moment { vector, body } => {
                Effect::Moment(self.vector(arena, vector), self.element.bodies[*body])
            }
        }
    }
}

/// What stands for the names in a law.
pub(super) struct Law<'a> {
    /// The place of the first of the user's own states.
    pub(super) first_state: usize,
    pub(super) arguments: &'a [ScalarExpr],
    /// What is read of a joint or force, by its place.
    pub(super) reading: &'a dyn Fn(&mut Arena, usize, &Term) -> ScalarExpr,
    /// The side that is held of an expression of the law.
    pub(super) held: &'a dyn Fn(&LawTerm) -> Held,
}

impl Law<'_> {
    /// A law with all of these put in.
    pub(super) fn expand(&self, arena: &mut Arena, law: &LawTerm) -> ScalarExpr {
        match law {
            LawTerm::Number(value) => ScalarExpr::Constant(number(arena, *value)),
            LawTerm::Time => ScalarExpr::Time,
            LawTerm::Argument(place) => self.arguments[*place].clone(),
            LawTerm::State(place) => ScalarExpr::State {
                place: *place,
                value: arena.input(Input::Coordinate((self.first_state + place) as u32)),
            },
            LawTerm::Reading { element, term } => (self.reading)(arena, *element, term),
            LawTerm::Sum(terms) => {
                let terms = terms
                    .iter()
                    .map(|(minus, term)| (signed_one(*minus), self.expand(arena, term)))
                    .collect();
                sum(arena, terms)
            }
            LawTerm::Product(a, b) => {
                let (a, b) = (self.expand(arena, a), self.expand(arena, b));
                product(arena, a, b)
            }
            LawTerm::Function(function, inner) => {
                let inner = self.expand(arena, inner);
                of(arena, *function, inner)
            }
            LawTerm::Direction(sine, cosine) => {
                let (sine, cosine) = (self.expand(arena, sine), self.expand(arena, cosine));
                direction(arena, sine, cosine)
            }
            LawTerm::Setpoint(numbers) => {
                ScalarExpr::Setpoint(numbers.map(|value| number(arena, value)))
            }
            LawTerm::Side(switching) => self.side(arena, &switching.of),
            LawTerm::Select(switching, parts) => {
                let side = self.side(arena, &switching.of);
                let parts = parts.each_ref().map(|part| self.expand(arena, part));
                select(arena, side, parts)
            }
        }
    }

    /// The side of an expression.
    fn side(&self, arena: &mut Arena, of: &LawTerm) -> ScalarExpr {
        let held = match (self.held)(of) {
            Some((held, is_opposite)) => {
                let held = number(arena, held);
                if is_opposite { -held } else { held }
            }
            None => Arena::ZERO,
        };
        match self.expand(arena, of) {
            ScalarExpr::Constant(value) if held == Arena::ZERO => {
                ScalarExpr::Constant(arena.side(held, value))
            }
            of => ScalarExpr::Side {
                held,
                of: Box::new(of),
            },
        }
    }
}

/// A sum; a constant where all terms are, and the one term that is left where the others are zero.
fn sum(arena: &mut Arena, mut terms: Vec<(Expr, ScalarExpr)>) -> ScalarExpr {
    terms.retain(|(_, term)| !matches!(term, ScalarExpr::Constant(Arena::ZERO)));
    if let [(Arena::ONE, term)] = &terms[..] {
        return term.clone();
    }
    let mut total = Arena::ZERO;
    for (factor, term) in &terms {
        let ScalarExpr::Constant(value) = term else {
            return ScalarExpr::Sum(terms);
        };
        let product = arena.mul(*factor, *value);
        total = arena.add(total, product);
    }
    ScalarExpr::Constant(total)
}

/// A product; constants fold and become factors.
fn product(arena: &mut Arena, a: ScalarExpr, b: ScalarExpr) -> ScalarExpr {
    match (a, b) {
        (ScalarExpr::Constant(a), ScalarExpr::Constant(b)) => ScalarExpr::Constant(arena.mul(a, b)),
        (ScalarExpr::Constant(Arena::ZERO), _) | (_, ScalarExpr::Constant(Arena::ZERO)) => {
            ScalarExpr::Constant(Arena::ZERO)
        }
        (ScalarExpr::Constant(factor), other) | (other, ScalarExpr::Constant(factor)) => {
            ScalarExpr::Sum(vec![(factor, other)])
        }
        (a, b) => square(&a, &b).unwrap_or_else(|| ScalarExpr::Product(Box::new(a), Box::new(b))),
    }
}

/// What stands under a root, where a product is its square: it has a gradient where it vanishes,
/// and the root has none. So a spring of free length zero passes its anchor.
fn square(a: &ScalarExpr, b: &ScalarExpr) -> Option<ScalarExpr> {
    let ScalarExpr::Function(Function::SquareRoot, under) = b else {
        return None;
    };
    if a == b {
        return Some((**under).clone());
    }
    match a {
        ScalarExpr::Sum(terms) => match &terms[..] {
            [(factor, root)] if root == b => {
                Some(ScalarExpr::Sum(vec![(*factor, (**under).clone())]))
            }
            _ => None,
        },
        _ => None,
    }
}

/// The first of two expressions where a side is not negative, else the second.
fn select(arena: &mut Arena, side: ScalarExpr, parts: [ScalarExpr; 2]) -> ScalarExpr {
    match (&side, &parts) {
        (
            ScalarExpr::Constant(side),
            [ScalarExpr::Constant(first), ScalarExpr::Constant(second)],
        ) => ScalarExpr::Constant(arena.select(*side, *first, *second)),
        _ => ScalarExpr::Select {
            side: Box::new(side),
            parts: Box::new(parts),
        },
    }
}

/// A function of a scalar.
fn of(arena: &mut Arena, function: Function, inner: ScalarExpr) -> ScalarExpr {
    match inner {
        ScalarExpr::Constant(value) => ScalarExpr::Constant(function.value(arena, value)),
        inner => ScalarExpr::Function(function, Box::new(inner)),
    }
}

/// The angle of a sine and a cosine, from `-pi` to `pi`.
fn direction(arena: &mut Arena, sine: ScalarExpr, cosine: ScalarExpr) -> ScalarExpr {
    match (sine, cosine) {
        (ScalarExpr::Constant(sine), ScalarExpr::Constant(cosine)) => {
            ScalarExpr::Constant(arena.atan2(sine, cosine))
        }
        (sine, cosine) => ScalarExpr::Direction(Box::new(AngleExpr {
            sine,
            cosine,
            near: Arena::ZERO,
            paired: None,
        })),
    }
}

fn signed_one(minus: bool) -> Expr {
    if minus { -Arena::ONE } else { Arena::ONE }
}
