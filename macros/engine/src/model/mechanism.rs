//! A mechanism: bodies, joints, gravity.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::ops::Range;

use proc_macro2::{Ident, TokenStream};

use super::asked::Asked;
use super::joint::{ElementDef, Row, Term, Turn};
use super::law::{LawTerm, Switch};
use super::name::Name;
use super::number::{Number, Symbol, literals};
use super::rank::{Components, Independence};
use super::shape::Shape;
use super::value::{RunTimeValue, Spline, ValueKind, first_further};

/// Whether a body has an orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// Position and orientation.
    Rigid,
    /// Position only.
    Particle,
}

impl BodyKind {
    /// The coordinates of a body of this kind.
    #[must_use]
    pub const fn coordinates(self) -> usize {
        match self {
            Self::Rigid => 7,
            Self::Particle => 3,
        }
    }

    /// The velocities of a body of this kind.
    #[must_use]
    pub const fn velocities(self) -> usize {
        match self {
            Self::Rigid => 6,
            Self::Particle => 3,
        }
    }
}

/// A body. Its axes here are the principal axes.
#[derive(Clone, Debug)]
pub struct Body {
    /// The field, or its element.
    pub name: Name,
    /// Body or particle.
    pub kind: BodyKind,
    /// Mass (kg).
    pub mass: Number,
    /// Principal moments of inertia about the centre of mass (kg m^2).
    pub inertia: [Number; 3],
    /// Euler parameters of the rotation that takes components in the user's axes to principal axes.
    pub user_axes: [f64; 4],
    /// The centre of mass at the start (m, global).
    pub position: [Number; 3],
    /// Euler parameters of the user's axes at the start.
    pub orientation: [Number; 4],
    /// The velocity of the centre of mass at the start (m/s, global).
    pub velocity: [Number; 3],
    /// The angular velocity at the start (rad/s, the user's axes).
    pub angular_velocity: [Number; 3],
    /// Whether it may go without a joint.
    pub free: bool,
    /// Whether mass and inertia are taken as they are given, though no body may have them.
    pub as_given: bool,
    /// What it looks like, where it is described by shapes.
    pub shapes: Vec<Shape>,
}

impl Body {
    /// Whether mass and moments, as far as they are written out, are positive.
    #[must_use]
    pub fn has_inertia(&self) -> bool {
        let moments: &[Number] = match self.kind {
            BodyKind::Rigid => &self.inertia,
            BodyKind::Particle => &[],
        };
        let mut all = moments.iter().chain([&self.mass]);
        all.all(|number| number.literal().is_none_or(|value| value > 0.0))
    }
}

/// What a mechanism gives for a parameter of a joint.
#[derive(Clone, Debug)]
pub enum Binding {
    /// A point or vector in global axes at the initial configuration.
    Global([Number; 3]),
    /// A point or vector for every body, in the user's body axes.
    Local(Vec<[Number; 3]>),
    /// A number.
    Scalar(Number),
    /// A law.
    Law(LawTerm),
    /// What the definition says where nothing is given.
    Default,
}

/// A joint or a force of a mechanism.
#[derive(Clone, Debug)]
pub struct Element {
    /// The field, or its element.
    pub name: Name,
    /// The type as it was written, without generic arguments.
    pub path: TokenStream,
    /// The place of its definition.
    pub definition: usize,
    /// Its bodies by their places; `None` is the ground.
    pub bodies: Vec<Option<usize>>,
    /// What its parameters are, in the order of the definition.
    pub bindings: Vec<Binding>,
    /// Equations of its definition that are left out, in order.
    pub dropped: Vec<usize>,
    /// The components of vector equations that lose some, each by the first of its three equations
    /// in the definition. Those of others are along global axes.
    pub components: Vec<(usize, Components)>,
    /// Whether it carries no body in joint coordinates, because the user says so.
    pub is_cut: bool,
    /// What rates of states read of it.
    pub read: Vec<Term>,
    /// Its limits, where it has some.
    pub limits: Option<Limits>,
}

impl Element {
    /// The components of the vector equation that begins at an equation of the definition; `None`
    /// for those along global axes.
    #[must_use]
    pub fn components_of(&self, first: usize) -> Option<&Components> {
        let mut known = self.components.iter();
        let found = known.find(|(equation, _)| *equation == first);
        found.map(|(_, components)| components)
    }
}

/// The limits of a joint that leaves one coordinate free: on its angle, else its displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The lower and the upper one (rad, m).
    pub bounds: [Number; 2],
    /// Newton's coefficient, from 0 to 1.
    pub restitution: Number,
}

/// A state of the user's own: a number that integrates a rate.
#[derive(Clone, Debug)]
pub struct UserState {
    /// The field, or its element.
    pub name: Name,
    /// The place of its start among the run-time values.
    pub value: usize,
    /// Its value at the start.
    pub start: Number,
    /// Its time derivative.
    pub rate: LawTerm,
}

/// A named point, fixed on a body.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// The field, or its element.
    pub name: Name,
    /// The body; `None` is the ground.
    pub body: Option<usize>,
    /// Where it is at the start (m, global).
    pub position: [Number; 3],
}

/// A field, or an element of one, that is an assembly.
#[derive(Clone, Debug)]
pub struct Part {
    /// The field, or its element.
    pub name: Name,
    /// The type, as the compiler finds it from the mechanism.
    pub path: TokenStream,
    /// The fingerprint of its description.
    pub fingerprint: u64,
}

/// An angle over many turns: an auxiliary variable of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counter {
    /// The place of the joint, or behind the joints that of the force.
    pub element: usize,
    /// The angle.
    pub turn: Turn,
}

/// By what the bodies of a mechanism are described.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coordinates {
    /// Positions and orientations of the bodies.
    #[default]
    Bodies,
    /// What the joints of a spanning tree leave free; what asks for the bodies' own equations of
    /// motion puts them together from their parts.
    Joints,
    /// Either, each with evaluations of its own.
    Both,
}

impl Coordinates {
    /// What `coordinates` takes.
    pub const ALL: [(&'static str, Self); 3] = [
        ("bodies", Self::Bodies),
        ("joints", Self::Joints),
        ("both", Self::Both),
    ];

    /// Whether the equations of motion of the bodies have fused evaluations.
    #[must_use]
    pub fn fuse_bodies(self) -> bool {
        self != Self::Joints
    }

    /// Whether there are joint coordinates.
    #[must_use]
    pub fn have_joints(self) -> bool {
        self != Self::Bodies
    }
}

/// A checked mechanism.
#[derive(Clone, Debug)]
pub struct Model {
    /// The struct.
    pub name: Ident,
    /// Gravity (m/s^2, global).
    pub gravity: [Number; 3],
    /// The bodies in the order of the fields.
    pub bodies: Vec<Body>,
    /// The joints in the order of the fields.
    pub joints: Vec<Element>,
    /// The forces in the order of the fields.
    pub forces: Vec<Element>,
    /// The user's own states in the order of the fields.
    pub states: Vec<UserState>,
    /// The named points in the order of the fields.
    pub points: Vec<NamedPoint>,
    /// The parts in the order of the fields, each before those in it.
    pub parts: Vec<Part>,
    /// Run-time values in the order of the fields.
    pub values: Vec<RunTimeValue>,
    /// The definitions that joints and forces use.
    pub definitions: Vec<ElementDef>,
    /// Numbers that the macro cannot see.
    pub symbols: Vec<Symbol>,
    /// The splines that laws read.
    pub splines: Vec<Spline>,
    /// The expressions whose signs decide in laws, each behind those in it.
    pub switches: Vec<Switch>,
    /// Whether the equations depend on each other.
    pub independence: Independence,
    /// By what the bodies are described.
    pub coordinates: Coordinates,
    /// Kernels in the rates of joints that are asked for.
    pub asked: Vec<Asked>,
    /// The places of the parameters by which there are derivatives of accelerations.
    pub derived_by: Vec<usize>,
    /// The constants by path that an assembly has, each once.
    pub constants: Vec<TokenStream>,
    /// Constants by their names that are said to have these values.
    pub lengths: Vec<(Ident, usize)>,
    /// The doc comments above fields, by their names, and that above the struct under none.
    pub comments: Vec<(String, String)>,
}

impl Model {
    /// Whether a body has a mass or a moment that is not positive. Then the equations of the bodies
    /// cannot be solved one by one, and motions follow from those of the joints alone.
    #[must_use]
    pub fn is_of_joints_alone(&self) -> bool {
        !self.bodies.iter().all(Body::has_inertia)
    }

    /// The same with masses and moments that are positive, wherever they are not: the least ones
    /// that are seen of the others. Where motions are compared or projected, these are a metric of
    /// them; where they move by forces, nothing.
    #[must_use]
    pub fn with_metric(&self) -> Cow<'_, Self> {
        if !self.is_of_joints_alone() {
            return Cow::Borrowed(self);
        }
        let positive = |number: &Number| self.seen(*number).filter(|value| *value > 0.0);
        let least = |numbers: &mut dyn Iterator<Item = &Number>| {
            numbers.filter_map(positive).reduce(f64::min).unwrap_or(1.0)
        };
        let mass = least(&mut self.bodies.iter().map(|body| &body.mass));
        let moment = least(&mut self.bodies.iter().flat_map(|body| &body.inertia));
        let mut metric = self.clone();
        for body in &mut metric.bodies {
            let own = [(&mut body.mass, mass)].into_iter();
            let moments = body.inertia.iter_mut().map(|own| (own, moment));
            for (own, other) in own.chain(moments) {
                if own.literal().is_some_and(|value| value <= 0.0) {
                    *own = Number::Literal(other);
                }
            }
        }
        Cow::Owned(metric)
    }

    /// A number as the macro sees it: written, or at the typical values of parameters.
    #[must_use]
    pub fn seen(&self, number: Number) -> Option<f64> {
        match number {
            Number::Literal(value) => Some(value),
            Number::Symbol(symbol) | Number::Varying(symbol) => self.like(symbol),
        }
    }

    /// The run-time values by which there are derivatives of accelerations, by their places: all
    /// inputs, and the parameters that are named.
    #[must_use]
    pub fn derived_values(&self) -> Vec<usize> {
        let values = self.values.iter().enumerate();
        let wanted = values.filter(|(place, value)| {
            let is_number = !matches!(value.kind, ValueKind::Spline(_));
            value.is_input && is_number || self.derived_by.contains(place)
        });
        wanted.map(|(place, _)| place).collect()
    }

    /// The number that a symbol is.
    #[must_use]
    pub fn number(&self, symbol: usize) -> Number {
        let mut values = self.symbols[symbol].values.iter();
        let place = symbol as u32;
        if values.any(|&value| self.values[value].is_input) {
            Number::Varying(place)
        } else {
            Number::Symbol(place)
        }
    }

    /// Several of them.
    #[must_use]
    pub fn all_seen<const N: usize>(&self, numbers: &[Number; N]) -> Option<[f64; N]> {
        literals(&numbers.map(|number| self.seen(number).map_or(number, Number::Literal)))
    }

    /// What a symbol is at the typical values of parameters.
    #[must_use]
    pub fn like(&self, symbol: u32) -> Option<f64> {
        self.symbols.get(symbol as usize)?.like
    }

    /// The definition of a joint.
    #[must_use]
    pub fn definition(&self, joint: &Element) -> &ElementDef {
        &self.definitions[joint.definition]
    }

    /// The body with the most joints of some bodies. Among equals it is one that is said to be
    /// free; then names decide.
    pub fn most_jointed(&self, bodies: impl Iterator<Item = usize>) -> Option<usize> {
        let joints = |body: usize| {
            let joints = self.joints.iter();
            joints
                .filter(|joint| joint.bodies.contains(&Some(body)))
                .count()
        };
        bodies.min_by_key(|&place| {
            let body = &self.bodies[place];
            (Reverse(joints(place)), !body.free, &body.name)
        })
    }

    /// The number of parameters: the values, their further numbers, and the sides of switches.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.first_side() + self.switches.len()
    }

    /// The place among the parameters of the first side of a switch.
    #[must_use]
    pub fn first_side(&self) -> usize {
        first_further(&self.values, self.values.len())
    }

    /// The places of a spline's numbers among the constants, which begin with those of splines.
    #[must_use]
    pub fn spline_numbers(&self, spline: usize) -> Range<usize> {
        let before = self.splines.iter().take(spline);
        let first = before.map(Spline::numbers).sum();
        first..first + self.splines.get(spline).map_or(0, Spline::numbers)
    }

    /// How many constants are numbers of splines.
    #[must_use]
    pub fn all_spline_numbers(&self) -> usize {
        self.splines.iter().map(Spline::numbers).sum()
    }

    /// Joints, then forces.
    pub fn elements(&self) -> impl Iterator<Item = &Element> {
        self.joints.iter().chain(&self.forces)
    }

    /// The auxiliary variables, in the order of the state.
    #[must_use]
    pub fn counters(&self) -> Vec<Counter> {
        let elements = self.elements().enumerate();
        elements
            .flat_map(|(element, joint)| {
                let turns = self.counted(joint).into_iter();
                turns.map(move |turn| Counter { element, turn })
            })
            .collect()
    }

    /// The mechanism of one joint and its bodies, and nothing else.
    #[must_use]
    pub fn only(&self, joint: usize) -> Self {
        let mut joint = self.joints[joint].clone();
        let mut kept: Vec<usize> = Vec::new();
        for body in joint.bodies.iter_mut().flatten() {
            let place = kept.iter().position(|known| known == body);
            *body = place.unwrap_or_else(|| {
                kept.push(*body);
                kept.len() - 1
            });
        }
        Self {
            bodies: kept.iter().map(|&body| self.bodies[body].clone()).collect(),
            joints: vec![joint],
            forces: Vec::new(),
            states: Vec::new(),
            switches: Vec::new(),
            ..self.clone()
        }
    }

    /// The number of a joint's equations that are not left out.
    #[must_use]
    pub fn equations(&self, joint: &Element) -> usize {
        self.definition(joint).equations() - joint.dropped.len()
    }

    /// The rows that are equations of velocities.
    #[must_use]
    pub fn velocity_rows(&self) -> Vec<usize> {
        let mut rows = Vec::new();
        let mut row = 0;
        for joint in &self.joints {
            let mut equation = 0;
            for definition in &self.definition(joint).rows {
                let own = equation..equation + definition.equations();
                equation = own.end;
                for _ in own.filter(|equation| !joint.dropped.contains(equation)) {
                    if definition.is_of_velocities() {
                        rows.push(row);
                    }
                    row += 1;
                }
            }
        }
        rows
    }

    /// Whether equations of velocities ask for others than zero.
    #[must_use]
    pub fn drives_velocities(&self) -> bool {
        let joints = self.joints.iter();
        joints
            .flat_map(|joint| &self.definition(joint).rows)
            .any(Row::is_driven)
    }

    /// The place of each body's first coordinate and first velocity, and the totals.
    #[must_use]
    pub fn layout(&self) -> Layout {
        let angles = self.joints.iter().filter(|joint| {
            let definition = self.definition(joint);
            definition.angle.is_some()
        });
        let angles = angles.count();
        let mut layout = Layout::default();
        for body in &self.bodies {
            layout.coordinate.push(layout.coordinates);
            layout.velocity.push(layout.velocities);
            layout.coordinates += body.kind.coordinates();
            layout.velocities += body.kind.velocities();
        }
        layout.auxiliaries = self.counters().len();
        layout.states = self.states.len();
        for joint in &self.joints {
            layout.row.push(layout.rows);
            layout.rows += self.equations(joint);
        }
        layout.turns = angles + usize::from(angles > 0);
        layout
    }
}

/// Where things stand in the state and among the rows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// The first coordinate of each body.
    pub coordinate: Vec<usize>,
    /// The first velocity of each body.
    pub velocity: Vec<usize>,
    /// The first row of each joint.
    pub row: Vec<usize>,
    /// All coordinates of bodies.
    pub coordinates: usize,
    /// Auxiliary variables, behind the coordinates of bodies.
    pub auxiliaries: usize,
    /// States of the user's own, behind the auxiliary variables.
    pub states: usize,
    /// All velocities.
    pub velocities: usize,
    /// All rows.
    pub rows: usize,
    /// The account of angles over many turns: one number for each joint with an angle, in their
    /// order, and one for how far they may have turned since.
    pub turns: usize,
}

impl Layout {
    /// Coordinates of bodies, auxiliary variables and states of the user's own.
    #[must_use]
    pub const fn stored(&self) -> usize {
        self.coordinates + self.auxiliaries + self.states
    }

    /// The joint of a row. Joints without rows stand at the place of the next.
    #[must_use]
    pub fn joint_of(&self, row: usize) -> usize {
        let joint = self.row.iter().rposition(|&first| first <= row);
        joint.unwrap_or(0)
    }

    /// The joint of a row, and its place among those of the joint.
    #[must_use]
    pub fn place_of(&self, row: usize) -> (usize, usize) {
        let joint = self.joint_of(row);
        (joint, row - self.row[joint])
    }
}
