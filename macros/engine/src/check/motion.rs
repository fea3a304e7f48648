//! What a definition says of how its joint moves: names bound.

use proc_macro2::Ident;
use syn::{Expr, Member};

use super::expression::Context;
use crate::diag::{Faults, code, did_you_mean};
use crate::model::{Direction, Motion, ParameterKind, Turn};
use crate::syntax::motion::{MotionKind, MotionSyntax};
use crate::syntax::ungroup;

impl Context<'_> {
    /// The motions that can be understood; of the others the faults tell.
    pub(super) fn motions(&self, written: &[MotionSyntax], faults: &mut Faults) -> Vec<Motion> {
        let motions = written.iter().filter_map(|motion| match &motion.kind {
            MotionKind::Turn { axis, point } => {
                let (axis, point) = (self.direction(axis, faults), self.place(point, faults));
                Some(Motion::Turn {
                    axis: axis?,
                    point: point?,
                })
            }
            MotionKind::Slide { along } => {
                let along = self.direction(along, faults)?;
                Some(Motion::Slide { along })
            }
            MotionKind::Screw { axis, point, pitch } => {
                let (axis, point) = (self.counted_axis(axis, faults), self.place(point, faults));
                let pitch = self.named(pitch, ParameterKind::Length, faults);
                Some(Motion::Screw {
                    axis: axis?,
                    point: point?,
                    pitch: pitch?,
                })
            }
            MotionKind::Ball { point } => {
                let point = self.place(point, faults)?;
                Some(Motion::Ball { point })
            }
        });
        motions.collect()
    }

    /// An axis, or a normal of one.
    fn direction(&self, expr: &Expr, faults: &mut Faults) -> Option<Direction> {
        let Expr::MethodCall(call) = ungroup(expr) else {
            let parameter = self.named(expr, ParameterKind::Axis, faults)?;
            return Some(Direction::axis(parameter));
        };
        let method = call.method.to_string();
        let normal = match method.as_str() {
            "normal" => Some(0),
            "binormal" => Some(1),
            "normals" => {
                faults.at(
                    &call.method,
                    "a motion has one direction, and `normals()` are two; write `normal()` or `binormal()`",
                );
                None
            }
            _ => {
                faults.at(
                    &call.method,
                    format!("no `{method}` here; an axis has `normal()` and `binormal()`, unit vectors perpendicular to it"),
                );
                None
            }
        };
        if normal.is_some() && !call.args.is_empty() {
            let found = call.args.len();
            faults.at(
                &call.args,
                format!("`{method}()` takes nothing in its parentheses; found {found}"),
            );
        }
        let parameter = self.named(&call.receiver, ParameterKind::Axis, faults)?;
        normal.map(|normal| Direction {
            parameter,
            normal: Some(normal),
        })
    }

    /// An axis about which turns are counted: no normal of one.
    fn counted_axis(&self, expr: &Expr, faults: &mut Faults) -> Option<usize> {
        if let Expr::MethodCall(call) = ungroup(expr) {
            faults.at(
                &call.method,
                "a screw turns about an `Axis` itself, as `angle(..)` does; take a further `Axis` for this direction",
            );
            return None;
        }
        let what = "a screw turns about an `Axis` of the joint";
        self.named_as(expr, ParameterKind::Axis, ("axis", what), faults)
    }

    /// A point.
    fn place(&self, expr: &Expr, faults: &mut Faults) -> Option<usize> {
        self.named(expr, ParameterKind::Point, faults)
    }

    /// A parameter of a kind that a motion speaks of, by its name alone.
    fn named(&self, expr: &Expr, wanted: ParameterKind, faults: &mut Faults) -> Option<usize> {
        let names = match wanted {
            ParameterKind::Point => ("point", "the point of a motion is a `Point` of the joint"),
            ParameterKind::Length => ("length", "the pitch of a screw is a `Length` of the joint"),
            _ => (
                "axis",
                "the direction of a motion is an `Axis` of the joint, or the `normal()` or `binormal()` of one",
            ),
        };
        self.named_as(expr, wanted, names, faults)
    }

    /// The same, by a word for it and what is said where something else stands.
    fn named_as(
        &self,
        expr: &Expr,
        wanted: ParameterKind,
        (word, what): (&str, &str),
        faults: &mut Faults,
    ) -> Option<usize> {
        let known = self.known(|kind| kind == wanted);
        let has = self.has(&known);
        let Some(name) = ident(expr) else {
            let message = match self.on_a_body(expr, wanted) {
                Some(name) if wanted == ParameterKind::Length => {
                    format!("`{name}` is a number, on no body; write `{name}`")
                }
                Some(name) => format!(
                    "a motion is told in the reference configuration, where both bodies have one `{name}`; write `{name}`"
                ),
                None => format!("{what}, and {has}; found `{}`", code(expr)),
            };
            faults.at(expr, message);
            return None;
        };
        let place = self.parameters.iter().position(|p| p.name == *name);
        if self.ambiguous.contains(&name) {
            return None;
        }
        let message = match place.map(|place| self.parameters[place].kind) {
            Some(kind) if kind == wanted => return place,
            Some(kind) => {
                let mut kinds = ParameterKind::ALL.into_iter();
                let kind = kinds.find(|(_, known)| *known == kind);
                let kind = kind.map_or("parameter", |(word, _)| word);
                let article = if kind.starts_with('A') { "an" } else { "a" };
                format!("{what}, and {has}; `{name}` is {article} `{kind}`")
            }
            None if self.bodies.contains(name) => format!("{what}, and {has}; `{name}` is a body"),
            None => {
                let near = did_you_mean(&name.to_string(), known.iter().map(String::as_str));
                format!("no {word} `{name}`; {has}{near}")
            }
        };
        faults.at(name, message);
        None
    }

    /// The name of a parameter of a kind that is written with a body.
    fn on_a_body<'e>(&self, expr: &'e Expr, wanted: ParameterKind) -> Option<&'e Ident> {
        let Expr::Field(field) = ungroup(expr) else {
            return None;
        };
        let Member::Named(name) = &field.member else {
            return None;
        };
        let is_body = ident(&field.base).is_some_and(|body| self.bodies.contains(body));
        let mut parameters = self.parameters.iter();
        let is_known = parameters.any(|p| p.name == *name && p.kind == wanted);
        (is_body && is_known).then_some(name)
    }
}

fn ident(expr: &Expr) -> Option<&Ident> {
    match ungroup(expr) {
        Expr::Path(path) => path.path.get_ident(),
        _ => None,
    }
}

/// Refuses two angles, about axes by their places and as they are written, that are not those of
/// the two turns of a motion.
pub(super) fn must_turn(
    angles: [usize; 2],
    motions: Option<&[Motion]>,
    written: &[Ident],
    faults: &mut Faults,
) {
    let turns = |motion: &Motion, wanted: usize| match motion {
        Motion::Turn { axis, .. } => axis.normal.is_none() && axis.parameter == wanted,
        _ => false,
    };
    let are_turns = match motions {
        Some([first, second]) => turns(first, angles[0]) && turns(second, angles[1]),
        _ => false,
    };
    if let (false, [first, second]) = (are_turns, written) {
        faults.at(
            first,
            format!(
                "two angles are those of two turns, of which the first carries the second; write `motion turn {first} at .., turn {second} at ..`"
            ),
        );
    }
}

/// Refuses a screw whose turns no equation counts: its displacement depends on them.
pub(super) fn must_count(
    motions: &[Motion],
    written: &[MotionSyntax],
    counted: &[Turn],
    context: &Context<'_>,
    faults: &mut Faults,
) {
    let [first, second] = context.bodies else {
        return;
    };
    for (motion, written) in motions.iter().zip(written) {
        if let Motion::Screw { axis, .. } = *motion
            && !counted.contains(&Turn::of_joint(axis))
        {
            let axis = &context.parameters[axis].name;
            faults.at(
                &written.tokens,
                format!("no equation counts the turns of this screw; write one with `angle({first}, {second}, {axis})`"),
            );
        }
    }
}
