//! A joint or a force as it is defined: formal bodies, parameters, rows, actions.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};

use super::function::Function;
use super::motion::Motion;

/// What a parameter of a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// A point, given once in global axes at the initial configuration, fixed on every body of the
    /// joint.
    Point,
    /// A direction, given like a point; of unit length.
    Axis,
    /// A vector, given like a point; of any length.
    Vector,
    /// A length (m).
    Length,
    /// An angle (rad).
    Angle,
    /// A number without unit.
    Number,
    /// A function, which the mechanism writes as an expression of the time and of the definition's
    /// arguments.
    Law,
}

impl ParameterKind {
    /// All kinds with the names they have in a definition.
    pub const ALL: [(&'static str, Self); 7] = [
        ("Point", Self::Point),
        ("Axis", Self::Axis),
        ("Vector", Self::Vector),
        ("Length", Self::Length),
        ("Angle", Self::Angle),
        ("Number", Self::Number),
        ("Law", Self::Law),
    ];

    /// Whether the parameter has three components and a copy on every body.
    #[must_use]
    pub const fn is_vector(self) -> bool {
        matches!(self, Self::Point | Self::Axis | Self::Vector)
    }

    /// Whether the parameter is a number.
    #[must_use]
    pub const fn is_number(self) -> bool {
        matches!(self, Self::Length | Self::Angle | Self::Number)
    }

    /// What a mechanism writes for it, for messages.
    #[must_use]
    pub const fn example(self) -> &'static str {
        match self {
            Self::Point => "a point such as `[0.0, 0.5, 0.0]`",
            Self::Axis => "an axis such as `[1.0, 0.0, 0.0]`",
            Self::Vector => "a vector such as `[0.0, 0.5, 0.0]`",
            Self::Length => "a length such as `0.5`",
            Self::Angle => "an angle such as `deg(30.0)`",
            Self::Number => "a number such as `2.0`",
            Self::Law => "an expression such as `0.5 * sin(10.0 * time)`",
        }
    }
}

/// A parameter of a joint or a force.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name, which is also the key in a mechanism's attribute.
    pub name: Ident,
    /// What it is.
    pub kind: ParameterKind,
    /// The names of a law's arguments.
    pub arguments: Vec<Ident>,
    /// What a number is where the mechanism does not give it.
    pub default: Option<Term>,
}

/// An expression of a definition; bodies and parameters by their places. Shapes agree.
#[derive(Clone, Debug, PartialEq)]
pub enum Term {
    /// A number.
    Number(f64),
    /// A scalar parameter.
    Scalar(usize),
    /// The time (s).
    Time,
    /// The point of a body that a parameter names.
    Point {
        /// The place of the body.
        body: usize,
        /// The place of the parameter.
        parameter: usize,
    },
    /// The vector fixed on a body that a parameter names.
    Fixed {
        /// The place of the body.
        body: usize,
        /// The place of the parameter.
        parameter: usize,
    },
    /// One of the two unit vectors fixed on a body that are perpendicular to an axis.
    Normal {
        /// The place of the body.
        body: usize,
        /// The place of the axis among the parameters.
        parameter: usize,
        /// First (0) or second (1); axis, first and second are right-handed.
        which: usize,
    },
    /// The centre of mass of a body.
    Origin(usize),
    /// A vector by its components, global axes.
    Components([Box<Term>; 3]),
    /// A vector as it is in the reference configuration, fixed on a body.
    Onto(usize, Box<Term>),
    /// A sum with signs: `true` is minus.
    Sum(Vec<(bool, Term)>),
    /// A product of scalars, or of a scalar (first) and a vector.
    Product(Box<Term>, Box<Term>),
    /// A scalar product.
    Dot(Box<Term>, Box<Term>),
    /// A cross product.
    Cross(Box<Term>, Box<Term>),
    /// A function of a scalar.
    Function(Function, Box<Term>),
    /// The angle of a sine (first) and a cosine, times any positive number, from `-pi` to `pi`.
    Direction(Box<Term>, Box<Term>),
    /// The angle of a body against another about an axis, over many turns.
    Angle(Turn),
    /// A scalar as it is in the reference configuration.
    Initial(Box<Term>),
    /// The time derivative of a scalar, or of a vector in global axes.
    Rate(Box<Term>),
    /// The angular velocity of a body against another, or against global axes.
    Spin {
        /// The place of the body that it is measured from.
        from: Option<usize>,
        /// The place of the body that turns.
        to: usize,
    },
    /// The value of a law.
    Law {
        /// The place of the parameter.
        parameter: usize,
        /// Its arguments, scalars.
        arguments: Vec<Term>,
    },
}

/// An angle of a body against another about an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The place of the body that it is measured from.
    pub from: usize,
    /// The place of the body that turns.
    pub to: usize,
    /// The place of the axis among the parameters.
    pub axis: usize,
}

impl Turn {
    /// That of a joint's second body against the first.
    #[must_use]
    pub const fn of_joint(axis: usize) -> Self {
        Self {
            from: 0,
            to: 1,
            axis,
        }
    }
}

impl Term {
    /// The terms that it is made of.
    #[must_use]
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Number(_)
            | Self::Scalar(_)
            | Self::Time
            | Self::Point { .. }
            | Self::Fixed { .. }
            | Self::Normal { .. }
            | Self::Origin(_)
            | Self::Spin { .. }
            | Self::Angle(_) => Vec::new(),
            Self::Components(components) => components.iter().map(|term| &**term).collect(),
            Self::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            Self::Product(a, b) | Self::Dot(a, b) | Self::Cross(a, b) | Self::Direction(a, b) => {
                vec![a, b]
            }
            Self::Onto(_, term)
            | Self::Function(_, term)
            | Self::Initial(term)
            | Self::Rate(term) => vec![term],
            Self::Law { arguments, .. } => arguments.iter().collect(),
        }
    }

    /// Calls `f` with the term and all that it is made of.
    pub fn visit(&self, f: &mut impl FnMut(&Self)) {
        f(self);
        for part in self.parts() {
            part.visit(f);
        }
    }

    /// How large it is; `named` says how large a scalar parameter is, or a law with arguments of
    /// given extents.
    pub fn extent(&self, named: &impl Fn(usize, &[Extent]) -> Extent) -> Extent {
        let parts: Vec<Extent> = self.parts().iter().map(|part| part.extent(named)).collect();
        match (self, parts.as_slice()) {
            (Self::Scalar(parameter) | Self::Law { parameter, .. }, _) => named(*parameter, &parts),
            (Self::Product(..) | Self::Dot(..) | Self::Cross(..), [a, b]) => a.product(*b),
            (Self::Function(..) | Self::Rate(_), [inner]) => inner.function(),
            (Self::Direction(..), _) => Extent::sum(parts).function(),
            // What they hold is a constant.
            (Self::Onto(..) | Self::Initial(_), [inner]) => Extent {
                first: 1.0,
                second: 1.0,
                ..*inner
            },
            _ => Extent::sum(parts),
        }
    }

    /// Whether it depends on where a body is.
    #[must_use]
    pub fn moves(&self) -> bool {
        match self {
            Self::Point { .. }
            | Self::Fixed { .. }
            | Self::Normal { .. }
            | Self::Origin(_)
            | Self::Onto(..)
            | Self::Spin { .. }
            | Self::Angle(_) => true,
            Self::Initial(_) => false,
            _ => self.parts().into_iter().any(Self::moves),
        }
    }

    /// Whether it is a rate itself.
    #[must_use]
    pub const fn is_rate(&self) -> bool {
        matches!(self, Self::Rate(_) | Self::Spin { .. })
    }

    /// Its degree in rates: 0 without any, 1 for what is linear in them, beside a part without.
    /// `None` for everything else.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        let degree = match self {
            Self::Rate(_) | Self::Spin { .. } => 1,
            Self::Sum(terms) => terms
                .iter()
                .try_fold(0, |most, (_, term)| Some(term.degree()?.max(most)))?,
            Self::Product(a, b) | Self::Dot(a, b) | Self::Cross(a, b) => {
                a.degree()? + b.degree()?
            }
            Self::Components(components) => components
                .iter()
                .try_fold(0, |most, term| Some(term.degree()?.max(most)))?,
            other if other.has(Self::is_rate) => return None,
            _ => 0,
        };
        (degree <= 1).then_some(degree)
    }

    /// Whether every term of what is linear in rates holds one.
    fn is_homogeneous(&self) -> bool {
        match self {
            Self::Sum(terms) => terms.iter().all(|(_, term)| term.is_homogeneous()),
            Self::Product(a, b) | Self::Dot(a, b) | Self::Cross(a, b) => {
                a.is_homogeneous() || b.is_homogeneous()
            }
            Self::Components(components) => components
                .iter()
                .all(|term| term.is_homogeneous() || matches!(**term, Self::Number(0.0))),
            other => other.is_rate(),
        }
    }

    /// Whether something in it fulfils a condition.
    pub fn has(&self, wanted: impl Fn(&Self) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |term| found |= wanted(term));
        found
    }
}

/// How large an expression is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Terms to look at for its value: all of them.
    pub size: f64,
    /// Terms to look at, again and again, for its first derivative.
    pub first: f64,
    /// Terms to look at, again and again, for its second derivative.
    pub second: f64,
    /// Terms within terms.
    pub depth: f64,
}

impl Extent {
    /// A term that holds no others.
    pub const ONE: Self = Self {
        size: 1.0,
        first: 1.0,
        second: 1.0,
        depth: 1.0,
    };
    /// The largest expression or definition: beyond it, expansion takes minutes.
    pub const MOST: Self = Self {
        size: 20_000.0,
        first: 40_000.0,
        second: 40_000.0,
        depth: 500.0,
    };

    /// A sum.
    pub fn sum(terms: impl IntoIterator<Item = Self>) -> Self {
        let whole = terms.into_iter().fold(Self::ONE, Self::beside);
        Self {
            depth: whole.depth + 1.0,
            ..whole
        }
    }

    /// A product of any kind.
    #[must_use]
    pub fn product(self, other: Self) -> Self {
        self.beside(other).function()
    }

    /// A function.
    #[must_use]
    pub fn function(self) -> Self {
        Self {
            size: self.size + 1.0,
            first: self.size + self.first,
            second: self.size + self.first + self.second,
            depth: self.depth + 1.0,
        }
    }

    fn beside(self, other: Self) -> Self {
        Self {
            size: self.size + other.size,
            first: self.first + other.first,
            second: self.second + other.second,
            depth: self.depth.max(other.depth),
        }
    }

    /// Whether it is too large to be worked out.
    #[must_use]
    pub fn is_too_large(self) -> bool {
        let most = Self::MOST;
        self.size > most.size
            || self.first > most.first
            || self.second > most.second
            || self.depth > most.depth
    }
}

/// One constraint, of one or three equations.
#[derive(Clone, Debug, PartialEq)]
pub enum Row {
    /// One equation: the scalar is zero.
    Scalar(Term),
    /// Three equations: the vector is zero.
    Vector(Term),
}

impl Row {
    /// The number of equations.
    #[must_use]
    pub const fn equations(&self) -> usize {
        match self {
            Self::Scalar(_) => 1,
            Self::Vector(_) => 3,
        }
    }

    /// Whether it is an equation of velocities: one that rates stand in.
    #[must_use]
    pub fn is_of_velocities(&self) -> bool {
        self.term().has(Term::is_rate)
    }

    /// Whether it asks for velocities other than zero: an equation of velocities with a part that
    /// holds none, or with a rate by the time itself.
    #[must_use]
    pub fn is_driven(&self) -> bool {
        let changes = |term: &Term| matches!(term, Term::Time | Term::Law { .. });
        self.is_of_velocities() && (self.term().has(changes) || !self.term().is_homogeneous())
    }

    /// What is zero.
    #[must_use]
    pub const fn term(&self) -> &Term {
        match self {
            Self::Scalar(term) | Self::Vector(term) => term,
        }
    }
}

/// What a force does.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A potential energy (J): the force is minus its gradient.
    Potential(Term),
    /// A generalised force along a coordinate: power is effort times the rate of the coordinate.
    Along {
        /// The generalised force.
        effort: Term,
        /// The coordinate.
        coordinate: Term,
    },
    /// A force (N) at a point.
    Force {
        /// The force.
        vector: Term,
        /// The point: a [`Term::Point`] or [`Term::Origin`].
        point: Term,
    },
    /// A moment (N m) on a body.
    Moment {
        /// The moment.
        vector: Term,
        /// The place of the body.
        body: usize,
    },
}

impl Action {
    /// The expressions of the action.
    #[must_use]
    pub fn terms(&self) -> Vec<&Term> {
        match self {
            Self::Potential(energy) => vec![energy],
            Self::Along { effort, coordinate } => vec![effort, coordinate],
            Self::Force { vector, point } => vec![vector, point],
            Self::Moment { vector, .. } => vec![vector],
        }
    }
}

/// What a definition defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Constraint equations.
    Joint,
    /// Forces and moments.
    Force,
}

impl ElementKind {
    /// The word of the language.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Joint => "joint",
            Self::Force => "force",
        }
    }
}

/// The definition of a joint or a force.
#[derive(Clone, Debug)]
pub struct ElementDef {
    /// Joint or force.
    pub kind: ElementKind,
    /// The name of its type.
    pub name: Ident,
    /// The names of its bodies.
    pub bodies: Vec<Ident>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Its constraints; none of a force.
    pub rows: Vec<Row>,
    /// Its forces; none of a joint.
    pub actions: Vec<Action>,
    /// The angle that can be read, of its second body against its first.
    pub angle: Option<Turn>,
    /// The axes of the two angles that can be read, in their order: `None` but for a joint of two
    /// bodies that leaves the turns about them, the second carried by the first.
    pub angles: Option<[usize; 2]>,
    /// The displacement that can be read.
    pub displacement: Option<Term>,
    /// Where the second of its bodies touches the first: the point, the normal, and the velocity of
    /// the material of the second there against that of the first.
    pub contact: Option<[Term; 3]>,
    /// What is positive on the side that is meant, of the configurations that satisfy its
    /// equations.
    pub requirements: Vec<Term>,
    /// The motions that it leaves free, of its second body against its first: each carries those
    /// behind it. `None` where the definition does not say; none are left where it says so. What
    /// stands in them is fixed on no body by that: they change nothing in the equations.
    pub motions: Option<Vec<Motion>>,
    /// The place of the row that drives, among its equations.
    pub drive: Option<usize>,
    /// The angles over many turns that it speaks of, in the order of first mention.
    pub turns: Vec<Turn>,
    /// Tells definitions apart.
    pub fingerprint: u64,
    /// Where the name was written.
    pub span: Span,
}

impl ElementDef {
    /// The number of its equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.rows.iter().map(Row::equations).sum()
    }

    /// How large it is, where laws are of given extents, with arguments of given extents.
    pub fn extent(&self, law: &impl Fn(usize, &[Extent]) -> Extent) -> Extent {
        let mut defaults: Vec<Option<Extent>> = Vec::new();
        let named = |defaults: &[Option<Extent>], parameter: usize, arguments: &[Extent]| match self
            .parameters[parameter]
            .kind
        {
            ParameterKind::Law => law(parameter, arguments),
            _ => {
                let known = defaults.get(parameter).copied().flatten();
                known.unwrap_or(Extent::ONE)
            }
        };
        for parameter in &self.parameters {
            let default = parameter.default.as_ref();
            let extent = default.map(|term| term.extent(&|p, parts| named(&defaults, p, parts)));
            defaults.push(extent);
        }
        let terms = self.terms();
        Extent::sum(terms.map(|term| term.extent(&|p, parts| named(&defaults, p, parts))))
    }

    /// All its expressions.
    pub fn terms(&self) -> impl Iterator<Item = &Term> {
        let rows = self.rows.iter().map(Row::term);
        let actions = self.actions.iter().flat_map(Action::terms);
        let readings = self.displacement.iter().chain(&self.requirements);
        let contact = self.contact.iter().flatten();
        rows.chain(actions).chain(readings).chain(contact)
    }

    /// The first body on which a vector parameter is used; the first of all if it is used nowhere.
    #[must_use]
    pub fn first_body_of(&self, parameter: usize) -> usize {
        self.bodies_of(parameter).first().copied().unwrap_or(0)
    }

    /// The bodies on which a vector parameter is used.
    #[must_use]
    pub fn bodies_of(&self, parameter: usize) -> BTreeSet<usize> {
        let mut bodies = BTreeSet::new();
        let mut meet = |body: usize| {
            bodies.insert(body);
        };
        let turns = self.turns.iter().chain(&self.angle);
        for turn in turns.filter(|turn| turn.axis == parameter) {
            meet(turn.from);
            meet(turn.to);
        }
        let defaults = self.parameters.iter().filter_map(|p| p.default.as_ref());
        for term in self.terms().chain(defaults) {
            term.visit(&mut |term| match term {
                Term::Point { body, parameter: p }
                | Term::Fixed { body, parameter: p }
                | Term::Normal {
                    body, parameter: p, ..
                } if *p == parameter => {
                    meet(*body);
                }
                Term::Angle(turn) if turn.axis == parameter => {
                    meet(turn.from);
                    meet(turn.to);
                }
                _ => (),
            });
        }
        bodies
    }

    /// The place of the parameter at whose point reactions are given.
    #[must_use]
    pub fn reaction_point(&self) -> Option<usize> {
        self.parameters
            .iter()
            .position(|p| p.kind == ParameterKind::Point)
    }
}
