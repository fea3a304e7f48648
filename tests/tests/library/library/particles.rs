//! Point masses in joints.

use holonom_assembler::joints::Joint;

use super::Entry;
use crate::freedom;

/// With a particle as the second body, or as the first where nothing but a point is fixed on it.
macro_rules! particle {
    (
        second: $equations:literal $joint:ident $attributes:tt,
        |$s:ident, $b:ident, $d:ident| $assemble:expr,
        |$p:ident, $f:ident| $free:expr $(,)?
    ) => {
        Entry {
            name: concat!(stringify!($joint), " of a particle"),
            equations: $equations,
            placements: vec![
                placement! { param [i bead] [i, bead] [I, Bead] $joint $attributes },
                placement! { literal [bead] [ground, bead] [Ground, Bead] $joint $attributes },
            ],
            assemble: |$s, $b, $d| {
                let &[i, j] = $b else {
                    unreachable!("two bodies")
                };
                let $b = [i, j];
                $assemble
            },
            free: Some(|$p, $f| $free),
        }
    };
    (
        first: $equations:literal $joint:ident $attributes:tt,
        |$s:ident, $b:ident, $d:ident| $assemble:expr,
        |$p:ident, $f:ident| $free:expr $(,)?
    ) => {
        Entry {
            name: concat!(stringify!($joint), " with a particle"),
            equations: $equations,
            placements: vec![
                placement! { param [bead j] [bead, j] [Bead, J] $joint $attributes },
                placement! { literal [bead] [bead, ground] [Bead, Ground] $joint $attributes },
            ],
            assemble: |$s, $b, $d| {
                let &[i, j] = $b else {
                    unreachable!("two bodies")
                };
                let $b = [i, j];
                $assemble
            },
            free: Some(|$p, $f| $free),
        }
    };
}

pub(super) fn entries() -> Vec<Entry> {
    vec![
        particle! {
            second: 3 Spherical { point = centre },
            |s, b, d| Joint::spherical(s, b, d.centre()),
            |p, d| freedom::spherical(p, [d.centre()]),
        },
        particle! {
            second: 1 Distance { head = head, tail = centre },
            |s, b, d| Joint::distance(s, b, d.head, d.centre(), None),
            |p, d| freedom::distance(p, [d.head, d.centre()]),
        },
        particle! {
            first: 3 Spherical { point = centre },
            |s, b, d| Joint::spherical(s, b, d.centre()),
            |p, d| freedom::spherical(p, [d.centre()]),
        },
        particle! {
            first: 1 Distance { head = centre, tail = tail },
            |s, b, d| Joint::distance(s, b, d.centre(), d.tail, None),
            |p, d| freedom::distance(p, [d.centre(), d.tail]),
        },
        particle! {
            second: 2 PointOnLine { point = centre, axis = a },
            |s, b, d| Joint::point_on_line(s, b, d.centre(), d.a),
            |p, d| freedom::point_on_line(p, [d.centre(), d.a]),
        },
        particle! {
            second: 1 PointOnPlane { point = centre, normal = a },
            |s, b, d| Joint::point_on_plane(s, b, d.centre(), d.a),
            |p, d| freedom::point_on_plane(p, [d.centre(), d.a]),
        },
    ]
}
