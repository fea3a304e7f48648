//! What a description means: bodies, joints and numbers, names bound, shapes known, independent of
//! how it was written.

mod asked;
pub mod comparison;
mod continuity;
mod counted;
pub mod function;
pub mod inertia;
pub mod joint;
pub mod law;
pub mod mechanism;
pub mod motion;
pub mod name;
pub mod number;
pub mod rank;
pub mod shape;
mod switch;
pub mod value;

pub use asked::Asked;
pub use comparison::Comparison;
pub use function::{Curve, Function};
pub use joint::{
    Action, ElementDef, ElementKind, Extent, Parameter, ParameterKind, Row, Term, Turn,
};
pub use law::{LawTerm, Switch, Switching};
pub use mechanism::{
    Binding, Body, BodyKind, Coordinates, Element, Limits, Model, NamedPoint, Part, UserState,
};
pub use motion::{Direction, Motion};
pub use name::Name;
pub use number::{Number, Symbol};
pub use rank::{Components, Contradiction, Independence, Rank, Redundant, RedundantRow};
pub use shape::{Shape, ShapeKind};
pub use value::{RunTimeValue, Spline, Table, ValueKind, first_further};
