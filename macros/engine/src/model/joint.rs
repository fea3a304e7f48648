//! A joint as it is defined: formal bodies, parameters, rows.

use proc_macro2::{Ident, Span};

/// What a parameter of a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// A point, given once in global axes at the initial configuration, fixed on every body of the joint.
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
}

impl ParameterKind {
    /// All kinds with the names they have in a definition.
    pub const ALL: [(&'static str, Self); 6] = [
        ("Point", Self::Point),
        ("Axis", Self::Axis),
        ("Vector", Self::Vector),
        ("Length", Self::Length),
        ("Angle", Self::Angle),
        ("Number", Self::Number),
    ];

    /// Whether the parameter has three components and a copy on every body.
    #[must_use]
    pub const fn is_vector(self) -> bool {
        matches!(self, Self::Point | Self::Axis | Self::Vector)
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
        }
    }
}

/// A parameter of a joint.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name, which is also the key in a mechanism's attribute.
    pub name: Ident,
    /// What it is.
    pub kind: ParameterKind,
}

/// An expression of a definition; bodies and parameters by their places. Shapes agree.
#[derive(Clone, Debug, PartialEq)]
pub enum Term {
    /// A number.
    Number(f64),
    /// A scalar parameter.
    Scalar(usize),
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
    /// A sum with signs: `true` is minus.
    Sum(Vec<(bool, Term)>),
    /// A product of scalars, or of a scalar (first) and a vector.
    Product(Box<Term>, Box<Term>),
    /// A scalar product.
    Dot(Box<Term>, Box<Term>),
    /// A cross product.
    Cross(Box<Term>, Box<Term>),
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
}

/// The angle of a joint: of its second body against its first, about an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AngleDef {
    /// The place of the axis among the parameters.
    pub axis: usize,
}

/// The definition of a joint.
#[derive(Clone, Debug)]
pub struct JointDef {
    /// The name of its type.
    pub name: Ident,
    /// The names of its bodies.
    pub bodies: Vec<Ident>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Its constraints.
    pub rows: Vec<Row>,
    /// Its angle, if it has one.
    pub angle: Option<AngleDef>,
    /// Tells definitions apart.
    pub fingerprint: u64,
    /// Where the name was written.
    pub span: Span,
}

impl JointDef {
    /// The number of its equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.rows.iter().map(Row::equations).sum()
    }

    /// The place of the parameter at whose point reactions are given.
    #[must_use]
    pub fn reaction_point(&self) -> Option<usize> {
        self.parameters
            .iter()
            .position(|p| p.kind == ParameterKind::Point)
    }
}
