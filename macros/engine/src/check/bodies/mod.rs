//! Bodies: mass, inertia, where they stand and how they move at the start.
//!
//! - `inertia.rs`: moments and tensors; `rotation.rs`: orientations, as they are written;
//!   `leading.rs`: those that lead an axis to a direction.
//! - `shape.rs`: shapes as they are written; `volume.rs`: their formulas, which `formula.rs` puts
//!   together as expressions; `mesh.rs`: shapes in files; `solid.rs`: what follows for a body, of
//!   several by `lumps.rs`; `looks.rs`: where nothing follows, because mass and inertia are given.
//! - `as_given.rs`: those that no body has.

mod as_given;
mod formula;
mod inertia;
mod leading;
mod looks;
mod lumps;
mod mesh;
mod reader;
mod rotation;
mod shape;
mod solid;
mod volume;

use proc_macro2::Span;
use syn::Expr;

pub(super) use self::as_given::coordinates;
pub use self::as_given::judged;
use self::reader::{AS_GIVEN, Reader};
use self::solid::Solid;
use super::number::Numbers;
use super::pairs::Pairs;
use super::turning::Turn;
use crate::diag::Faults;
use crate::model::inertia::{IDENTITY, compose};
use crate::model::{Body, BodyKind, Name, Number};
use crate::syntax::List;

/// Checks the attribute of a body.
pub fn check(
    name: &Name,
    kind: BodyKind,
    owner: Span,
    written: &List,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Option<Body> {
    let mut pairs = Pairs::new(format!("body `{name}`"), owner, written);
    let mut reader = Reader {
        name,
        numbers,
        faults,
        as_given: false,
    };
    let solid = match kind {
        BodyKind::Rigid if is_shaped(&pairs) => reader.solid(&mut pairs, owner),
        BodyKind::Rigid => reader.measured(&mut pairs),
        BodyKind::Particle => reader.particle(&mut pairs),
    };
    let mut vector = |key: &str| reader.optional_vector(&mut pairs, key);
    let velocity = vector("velocity");
    let angular_velocity = match kind {
        BodyKind::Rigid => vector("angular_velocity"),
        BodyKind::Particle => Some([Number::ZERO; 3]),
    };
    let free = pairs.flag("free", reader.faults);
    let instead = "write `shape = mesh(file = \"part.stl\", scale = 0.001)`, with the m of a unit of the file";
    pairs.refuse("mesh", instead, reader.faults);
    pairs.finish(reader.faults);
    let solid = solid?;
    Some(Body {
        name: name.clone(),
        kind,
        mass: solid.mass,
        inertia: solid.inertia,
        user_axes: solid.user_axes,
        position: solid.position,
        orientation: solid.orientation,
        velocity: velocity?,
        angular_velocity: angular_velocity?,
        free,
        as_given: solid.as_given,
        shapes: solid.shapes,
    })
}

/// Whether the body follows from shapes. Beside a mass and an inertia they are only drawn.
fn is_shaped(pairs: &Pairs<'_>) -> bool {
    let has_shapes = pairs.has("shape") || pairs.has("shapes");
    has_shapes && !(pairs.has("mass") && pairs.has("inertia"))
}

/// Euler parameters of a rotation that the macro can see, in the attribute of a field.
pub(super) fn rotation(
    name: &Name,
    attribute: &str,
    expr: &Expr,
    numbers: &mut Numbers<'_>,
    faults: &mut Faults,
) -> Option<Turn> {
    let mut reader = Reader {
        name,
        numbers,
        faults,
        as_given: false,
    };
    reader.at(attribute);
    reader.turn(expr)
}

/// What stands in the place of a port as long as nobody says which body it is.
#[must_use]
pub fn port(name: &Name) -> Body {
    Body {
        name: name.clone(),
        kind: BodyKind::Rigid,
        mass: Number::ONE,
        inertia: [Number::ONE; 3],
        user_axes: IDENTITY,
        position: [Number::ZERO; 3],
        orientation: IDENTITY.map(Number::Literal),
        velocity: [Number::ZERO; 3],
        angular_velocity: [Number::ZERO; 3],
        free: true,
        as_given: false,
        shapes: Vec::new(),
    }
}

impl Reader<'_, '_> {
    /// A body whose mass and inertia are given.
    fn measured(&mut self, pairs: &mut Pairs<'_>) -> Option<Solid> {
        self.as_given = pairs.has(AS_GIVEN);
        let mass = self.required_mass(pairs);
        let example = "principal moments as in `inertia = [0.1, 0.1, 0.01]` (kg m^2), or a `shape`, or make it a `Particle`";
        let inertia = pairs.required("inertia", example, self.faults);
        let inertia = inertia.and_then(|expr| self.inertia(expr));
        let axes = match pairs.optional("inertia_axes", self.faults) {
            Some(axes) => {
                self.at("inertia_axes");
                self.seen_turn("`inertia_axes`", axes)
            }
            None => Some(IDENTITY),
        };
        let written = ["shape", "shapes"].map(|key| pairs.optional(key, self.faults));
        pairs.refuse("density", "it belongs to a `shape`", self.faults);
        let position = self.optional_vector(pairs, "position");
        let orientation = match pairs.optional("orientation", self.faults) {
            Some(orientation) => self.orientation("orientation", orientation),
            None => Some(IDENTITY.map(Number::Literal)),
        };
        let as_given = pairs.flag(AS_GIVEN, self.faults);
        let shapes = self.looks(written, position, orientation);
        let ((inertia, principal_axes), [e0, e1, e2, e3]) = (inertia?, axes?);
        Some(Solid {
            mass: mass?,
            inertia,
            user_axes: compose(principal_axes, [e0, -e1, -e2, -e3]),
            position: position?,
            orientation: orientation?,
            shapes: shapes?,
            as_given,
        })
    }

    fn particle(&mut self, pairs: &mut Pairs<'_>) -> Option<Solid> {
        let mass = self.required_mass(pairs);
        let position = self.optional_vector(pairs, "position");
        for key in [
            "inertia",
            "inertia_axes",
            "orientation",
            "angular_velocity",
            "shape",
            "shapes",
            "mesh",
            "density",
            AS_GIVEN,
        ] {
            pairs.refuse(
                key,
                "a `Particle` is a point mass without orientation; make it a `Body`",
                self.faults,
            );
        }
        Some(Solid {
            mass: mass?,
            inertia: [Number::ZERO; 3],
            user_axes: IDENTITY,
            position: position?,
            orientation: IDENTITY.map(Number::Literal),
            shapes: Vec::new(),
            as_given: false,
        })
    }

    fn required_mass(&mut self, pairs: &mut Pairs<'_>) -> Option<Number> {
        let mass = pairs.required("mass", "a mass in kg, as in `mass = 7.02`", self.faults);
        mass.and_then(|expr| self.mass(expr))
    }

    fn optional_vector(&mut self, pairs: &mut Pairs<'_>, key: &str) -> Option<[Number; 3]> {
        match pairs.optional(key, self.faults) {
            Some(expr) => self.vector(key, expr),
            None => Some([Number::ZERO; 3]),
        }
    }

    fn vector(&mut self, key: &str, expr: &Expr) -> Option<[Number; 3]> {
        self.at(key);
        self.numbers.vector(expr, self.faults)
    }
}
