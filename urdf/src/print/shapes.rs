//! What a body looks like, in the words of its attribute.

use super::page::{number, vector};
use crate::mechanism::Shape;

/// One `shape`, or several `shapes` in a line each.
pub(super) fn pair(shapes: &[Shape]) -> Option<(&'static str, String)> {
    match shapes {
        [] => None,
        [shape] => Some(("shape", call(shape))),
        _ => {
            let lines = shapes.iter().map(|shape| format!("    {},\n", call(shape)));
            Some(("shapes", format!("[\n{}]", lines.collect::<String>())))
        }
    }
}

fn call(shape: &Shape) -> String {
    match shape {
        Shape::Block { size, at } => {
            format!("block(size = {}, at = {})", vector(size), vector(at))
        }
        Shape::Bar {
            width,
            height,
            from,
            to,
            up,
        } => format!(
            "bar(width = {}, height = {}, from = {}, to = {}, up = {})",
            number(*width),
            number(*height),
            vector(from),
            vector(to),
            vector(up)
        ),
        Shape::Cylinder { radius, from, to } => format!(
            "cylinder(radius = {}, from = {}, to = {})",
            number(*radius),
            vector(from),
            vector(to)
        ),
        Shape::Ball { radius, at } => {
            format!("ball(radius = {}, at = {})", number(*radius), vector(at))
        }
    }
}
