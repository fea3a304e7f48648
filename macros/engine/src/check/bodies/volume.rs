//! Volumes and moments of shapes, as formulas of their sizes.
//!
//! Meriam, Kraige, Bolton, *Engineering Mechanics: Dynamics*, table D/4. `tests/shapes.rs`
//! compares them with integrals.

use std::f64::consts::PI;

use syn::Expr;

use super::formula::{difference, number, product, square, sum, times};
use crate::model::ShapeKind;

/// What a shape encloses, in its own axes, with its length along x.
#[derive(Debug)]
pub(super) struct Volume {
    pub(super) kind: ShapeKind,
    /// See [`ShapeKind`].
    pub(super) sizes: [Expr; 3],
    /// m^3.
    pub(super) volume: Expr,
    /// Moments about the centre of mass, over the mass (m^2).
    pub(super) moments: [Expr; 3],
    /// Where the centre of mass is on the way along its length.
    pub(super) share: f64,
}

pub(super) fn ball(radius: &Expr) -> Volume {
    let squared = square(radius);
    let moment = times(0.4, &squared);
    Volume {
        kind: ShapeKind::Ball,
        sizes: [radius.clone(), number(0.0), number(0.0)],
        volume: times(4.0 / 3.0 * PI, &product(&squared, radius)),
        moments: [moment.clone(), moment.clone(), moment],
        share: 0.5,
    }
}

pub(super) fn block(sizes: [Expr; 3]) -> Volume {
    let [a, b, c] = &sizes;
    let moments = [(b, c), (c, a), (a, b)];
    Volume {
        kind: ShapeKind::Block,
        volume: product(&product(a, b), c),
        moments: moments.map(|(a, b)| times(1.0 / 12.0, &sum(&square(a), &square(b)))),
        sizes,
        share: 0.5,
    }
}

pub(super) fn cylinder(radius: &Expr, long: &Expr) -> Volume {
    Volume {
        kind: ShapeKind::Cylinder,
        sizes: [long.clone(), radius.clone(), number(0.0)],
        ..tube(radius, &number(0.0), long)
    }
}

/// Thin: what its thickness adds to the moments across is left out.
pub(super) fn rod(radius: &Expr, long: &Expr) -> Volume {
    let cylinder = cylinder(radius, long);
    let [along, ..] = &cylinder.moments;
    let across = times(1.0 / 12.0, &square(long));
    Volume {
        moments: [along.clone(), across.clone(), across],
        ..cylinder
    }
}

pub(super) fn tube(outer: &Expr, inner: &Expr, long: &Expr) -> Volume {
    let (thick, thin) = (square(outer), square(inner));
    let both = sum(&thick, &thin);
    let across = sum(&times(0.25, &both), &times(1.0 / 12.0, &square(long)));
    Volume {
        kind: ShapeKind::Tube,
        sizes: [long.clone(), outer.clone(), inner.clone()],
        volume: times(PI, &product(&difference(&thick, &thin), long)),
        moments: [times(0.5, &both), across.clone(), across],
        share: 0.5,
    }
}

pub(super) fn cone(radius: &Expr, long: &Expr) -> Volume {
    let squared = square(radius);
    let across = sum(&times(0.15, &squared), &times(0.0375, &square(long)));
    Volume {
        kind: ShapeKind::Cone,
        sizes: [long.clone(), radius.clone(), number(0.0)],
        volume: times(PI / 3.0, &product(&squared, long)),
        moments: [times(0.3, &squared), across.clone(), across],
        share: 0.25,
    }
}
