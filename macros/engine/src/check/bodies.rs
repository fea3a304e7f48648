//! Bodies: mass, inertia, where they stand and how they move at the start.

use proc_macro2::Span;
use syn::Expr;

use super::number::{AT_LIKES, Numbers, elements};
use super::pairs::Pairs;
use crate::diag::Faults;
use crate::model::inertia::{IDENTITY, principal};
use crate::model::number::literals;
use crate::model::{Body, BodyKind, Name, Number};
use crate::syntax::{List, ungroup};

/// What a link without a mass may have: base parameters tell no more of it.
const MASS_MOVES: &str = "; a mass at a point on the axis of a hinge may be counted to either of its bodies: take \
     some from the other one, and no motion changes";

/// The same of moments, which measurements, taken link by link, get wrong by what motions do not
/// tell.
const MOMENTS_MOVE: &str = "; if they were measured, raise both moments across the axis of a hinge by one amount and \
     take it from the other body of the hinge, unless that is the ground: no motion changes";

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
    };
    let mass = pairs.required("mass", "a mass in kg, as in `mass = 7.02`", reader.faults);
    let mass = mass.and_then(|expr| reader.mass(expr));
    let rigid = kind == BodyKind::Rigid;
    let (mut inertia, mut user_axes) = (Some([Number::ZERO; 3]), IDENTITY);
    if rigid {
        let example = "principal moments as in `inertia = [0.1, 0.1, 0.01]` (kg m^2), or make it a `Particle`";
        let expr = pairs.required("inertia", example, reader.faults);
        let found = expr.and_then(|expr| reader.inertia(expr));
        inertia = found.map(|(moments, _)| moments);
        user_axes = found.map_or(IDENTITY, |(_, axes)| axes);
    }
    let mut vector =
        |key: &str, reader: &mut Reader<'_, '_>| match pairs.optional(key, reader.faults) {
            Some(expr) => reader.vector(key, expr),
            None => Some([Number::ZERO; 3]),
        };
    let position = vector("position", &mut reader);
    let velocity = vector("velocity", &mut reader);
    let mut angular_velocity = Some([Number::ZERO; 3]);
    let mut orientation = Some([Number::ONE, Number::ZERO, Number::ZERO, Number::ZERO]);
    if rigid {
        angular_velocity = vector("angular_velocity", &mut reader);
        if let Some(expr) = pairs.optional("orientation", reader.faults) {
            orientation = reader.orientation(expr);
        }
    } else {
        for key in ["inertia", "orientation", "angular_velocity"] {
            pairs.refuse(
                key,
                "a `Particle` is a point mass without orientation; make it a `Body`",
                reader.faults,
            );
        }
    }
    let free = pairs.flag("free", reader.faults);
    pairs.finish(reader.faults);
    Some(Body {
        name: name.clone(),
        kind,
        mass: mass?,
        inertia: inertia?,
        user_axes,
        position: position?,
        orientation: orientation?,
        velocity: velocity?,
        angular_velocity: angular_velocity?,
        free,
    })
}

struct Reader<'a, 'b> {
    name: &'a Name,
    numbers: &'a mut Numbers<'b>,
    faults: &'a mut Faults,
}

impl Reader<'_, '_> {
    fn at(&mut self, attribute: &str) {
        self.numbers.field = self.name.clone();
        self.numbers.attribute = attribute.into();
    }

    fn mass(&mut self, expr: &Expr) -> Option<Number> {
        self.at("mass");
        let mass = self.numbers.scalar(expr, self.faults)?;
        if let Some(value) = self.numbers.seen(mass).filter(|&value| value <= 0.0) {
            let place = place_of(&[mass]);
            let instead = if value == 0.0 { MASS_MOVES } else { "" };
            self.faults.advised(
                expr,
                format!(
                    "the mass of `{}` must be positive, in kg; this is {value}{place}",
                    self.name
                ),
                instead,
            );
            return None;
        }
        Some(mass)
    }

    fn vector(&mut self, key: &str, expr: &Expr) -> Option<[Number; 3]> {
        self.at(key);
        self.numbers.vector(expr, self.faults)
    }

    /// Three principal moments, or three rows of a full tensor.
    fn inertia(&mut self, expr: &Expr) -> Option<([Number; 3], [f64; 4])> {
        self.at("inertia");
        let Some(rows) = elements(expr) else {
            self.faults.at(
                expr,
                "expected three principal moments as in `[0.1, 0.1, 0.01]`, or the full tensor as three such rows",
            );
            return None;
        };
        let is_tensor = rows.iter().any(|row| elements(row).is_some());
        let (moments, axes) = if is_tensor {
            let tensor = self.tensor(expr, &rows)?;
            let (moments, axes) = principal(tensor);
            (moments.map(Number::Literal), axes)
        } else {
            (self.numbers.array(expr, self.faults)?, IDENTITY)
        };
        let (name, place) = (self.name, place_of(&moments));
        let seen = moments.map(|moment| self.numbers.seen(moment));
        if seen.iter().any(|m| m.is_some_and(|moment| moment <= 0.0)) {
            let is_measured = |m: &Option<f64>| m.is_none_or(|moment| moment >= 0.0);
            let instead = if seen.iter().all(is_measured) {
                MOMENTS_MOVE
            } else {
                ""
            };
            let found = seen.map(|m| m.map_or("..".into(), |m| brief(m).to_string()));
            self.faults.advised(
                expr,
                format!(
                    "the moments of inertia of `{name}` must be positive, in kg m^2; these are {}{place}; a point mass is a \
                     `Particle`",
                    found.join(", ")
                ),
                instead,
            );
            return None;
        }
        if let [Some(a), Some(b), Some(c)] = seen {
            let excess = |x: f64, y: f64, z: f64| x > (y + z) * (1.0 + 1e-9);
            if excess(a, b, c) || excess(b, c, a) || excess(c, a, b) {
                let largest = a.max(b).max(c);
                let excess = brief(largest - (a + b + c - largest));
                let [a, b, c] = [a, b, c].map(brief);
                self.faults.advised(
                    expr,
                    format!(
                        "no body has the moments of inertia of `{name}`: of {a}, {b} and {c}{place}, one exceeds the sum of \
                         the others by {excess}; a point mass is a `Particle`"
                    ),
                    MOMENTS_MOVE,
                );
                return None;
            }
        }
        Some((moments, axes))
    }

    fn tensor(&mut self, expr: &Expr, rows: &[&Expr]) -> Option<[[f64; 3]; 3]> {
        if rows.len() != 3 {
            self.faults
                .at(expr, format!("found {} rows; a tensor has 3", rows.len()));
            return None;
        }
        let rows: Vec<Option<[Number; 3]>> = rows
            .iter()
            .map(|row| self.numbers.vector(row, self.faults))
            .collect();
        let rows: Vec<[Number; 3]> = rows.into_iter().collect::<Option<_>>()?;
        let values: Option<Vec<[f64; 3]>> = rows.iter().map(literals).collect();
        let Some(values) = values else {
            self.faults.at(
                expr,
                "a full tensor needs numbers that the macro can see, to find its principal axes; \
                 give principal moments instead",
            );
            return None;
        };
        let tensor: [[f64; 3]; 3] = values.try_into().ok()?;
        for (k, l) in [(0, 1), (0, 2), (1, 2)] {
            let (a, b) = (tensor[k][l], tensor[l][k]);
            if (a - b).abs() > 1e-12 * a.abs().max(b.abs()) {
                self.faults.at(
                    expr,
                    format!("the tensor is not symmetric: {a} stands against {b}"),
                );
                return None;
            }
        }
        Some(tensor)
    }

    /// Four Euler parameters, or `rotation(axis, angle)`.
    fn orientation(&mut self, expr: &Expr) -> Option<[Number; 4]> {
        self.at("orientation");
        if let Expr::Call(call) = ungroup(expr) {
            return self.rotation(call);
        }
        if elements(expr).is_none() {
            self.faults.at(
                expr,
                "expected four Euler parameters, scalar first, as in `[1.0, 0.0, 0.0, 0.0]`, \
                 or `rotation([1.0, 0.0, 0.0], deg(30.0))`",
            );
            return None;
        }
        let p: [Number; 4] = self.numbers.array(expr, self.faults)?;
        let Some(values) = self.numbers.all_seen(&p) else {
            return Some(p);
        };
        let norm = values.iter().map(|e| e * e).sum::<f64>().sqrt();
        if norm == 0.0 {
            let place = place_of(&p);
            self.faults.at(
                expr,
                format!("Euler parameters may be of any length but zero; these are zero{place}"),
            );
            return None;
        }
        Some(match literals(&p) {
            Some(values) => values.map(|e| Number::Literal(e / norm)),
            None => p,
        })
    }

    fn rotation(&mut self, call: &syn::ExprCall) -> Option<[Number; 4]> {
        let is_rotation =
            matches!(ungroup(&call.func), Expr::Path(path) if path.path.is_ident("rotation"));
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let (true, [axis, angle]) = (is_rotation, &arguments[..]) else {
            self.faults.at(
                call,
                "expected `rotation(axis, angle)`, as in `rotation([1.0, 0.0, 0.0], deg(30.0))`",
            );
            return None;
        };
        let vector = self.numbers.vector(axis, self.faults);
        let size = self.numbers.scalar(angle, self.faults);
        let (vector, size) = (vector?, size?);
        let (Some(vector), Some(size)) = (literals(&vector), size.literal()) else {
            self.faults.at(
                call,
                "a rotation needs numbers that the macro can see; give four Euler parameters instead",
            );
            return None;
        };
        let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 {
            self.faults
                .at(axis, "the axis of a rotation must not be the zero vector");
            return None;
        }
        let (sine, cosine) = (0.5 * size).sin_cos();
        let [x, y, z] = vector.map(|component| Number::Literal(sine * component / length));
        Some([Number::Literal(cosine), x, y, z])
    }
}

/// Where numbers are what the macro sees, if that is not everywhere.
fn place_of(numbers: &[Number]) -> &'static str {
    let is_seen_everywhere = numbers.iter().all(|number| number.literal().is_some());
    if is_seen_everywhere { "" } else { AT_LIKES }
}

/// A number to seven digits, for messages: principal moments of a tensor come with round-off.
fn brief(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
