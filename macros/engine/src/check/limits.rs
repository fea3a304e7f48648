//! Limits of joints that leave one coordinate free.

use proc_macro2::Span;
use syn::{Expr, UnOp};

use super::joints::JointChecker;
use super::number::{AT_LIKES, Numbers, elements};
use super::pairs::Pairs;
use crate::diag::Faults;
use crate::model::number::literals;
use crate::model::{ElementDef, ElementKind, Limits, Number};
use crate::syntax::ungroup;

const BOUNDS: &str = "limits";
const RESTITUTION: &str = "restitution";

/// The freedom of a body.
const FREE: usize = 6;

impl JointChecker<'_> {
    /// The limits of a joint, unless `limits` is a parameter of its own.
    pub(super) fn limits(
        &self,
        joint: &ElementDef,
        pairs: &mut Pairs<'_>,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<Limits> {
        let is_taken = |key: &str| joint.parameters.iter().any(|own| own.name == key);
        let is_given = |key: &str, pairs: &Pairs<'_>| !is_taken(key) && pairs.has(key);
        if self.kind == ElementKind::Force {
            return None;
        }
        let has_limits = is_given(BOUNDS, pairs);
        let mut restitution = Some(Number::ZERO);
        numbers.field = self.field.name.clone();
        numbers.no_inputs =
            Some("limits are what they are for the whole run; make it a `#[param]`");
        if is_given(RESTITUTION, pairs) {
            restitution = self.restitution(has_limits, pairs, numbers, faults);
        }
        let mut bounds = None;
        if has_limits {
            bounds = self.bounds(joint, pairs, numbers, faults);
        } else if !is_taken(BOUNDS) && unfit(joint).is_none() {
            // It is among the keys that a joint takes.
            pairs.optional(BOUNDS, faults);
        }
        numbers.no_inputs = None;
        Some(Limits {
            bounds: bounds?,
            restitution: restitution?,
        })
    }

    fn restitution(
        &self,
        has_limits: bool,
        pairs: &mut Pairs<'_>,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<Number> {
        let at = self.key(RESTITUTION);
        let expr = pairs.optional(RESTITUTION, faults);
        if !has_limits {
            faults.at_span(
                at,
                "`restitution` says how the limits of a joint throw it back, and this one has none; give them, as in `limits = [-1.0, 1.0]`",
            );
        }
        let expr = expr?;
        numbers.attribute = RESTITUTION.into();
        let number = numbers.scalar(expr, faults)?;
        if let Some([value]) = numbers.all_seen(&[number])
            && !(0.0..=1.0).contains(&value)
        {
            let name = &self.field.name;
            let place = place_of(&[number]);
            faults.at(
                expr,
                format!(
                    "the restitution of `{name}` is {value}{place}; it is the rate after an impact over the one before, from 0.0 to 1.0"
                ),
            );
            return None;
        }
        Some(number)
    }

    fn bounds(
        &self,
        joint: &ElementDef,
        pairs: &mut Pairs<'_>,
        numbers: &mut Numbers<'_>,
        faults: &mut Faults,
    ) -> Option<[Number; 2]> {
        let expr = pairs.optional(BOUNDS, faults);
        if let Some(reason) = unfit(joint) {
            faults.at_span(self.key(BOUNDS), reason);
            return None;
        }
        let expr = expr?;
        let both = elements(expr).filter(|both| both.len() == 2);
        let Some([lower, upper]) = both.as_deref() else {
            let unit = unit(joint);
            faults.at(
                expr,
                format!(
                    "`limits` takes two numbers ({unit}), the lower and the upper one, as in `limits = [-1.0, 1.0]`"
                ),
            );
            return None;
        };
        numbers.attribute = BOUNDS.into();
        let mut bound = |expr: &Expr| {
            if is_not_finite(expr) {
                faults.at(
                    expr,
                    "limits are finite; a run takes a single stop as one of its `interactions`: `Interaction::limits(.., [0.0, f64::INFINITY])`",
                );
                return None;
            }
            numbers.scalar(expr, faults)
        };
        let both = [bound(lower), bound(upper)];
        let [Some(lower), Some(upper)] = both else {
            return None;
        };
        let bounds = [lower, upper];
        if let Some([lower, upper]) = numbers.all_seen(&bounds)
            && lower >= upper
        {
            let name = &self.field.name;
            let place = place_of(&bounds);
            faults.at(
                expr,
                format!(
                    "the lower limit of `{name}` is {lower} and the upper one {upper}{place}; the lower one comes first and is less"
                ),
            );
            return None;
        }
        Some(bounds)
    }

    /// Where a key is written.
    fn key(&self, key: &str) -> Span {
        let written = self.field.list.pairs.iter().find(|pair| pair.key == key);
        written.map_or(self.word, |pair| pair.key.span())
    }
}

/// Where numbers are what a message says that they are.
fn place_of<const N: usize>(numbers: &[Number; N]) -> &'static str {
    match literals(numbers) {
        Some(_) => "",
        None => AT_LIKES,
    }
}

fn unit(joint: &ElementDef) -> &'static str {
    if joint.angle.is_some() { "rad" } else { "m" }
}

/// Why a joint cannot have limits.
fn unfit(joint: &ElementDef) -> Option<String> {
    let name = &joint.name;
    let has_reading = joint.angle.is_some() || joint.displacement.is_some();
    let is_pair = joint.bodies.len() == 2;
    let free = FREE.saturating_sub(joint.equations());
    if is_pair && free == 1 && has_reading {
        return None;
    }
    if is_pair && free == 1 {
        return Some(format!(
            "`limits` hold an angle or a displacement, and `{name}` names none; write `angle about ..` or `displacement ..` in its definition"
        ));
    }
    let found = match (is_pair, free) {
        (false, _) => format!("`{name}` connects {} bodies", joint.bodies.len()),
        (true, 0) => format!("`{name}` leaves none"),
        (true, free) => format!("`{name}` leaves {free}"),
    };
    let way = if has_reading {
        "; a run takes limits of one of them as one of its `interactions`"
    } else {
        ""
    };
    Some(format!(
        "`limits` are for joints that leave one coordinate free, such as `Revolute`, `Prismatic` and `Screw`; {found}{way}"
    ))
}

/// Whether an expression names a number that is not finite.
fn is_not_finite(expr: &Expr) -> bool {
    match ungroup(expr) {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => is_not_finite(&unary.expr),
        Expr::Path(path) => path.path.segments.last().is_some_and(|last| {
            ["INFINITY", "NEG_INFINITY", "NAN"]
                .iter()
                .any(|name| last.ident == name)
        }),
        _ => false,
    }
}
